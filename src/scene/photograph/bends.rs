//! The fold of a photograph, ideal and bent in the ways that matter in all light.

use crate::estimate::photograph::sheets::CREASE_RADII;
use crate::geometry::Fold;
use crate::kernel::bent::{BentExchange, BentFold, View};

/// Degrees of bow at which bends are tabulated.
pub const BOWS_DEG: [f64; 2] = [-3.0, 3.0];

/// A size of a bend, and the fold bent by it.
pub type Bent = (f64, BentExchange);

/// Bent folds as seen from the camera.
pub struct Bends {
    /// How the picture shows them.
    pub view: View,
    /// The fold as stated.
    pub ideal: BentExchange,
    /// With a rounded crease.
    pub rounded: [Bent; 2],
    /// With both panels bowed: away from the light, towards it.
    pub bowed: [Bent; 2],
}

impl Bends {
    /// Of a fold.
    pub fn of(fold: &Fold, view: View) -> Self {
        let flat = BentFold::ideal(fold.angle_deg());
        let seen = |bent: BentFold| BentExchange::new(&bent, fold, view);
        Self {
            view,
            ideal: seen(flat),
            rounded: CREASE_RADII
                .map(|crease_radius| (crease_radius, seen(BentFold { crease_radius, ..flat }))),
            bowed: BOWS_DEG.map(|bow_deg| (bow_deg, seen(BentFold { bow_deg: [bow_deg; 2], ..flat }))),
        }
    }
}
