//! Every method on one fold.

use vfold::geometry::{FacetGrid, Fold};
use vfold::kernel::mesh::Mesh;
use vfold::paper::check::spectral_radius;
use vfold::paper::monte_carlo::{MonteCarlo, Sampling};
use vfold::paper::{FoldKernel, Method, respond};
use vfold::response::{PanelOperator, Response};

use crate::common::{self, timed};
use crate::reference::{self, REFLECTANCES, relative_error};
use crate::solutions::{irradiance, operator};
use crate::table::Row;

/// Samples of a Monte Carlo estimate: pairs of points a distinct entry, or rays a row of facets.
const SAMPLES: [u32; 4] = [100, 1_000, 10_000, 100_000];
/// An estimate of more samples in all is left out: it would take more than a second.
const SAMPLES_MAX: usize = 60_000_000;
/// Patches along a facet's side.
const DIVISIONS: [usize; 4] = [2, 4, 8, 16];
/// Most patches along a panel's side.
const PATCHES_MAX: usize = 160;
/// Residual of the bounces on flat patches, relative to the light.
const RESIDUAL: f64 = 1e-8;

/// What the methods on a fold are compared with.
struct Truth {
    kernel: FoldKernel,
    row_sums: Vec<f64>,
    irradiances: Option<[Vec<f64>; 3]>,
}

/// All methods on square panels of `n` x `n` facets.
pub fn fold(angle_deg: f64, n: usize) -> Vec<Row> {
    let fold = common::fold(angle_deg, n);
    let kernel = Method::Exact.form_factors(&fold).0;
    let solved = reference::irradiances(&fold);
    let irradiances = solved.as_ref().map(|(irradiances, _)| irradiances.clone());
    let truth = Truth { row_sums: row_sums(&kernel), kernel, irradiances };
    let mut rows: Vec<_> = methods(n)
        .into_iter()
        .map(|(name, setting, method)| {
            let row = Row::new(angle_deg, n, name, setting);
            match method {
                Some(method) => by_method(&fold, method, &truth, row),
                None => Row { note: format!("left out: more than {SAMPLES_MAX} samples"), ..row },
            }
        })
        .collect();
    let Some((_, error)) = solved else { return rows };
    let patches = DIVISIONS
        .map(|times| times * n)
        .into_iter()
        .filter(|side| *side <= PATCHES_MAX && !reference::too_many(&fold, *side));
    for side in patches {
        let row = Row::new(angle_deg, n, "patches", format!("{side}x{side}"));
        rows.push(by_mesh(
            &fold,
            Mesh::Patches(FacetGrid { rows: side, cols: side }),
            10.0 * RESIDUAL,
            &truth,
            row,
        ));
    }
    for exponent in 2..=7 {
        let tolerance = 10_f64.powi(-exponent);
        if tolerance > 5.0 * reference::tolerance(&fold) {
            let row = Row::new(angle_deg, n, "auto", format!("{tolerance:e}"));
            rows.push(by_mesh(&fold, Mesh::Auto, tolerance, &truth, row));
        }
    }
    let as_good = |row: &&mut Row| row.radiance_errors.iter().all(|difference| *difference < error);
    rows.iter_mut()
        .filter(as_good)
        .for_each(|row| row.note = "as good as what it is compared with".to_owned());
    let note = format!("what radiances are compared with; estimated error {error:.1e}");
    let setting = format!("{:e}", reference::tolerance(&fold));
    rows.push(Row { note, ..Row::new(angle_deg, n, "auto", setting) });
    rows
}

/// Names, settings and methods; none for an estimate that would take too long.
fn methods(n: usize) -> Vec<(&'static str, String, Option<Method>)> {
    let mut all = vec![
        ("exact", String::new(), Some(Method::Exact)),
        ("midpoint", String::new(), Some(Method::Midpoint)),
    ];
    let samplings = [
        ("monte-carlo area", Sampling::Area, n * n * (n + 1) / 2),
        ("monte-carlo cosine", Sampling::Cosine, n),
    ];
    for (name, sampling, estimates) in samplings {
        for samples in SAMPLES {
            let estimate = MonteCarlo::new(sampling, samples, 0).unwrap();
            let affordable = estimates * samples as usize <= SAMPLES_MAX;
            all.push((name, samples.to_string(), affordable.then_some(Method::MonteCarlo(estimate))));
        }
    }
    all
}

fn by_method(fold: &Fold, method: Method, truth: &Truth, row: Row) -> Row {
    let (kernel_ms, (kernel, _)) = timed(|| method.form_factors(fold));
    let entry_error = match method {
        Method::Exact => reference::entry_error(fold, &kernel),
        _ => difference(&kernel, &truth.kernel),
    };
    let row_sum_error = match method {
        Method::Exact => f64::NAN,
        _ => largest_difference(&row_sums(&kernel), &truth.row_sums),
    };
    let row = Row { kernel_ms, entry_error, row_sum_error, ..row };
    let radius = spectral_radius(&operator(&kernel));
    if radius >= 1.0 {
        return Row { note: format!("spectral radius {radius:.2}: no radiance"), ..row };
    }
    let Some(irradiances) = &truth.irradiances else {
        return Row {
            note: "left out: what radiances are compared with takes half a minute".to_owned(),
            ..row
        };
    };
    let (solve_ms, response) = timed(|| Response::solve(&operator(&kernel), RESIDUAL).unwrap().0);
    Row { total_ms: kernel_ms + solve_ms, radiance_errors: radiance_errors(&response, irradiances), ..row }
}

fn by_mesh(fold: &Fold, mesh: Mesh, tolerance: f64, truth: &Truth, row: Row) -> Row {
    let (total_ms, (response, _)) = timed(|| respond(Method::Exact, fold, mesh, tolerance).unwrap());
    let errors = truth.irradiances.as_ref().map(|irradiances| radiance_errors(&response, irradiances));
    Row { total_ms, radiance_errors: errors.unwrap_or([f64::NAN; 3]), ..row }
}

/// Radiance is reflectance times irradiance over pi, so that relative errors are the same.
fn radiance_errors(response: &Response, irradiances: &[Vec<f64>; 3]) -> [f64; 3] {
    std::array::from_fn(|k| relative_error(&irradiance(response, REFLECTANCES[k]), &irradiances[k]))
}

/// Largest difference of a form factor.
fn difference(a: &FoldKernel, b: &FoldKernel) -> f64 {
    let rows = a.facets().rows;
    let pairs = (0..rows).flat_map(|i| (i..rows).map(move |j| (i, j)));
    pairs
        .map(|(i, j)| largest_difference(a.shifts(i, j), b.shifts(i, j)) / a.row_height(0, i))
        .fold(0.0, f64::max)
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Share of its light that each facet of a panel hands to the other.
fn row_sums(kernel: &FoldKernel) -> Vec<f64> {
    let operator = operator(kernel);
    // Facets of these folds are of one size, so that the symmetric exchange is the form factors.
    let mut sums = vec![0.0; kernel.facets().len()];
    operator.apply(0, &vec![1.0; sums.len()], &mut sums);
    sums
}
