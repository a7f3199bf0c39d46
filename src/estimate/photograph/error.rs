//! The model error: what no unknown explains, smooth over a panel and similar in all channels.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use super::corners::shifts;
use super::day::Day;
use super::parts::Place;
use super::priors::Priors;
use crate::solve::dense::{add, add_rows, cholesky, columns};

/// Correlated error of facets, relative to their values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModelError {
    /// Standard deviation of the part shared by all channels.
    pub shared: f64,
    /// Of the part of each channel by itself.
    pub own: f64,
    /// Of the part of each facet by itself.
    pub white: f64,
    /// Of the facets at the crease by themselves, nearly the same in all channels: the crease is not as
    /// sharp, or as round, as in the model.
    pub at_crease: f64,
    /// Of the facets at the outer sides by themselves, nearly the same in all channels: an edge is not
    /// straight or sharp, so that some background counts as sheet.
    pub at_outer_side: f64,
    /// Displacement of a corner from its mark, in panel depths.
    pub corner: f64,
    /// Correlation length, in panel depths.
    pub length: f64,
    /// Of one panel relative to the other, the same in all channels: light from the side.
    pub aside: f64,
}

/// Depth over which the crease or an outer side matters, in panel depths.
const SIDE_DEPTH: f64 = 0.06;
/// Share of the variance there that is common to all channels.
const SIDE_SHARED: f64 = 0.8;

impl ModelError {
    /// For photographs of sheets that the sheet models describe, on this kind of day.
    #[must_use]
    pub fn of(priors: &Priors, day: Day) -> Self {
        let diffuse = day.diffuse_share(priors);
        Self {
            shared: priors.discrepancy_shared.hypot(diffuse * priors.discrepancy_sky),
            aside: diffuse * priors.discrepancy_sky_aside,
            own: priors.discrepancy_own,
            white: priors.discrepancy_white,
            at_crease: priors.discrepancy_at_crease,
            at_outer_side: priors.discrepancy_at_outer_side,
            corner: priors.corner,
            length: priors.discrepancy_length,
        }
    }

    /// The same for a photograph that deviates from the ideal `by` times as much.
    #[must_use]
    pub fn scaled(&self, by: f64) -> Self {
        let &Self { shared, own, white, at_crease, at_outer_side, corner, length, aside } = self;
        Self {
            shared: by * shared,
            own: by * own,
            white: by * white,
            at_crease: by * at_crease,
            at_outer_side: by * at_outer_side,
            corner: by * corner,
            length,
            aside: by * aside,
        }
    }

    /// The whitening of the errors of all values; `None` if their covariance is not finite.
    ///
    /// # Arguments
    /// - `places`: positions of the facets; `values`, `sd`: facet by channel, predicted values and the
    ///   standard deviations of their noise. With measured values, those that are too small by chance would
    ///   count for more (R. W. Peelle, Oak Ridge National Laboratory, 1987).
    #[must_use]
    pub fn whitening(&self, places: &[Place], values: &DMatrix<f64>, sd: &DMatrix<f64>) -> Option<Whitening> {
        let facets = values.nrows();
        let correlations = DMatrix::from_fn(facets, facets, |a, b| {
            if a < b { 0.0 } else { self.correlation(&places[a], &places[b]) }
        });
        let at_sides: Vec<f64> = places.iter().map(|place| self.at_sides(place)).collect();
        let covariance = |i: usize, j: usize| {
            let ((a, c), (b, d)) = ((i % facets, i / facets), (j % facets, j / facets));
            let own = if c == d { self.own.powi(2) } else { 0.0 };
            let mut relative = (self.shared.powi(2) + own) * correlations[(a.max(b), a.min(b))];
            if a == b {
                relative += at_sides[a] * if c == d { 1.0 } else { SIDE_SHARED };
            }
            if i == j {
                relative += self.white.powi(2);
            }
            let noise = if i == j { sd[(a, c)].powi(2) } else { 0.0 };
            relative * values[(a, c)] * values[(b, d)] + noise
        };
        let count = values.len();
        let mut covariance = DMatrix::from_fn(count, count, covariance);
        for shift in shifts(places, values) {
            covariance.ger(self.corner.powi(2), &shift, &shift, 1.0);
        }
        let aside =
            DVector::from_fn(
                count,
                |i, _| if places[i % facets].panel == 0 { values[i] } else { -values[i] },
            );
        covariance.ger(self.aside.powi(2), &aside, &aside, 1.0);
        let factor = cholesky(covariance)?.unpack();
        let mut inverse = DMatrix::zeros(count, count);
        for n in 0..count {
            // entries before the diagonal remain 0
            let mut column = inverse.view_mut((n, n), (count - n, 1));
            column[0] = 1.0;
            factor.view((n, n), (count - n, count - n)).solve_lower_triangular_mut(&mut column);
        }
        let ln_determinant = inverse.diagonal().iter().map(|value| value.ln()).sum();
        Some(Whitening { inverse, ln_determinant })
    }

    /// Variance of a facet's own error at the crease and at the outer side.
    fn at_sides(&self, place: &Place) -> f64 {
        let at = |sd: f64, away: f64| (sd * (-0.5 * (away / SIDE_DEPTH).powi(2)).exp()).powi(2);
        at(self.at_crease, place.depth) + at(self.at_outer_side, 1.0 - place.depth)
    }

    fn correlation(&self, a: &Place, b: &Place) -> f64 {
        let square = ((a.depth - b.depth).powi(2) + (a.along - b.along).powi(2)) / self.length.powi(2);
        if a.panel == b.panel { (-0.5 * square).exp() } else { 0.0 }
    }
}

/// Whitens the errors of all values: the inverse of the Cholesky factor of their covariance.
pub struct Whitening {
    inverse: DMatrix<f64>,
    ln_determinant: f64,
}

/// Rows multiplied at once: of a triangle, half of the work is saved, except within these.
const ROWS: usize = 16;

impl Whitening {
    /// Its log determinant, the logarithm of the factor by which it enlarges volumes of errors.
    #[must_use]
    pub fn ln_determinant(&self) -> f64 {
        self.ln_determinant
    }

    /// Whitens the errors of all values, ordered by channel and then facet.
    #[must_use]
    pub fn of(&self, errors: &DVector<f64>) -> DVector<f64> {
        let mut white = DVector::zeros(errors.len());
        for (n, (column, error)) in self.inverse.column_iter().zip(errors.as_slice()).enumerate() {
            add(&mut white.as_mut_slice()[n..], *error, &column.as_slice()[n..]);
        }
        white
    }

    /// The same for each column of a matrix.
    #[must_use]
    pub fn of_all(&self, errors: &DMatrix<f64>) -> DMatrix<f64> {
        let (count, mut white) = (errors.nrows(), DMatrix::zeros(errors.nrows(), errors.ncols()));
        let affected: Vec<_> = columns(errors).map(affected).collect();
        let mut first = 0;
        for alike in affected.chunk_by(|a, b| a == b) {
            let (affected, width) = (&alike[0], alike.len());
            let transposed = errors.columns(first, width).transpose();
            let own = &mut white.as_mut_slice()[first * count..(first + width) * count];
            for start in (affected.start..count).step_by(ROWS) {
                let end = count.min(start + ROWS);
                let inner = affected.start..affected.end.min(end);
                add_rows(own, start..end, (&self.inverse, &transposed), inner);
            }
            first += width;
        }
        white
    }
}

/// The values that are not zero: errors of a camera's channel leave those of the others alone.
fn affected(errors: &[f64]) -> Range<usize> {
    let counts = |error: &f64| *error != 0.0;
    match (errors.iter().position(counts), errors.iter().rposition(counts)) {
        (Some(first), Some(last)) => first..last + 1,
        _ => errors.len()..errors.len(),
    }
}
