//! The bounces: how finely panels are divided, and how closely the equations of one division are solved.

use nalgebra::DMatrix;
use vfold::geometry::FacetGrid;
use vfold::kernel::mesh::Mesh;
use vfold::paper::{Method, form_factors, respond};
use vfold::response::{Modes, PanelOperator, Response};

use crate::common::{fold, timed};
use crate::point::Point;
use crate::reference::{REFLECTANCES, radiances, relative_error};
use crate::solutions::{irradiance, operator};

const ANGLE_DEG: f64 = 45.0;
const FACETS: usize = 10;
/// Error that the undivided panels have which others are compared with.
const TRUTH: f64 = 1e-8;
/// Flat patches along a side.
const PATCHES: [usize; 5] = [10, 20, 40, 80, 160];
/// Wavebands for which light is bounced.
const BANDS: usize = 61;
/// Bounces that are added up one by one.
const BOUNCES: [usize; 7] = [1, 2, 5, 10, 20, 50, 100];

/// Prints a row a mesh and a solver.
pub fn measure() {
    meshes();
    solvers();
}

/// Facet means on every mesh, against those of undivided panels.
fn meshes() {
    let fold = fold(ANGLE_DEG, FACETS);
    let means = |mesh, tolerance| {
        let response = respond(Method::Exact, &fold, mesh, tolerance).unwrap().0;
        REFLECTANCES.map(|r| irradiance(&response, r)).concat()
    };
    let truth = means(Mesh::Auto, TRUTH);
    let measure = |series, setting: &str, mesh, tolerance| {
        let (ms, means) = timed(|| means(mesh, tolerance));
        Point::print("mesh: facet means", series, setting, (ms, relative_error(&means, &truth)));
    };
    for exponent in 2..=7 {
        let tolerance = 10_f64.powi(-exponent);
        measure("--mesh auto --tolerance", &format!("{tolerance:e}"), Mesh::Auto, tolerance);
    }
    for side in PATCHES {
        let mesh = Mesh::Patches(FacetGrid { rows: side, cols: side });
        measure("--mesh patches", &format!("{side}x{side}"), mesh, TRUTH);
    }
}

/// Solutions for all wavebands of the equations of 10 x 10 flat patches, against solutions in 14 digits.
fn solvers() {
    let fold = fold(ANGLE_DEG, FACETS);
    let kernel = form_factors(&fold);
    let operator = operator(&kernel);
    let truth = radiances(&fold);
    let given: Vec<f64> = truth.iter().map(|(r, _)| *r).collect();
    let even = (given.len()..BANDS).map(|n| n as f64 / BANDS as f64);
    let reflectances: Vec<f64> = given.iter().copied().chain(even).collect();
    let measure = |series, setting: &str, solve: &dyn Fn() -> DMatrix<f64>| {
        let (ms, solved) = timed(solve);
        let error = |(band, (_, wanted)): (usize, &(f64, Vec<f64>))| {
            relative_error(solved.column(band).as_slice(), wanted)
        };
        let error = truth.iter().enumerate().map(error).fold(0.0, f64::max);
        Point::print("solver: 100 patches x 61 wavebands", series, setting, (ms, error));
    };
    for exponent in (1..=13).step_by(2) {
        let tolerance = 10_f64.powi(-exponent);
        measure("Lanczos to residual", &format!("{tolerance:e}"), &|| {
            by_poles(&Response::solve(&operator, tolerance).unwrap().0, &reflectances)
        });
    }
    for bounces in BOUNCES {
        measure("bounce by bounce", &bounces.to_string(), &|| by_bounces(&operator, bounces, &reflectances));
    }
}

/// Irradiance, facet by waveband.
fn by_poles(response: &Response, reflectances: &[f64]) -> DMatrix<f64> {
    let Modes::Shared(set) = response.modes() else { panic!("panels that are alike") };
    let poles = &set.poles;
    &set.residues
        * DMatrix::from_fn(poles.len(), reflectances.len(), |k, n| (1.0 - reflectances[n] * poles[k]).recip())
}

/// The same as a sum over bounces, the light of each found once for all wavebands.
fn by_bounces(operator: &impl PanelOperator, bounces: usize, reflectances: &[f64]) -> DMatrix<f64> {
    let mut light = operator.uniform(0);
    let mut next = light.clone();
    let mut after = Vec::new();
    for _ in 0..=bounces {
        after.push(nalgebra::DVector::from_vec(operator.facet_means(0, &light)));
        operator.apply(0, &light, &mut next);
        std::mem::swap(&mut light, &mut next);
    }
    let shares = DMatrix::from_fn(after.len(), reflectances.len(), |b, n| reflectances[n].powi(b as i32));
    DMatrix::from_columns(&after) * shares
}
