//! Divides a set of reflectances into classes, each nearly Gaussian in logit.
//!
//! Once the class of a spectrum is known (reds, greens, greys), one end of it says far more about the other.

use nalgebra::{DMatrix, DVector, RowDVector};

use crate::solve::Eigen;

/// Maximum number of halvings: eight classes.
const HALVINGS: u32 = 3;
/// Number of spectra that the set must have for each half before classes are halved.
const SPECTRA_A_CLASS: usize = 80;
/// Number of principal coordinates in which classes are distinguished.
const COORDINATES: usize = 15;
/// Passes of expectation maximisation.
const PASSES: usize = 40;
/// Shrinkage of a small class's covariance towards that of the set: equivalent to this many spectra with a
/// tenth of the set's variance.
const SHRINKAGE: f64 = 5.0;
const SHRUNK_VARIANCE: f64 = 0.1;

/// Classes of the built-in Munsell chips, in their order, as [`divide`] finds them from 400 to 700 nm by 5.
/// They are stored because finding them takes longer than many estimates; `share/make-munsell.rs` wrote them.
#[must_use]
pub fn of_munsell() -> Vec<usize> {
    let digits = include_str!("../../share/munsell1269-classes.txt");
    digits.lines().filter_map(|class| class.parse().ok()).collect()
}

/// The class of every spectrum, given as columns of `logits` (waveband by spectrum). `spread` is the
/// covariance of spectra beyond their class. Sets of fewer than 160 spectra form one class.
///
/// # Source
/// Halving along principal axes, then a Gaussian mixture by expectation maximisation (Bishop, *Pattern
/// Recognition and Machine Learning*, 2006, section 9.2).
#[must_use]
pub fn divide(logits: &DMatrix<f64>, spread: &DMatrix<f64>) -> Vec<usize> {
    let halvings = (logits.ncols() / SPECTRA_A_CLASS).max(1).ilog2().min(HALVINGS);
    let (mean, covariance) = moments(logits, &RowDVector::from_element(logits.ncols(), 1.0));
    let mut centred = logits.clone();
    centred.column_iter_mut().for_each(|mut column| column -= &mean);
    let axes = leading_axes(covariance, COORDINATES);
    let points = axes.tr_mul(&centred);
    let spread = axes.tr_mul(spread) * &axes;
    let classes = (0..halvings).fold(vec![0; points.ncols()], |classes, _| halve(&points, &classes));
    let count = 1 << halvings;
    let mut memberships =
        DMatrix::from_fn(count, points.ncols(), |k, n| f64::from(u8::from(classes[n] == k)));
    for _ in 0..PASSES {
        memberships = reassess(&points, &spread, &memberships);
    }
    memberships.column_iter().map(|column| column.imax()).collect()
}

/// Mean of weighted columns, and covariance about it.
pub(super) fn moments(columns: &DMatrix<f64>, weights: &RowDVector<f64>) -> (DVector<f64>, DMatrix<f64>) {
    let total = weights.sum().max(f64::MIN_POSITIVE);
    let mean = columns * weights.transpose() / total;
    let mut centred = columns.clone();
    for (mut column, weight) in centred.column_iter_mut().zip(weights.iter()) {
        column -= &mean;
        column *= weight.sqrt();
    }
    let covariance = &centred * centred.transpose() / total;
    (mean, covariance)
}

/// Covariance of a class of `count` spectra, shrunk towards that of the set.
pub(super) fn shrunk(covariance: &DMatrix<f64>, count: f64, of_set: &DMatrix<f64>) -> DMatrix<f64> {
    (covariance * count + of_set * (SHRINKAGE * SHRUNK_VARIANCE)) / (count + SHRINKAGE)
}

/// Eigenvectors of the largest eigenvalues, a column each.
fn leading_axes(covariance: DMatrix<f64>, count: usize) -> DMatrix<f64> {
    let eigen = Eigen::of_symmetric(covariance);
    let mut order: Vec<usize> = (0..eigen.values.len()).collect();
    order.sort_by(|a, b| eigen.values[*b].total_cmp(&eigen.values[*a]));
    let columns: Vec<_> = order.iter().take(count).map(|k| eigen.vectors.column(*k)).collect();
    DMatrix::from_columns(&columns)
}

/// Splits every class in two across its principal axis.
fn halve(points: &DMatrix<f64>, classes: &[usize]) -> Vec<usize> {
    let mut halves: Vec<usize> = classes.iter().map(|class| 2 * class).collect();
    for class in 0..=classes.iter().copied().max().unwrap_or(0) {
        let members = RowDVector::from_iterator(
            classes.len(),
            classes.iter().map(|other| f64::from(u8::from(*other == class))),
        );
        let (mean, covariance) = moments(points, &members);
        let axis = leading_axes(covariance, 1);
        for (n, point) in points.column_iter().enumerate() {
            if classes[n] == class && (point - &mean).dot(&axis.column(0)) > 0.0 {
                halves[n] += 1;
            }
        }
    }
    halves
}

/// Class by point: probabilities of the classes, given the moments that follow from the old ones.
fn reassess(points: &DMatrix<f64>, spread: &DMatrix<f64>, memberships: &DMatrix<f64>) -> DMatrix<f64> {
    let everything = RowDVector::from_element(points.ncols(), 1.0);
    let (_, of_set) = moments(points, &everything);
    let mut densities = DMatrix::zeros(memberships.nrows(), points.ncols());
    for (k, weights) in memberships.row_iter().enumerate() {
        let (mean, covariance) = moments(points, &weights.into_owned());
        let covariance = shrunk(&covariance, weights.sum(), &of_set) + spread;
        // A covariance ruined by rounding takes no points.
        let Some(factor) = covariance.cholesky() else { continue };
        let mut centred = points.clone();
        centred.column_iter_mut().for_each(|mut column| column -= &mean);
        factor.l_dirty().solve_lower_triangular_mut(&mut centred);
        let constant = weights.sum().max(f64::MIN_POSITIVE).ln() - factor.ln_determinant() / 2.0;
        for (n, column) in centred.column_iter().enumerate() {
            densities[(k, n)] = constant - column.norm_squared() / 2.0;
        }
    }
    for mut column in densities.column_iter_mut() {
        let most = column.max();
        column.apply(|density| *density = (*density - most).exp());
        column /= column.sum();
    }
    densities
}
