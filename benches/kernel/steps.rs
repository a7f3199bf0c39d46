//! Lanczos steps against time and error.

use std::fmt;

use vfold::paper::form_factors;
use vfold::response::Response;

use crate::common::{fold, timed};
use crate::reference::{REFLECTANCES, relative_error};
use crate::solutions::{irradiance, operator};
use crate::table::number;

/// Columns of [`Steps`].
pub const HEAD: &str =
    "angle_deg,facets,steps,solve_ms,residual,radiance_error_r0.5,radiance_error_r0.9,radiance_error_r0.99";
const FACETS: [usize; 2] = [10, 64];
/// Residual of the solution that the others are compared with.
const CONVERGED: f64 = 1e-15;

/// What so many steps took and left.
#[derive(Clone, Debug)]
pub struct Steps {
    pub angle_deg: f64,
    pub n: usize,
    pub steps: usize,
    pub solve_ms: f64,
    pub residual: f64,
    pub radiance_errors: [f64; 3],
}

impl fmt::Display for Steps {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Self { angle_deg, n, steps, solve_ms, residual, radiance_errors } = self;
        let numbers = [*solve_ms, *residual].map(number).join(",");
        write!(f, "{angle_deg},{n},{steps},{numbers},{}", radiance_errors.map(number).join(","))
    }
}

/// One flat patch per facet, solved ever more closely.
pub fn of_fold(angle_deg: f64) -> Vec<Steps> {
    FACETS.into_iter().flat_map(|n| of_facets(angle_deg, n)).collect()
}

fn of_facets(angle_deg: f64, n: usize) -> Vec<Steps> {
    eprintln!("{angle_deg}°, {n}x{n} facets, Lanczos steps");
    let kernel = form_factors(&fold(angle_deg, n));
    let operator = operator(&kernel);
    let (converged, _) = Response::solve(&operator, CONVERGED).unwrap();
    let converged = REFLECTANCES.map(|r| irradiance(&converged, r));
    let solve = |exponent: i32| {
        let (solve_ms, (response, residual)) =
            timed(|| Response::solve(&operator, 10_f64.powi(-exponent)).unwrap());
        let radiance_errors =
            std::array::from_fn(|k| relative_error(&irradiance(&response, REFLECTANCES[k]), &converged[k]));
        Steps { angle_deg, n, steps: response.poles().len(), solve_ms, residual, radiance_errors }
    };
    (1..=13).map(solve).collect()
}
