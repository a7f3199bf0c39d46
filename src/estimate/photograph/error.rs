//! What no unknown explains: smooth over a panel, alike in the channels.

use nalgebra::{Cholesky, DMatrix, DMatrixView, DVector, Dyn, U1};

use super::corners::shifts;
use super::day::Day;
use super::parts::Place;
use super::priors::Priors;
use super::sums::add;

/// Correlated error of facets, relative to their values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModelError {
    /// Standard deviation of what all channels share.
    pub shared: f64,
    /// Of what each channel has to itself.
    pub own: f64,
    /// Of what each facet has to itself.
    pub white: f64,
    /// Of what the facets at the crease have to themselves, nearly all of it in all channels: the crease is
    /// not as sharp, nor as round, as the model has it.
    pub at_crease: f64,
    /// Of what the facets at the outer sides have to themselves, nearly all of it in all channels: an edge is
    /// not straight, nor sharp, so that some of the background is taken for the sheet.
    pub at_outer_side: f64,
    /// How far a corner is from where it is marked, in depths of a panel.
    pub corner: f64,
    /// Length over which it is correlated, in depths of a panel.
    pub length: f64,
    /// Of one panel beside the other, in all channels alike: light that comes from aside.
    pub aside: f64,
}

/// Depth over which the crease or an outer side matters, in depths of a panel.
const SIDE_DEPTH: f64 = 0.06;
/// Share of the variance there that is alike in all channels.
const SIDE_SHARED: f64 = 0.8;

impl ModelError {
    /// That of photographs of sheets that the kinds describe, on such a day.
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

    /// The same in a photograph that is so many times as far from an ideal one.
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

    /// What makes errors of all values standard normal; none if their covariance is not finite.
    ///
    /// # Arguments
    /// - `places`: of the facets; `values`, `sd`: facet by channel, the values as they are predicted and the
    ///   standard deviations of their noise. Of measured values those that chance made too small would count
    ///   for more (R. W. Peelle, Oak Ridge National Laboratory, 1987).
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
        let factor = Cholesky::new(covariance)?.unpack();
        let mut inverse = DMatrix::zeros(count, count);
        for n in 0..count {
            // what is before the diagonal stays 0
            let mut column = inverse.view_mut((n, n), (count - n, 1));
            column[0] = 1.0;
            factor.view((n, n), (count - n, count - n)).solve_lower_triangular_mut(&mut column);
        }
        let ln_determinant = inverse.diagonal().iter().map(|value| value.ln()).sum();
        Some(Whitening { inverse, ln_determinant })
    }

    /// Variance of what a facet has to itself at the crease and at the outer side.
    fn at_sides(&self, place: &Place) -> f64 {
        let at = |sd: f64, away: f64| (sd * (-0.5 * (away / SIDE_DEPTH).powi(2)).exp()).powi(2);
        at(self.at_crease, place.depth) + at(self.at_outer_side, 1.0 - place.depth)
    }

    fn correlation(&self, a: &Place, b: &Place) -> f64 {
        let square = ((a.depth - b.depth).powi(2) + (a.along - b.along).powi(2)) / self.length.powi(2);
        if a.panel == b.panel { (-0.5 * square).exp() } else { 0.0 }
    }
}

/// What makes errors of all values standard normal: the inverse of the Cholesky factor of their covariance.
pub struct Whitening {
    inverse: DMatrix<f64>,
    ln_determinant: f64,
}

/// Rows that are multiplied at once: of a triangle, half of the work is saved but for these.
const ROWS: usize = 60;

impl Whitening {
    /// Logarithm of the factor by which it makes volumes of errors larger.
    #[must_use]
    pub fn ln_determinant(&self) -> f64 {
        self.ln_determinant
    }

    /// Errors of all values, channel by channel and in each facet by facet.
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
        let mut white = DMatrix::zeros(errors.nrows(), errors.ncols());
        for (rows, end) in self.rows() {
            let mut white = white.rows_mut(end - rows.nrows(), rows.nrows());
            white.gemm(1.0, &rows, &errors.rows(0, end), 0.0);
        }
        white
    }

    /// A few rows after the other, up to the diagonal of the last of them, and where that is.
    fn rows(&self) -> impl Iterator<Item = (DMatrixView<'_, f64, U1, Dyn>, usize)> {
        let count = self.inverse.nrows();
        (0..count).step_by(ROWS).map(move |start| {
            let end = count.min(start + ROWS);
            (self.inverse.view((start, 0), (end - start, end)), end)
        })
    }
}
