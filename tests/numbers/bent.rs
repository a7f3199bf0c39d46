//! Bent folds against the exact solution of ideal ones, laws, and a rendered photograph.

use std::f64::consts::PI;
use std::fs;
use std::path::PathBuf;

use nalgebra::{Vector2, Vector3};
use ndarray::Array2;
use serde_json::Value;
use vfold::geometry::{FacetGrid, Fold, LightSource, StandardSky};
use vfold::image::{
    Grid, Homography, LensEstimate, Marked, Photograph, Point, ReadOptions, measure, refine as refine_corners,
};
use vfold::kernel::bent::{BentExchange, BentFold, View};
use vfold::kernel::environment::{Environment, Surroundings, facet_radiances};
use vfold::kernel::mesh::Mesh;
use vfold::kernel::refinement::refine;
use vfold::response::ModeLight;
use vfold::surfaces::kernel::refinement::solve;

const GRID: FacetGrid = FacetGrid { rows: 10, cols: 10 };

fn fold(angle_deg: f64) -> Fold {
    Fold::new(angle_deg, 1.0, 1.0, GRID).unwrap()
}

/// Ten albedos at the Chebyshev nodes of [0, 1].
fn nodes() -> Vec<f64> {
    (0..10).map(|n| 0.5 - 0.5 * (PI * (f64::from(n) + 0.5) / 10.0).cos()).collect()
}

/// Towards a sun that leans by `tilt_deg` towards panel 1.
fn sun(tilt_deg: f64) -> Vector3<f64> {
    let (sin, cos) = tilt_deg.to_radians().sin_cos();
    Vector3::new(sin, 0.0, cos)
}

/// Facet radiance of an ideal fold, to 1e-5.
fn exact(angle_deg: f64, tilt_deg: f64, albedos: &[f64]) -> Array2<f64> {
    let fold = fold(angle_deg);
    let response = refine(&fold, 1e-5).unwrap().response;
    let light =
        ModeLight::Sun([1.0, -1.0].map(|side| (angle_deg / 2.0 + side * tilt_deg).to_radians().sin()));
    Array2::from_shape_fn((200, albedos.len()), |(facet, node)| {
        albedos[node] * response.irradiance(facet / 100, facet % 100, light, [albedos[node]; 2])
    })
}

/// Largest relative difference in the rows at the crease, and in the others.
fn worst(got: &Array2<f64>, want: &Array2<f64>) -> [f64; 2] {
    let mut worst = [0.0_f64; 2];
    for ((facet, node), want) in want.indexed_iter() {
        let at = usize::from(facet % 100 >= 10);
        worst[at] = worst[at].max((got[(facet, node)] / want - 1.0).abs());
    }
    worst
}

#[test]
fn an_ideal_fold_has_the_exact_solution() {
    for (angle_deg, tilt_deg) in [(48.0, 0.0), (48.0, 5.0), (30.0, 0.0), (72.0, 2.0)] {
        let got =
            BentFold::ideal(angle_deg).facet_radiance(&fold(angle_deg), sun(tilt_deg), &nodes()).unwrap();
        let [crease, others] = worst(&got, &exact(angle_deg, tilt_deg, &nodes()));
        println!("{angle_deg}° {tilt_deg}°: {crease:.5} {others:.5}");
        let coarse = 48.0 / angle_deg;
        assert!(
            crease < 0.08 * coarse * coarse && others < 0.035 * coarse * coarse,
            "{angle_deg}: {crease} {others}"
        );
    }
}

/// What a lamp changes of the sun's light, against the same fold as any surface, in the columns at the middle
/// of the crease.
#[test]
fn a_lamp_near_by_is_that_of_the_exact_solution() {
    let grid = FacetGrid { rows: 5, cols: 5 };
    let fold = Fold::new(60.0, 1.0, 1.0, grid).unwrap();
    let (distance, albedo) = (5.0, 0.8);
    let height = 0.5 * 30_f64.to_radians().cos();
    let exchange = BentExchange::new(&BentFold::ideal(60.0), &fold, Vector3::z());
    let lamp = (Vector2::new(0.0, height), distance);
    let near = exchange.radiance_by_lamp(Vector3::z(), lamp, &[albedo]).unwrap();
    let got = near / exchange.facet_radiance(Vector3::z(), &[albedo]).unwrap();
    let sources = [
        LightSource::point([0.0, 0.0, height + distance], 1.0, distance).unwrap(),
        LightSource::directional([0.0, 0.0, 1.0], 1.0).unwrap(),
    ];
    let solved = solve(&fold.shape().unwrap(), &sources, Mesh::Auto, 5e-3).unwrap();
    let [lamp, sun] = [0, 1].map(|n| &solved.responses[n]);
    for facet in (2..50).step_by(5) {
        let want = lamp.irradiance(facet, albedo) / sun.irradiance(facet, albedo);
        assert!((got[(facet, 0)] / want - 1.0).abs() < 8e-3, "{facet}: {} for {want}", got[(facet, 0)]);
    }
    assert!(got[(22, 0)] / got[(2, 0)] > 1.2, "the outer row is nearer to the lamp");
}

#[test]
fn the_derivative_by_angle_is_that_of_the_exact_solution() {
    let albedos = nodes();
    let bent = |angle_deg: f64| {
        BentFold::ideal(angle_deg).facet_radiance(&fold(angle_deg), sun(0.0), &albedos).unwrap()
    };
    let got = bent(49.0) - bent(47.0);
    let want = exact(49.0, 0.0, &albedos) - exact(47.0, 0.0, &albedos);
    let scale = exact(48.0, 0.0, &albedos);
    let error = (&got - &want) / &scale;
    let [crease, others] = worst(&(1.0 + &error), &Array2::ones(error.raw_dim()));
    println!("of the facet, 2°: {crease:.5} {others:.5}");
    assert!(crease < 0.008 && others < 0.005, "{crease} {others}");
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

/// A rendered photograph: its sidecar, the mean colours of its facets, panel 0 first, and half a pixel at
/// the crease as a fraction of each panel. Corners are refined as vextract does, which places the crease
/// where the panels would meet without rounding.
fn photograph(name: &str) -> Option<(Value, Array2<f64>, [f64; 2])> {
    let folder = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/real"));
    let Ok(text) = fs::read_to_string(folder.join(name).with_extension("json")) else {
        println!("left out: the photographs of {}, which is not there", folder.display());
        return None;
    };
    let sidecar: Value = serde_json::from_str(&text).unwrap();
    let marked = [0, 1].map(|panel: usize| Marked {
        panel,
        corners: [0, 1, 2, 3].map(|n| {
            let corner = numbers(&sidecar["told"][format!("panel{panel}")][n]);
            Point::new(corner[0], corner[1])
        }),
        joints: [[0, 1, 2, 3], [0, 1, 4, 5]][panel],
    });
    let photograph =
        Photograph::open(&folder.join(name).with_extension("tif"), &ReadOptions::default()).unwrap();
    let refined = refine_corners(&photograph, &marked, &LensEstimate::UNKNOWN, 6.0).unwrap().panels;
    let outlines = [0, 1].map(|panel: usize| Homography::from_unit_square(refined[panel]).unwrap());
    let panels = outlines.clone().map(|outline| Grid::even(outline, [10, 10]));
    let half_px = outlines.map(|outline| {
        let [crease, inside] = [0.0, 0.05].map(|depth| outline.to_image(0.5, depth));
        0.5 * 0.05 / (inside.x - crease.x).abs()
    });
    let means: Vec<f64> = measure(&photograph, &panels, 0.0)
        .unwrap()
        .into_iter()
        .flat_map(|facet| facet.mean.unwrap())
        .collect();
    Some((sidecar, Array2::from_shape_vec((200, 3), means).unwrap(), half_px))
}

/// Weight of each wavelength in each channel: a perfect diffuser that faces light of this spectrum has the
/// `white_rgb` of the sidecar if the light is the sun.
fn weights(sidecar: &Value, spectrum: &[f64]) -> Array2<f64> {
    let curves: Vec<Vec<f64>> =
        sidecar["camera_sensitivities_rgb"].as_array().unwrap().iter().map(numbers).collect();
    let scale = sidecar["exposure_scale"].as_f64().unwrap();
    Array2::from_shape_fn((3, spectrum.len()), |(channel, band)| {
        let width = if band == 0 || band + 1 == spectrum.len() { 2.5 } else { 5.0 };
        scale / PI * width * curves[channel][band] * spectrum[band]
    })
}

#[test]
fn a_rounded_crease_is_as_photographed() {
    let Some((sidecar, rgb, half_px)) = photograph("one_crease") else { return };
    let reflectance = numbers(&sidecar["reflectance_body"]);
    let eye = numbers(&sidecar["camera_pose"]["position_mm"]);
    let fold = fold(48.0);
    let ideal = BentFold::ideal(48.0);
    let rounded = BentFold { crease_radius: 0.015, ..ideal };
    let sharp = exact(48.0, 0.0, &reflectance);
    let weights = weights(&sidecar, &numbers(&sidecar["illuminant_spd"]));
    let effect = |view: View| {
        let at =
            |shape| BentExchange::new(&shape, &fold, view).facet_radiance(sun(0.0), &reflectance).unwrap();
        at(rounded) - at(ideal)
    };
    let eye = View::from(Vector3::new(eye[0], eye[1], eye[2]));
    for (label, model) in [
        ("ideal", sharp.clone()),
        ("rounded", &sharp + &effect(Vector3::z().into())),
        ("rounded, eye", &sharp + &effect(eye)),
        ("rounded, eye, pixels", &sharp + &effect(View { unread: half_px, ..eye })),
    ] {
        let error = model.dot(&weights.t()) / &rgb - 1.0;
        let rms = |rows: std::ops::Range<usize>| {
            let all: Vec<f64> = error
                .indexed_iter()
                .filter(|((facet, _), _)| rows.contains(&(facet % 100 / 10)))
                .map(|(_, e)| e * e)
                .collect();
            100.0 * (all.iter().sum::<f64>() / all.len() as f64).sqrt()
        };
        let mean = |panel: usize, row: usize| {
            let at = panel * 100 + row * 10;
            100.0 * (at..at + 10).flat_map(|facet| error.row(facet).to_vec()).sum::<f64>() / 30.0
        };
        println!(
            "{label}: crease {:.3} % others {:.3} %; rows {:?}",
            rms(0..1),
            rms(1..10),
            [0, 1].map(|p| (0..4).map(|r| format!("{:.2}", mean(p, r))).collect::<Vec<_>>())
        );
        match label {
            "ideal" => assert!(rms(0..1) > 10.0),
            "rounded, eye" => assert!(rms(0..1) < 2.0 && rms(1..10) < 0.5),
            "rounded, eye, pixels" => assert!(rms(0..1) < 0.7 && rms(1..10) < 0.5),
            _ => assert!(rms(1..10) < 0.5),
        }
    }
}

#[test]
fn sky_and_ground_are_as_photographed() {
    let Some((sidecar, rgb, _)) = photograph("one_sky_ground") else { return };
    let [reflectance, sun_spectrum, sky_spectrum, ground] =
        ["reflectance_body", "illuminant_spd", "sky_spd", "ground_albedo"]
            .map(|name| numbers(&sidecar[name]));
    let up = Vector3::from_vec(numbers(&sidecar["rendered"]["up"])).normalize();
    let by_sun = exact(48.0, 0.0, &reflectance).dot(&weights(&sidecar, &sun_spectrum).t());
    let lit_ground: Vec<f64> =
        (0..ground.len()).map(|n| ground[n] * (up.z * sun_spectrum[n] + sky_spectrum[n])).collect();
    let fold = fold(48.0);
    let by = |part: Surroundings, spectrum: &[f64]| {
        let light = Environment::new([part], up);
        let seen = BentExchange::new(&BentFold::ideal(48.0), &fold, Vector3::z());
        let [radiance] = &facet_radiances(&[light], &seen, &reflectance).unwrap()[0];
        radiance.dot(&weights(&sidecar, spectrum).t())
    };
    let by_ground = by(Surroundings::Ground, &lit_ground);
    let sky = |part: Surroundings| &by_sun + &by_ground + &by(part, &sky_spectrum);
    for (label, model) in [
        ("sun alone", by_sun.clone()),
        ("even sky", sky(Surroundings::Sky)),
        ("clear sky", sky(Surroundings::Standard(StandardSky::CLEAR, Vector3::z()))),
    ] {
        let error = model / &rgb - 1.0;
        let rms = |from: usize| {
            let all: Vec<f64> = error
                .indexed_iter()
                .filter(|((facet, _), _)| facet % 100 / 10 >= from)
                .map(|(_, e)| e * e)
                .collect();
            100.0 * (all.iter().sum::<f64>() / all.len() as f64).sqrt()
        };
        println!(
            "{label}: {:.3} % all, {:.3} % without the crease row; mean {:.3} %",
            rms(0),
            rms(1),
            100.0 * error.mean().unwrap()
        );
        assert!(rms(0) < if label == "clear sky" { 1.0 } else { 20.0 }, "{label}");
    }
}
