//! Physical laws of the form factors of any fold, tested on a kernel from any method.

use std::fmt;

use nalgebra::DMatrix;

use super::facets::FacetOperator;
use super::fold_kernel::FoldKernel;
use crate::response::{ModeLight, PanelOperator, Response};
use crate::solve::{Eigen, dot};

/// Relative deviation attributed to rounding.
const ROUNDING: f64 = 1e-12;
/// Residual to which the bounces are solved for the energy balance.
const SOLVED: f64 = 1e-13;
/// Most Lanczos steps for the spectral radius; a 1° fold takes some 30.
const STEPS_MAX: usize = 300;

/// A law, the measured number, and its bound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Law {
    /// The measured quantity.
    pub name: &'static str,
    /// Its value; infinite where the bounces diverge.
    pub measured: f64,
    /// Its bound.
    pub bound: Bound,
}

/// The bound of a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bound {
    /// This or more.
    AtLeast(f64),
    /// This or less.
    AtMost(f64),
    /// Less than this.
    Below(f64),
    /// None: the number is for information.
    Nothing,
}

impl Law {
    /// Whether the law holds; NaN breaks every law.
    #[must_use]
    pub fn holds(&self) -> bool {
        match self.bound {
            Bound::AtLeast(bound) => self.measured >= bound,
            Bound::AtMost(bound) => self.measured <= bound,
            Bound::Below(bound) => self.measured < bound,
            Bound::Nothing => true,
        }
    }
}

impl fmt::Display for Bound {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::AtLeast(bound) => f.pad(&format!(">={bound}")),
            Self::AtMost(bound) if *bound < 1e-3 => f.pad(&format!("<={bound:e}")),
            Self::AtMost(bound) => f.pad(&format!("<={bound}")),
            Self::Below(bound) => f.pad(&format!("<{bound}")),
            Self::Nothing => f.pad("-"),
        }
    }
}

/// One line of a report: law, measured number, bound, `ok` or `BROKEN`.
impl fmt::Display for Law {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let measured = match self.measured {
            small if small.abs() < 1e-3 => format!("{small:.2e}"),
            number => format!("{number:.6}"),
        };
        let verdict = match self.bound {
            Bound::Nothing => "-",
            _ if self.holds() => "ok",
            _ => "BROKEN",
        };
        write!(f, "{:<28} {measured:>12}   {:<8} {verdict}", self.name, self.bound)
    }
}

/// Tests every law on `kernel`, and measures its distance from the `exact` kernel of the same facets.
///
/// The dense matrix is never formed. Reciprocity holds by construction, since one number represents both
/// directions: its line shows the rounding of the form factors derived from it.
///
/// # Example
/// ```
/// use vfold::geometry::{FacetGrid, Fold};
/// use vfold::paper::check::check;
/// use vfold::paper::{form_factors, midpoint};
/// let fold = Fold::new(45.0, 1.0, 1.0, FacetGrid { rows: 10, cols: 10 })?;
/// let (exact, midpoint) = (form_factors(&fold), midpoint::form_factors(&fold));
/// assert!(check(&exact, &exact).iter().all(|law| law.holds()));
/// assert!(!check(&midpoint, &exact).iter().all(|law| law.holds()));
/// # Ok::<(), vfold::Error>(())
/// ```
#[must_use]
pub fn check(kernel: &FoldKernel, exact: &FoldKernel) -> Vec<Law> {
    let law = |name, measured, bound| Law { name, measured, bound };
    let operator = FacetOperator::new(kernel, kernel.facets());
    let row_sums = [0, 1].map(|panel| row_sums(&operator, panel));
    let largest_sum = row_sums.iter().flatten().copied().fold(0.0, f64::max);
    let balance = |r| energy_imbalance(&operator, &row_sums, r);
    vec![
        law("smallest entry", entries(kernel).fold(f64::INFINITY, f64::min), Bound::AtLeast(0.0)),
        law("largest entry", entries(kernel).fold(0.0, f64::max), Bound::AtMost(1.0)),
        law("reciprocity, relative", irreciprocity(kernel), Bound::AtMost(ROUNDING)),
        law("largest row sum", largest_sum, Bound::Below(1.0)),
        law("spectral radius", spectral_radius(&operator), Bound::Below(1.0)),
        law("energy imbalance, r = 0.5", balance(0.5), Bound::AtMost(ROUNDING)),
        law("energy imbalance, r = 1", balance(1.0), Bound::AtMost(ROUNDING)),
        law("difference from exact entry", difference(kernel, exact), Bound::Nothing),
    ]
}

/// Largest absolute eigenvalue of the matrix of eq. (10): the fraction of its light that the slowest mode
/// passes on.
///
/// K = [0 F; Fᵀ 0] has the singular values of F, which the Lanczos method finds from products alone (Golub
/// and Van Loan, *Matrix Computations*, section 10.1). Without reorthogonalisation eigenvalues are
/// duplicated, but the largest is unaffected.
#[must_use]
pub fn spectral_radius(operator: &impl PanelOperator) -> f64 {
    let mut now = operator.uniform(0);
    let mut before = vec![0.0; now.len()];
    let mut across = operator.uniform(1);
    let (mut diagonal, mut off_diagonal) = (Vec::new(), Vec::new());
    let (mut largest, mut length) = (0.0, 0.0);
    let norm = dot(&now, &now).sqrt();
    now.iter_mut().for_each(|x| *x /= norm);
    loop {
        let mut next = vec![0.0; now.len()];
        operator.apply(1, &now, &mut across);
        operator.apply(0, &across, &mut next);
        let along = dot(&now, &next);
        for ((next, now), before) in next.iter_mut().zip(&now).zip(&before) {
            *next -= along * now + length * before;
        }
        diagonal.push(along);
        length = dot(&next, &next).sqrt();
        let eigen = Eigen::seen(DMatrix::zeros(0, diagonal.len()), &diagonal, &off_diagonal);
        let found = eigen.values.into_iter().fold(0.0, f64::max);
        let settled = found - largest <= 1e-15 * found || length <= 1e-15 * found;
        if settled || diagonal.len() == STEPS_MAX {
            return found.max(0.0).sqrt();
        }
        largest = found;
        off_diagonal.push(length);
        next.iter_mut().for_each(|x| *x /= length);
        before = std::mem::replace(&mut now, next);
    }
}

/// All distinct form factors, in both directions.
fn entries(kernel: &FoldKernel) -> impl Iterator<Item = f64> + '_ {
    pairs(kernel).flat_map(move |(i, j)| {
        let heights = [kernel.row_height(0, i), kernel.row_height(1, j)];
        kernel.shifts(i, j).iter().flat_map(move |exchange| heights.map(|height| exchange / height))
    })
}

fn pairs(kernel: &FoldKernel) -> impl Iterator<Item = (usize, usize)> + use<> {
    let rows = kernel.facets().rows;
    (0..rows).flat_map(move |i| (0..rows).map(move |j| (i, j)))
}

/// Largest `|A_i F_ij − A_j F_ji|`, relative to the larger.
fn irreciprocity(kernel: &FoldKernel) -> f64 {
    let cols = kernel.facets().cols;
    let disagreement = |(i, j, shift): (usize, usize, usize)| {
        let there = kernel.row_height(0, i) * kernel.form_factor(0, i, j, shift);
        let back = kernel.row_height(1, j) * kernel.form_factor(1, j, i, shift);
        (there - back).abs() / there.abs().max(back.abs()).max(f64::MIN_POSITIVE)
    };
    pairs(kernel)
        .flat_map(|(i, j)| (0..cols).map(move |shift| (i, j, shift)))
        .map(disagreement)
        .fold(0.0, f64::max)
}

/// Fraction of its light that each facet of `panel` sends to the other panel.
fn row_sums(operator: &FacetOperator, panel: usize) -> Vec<f64> {
    let (scale, across) = (operator.uniform(panel), operator.uniform(1 - panel));
    let mut sums = vec![0.0; scale.len()];
    operator.apply(panel, &across, &mut sums);
    sums.iter_mut().zip(&scale).for_each(|(sum, scale)| *sum /= scale);
    sums
}

/// For uniform light on two sheets of reflectance `r`: |received − absorbed − leaving|, relative to the
/// received light; infinite where the bounces diverge.
fn energy_imbalance(operator: &FacetOperator, row_sums: &[Vec<f64>; 2], r: f64) -> f64 {
    let Ok((response, _)) = Response::solve(&Dimmed { operator, r }, SOLVED) else { return f64::INFINITY };
    let (mut received, mut lost) = (0.0, 0.0);
    for (panel, row_sums) in row_sums.iter().enumerate() {
        for (facet, (handed_on, root_area)) in row_sums.iter().zip(operator.uniform(panel)).enumerate() {
            let area = root_area * root_area;
            let light = response.irradiance(panel, facet, ModeLight::Sun([1.0, 1.0]), [1.0, 1.0]);
            received += area;
            lost += area * light * ((1.0 - r) + r * (1.0 - handed_on));
        }
    }
    (received - lost).abs() / received
}

/// Largest difference between form factors and the exact ones.
fn difference(kernel: &FoldKernel, exact: &FoldKernel) -> f64 {
    entries(kernel).zip(entries(exact)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// An operator multiplied by the reflectance: even a kernel with a radius above 1 has a solution for dark
/// sheets.
struct Dimmed<'a> {
    operator: &'a FacetOperator<'a>,
    r: f64,
}

impl PanelOperator for Dimmed<'_> {
    fn is_symmetric(&self) -> bool {
        self.operator.is_symmetric()
    }

    fn uniform(&self, panel: usize) -> Vec<f64> {
        self.operator.uniform(panel)
    }

    fn apply(&self, panel: usize, x: &[f64], out: &mut [f64]) {
        self.operator.apply(panel, x, out);
        out.iter_mut().for_each(|light| *light *= self.r);
    }

    fn facet_means(&self, panel: usize, x: &[f64]) -> Vec<f64> {
        self.operator.facet_means(panel, x)
    }
}
