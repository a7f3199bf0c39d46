//! The fold of a photograph, ideal and bent in the ways that matter in all light.

use nalgebra::Vector3;

use crate::geometry::Fold;
use crate::kernel::bent::{BentExchange, BentFold};

/// Sizes at which bends are tabulated: radii of the crease in panel depths, and degrees of bow.
const CREASE_RADII: [f64; 2] = [0.012, 0.03];
pub const BOWS_DEG: [f64; 2] = [-3.0, 3.0];

/// A size of a bend, and the fold bent by it.
pub type Bent = (f64, BentExchange);

/// Bent folds as seen from the camera.
pub struct Bends {
    /// The fold as stated.
    pub ideal: BentExchange,
    /// With a rounded crease.
    pub rounded: [Bent; 2],
    /// With both panels bowed: away from the light, towards it.
    pub bowed: [Bent; 2],
}

impl Bends {
    /// Of a fold seen from far away in the direction `view`.
    pub fn of(fold: &Fold, view: Vector3<f64>) -> Self {
        let flat = BentFold::ideal(fold.angle_deg());
        let seen = |bent: BentFold| BentExchange::new(&bent, fold, view);
        Self {
            ideal: seen(flat),
            rounded: CREASE_RADII
                .map(|crease_radius| (crease_radius, seen(BentFold { crease_radius, ..flat }))),
            bowed: BOWS_DEG.map(|bow_deg| (bow_deg, seen(BentFold { bow_deg: [bow_deg; 2], ..flat }))),
        }
    }
}
