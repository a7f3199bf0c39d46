//! How finely a fold's radiosity is resolved to be as exact as asked for.

use std::f64::consts::FRAC_PI_4;

use crate::geometry::Fold;

/// Exchange that is left out, relative to the error that is aimed at and the share of light that a bounce
/// loses at least.
const NEGLIGIBLE: f64 = 0.01;

/// How finely the radiosity of a panel is resolved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    /// Strips from the crease to the middle of a square panel.
    pub crease_strips: usize,
    /// Strips from the end of the crease to its middle, on a square panel opened by half a radian.
    pub end_strips: usize,
    /// Polynomials on a cell in either direction, both degrees together being less than this.
    pub order: usize,
    /// Nodes per e-fold of the distance.
    pub nodes: usize,
    /// Exchange between two functions, of 1 at most, that is left out below this.
    pub negligible: f64,
}

impl Resolution {
    /// The resolution that reaches about `aim`, a relative error of facet means at reflectance 1; found by
    /// trying.
    #[must_use]
    pub fn reaching(aim: f64, fold: &Fold) -> Self {
        // Less averages out on facets that are smaller, at the crease, than those of ten rows.
        let small = (10.0 * first_row(fold)).min(1.0);
        // What a twentieth of the error takes.
        let levels = (1e-5 / (small * aim)).ln() / 20_f64.ln();
        // In narrow folds light spreads less between one bounce and the next, and bounces longer.
        let open = fold.angle_rad().min(FRAC_PI_4) / FRAC_PI_4;
        let (narrow, bounces) = (1.0 - open, -open.ln());
        let count = |at_1e5: f64, a_level: f64| (at_1e5 + a_level * levels).ceil().max(2.0) as usize;
        Self {
            crease_strips: count(3.28 + narrow, 0.95),
            end_strips: count(2.42, 0.85),
            order: count(6.7 + 1.3 * narrow + 0.35 * bounces, 1.6 + 0.45 * narrow),
            nodes: count(5.6 + narrow + 0.05 * bounces, 1.6).max(4),
            // What is left out many times must not add up to what the solution may be off by, in narrow folds
            // over many bounces.
            negligible: NEGLIGIBLE * aim * (0.5 * fold.angle_rad()).sin(),
        }
    }
}

/// Depth of the first row of facets by that of its panel, the smaller of both panels.
fn first_row(fold: &Fold) -> f64 {
    let first = |panel: usize| fold.row_edges()[panel][1] / fold.depths()[panel];
    first(0).min(first(1))
}
