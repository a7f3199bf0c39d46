//! The bounces on undivided panels against patches with exact form factors, and the error estimate against
//! finer solutions.

use vfold::geometry::{FacetGrid, Fold, Spacing};
use vfold::kernel::mesh::{Mesh, respond};
use vfold::paper::{self, Method};
use vfold::response::{ModeLight, Response};

fn fold(angle_deg: f64, width: f64, depth: f64) -> Fold {
    Fold::new(angle_deg, width, depth, FacetGrid { rows: 10, cols: 10 }).unwrap()
}

/// Irradiance of every facet of both panels under even light at reflectance `r`.
fn irradiance(response: &Response, r: f64) -> Vec<f64> {
    let even = ModeLight::Sun([1.0, 1.0]);
    let facets = (0..2).flat_map(|panel| (0..response.facets()).map(move |facet| (panel, facet)));
    facets.map(|(panel, facet)| response.irradiance(panel, facet, even, [r; 2])).collect()
}

/// Largest relative difference.
fn difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max)
}

#[test]
fn patches_converge_to_the_undivided_panels() {
    for (angle_deg, width) in [(45.0, 1.0), (90.0, 1.0), (60.0, 2.0)] {
        let fold = fold(angle_deg, width, 1.0);
        let patches = |n| {
            let (response, _) =
                paper::respond(Method::Exact, &fold, Mesh::Patches(FacetGrid { rows: n, cols: n }), 1e-8)
                    .unwrap();
            irradiance(&response, 0.5)
        };
        let [coarse, middle, fine] = [20, 40, 80].map(patches);
        let (auto, _) = respond(&fold, 1e-5).unwrap();
        let auto = irradiance(&auto, 0.5);
        // Errors fall by a constant factor from mesh to mesh, which Aitken's process takes to the limit;
        // facets whose error changes sign on the way have none.
        let errors: Vec<f64> = (0..fine.len())
            .filter_map(|k| {
                let (first, second) = (middle[k] - coarse[k], fine[k] - middle[k]);
                let limit = fine[k] - second * second / (second - first);
                (0.0..0.5).contains(&(second / first)).then(|| (auto[k] / limit - 1.0).abs())
            })
            .collect();
        let (mean, worst) =
            (errors.iter().sum::<f64>() / errors.len() as f64, errors.iter().copied().fold(0.0, f64::max));
        assert!(errors.len() > 160, "{} facets converge", errors.len());
        assert!(mean < 1e-5 && worst < 2e-4, "{angle_deg}° {width}x1: mean {mean:.1e}, worst {worst:.1e}");
    }
}

/// Folds from narrow to wide open, long and short, of unequal panels, with facets that narrow towards the
/// crease.
fn folds() -> Vec<Fold> {
    let plain = [5.0, 12.0, 15.0, 30.0, 36.0, 45.0, 90.0, 150.0].map(|angle_deg| (angle_deg, 1.0, 1.0));
    let oblong = [(45.0, 3.0, 1.0), (60.0, 1.0, 4.0)];
    let unequal = fold(50.0, 1.0, 1.0).with_panel1_depth(0.4).unwrap();
    let graded = fold(45.0, 1.0, 1.0).with_spacing(Spacing::Graded);
    let equal =
        plain.into_iter().chain(oblong).map(|(angle_deg, width, depth)| fold(angle_deg, width, depth));
    equal.chain([unequal, graded]).collect()
}

#[test]
fn facet_means_are_within_the_tolerance_of_a_finer_solution() {
    for fold in folds() {
        let (finest, left) = respond(&fold, 1e-6).unwrap();
        for tolerance in [1e-2, 1e-3, 1e-4, 1e-5] {
            let (response, accuracy) = respond(&fold, tolerance).unwrap();
            let stated = accuracy.facet_mean_error.unwrap();
            assert!(stated <= tolerance, "{fold:?}: {accuracy:?}");
            let may_be = 1.1 * stated + left.facet_mean_error.unwrap();
            for r in [0.1, 0.5, 0.9, 1.0] {
                let error = difference(&irradiance(&response, r), &irradiance(&finest, r));
                assert!(error <= tolerance, "{fold:?} r {r}: {error:.1e} beyond {tolerance:e}");
                assert!(error <= may_be, "{fold:?} r {r}: {error:.1e}, {stated:.1e} stated");
            }
        }
    }
}

/// Patches come nearer by about a half with each halving, at the crease.
#[test]
fn unequal_panels_converge_like_equal_ones() {
    let fold = fold(70.0, 1.0, 1.0).with_panel1_depth(0.5).unwrap();
    let (auto, _) = respond(&fold, 1e-5).unwrap();
    let mut errors = [20, 40, 80].map(|n| {
        let (patches, _) =
            paper::respond(Method::Exact, &fold, Mesh::Patches(FacetGrid { rows: n, cols: n }), 1e-8)
                .unwrap();
        difference(&irradiance(&patches, 0.5), &irradiance(&auto, 0.5))
    });
    errors.sort_by(f64::total_cmp);
    assert!(errors[0] < 1e-3 && errors[1] > 1.7 * errors[0] && errors[2] > 1.7 * errors[1], "{errors:?}");
}

#[test]
fn one_flat_patch_a_facet_is_five_percent_off_at_the_crease() {
    let fold = fold(45.0, 1.0, 1.0);
    let (facets, accuracy) = paper::respond(Method::Exact, &fold, Mesh::Facets, 1e-5).unwrap();
    let (auto, _) = respond(&fold, 1e-5).unwrap();
    let error = difference(&irradiance(&facets, 0.9), &irradiance(&auto, 0.9));
    assert!(accuracy.facet_mean_error.is_none());
    assert!((0.045..0.055).contains(&error), "{error}");
}

#[test]
fn patches_that_do_not_divide_into_facets_are_refused() {
    let refused = paper::respond(
        Method::Exact,
        &fold(45.0, 1.0, 1.0),
        Mesh::Patches(FacetGrid { rows: 15, cols: 20 }),
        1e-5,
    )
    .unwrap_err();
    assert!(refused.to_string().contains("multiples of the facets"), "{refused}");
}
