//! What the library makes of the ends of every range obeys the laws of light.

use vfold::geometry::{FacetGrid, Fold, Spacing};
use vfold::kernel::mesh::{Mesh, respond};
use vfold::paper::{self, Method, form_factors};
use vfold::response::{ModeLight, Response};

const ANGLES: [f64; 6] = [0.1, 1.0, 10.0, 120.0, 179.0, 179.9];
const PANELS: [(f64, f64); 3] = [(1.0, 1.0), (1000.0, 1.0), (1.0, 1000.0)];

/// Form factor of one panel to the other, for [`PANELS`]: A. Feingold, *Proc. R. Soc. A* 292 (1966), p. 51,
/// as corrected in J. R. Howell's catalogue of configuration factors (C-16), with 50 digits by mpmath.
const PANEL_FACTORS: [(f64, [f64; 3]); 7] = [
    (0.1, [0.998_261_391_654_143_6, 0.999_126_469_464_638_8, 0.512_115_704_727_333_2]),
    (1.0, [0.982_997_178_574_648_8, 0.991_265_180_587_520_4, 0.115_940_259_741_160_62]),
    (45.0, [0.483_347_695_478_877_76, 0.617_171_625_679_696_5, 0.004_059_407_303_680_12]),
    (90.0, [0.200_043_776_075_403_15, 0.292_782_901_039_901_96, 0.001_282_976_932_813_185]),
    (135.0, [0.048_309_447_801_817_94, 0.076_085_250_570_414_66, 2.816_171_300_913_018e-4]),
    (179.0, [2.360_878_311_498_336e-5, 3.805_820_842_860_858e-5, 1.341_008_362_048_113_9e-7]),
    (179.9, [2.360_866_544_678_867_7e-7, 3.805_844_699_255_524e-7, 1.340_985_421_896_24e-9]),
];

fn folds(rows: usize, cols: usize) -> impl Iterator<Item = Fold> {
    let shapes = ANGLES.into_iter().flat_map(|angle| PANELS.into_iter().map(move |panel| (angle, panel)));
    shapes.flat_map(move |(angle, (width, depth))| {
        let fold = Fold::new(angle, width, depth, FacetGrid { rows, cols }).unwrap();
        let unequal = fold.with_panel1_depth(width.max(depth) / 100.0).unwrap();
        [fold, fold.with_spacing(Spacing::Graded), unequal]
    })
}

/// Every number that a camera could see of it, for sheets from black to white in sun and sky.
fn irradiances(response: &Response) -> impl Iterator<Item = f64> + '_ {
    let lights = [ModeLight::Sun([1.0, 1.0]), ModeLight::Sun([1.0, 0.01]), ModeLight::Sky(1.0)];
    let cases = [0.0, 1e-9, 0.5, 0.999, 1.0].into_iter().flat_map(move |r| lights.map(|light| (r, light)));
    cases.flat_map(move |(r, light)| {
        (0..2 * response.facets())
            .map(move |n| response.irradiance(n / response.facets(), n % response.facets(), light, [r, r]))
    })
}

#[test]
fn facets_keep_the_laws() {
    for (rows, cols) in [(1, 1), (7, 5), (60, 1), (1, 60)] {
        for fold in folds(rows, cols) {
            let kernel = form_factors(&fold);
            for (panel, row) in (0..2).flat_map(|panel| (0..rows).map(move |row| (panel, row))) {
                let sum = kernel.row_sum(panel, row, 0);
                assert!((0.0..1.0).contains(&sum), "{fold:?}: row {row} of panel {panel} hands on {sum}");
                let entries = (0..rows).flat_map(|j| kernel.shifts_from(panel, row, j));
                assert!(entries.copied().all(|entry| entry >= 0.0), "{fold:?}: row {row}");
            }
        }
    }
}

#[test]
fn thin_and_wide_panels_have_feingolds_factors() {
    for (angle_deg, factors) in PANEL_FACTORS {
        for ((width, depth), want) in PANELS.into_iter().zip(factors) {
            for facets in [1, 4, 256] {
                let kernel = form_factors(
                    &Fold::new(angle_deg, width, depth, FacetGrid { rows: facets, cols: 4 }).unwrap(),
                );
                let all = (0..facets).flat_map(|row| (0..4).map(move |col| (row, col)));
                let got =
                    all.map(|(row, col)| kernel.row_sum(0, row, col)).sum::<f64>() / (4 * facets) as f64;
                let off = (got - want).abs();
                assert!(
                    off < 1e-12 && off < 1e-9 * want,
                    "{angle_deg}° {width}x{depth} in {facets}x4: {got}, {want}"
                );
            }
        }
    }
}

/// A panel in parts gets what it gets as a whole, however far the parts' sizes are apart.
#[test]
fn parts_add_up_to_the_whole() {
    for angle_deg in ANGLES {
        let whole = Fold::new(angle_deg, 1.0, 1.0, FacetGrid { rows: 1, cols: 1 }).unwrap();
        let want = form_factors(&whole).form_factor(0, 0, 0, 0);
        let fold = whole.with_facets(FacetGrid { rows: 64, cols: 16 }).unwrap().with_spacing(Spacing::Graded);
        let kernel = form_factors(&fold);
        let share = |row: usize, col: usize| kernel.row_sum(0, row, col) * kernel.row_height(0, row) / 256.0;
        let sum: f64 = (0..64)
            .flat_map(|row| (0..16).map(move |col| (row, col)))
            .map(|(row, col)| share(row, col))
            .sum();
        assert!((sum - want).abs() < 1e-12, "{angle_deg}°: {sum} {want}");
    }
}

#[test]
fn bounces_end_and_are_finite() {
    for fold in folds(4, 3) {
        // Undivided panels narrower than this take seconds each.
        let meshes = if fold.angle_deg() < 10.0 { &[Mesh::Facets][..] } else { &[Mesh::Facets, Mesh::Auto] };
        for mesh in meshes {
            let (response, _) = paper::respond(Method::Exact, &fold, *mesh, 1e-2).unwrap();
            assert!(response.poles().iter().all(|g| g.abs() < 1.0), "{fold:?}");
            assert!(irradiances(&response).all(|e| e.is_finite() && e > -1e-2), "{fold:?} {mesh}");
        }
    }
}

/// The narrow fold that stands for all.
#[test]
fn a_fold_of_one_degree_is_solved() {
    let fold = Fold::new(1.0, 1.0, 1.0, FacetGrid { rows: 10, cols: 10 }).unwrap();
    let (response, accuracy) = respond(&fold, 1e-2).unwrap();
    assert!(accuracy.facet_mean_error.unwrap() <= 1e-2);
    assert!(irradiances(&response).all(|e| e.is_finite() && e > -1e-2));
}
