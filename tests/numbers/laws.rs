//! Laws that any fold, light and reflectance obey, whatever the code does to obey them.
//!
//! The dense solution of eq. (15) and the reference radiances check the poles and residues that replace it.

use std::f64::consts::PI;
use std::fs;

use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use serde_json::Value;
use vfold::camera::CameraResponse;
use vfold::forward::{FacetModel, Lighting};
use vfold::geometry::{FacetGrid, Fold, Light, Spacing};
use vfold::kernel::mesh::Mesh;
use vfold::paper::bounces::Bounces;
use vfold::paper::{Method, form_factors, nonuniform, respond};
use vfold::response::{ModeLight, Response};
use vfold::score::pearson_distance;
use vfold::spectrum::{Outside, WavelengthGrid, camera, illuminant};

/// Even light on both panels.
const EVEN: ModeLight = ModeLight::Sun([1.0, 1.0]);

/// Folds of a few facets, square to long, narrow to wide open.
fn folds() -> impl Strategy<Value = Fold> {
    (5.0..175.0, 0.2..5.0, 1_usize..6, 1_usize..6).prop_map(|(angle_deg, width, rows, cols)| {
        Fold::new(angle_deg, width, 1.0, FacetGrid { rows, cols }).unwrap()
    })
}

/// The same, and folds with rows that narrow towards the crease or a panel 1 of another depth.
fn any_folds() -> impl Strategy<Value = Fold> {
    (folds(), any::<bool>(), prop::option::of(0.1..10.0)).prop_map(|(fold, graded, depth)| {
        let fold = depth.map_or(fold, |depth| fold.with_panel1_depth(depth).unwrap());
        fold.with_spacing(if graded { Spacing::Graded } else { Spacing::Uniform })
    })
}

/// K of eq. (10), dense, facet order panel, row, column.
fn matrix(fold: &Fold) -> DMatrix<f64> {
    let kernel = form_factors(fold);
    let facets = 2 * fold.facets().len();
    let rows: Vec<_> = (0..facets).flat_map(|facet| kernel.matrix_row(facet)).collect();
    DMatrix::from_row_slice(facets, facets, &rows)
}

/// Poles and residues of the fold with one flat patch per facet.
fn response(fold: &Fold) -> Response {
    respond(Method::Exact, fold, Mesh::Facets, 1e-12).unwrap().0
}

/// Irradiance of all facets of both panels, from poles and residues.
fn irradiance(response: &Response, light: ModeLight, r0: f64, r1: f64) -> DVector<f64> {
    let facets = response.facets();
    let of = |facet: usize| response.irradiance(facet / facets, facet % facets, light, [r0, r1]);
    DVector::from_fn(2 * facets, |facet, _| of(facet))
}

/// Areas of all facets, relative.
fn areas(fold: &Fold) -> DVector<f64> {
    let (FacetGrid { rows, cols }, edges) = (fold.facets(), fold.row_edges());
    DVector::from_fn(2 * rows * cols, |facet, _| {
        let (panel, row) = (facet / (rows * cols), facet / cols % rows);
        edges[panel][row + 1] - edges[panel][row]
    })
}

/// Share of its light that each facet hands on.
fn handed_on(k: &DMatrix<f64>) -> DVector<f64> {
    k * DVector::from_element(k.nrows(), 1.0)
}

/// The same by solving eq. (15) as it stands.
fn dense_irradiance(k: &DMatrix<f64>, direct: &DVector<f64>, r0: f64, r1: f64) -> DVector<f64> {
    let half = k.nrows() / 2;
    let r = DVector::from_fn(k.nrows(), |facet, _| if facet < half { r0 } else { r1 });
    let system = DMatrix::identity(k.nrows(), k.nrows()) - k * DMatrix::from_diagonal(&r);
    system.lu().solve(direct).unwrap()
}

/// A fold under sun and sky, one waveband and one channel.
struct Lit {
    fold: Fold,
    lighting: Lighting,
    k: DMatrix<f64>,
    direct: DVector<f64>,
}

impl Lit {
    /// The sun leans by a share of half the opening.
    fn new(fold: &Fold, lean: f64, sky: f64) -> Self {
        let light = Light::new(fold, 0.5 * lean * fold.angle_deg(), 0.0, sky).unwrap();
        let (k, half, sun) = (matrix(fold), fold.facets().len(), light.panel_irradiance());
        let open = handed_on(&k).map(|sum| 1.0 - sum);
        let direct = DVector::from_fn(2 * half, |facet, _| sun[facet / half] + sky * open[facet]);
        let eye = CameraResponse::from_weights(vec![vec![1.0]]);
        Self { fold: *fold, lighting: Lighting { light, sun: eye.clone(), sky: eye }, k, direct }
    }

    /// One sheet, and a sheet beside a card on either panel, with the reflectances of both panels.
    fn models(&self, r: f64, card: f64) -> [(FacetModel, [f64; 2]); 3] {
        let response = response(&self.fold);
        let beside = |panel| FacetModel::with_card(&response, &self.lighting, panel, vec![card]);
        let sheet = FacetModel::one_sheet(&response, &self.lighting);
        [(sheet, [r, r]), (beside(0), [card, r]), (beside(1), [r, card])]
    }

    /// Irradiance times the reflectances of the panels.
    fn reflected(&self, irradiance: &DVector<f64>, r0: f64, r1: f64) -> DVector<f64> {
        let half = irradiance.len() / 2;
        DVector::from_fn(2 * half, |facet, _| if facet < half { r0 } else { r1 } * irradiance[facet])
    }
}

fn worst_relative(a: &DVector<f64>, b: &DVector<f64>) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max)
}

proptest! {
    /// Paper appendix A rests on this: no facet hands on more light than it has, and none takes any away.
    #[test]
    fn a_facet_hands_on_less_than_it_has(fold in any_folds()) {
        let k = matrix(&fold);
        prop_assert!(k.iter().all(|factor| (0.0..1.0).contains(factor)));
        for (facet, row) in k.row_iter().enumerate() {
            prop_assert!(row.sum() > 0.0 && row.sum() < 1.0, "facet {facet}: {}", row.sum());
        }
    }

    /// What reaches a facet is what reaches its parts, and a facet's own light is the mean of its parts'
    /// light.
    #[test]
    fn parts_of_facets_exchange_what_the_facets_do(fold in folds(), split in 2_usize..4) {
        let FacetGrid { rows, cols } = fold.facets();
        let coarse = form_factors(&fold);
        let finer = FacetGrid { rows: split * rows, cols: split * cols };
        let fine = form_factors(&fold.with_facets(finer).unwrap());
        for (i, j, k) in (0..rows * rows * cols).map(|n| (n / cols / rows, n / cols % rows, n % cols)) {
            let parts = |n: usize| split * n..split * (n + 1);
            let mut sum = 0.0;
            for (from_row, to_row) in parts(i).flat_map(|from| parts(j).map(move |to| (from, to))) {
                for (from, to) in parts(0).flat_map(|from| parts(k).map(move |to| (from, to))) {
                    sum += fine.form_factor(0, from_row, to_row, from.abs_diff(to));
                }
            }
            let whole = coarse.form_factor(0, i, j, k);
            prop_assert!((sum / (split * split) as f64 - whole).abs() < 1e-13, "rows {i} {j}, shift {k}");
        }
    }

    /// What two facets exchange is the same both ways, their areas taken into account.
    #[test]
    fn exchange_is_mutual(fold in any_folds()) {
        let exchange = DMatrix::from_diagonal(&areas(&fold)) * matrix(&fold);
        prop_assert!((&exchange - exchange.transpose()).amax() < 1e-15);
    }

    #[test]
    fn only_the_shape_matters(fold in any_folds(), scale in 1e-3..1e3) {
        let (width, depth) = (scale * fold.width(), scale * fold.depths()[0]);
        let scaled = Fold::new(fold.angle_deg(), width, depth, fold.facets()).unwrap();
        let scaled = scaled.with_panel1_depth(scale * fold.depths()[1]).unwrap().with_spacing(fold.spacing());
        let [a, b] = [&fold, &scaled].map(|fold| irradiance(&response(fold), EVEN, 0.8, 0.8));
        prop_assert!(worst_relative(&a, &b) < 1e-10);
    }

    /// Two panels of any two reflectances under a sun anywhere between them.
    #[test]
    fn poles_and_residues_solve_the_dense_system(
        fold in any_folds(), lean in -0.9..0.9, r0 in 0.0..=1.0, r1 in 0.0..=1.0,
    ) {
        let light = Light::new(&fold, 0.5 * lean * fold.angle_deg(), 0.0, 0.0).unwrap();
        let sun = light.panel_irradiance();
        let half = fold.facets().len();
        let direct = DVector::from_fn(2 * half, |facet, _| sun[facet / half]);
        let dense = dense_irradiance(&matrix(&fold), &direct, r0, r1);
        let short = irradiance(&response(&fold), ModeLight::Sun(sun), r0, r1);
        prop_assert!(worst_relative(&short, &dense) < 1e-10, "{}", worst_relative(&short, &dense));
    }

    /// The model behind the tools: what it sees is reflectance times dense irradiance, under sun and sky
    /// together, for one sheet and for a sheet beside a card on either panel.
    #[test]
    fn the_facet_model_sees_the_dense_solution(
        fold in any_folds(), lean in -0.9..0.9, sky in 0.0..1.0, r in 0.01..=1.0, card in 0.01..=1.0,
    ) {
        let lit = Lit::new(&fold, lean, sky);
        for (model, [r0, r1]) in lit.models(r, card) {
            let seen = model.facet_rgb(&[r]).column(0).into_owned();
            let want = lit.reflected(&dense_irradiance(&lit.k, &lit.direct, r0, r1), r0, r1);
            prop_assert!(worst_relative(&seen, &want) < 1e-9, "{}", worst_relative(&seen, &want));
        }
    }

    /// Eqs. (11) to (14): what it sees of the first bounces is their sum in the dense system, and what it
    /// leaves out is what one more bounce becomes in eq. (15). As few bounces as needed are no more than
    /// that.
    #[test]
    fn the_facet_model_counts_bounces(
        fold in any_folds(),
        lean in -0.9..0.9,
        sky in 0.0..1.0,
        r in 0.01..=1.0,
        card in 0.01..=1.0,
        count in 0_u32..20,
    ) {
        let lit = Lit::new(&fold, lean, sky);
        for (model, [r0, r1]) in lit.models(r, card) {
            let hand_on = |light: &DVector<f64>| &lit.k * lit.reflected(light, r0, r1);
            let (mut bounce, mut sum) = (lit.direct.clone(), lit.direct.clone());
            for _ in 0..count {
                bounce = hand_on(&bounce);
                sum += &bounce;
            }
            let (seen, left_out) = Bounces::First(count).facet_rgb(&model, &[r]);
            let want = lit.reflected(&sum, r0, r1);
            prop_assert!(worst_relative(&seen.column(0).into_owned(), &want) < 1e-9);
            let rest = dense_irradiance(&lit.k, &hand_on(&bounce), r0, r1);
            let missing = rest.component_div(&(sum + &rest)).max();
            prop_assert!((left_out.unwrap().missing - missing).abs() < 1e-9);

            let enough = Bounces::Within(1e-6).facet_rgb(&model, &[r]).1.unwrap();
            prop_assert!(enough.missing <= 1e-6);
            let one_less = enough.count.checked_sub(1);
            let fewer = one_less.map(|count| Bounces::First(count).facet_rgb(&model, &[r]).1);
            prop_assert!(fewer.is_none_or(|fewer| fewer.unwrap().missing > 1e-6));
        }
    }

    #[test]
    fn many_bounces_are_all(fold in any_folds(), r in 0.0..=1.0, card in 0.0..=1.0) {
        for (model, _) in Lit::new(&fold, 0.3, 0.2).models(r, card) {
            let (all, left_out) = Bounces::All.facet_rgb(&model, &[r]);
            prop_assert!(left_out.is_none());
            let (many, _) = Bounces::First(u32::MAX).facet_rgb(&model, &[r]);
            prop_assert!((many - &all).amax() < 1e-12 * all.amax());
        }
    }

    /// Eq. (24) with one reflectance per facet, black and white ones among them, in the light of sun and sky.
    #[test]
    fn facets_of_any_reflectance_solve_the_dense_system(
        fold in any_folds(), lean in -0.9..0.9, sky in 0.0..1.0,
        r in prop::collection::vec(prop_oneof![Just(0.0), 0.0..=1.0, Just(1.0)], 50),
    ) {
        let lit = Lit::new(&fold, lean, sky);
        let r = DVector::from_column_slice(&r[..2 * fold.facets().len()]);
        let system = DMatrix::identity(r.len(), r.len()) - &lit.k * DMatrix::from_diagonal(&r);
        let want = system.lu().solve(&lit.direct).unwrap().component_mul(&r);
        let r = DMatrix::from_columns(&[r]);
        let seen = nonuniform::facet_rgb(&form_factors(&fold), &lit.lighting, &r).unwrap();
        prop_assert!((seen.column(0) - &want).amax() <= 1e-12 * want.amax(), "{}", seen.column(0) - &want);
    }

    /// Even panels are the special case that the poles solve.
    #[test]
    fn facets_of_one_reflectance_are_a_panel(
        fold in any_folds(), lean in -0.9..0.9, sky in 0.0..1.0, r in 0.01..=1.0, card in 0.01..=1.0,
    ) {
        let lit = Lit::new(&fold, lean, sky);
        for (model, [r0, r1]) in lit.models(r, card) {
            let facets = lit.reflected(&DVector::from_element(lit.k.nrows(), 1.0), r0, r1);
            let facets = DMatrix::from_columns(&[facets]);
            let seen = nonuniform::facet_rgb(&form_factors(&fold), &lit.lighting, &facets).unwrap();
            prop_assert!((&seen - model.facet_rgb(&[r])).amax() < 1e-10 * seen.amax());
        }
    }

    /// Each facet sees the sky that the other panel does not hide: its share is one less its row of K.
    #[test]
    fn a_sky_lights_what_the_other_panel_leaves_open(fold in any_folds(), r in 0.0..=1.0) {
        let k = matrix(&fold);
        let open = handed_on(&k).map(|sum| 1.0 - sum);
        let dense = dense_irradiance(&k, &(0.3 * open), r, r);
        let short = irradiance(&response(&fold), ModeLight::Sky(0.3), r, r);
        prop_assert!(worst_relative(&short, &dense) < 1e-9, "{}", worst_relative(&short, &dense));
    }

    /// A sheet inside a uniform sky that reflects everything is as bright as the sky, wherever one looks: the
    /// white furnace. The sun is left out.
    #[test]
    fn a_white_fold_in_a_sky_disappears(fold in any_folds()) {
        let lit = irradiance(&response(&fold), ModeLight::Sky(1.0), 1.0, 1.0);
        prop_assert!(lit.iter().all(|e| (e - 1.0).abs() < 1e-10), "{lit}");
    }

    /// Light absorbed and light that leaves the fold are the light received.
    #[test]
    fn no_light_is_lost_or_gained(
        fold in any_folds(),
        sun in (0.1..1.0, 0.1..1.0),
        r0 in 0.0..=1.0,
        r1 in 0.0..=1.0,
    ) {
        let k = matrix(&fold);
        let half = fold.facets().len();
        let lit = irradiance(&response(&fold), ModeLight::Sun([sun.0, sun.1]), r0, r1);
        let r = |facet: usize| if facet < half { r0 } else { r1 };
        let (area, handed_on) = (areas(&fold), handed_on(&k));
        let absorbed: f64 = (0..2 * half).map(|n| area[n] * (1.0 - r(n)) * lit[n]).sum();
        let leaving: f64 = (0..2 * half).map(|n| area[n] * r(n) * lit[n] * (1.0 - handed_on[n])).sum();
        let received: f64 = (0..2 * half).map(|n| area[n] * if n < half { sun.0 } else { sun.1 }).sum();
        prop_assert!((absorbed + leaving - received).abs() < 1e-10 * received);
    }

    /// Eq. (14): every bounce adds light, and what n bounces leave out shrinks as the largest row sum to the
    /// n.
    #[test]
    fn bounce_after_bounce_approaches_the_response(fold in any_folds(), r in 0.05_f64..=1.0) {
        let k: DMatrix<f64> = r * matrix(&fold);
        let most = handed_on(&k).max();
        let whole = irradiance(&response(&fold), EVEN, r, r);
        let (mut bounce, mut sum) = (DVector::from_element(k.nrows(), 1.0), DVector::zeros(k.nrows()));
        for n in 1..=12 {
            sum += &bounce;
            bounce = &k * bounce;
            prop_assert!(bounce.iter().all(|light| *light > 0.0));
            let rest = (&whole - &sum).amax();
            prop_assert!(rest <= most.powi(n) / (1.0 - most) * (1.0 + 1e-9) + 1e-10, "{n} bounces: {rest}");
        }
    }

    #[test]
    fn a_lighter_sheet_is_brighter(fold in any_folds(), darker in 0.0..1.0, step in 1e-3..1.0) {
        let response = response(&fold);
        let radiance = |r: f64| irradiance(&response, EVEN, r, r) * r;
        let lighter = f64::min(darker + step, 1.0);
        prop_assume!(lighter > darker);
        let (dark, light) = (radiance(darker), radiance(lighter));
        prop_assert!(dark.iter().zip(&light).all(|(dark, light)| dark < light));
    }

    /// A light along the bisecting plane lights both panels by the sine of half the angle.
    #[test]
    fn no_tilt_is_the_bisector(fold in any_folds()) {
        let [e0, e1] = Light::new(&fold, 0.0, 0.0, 0.0).unwrap().panel_irradiance();
        let half = 0.5 * fold.angle_deg().to_radians();
        prop_assert!((e0 - half.sin()).abs() < 1e-15 && (e1 - half.sin()).abs() < 1e-15);
    }

    /// What the camera sees of sun and sky together is what it sees of each: the second helping of sky adds
    /// as much as the first.
    #[test]
    fn sun_and_sky_superpose(fold in any_folds(), sky in 0.01..2.0, r in 0.0..=1.0, lean in -0.9..0.9) {
        let response = response(&fold);
        let rgb = |sky: f64| {
            let light = Light::new(&fold, 0.5 * lean * fold.angle_deg(), 0.0, sky).unwrap();
            FacetModel::one_sheet(&response, &lighting(light)).facet_rgb(&[r; 31])
        };
        let (none, one, two) = (rgb(0.0), rgb(sky), rgb(2.0 * sky));
        prop_assert!((two - &one * 2.0 + none).amax() < 1e-12 * one.amax().max(1.0));
    }

    #[test]
    fn a_black_sheet_is_dark(fold in any_folds(), sky in 0.0..2.0) {
        let light = Light::new(&fold, 0.0, 0.0, sky).unwrap();
        let rgb = FacetModel::one_sheet(&response(&fold), &lighting(light)).facet_rgb(&[0.0; 31]);
        prop_assert!(rgb.iter().all(|value| *value == 0.0));
    }

    /// Eq. (38) has no means in it: greys are alike, and a spectrum is like any multiple of itself.
    #[test]
    fn pearson_distance_sees_no_scale(spectrum in prop::collection::vec(0.01..1.0, 5), scale in 0.1..10.0) {
        let scaled: Vec<_> = spectrum.iter().map(|r| scale * r).collect();
        prop_assert!(pearson_distance(&spectrum, &scaled) < 1e-14);
        prop_assert!(pearson_distance(&[0.2; 5], &[scale; 5]) < 1e-14);
    }
}

/// A camera in daylight, with a bluer sky, on 31 wavebands.
fn lighting(light: Light) -> Lighting {
    let grid = WavelengthGrid::uniform(400.0, 700.0, 10.0).unwrap();
    let power = |spec: &str| illuminant(spec).unwrap().on(&grid, Outside::Refuse).unwrap();
    let channels = camera("canon-5d-mark-ii").unwrap().channels;
    let sensitivities: Vec<_> =
        channels.iter().map(|channel| channel.on(&grid, Outside::Zero).unwrap()).collect();
    let sun = CameraResponse::new(&grid, &sensitivities, &power("D65")).unwrap();
    let sky = sun.to_other_light(&grid, &sensitivities, &power("daylight:10000")).unwrap();
    Lighting { light, sun, sky }
}

/// Lanczos' matrix of this fold is one that nalgebra's eigenvalues are wrong for, by a hundredth.
#[test]
fn a_hard_tridiagonal_matrix() {
    let facets = FacetGrid { rows: 3, cols: 3 };
    let fold = Fold::new(12.692330767814138, 4.241862460768551, 1.0, facets).unwrap();
    let fold = fold.with_panel1_depth(5.262542651803017).unwrap();
    let dense = dense_irradiance(&matrix(&fold), &DVector::from_element(18, 1.0), 0.5, 0.5);
    assert!(worst_relative(&irradiance(&response(&fold), EVEN, 0.5, 0.5), &dense) < 1e-12);
}

/// Flat and facing the sun, a perfect white diffuser gives 1 in the camera's strongest channel; a sky adds
/// its share.
#[test]
fn white_facing_the_sun_is_one() {
    let flat = Fold::new(180.0, 1.0, 1.0, FacetGrid { rows: 2, cols: 2 }).unwrap();
    for (sky, want) in [(0.0, 1.0), (0.25, 1.25)] {
        let light = Light::new(&flat, 0.0, 0.0, sky).unwrap();
        let rgb = FacetModel::one_sheet(&response(&flat), &lighting(light)).facet_rgb(&[1.0; 31]);
        assert!(rgb.row_iter().all(|facet| (facet.max() - want).abs() < 1e-14), "{rgb}");
    }
}

/// Radiances of folds under even light, solved with exact form factors by LU in double precision elsewhere.
#[test]
fn reference_radiances() {
    let text = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/reference/radiance.json"));
    let reference: Value = serde_json::from_str(&text.unwrap()).unwrap();
    for system in reference["systems"].as_array().unwrap() {
        let (angle_deg, n) = (system["theta_deg"].as_f64().unwrap(), system["nx"].as_u64().unwrap() as usize);
        let fold = Fold::new(angle_deg, 1.0, 1.0, FacetGrid { rows: n, cols: n }).unwrap();
        let response = response(&fold);
        for known in system["radiance"].as_array().unwrap() {
            let r = known["r"].as_f64().unwrap();
            for (row, col) in (0..n).flat_map(|row| (0..n / 2).map(move |col| (row, col))) {
                let want = known["L"][row][col].as_f64().unwrap();
                let got = r / PI * response.irradiance(0, row * n + col, EVEN, [r; 2]);
                assert!((got / want - 1.0).abs() < 1e-11, "{angle_deg}° r {r} ({row}, {col}): {got} {want}");
            }
        }
    }
}
