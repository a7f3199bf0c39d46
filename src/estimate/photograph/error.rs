//! What no unknown explains: smooth over a panel, alike in the channels.

use nalgebra::{Cholesky, DMatrix};

use super::parts::Place;

/// Correlated error of facets, relative to their values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModelError {
    /// Standard deviation of what all channels share.
    pub shared: f64,
    /// Of what each channel has to itself.
    pub own: f64,
    /// Of what each facet has to itself.
    pub white: f64,
    /// Of what the facets at the crease have to themselves: the crease is not where it is clicked, nor as sharp.
    pub at_crease: f64,
}

/// Length over which the error is correlated, in depths of a panel.
const LENGTH: f64 = 0.3;
/// Correlation between places that mirror each other on the two panels.
const BETWEEN_PANELS: f64 = 0.3;
/// Depth over which the crease matters, in depths of a panel.
const CREASE_DEPTH: f64 = 0.06;

impl ModelError {
    /// The inverse of the Cholesky factor of the covariance of all values, facet by facet and in each channel by channel.
    ///
    /// # Arguments
    /// - `places`: of the facets; `values`, `sd`: facet by channel, the values and the standard deviations of their noise.
    #[must_use]
    pub fn whitening(
        &self,
        places: &[Place],
        values: &DMatrix<f64>,
        sd: &DMatrix<f64>,
    ) -> Option<DMatrix<f64>> {
        let channels = values.ncols();
        let covariance = |i: usize, j: usize| {
            let ((a, c), (b, d)) = ((i / channels, i % channels), (j / channels, j % channels));
            let own = if c == d { self.own.powi(2) } else { 0.0 };
            let mut relative = (self.shared.powi(2) + own) * correlation(&places[a], &places[b]);
            if i == j {
                let crease = self.at_crease * (-0.5 * (places[a].depth / CREASE_DEPTH).powi(2)).exp();
                relative += self.white.powi(2) + crease.powi(2);
            }
            let noise = if i == j { sd[(a, c)].powi(2) } else { 0.0 };
            relative * values[(a, c)] * values[(b, d)] + noise
        };
        let count = values.len();
        let covariance = DMatrix::from_fn(count, count, covariance);
        let factor = Cholesky::new(covariance)?.l();
        factor.solve_lower_triangular(&DMatrix::identity(count, count))
    }
}

fn correlation(a: &Place, b: &Place) -> f64 {
    let square = ((a.depth - b.depth).powi(2) + (a.along - b.along).powi(2)) / LENGTH.powi(2);
    let panels = if a.panel == b.panel { 1.0 } else { BETWEEN_PANELS };
    panels * (-0.5 * square).exp()
}
