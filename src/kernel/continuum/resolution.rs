//! The resolution of a fold's radiosity required for a given accuracy.

use std::f64::consts::FRAC_PI_4;

use crate::geometry::Fold;

/// Neglected exchange, relative to the target error and to the minimum share of light lost per bounce.
const NEGLIGIBLE: f64 = 0.01;

/// Resolution of the radiosity of a panel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    /// Strips from the crease to the middle of a square panel.
    pub crease_strips: usize,
    /// Strips from the end of the crease to its middle, for a square panel opened by half a radian.
    pub end_strips: usize,
    /// Polynomials on a cell in either direction; the sum of both degrees is less than this.
    pub order: usize,
    /// Nodes per e-fold of the distance.
    pub nodes: usize,
    /// Threshold below which the exchange between two functions, which is at most 1, is neglected.
    pub negligible: f64,
}

impl Resolution {
    /// The resolution that reaches about `aim`, a relative error of facet means at reflectance 1, tuned by
    /// experiment.
    #[must_use]
    pub fn reaching(aim: f64, fold: &Fold) -> Self {
        // Facets at the crease that are smaller than those of ten rows average less.
        let small = (10.0 * first_row(fold)).min(1.0);
        // Levels of refinement, each of which divides the error by twenty.
        let levels = (1e-5 / (small * aim)).ln() / 20_f64.ln();
        // In narrow folds light spreads less per bounce, and bounces more often.
        let open = fold.angle_rad().min(FRAC_PI_4) / FRAC_PI_4;
        let (narrow, bounces) = (1.0 - open, -open.ln());
        let count = |at_1e5: f64, a_level: f64| (at_1e5 + a_level * levels).ceil().max(2.0) as usize;
        Self {
            crease_strips: count(3.28 + narrow, 0.95),
            end_strips: count(2.42, 0.85),
            order: count(6.7 + 1.3 * narrow + 0.35 * bounces, 1.6 + 0.45 * narrow),
            nodes: count(5.6 + narrow + 0.05 * bounces, 1.6).max(4),
            // The sum of all that is neglected must stay below the error of the solution, in narrow folds
            // over many bounces.
            negligible: NEGLIGIBLE * aim * (0.5 * fold.angle_rad()).sin(),
        }
    }
}

/// Smaller ratio, of the two panels, of the depth of the first row of facets to that of the panel.
fn first_row(fold: &Fold) -> f64 {
    let first = |panel: usize| fold.row_edges()[panel][1] / fold.depths()[panel];
    first(0).min(first(1))
}
