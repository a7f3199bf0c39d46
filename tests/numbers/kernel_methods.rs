//! The paper's ways to a kernel against the exact one, and the laws that tell them apart.

use vfold::geometry::{FacetGrid, Fold, Spacing};
use vfold::kernel::mesh::Mesh;
use vfold::paper::check::{check, spectral_radius};
use vfold::paper::monte_carlo::{MonteCarlo, Sampling};
use vfold::paper::{FacetOperator, FoldKernel, Method, respond};

fn fold(angle_deg: f64, rows: usize, cols: usize) -> Fold {
    Fold::new(angle_deg, 1.0, 1.0, FacetGrid { rows, cols }).unwrap()
}

/// Panels alike and not, rows even and graded.
fn folds() -> [Fold; 3] {
    let uneven = Fold::new(70.0, 2.0, 1.0, FacetGrid { rows: 3, cols: 4 }).unwrap();
    [
        fold(45.0, 4, 4),
        fold(120.0, 3, 5),
        uneven.with_panel1_depth(0.6).unwrap().with_spacing(Spacing::Graded),
    ]
}

fn estimate(sampling: Sampling, samples: u32, seed: u64, fold: &Fold) -> (FoldKernel, f64) {
    MonteCarlo::new(sampling, samples, seed).unwrap().form_factors(fold)
}

/// Form factors of all pairs of rows and shifts, from panel 0.
fn entries(kernel: &FoldKernel) -> Vec<f64> {
    let FacetGrid { rows, cols } = kernel.facets();
    let pairs = (0..rows).flat_map(|i| (0..rows).map(move |j| (i, j)));
    pairs.flat_map(|(i, j)| (0..cols).map(move |k| kernel.form_factor(0, i, j, k))).collect()
}

/// Mean and standard deviation of one entry over estimates with different seeds.
fn spread(estimates: &[Vec<f64>], entry: usize) -> (f64, f64) {
    let count = estimates.len() as f64;
    let mean = estimates.iter().map(|entries| entries[entry]).sum::<f64>() / count;
    let squares: f64 = estimates.iter().map(|entries| (entries[entry] - mean).powi(2)).sum();
    (mean, (squares / (count - 1.0)).sqrt())
}

/// The mean of 100 estimates is within five of its standard errors of the exact entry, all errors measured
/// from the estimates themselves. Facets that meet at the crease have no finite variance when sampled by
/// area: they are left out there.
#[test]
fn both_samplings_are_unbiased() {
    for (fold, sampling) in folds().iter().flat_map(|fold| [(fold, Sampling::Area), (fold, Sampling::Cosine)])
    {
        let FacetGrid { rows, cols } = fold.facets();
        let exact = entries(&Method::Exact.form_factors(fold).0);
        let estimates: Vec<_> =
            (0..100).map(|seed| entries(&estimate(sampling, 4000, seed, fold).0)).collect();
        for (n, exact) in exact.iter().enumerate() {
            let (i, j, k) = (n / cols / rows, n / cols % rows, n % cols);
            if sampling == Sampling::Area && i == 0 && j == 0 && k < 2 {
                continue;
            }
            let (mean, sd) = spread(&estimates, n);
            let off = (mean - exact).abs() / (sd / 10.0);
            assert!(off < 5.0, "{fold:?} {sampling:?} {i} {j} {k}: {mean}, not {exact}: {off:.1} sd");
        }
    }
}

/// The standard error that one estimate states is the spread of many, where there is a variance.
#[test]
fn the_stated_standard_error_is_the_spread() {
    for fold in folds() {
        let estimates: Vec<_> = (0..200).map(|seed| estimate(Sampling::Cosine, 1000, seed, &fold)).collect();
        let stated = estimates.iter().map(|(_, sd)| sd).sum::<f64>() / 200.0;
        let all: Vec<_> = estimates.iter().map(|(kernel, _)| both_directions(kernel)).collect();
        let seen = (0..all[0].len()).map(|n| spread(&all, n).1).fold(0.0, f64::max);
        // A standard deviation of 200 numbers is known to 5 %, and the largest of many is the luckiest.
        assert!((0.85..1.2).contains(&(seen / stated)), "{fold:?}: {seen}, stated {stated}");
    }
}

/// Entries from panel 0 and from panel 1.
fn both_directions(kernel: &FoldKernel) -> Vec<f64> {
    (0..2 * kernel.facets().len()).flat_map(|facet| kernel.matrix_row(facet)).collect()
}

#[test]
fn the_error_of_rays_falls_as_the_root_of_their_number() {
    let fold = fold(45.0, 10, 10);
    let exact = entries(&Method::Exact.form_factors(&fold).0);
    let rms = |samples| {
        let estimate = entries(&estimate(Sampling::Cosine, samples, 3, &fold).0);
        let squares: f64 = exact.iter().zip(&estimate).map(|(a, b)| (a - b).powi(2)).sum();
        (squares / exact.len() as f64).sqrt()
    };
    let gain = rms(1000) / rms(100_000);
    assert!((8.0..12.5).contains(&gain), "{gain}");
}

#[test]
fn a_seed_repeats_on_any_number_of_threads() {
    let run = |threads, sampling, seed| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let (kernel, sd) = pool.install(|| estimate(sampling, 5000, seed, &fold(45.0, 8, 8)));
        (entries(&kernel).into_iter().map(f64::to_bits).collect::<Vec<_>>(), sd.to_bits())
    };
    for sampling in [Sampling::Area, Sampling::Cosine] {
        assert_eq!(run(1, sampling, 5), run(2, sampling, 5));
        assert_ne!(run(1, sampling, 5), run(1, sampling, 6));
    }
}

/// Row sum and radii of eq. (2) at facet centres, 10 x 10 facets, found with NumPy's `eigvalsh` on the dense
/// matrix.
#[test]
fn midpoint_radii() {
    for (angle_deg, want) in [(30.0, 4.47), (45.0, 1.93), (60.0, 1.06), (90.0, 0.43)] {
        let fold = fold(angle_deg, 10, 10);
        let kernel = Method::Midpoint.form_factors(&fold).0;
        let radius = spectral_radius(&FacetOperator::new(&kernel, fold.facets()));
        assert!((radius - want).abs() < 0.005, "{angle_deg}°: {radius}");
        let refused = respond(Method::Midpoint, &fold, Mesh::Facets, 1e-5).is_err();
        assert_eq!(refused, want >= 1.0, "{angle_deg}°");
    }
    let kernel = Method::Midpoint.form_factors(&fold(45.0, 10, 10)).0;
    assert!((kernel.row_sum(0, 0, 5) - 2.09).abs() < 0.005);
}

/// The error of a pair of facets at a fixed distance falls with their area, as that of any midpoint rule.
#[test]
fn midpoint_converges_for_facets_far_apart() {
    let error = |n| {
        let fold = fold(45.0, n, n);
        let [exact, midpoint] = [Method::Exact, Method::Midpoint]
            .map(|method| method.form_factors(&fold).0.form_factor(0, n - 1, n / 2, n - 1));
        (midpoint / exact - 1.0).abs()
    };
    let [coarse, fine] = [16, 32].map(error);
    assert!(coarse < 3e-3 && (3.0..5.0).contains(&(coarse / fine)), "{coarse:e} {fine:e}");
}

/// Lanczos' radius is the largest singular value of the dense matrix.
#[test]
fn the_spectral_radius_is_that_of_the_dense_matrix() {
    for fold in folds() {
        for method in [Method::Exact, Method::Midpoint] {
            let kernel = method.form_factors(&fold).0;
            let size = 2 * fold.facets().len();
            let rows: Vec<f64> = (0..size).flat_map(|facet| kernel.matrix_row(facet)).collect();
            let dense = nalgebra::DMatrix::from_row_slice(size, size, &rows);
            let want = dense.complex_eigenvalues().iter().map(|value| value.norm()).fold(0.0, f64::max);
            let got = spectral_radius(&FacetOperator::new(&kernel, fold.facets()));
            assert!((got / want - 1.0).abs() < 1e-12, "{fold:?} {method}: {got}, not {want}");
        }
    }
}

/// Exact kernels keep every law, from nearly shut to flat; the report says which law a kernel at facet
/// centres breaks.
#[test]
fn laws_tell_the_methods_apart() {
    let wide = [1.0, 20.0, 90.0, 179.0, 180.0].map(|angle_deg| fold(angle_deg, 6, 30));
    for fold in folds().into_iter().chain(wide) {
        let exact = Method::Exact.form_factors(&fold).0;
        for law in check(&exact, &exact) {
            assert!(law.holds(), "{fold:?}: {law}");
        }
    }
    let fold = fold(45.0, 10, 10);
    let [exact, midpoint] = [Method::Exact, Method::Midpoint].map(|method| method.form_factors(&fold).0);
    let laws = check(&midpoint, &exact);
    let broken: Vec<_> = laws.iter().filter(|law| !law.holds()).map(|law| law.name).collect();
    assert_eq!(broken, ["largest entry", "largest row sum", "spectral radius", "energy imbalance, r = 1"]);
}
