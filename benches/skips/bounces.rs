//! Skips on the way from form factors to light after all bounces.

use nalgebra::DMatrix;
use vfold::paper::{FacetOperator, FoldKernel, form_factors};
use vfold::response::{PanelOperator, Response};
use vfold::solve::Eigen;

use super::{ANGLE_DEG, Skip};
use crate::common::fold;
use crate::solutions::{irradiance, operator};

/// Residual that rounding leaves.
const ROUNDING: f64 = 1e-14;
/// Residual that a scene asks for.
const TOLERANCE: f64 = 1e-6;
/// Reflectance at which results are compared.
const R: f64 = 0.9;

pub fn rows() -> Vec<String> {
    let mut rows: Vec<_> = [10, 64].map(mirrored_panel).into();
    rows.push(modes_without_light());
    rows.extend([10, 64].map(modes_below_tolerance));
    rows
}

/// The irradiance that an operator's bounces lead to.
fn solved(operator: &impl PanelOperator, residual: f64) -> Vec<f64> {
    irradiance(&Response::solve(operator, residual).unwrap().0, R)
}

/// Panels that nobody has found to be alike.
struct Unlike<'a>(FacetOperator<'a>);

impl PanelOperator for Unlike<'_> {
    fn is_symmetric(&self) -> bool {
        false
    }

    fn uniform(&self, panel: usize) -> Vec<f64> {
        self.0.uniform(panel)
    }

    fn apply(&self, panel: usize, x: &[f64], out: &mut [f64]) {
        self.0.apply(panel, x, out);
    }

    fn facet_means(&self, panel: usize, x: &[f64]) -> Vec<f64> {
        self.0.facet_means(panel, x)
    }
}

fn mirrored_panel(n: usize) -> String {
    let kernel = form_factors(&fold(ANGLE_DEG, n));
    let (alike, unlike) = (operator(&kernel), Unlike(operator(&kernel)));
    let skip = Skip::new(
        format!("mirrored panel, {n}x{n}"),
        "Lanczos on both panels, for light on either",
        "Lanczos on one panel",
    );
    skip.row(|| solved(&unlike, ROUNDING), || solved(&alike, ROUNDING))
}

/// The exchange of one panel with the other as a full matrix.
fn dense(kernel: &FoldKernel) -> DMatrix<f64> {
    let count = kernel.facets().len();
    let rows: Vec<_> = (0..count).map(|facet| kernel.matrix_row(facet).split_off(count)).collect();
    DMatrix::from_fn(count, count, |i, j| rows[i][j])
}

/// Irradiance by all modes of the full matrix, eqs. (26) to (28).
fn by_all_modes(exchange: DMatrix<f64>) -> Vec<f64> {
    let Eigen { values, vectors } = Eigen::of_symmetric(exchange);
    let shares =
        vectors.row_sum().iter().zip(&values).map(|(lit, g)| lit / (1.0 - R * g)).collect::<Vec<_>>();
    (vectors * DMatrix::from_vec(shares.len(), 1, shares)).as_slice().to_vec()
}

fn modes_without_light() -> String {
    let kernel = form_factors(&fold(ANGLE_DEG, 10));
    let operator = operator(&kernel);
    let exchange = dense(&kernel);
    let modes = Response::solve(&operator, ROUNDING).unwrap().0.poles().len();
    let skip = Skip::new(
        "modes that the light does not excite",
        "all 100 modes of one panel's exchange",
        format!("the {modes} modes that Lanczos finds from the light"),
    );
    skip.row(|| by_all_modes(exchange.clone()), || solved(&operator, ROUNDING))
}

fn modes_below_tolerance(n: usize) -> String {
    let kernel = form_factors(&fold(ANGLE_DEG, n));
    let operator = operator(&kernel);
    let modes = |residual| Response::solve(&operator, residual).unwrap().0.poles().len();
    let skip = Skip::new(
        format!("modes below tolerance, {n}x{n}"),
        format!("{} modes, to rounding", modes(ROUNDING)),
        format!("{} modes, residual {TOLERANCE:e}", modes(TOLERANCE)),
    );
    skip.row(|| solved(&operator, ROUNDING), || solved(&operator, TOLERANCE))
}
