//! The model error: what no unknown explains, smooth over a panel and similar in all channels.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use super::corners::shifts;
use super::day::Day;
use super::parts::Place;
use super::priors::Priors;
use crate::solve::dense::{add, add_rows, cholesky, columns, inverse_of_lower};

/// Correlated error of facets, relative to their values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModelError<'a> {
    priors: &'a Priors,
    /// Share of the sky in the light.
    diffuse: f64,
    /// Size, relative to usual photographs.
    size: f64,
}

/// Depth over which the crease or an outer side matters, in panel depths.
const SIDE_DEPTH: f64 = 0.06;
/// Share of the variance there that is common to all channels.
const SIDE_SHARED: f64 = 0.8;

impl<'a> ModelError<'a> {
    /// For photographs of sheets that the sheet models describe, on this kind of day, which deviate from the
    /// ideal `size` times as much as usual ones.
    #[must_use]
    pub fn of(priors: &'a Priors, day: Day, size: f64) -> Self {
        Self { priors, diffuse: day.diffuse_share(priors), size }
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
        let [shared, own, white, corner, aside] = self.variances();
        // its lower triangle is all that is factored
        let covariance = |i: usize, j: usize| {
            if i < j {
                return 0.0;
            }
            let ((a, c), (b, d)) = ((i % facets, i / facets), (j % facets, j / facets));
            let own = if c == d { own } else { 0.0 };
            let mut relative = (shared + own) * correlations[(a.max(b), a.min(b))];
            if a == b {
                relative += at_sides[a] * if c == d { 1.0 } else { SIDE_SHARED };
            }
            if i == j {
                relative += white;
            }
            let noise = if i == j { sd[(a, c)].powi(2) } else { 0.0 };
            relative * values[(a, c)] * values[(b, d)] + noise
        };
        let count = values.len();
        let mut covariance = DMatrix::from_fn(count, count, covariance);
        for shift in shifts(places, values) {
            covariance.ger(corner, &shift, &shift, 1.0);
        }
        let side = |i: usize| if places[i % facets].panel == 0 { values[i] } else { -values[i] };
        let sides = DVector::from_fn(count, |i, _| side(i));
        covariance.ger(aside, &sides, &sides, 1.0);
        let inverse = inverse_of_lower(cholesky(covariance)?.l_dirty());
        let ln_determinant = inverse.diagonal().iter().map(|value| value.ln()).sum();
        Some(Whitening { inverse, ln_determinant })
    }

    /// Variances: of what all channels share, of each channel by itself, of each facet by itself, of the
    /// position of a corner, and of light from the side, which one panel gains and the other loses.
    fn variances(&self) -> [f64; 5] {
        let Self { priors, diffuse, .. } = self;
        let shared = priors.discrepancy_shared.hypot(diffuse * priors.discrepancy_sky);
        let aside = diffuse * priors.discrepancy_sky_aside;
        [shared, priors.discrepancy_own, priors.discrepancy_white, priors.corner, aside]
            .map(|sd| (self.size * sd).powi(2))
    }

    /// Variance of a facet's own error at the crease and at the outer side.
    fn at_sides(&self, place: &Place) -> f64 {
        let at = |sd: f64, away: f64| (self.size * sd * (-0.5 * (away / SIDE_DEPTH).powi(2)).exp()).powi(2);
        at(self.priors.discrepancy_at_crease, place.depth)
            + at(self.priors.discrepancy_at_outer_side, 1.0 - place.depth)
    }

    fn correlation(&self, a: &Place, b: &Place) -> f64 {
        let apart = (a.depth - b.depth).powi(2) + (a.along - b.along).powi(2);
        let square = apart / self.priors.discrepancy_length.powi(2);
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
