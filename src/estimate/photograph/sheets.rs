//! What is known of how sheets reflect: how one that is not Lambertian departs from one that is, of the same
//! albedo.

use super::sums::{Radiance, add};

/// How a sheet departs from a Lambertian one.
#[derive(Clone, Debug)]
pub struct Departure {
    /// What its facets have more, at the nodes of albedo.
    pub radiance: Radiance,
    /// Its 45:0 reflectance is the first times its albedo, plus the second.
    pub reflectance: [f64; 2],
}

impl Departure {
    /// That of a Lambertian sheet.
    #[must_use]
    pub fn none(like: &Radiance) -> Self {
        Self { radiance: Radiance::zeros(like.nrows(), like.ncols()), reflectance: [1.0, 0.0] }
    }

    /// What it has more than another.
    #[must_use]
    pub fn less(&self, other: &Self) -> Self {
        let mut difference = self.clone();
        difference.add(-1.0, other, [0.0; 2]);
        difference
    }

    /// Adds a share of another, the reflectance of which counts from `reference`.
    pub fn add(&mut self, share: f64, other: &Self, reference: [f64; 2]) {
        if share != 0.0 {
            add(self.radiance.as_mut_slice(), share, other.radiance.as_slice());
            let departed = other.reflectance.iter().zip(&reference);
            for (sum, (other, reference)) in self.reflectance.iter_mut().zip(departed) {
                *sum += share * (other - reference);
            }
        }
    }
}

/// Where a grid of families is known: strength and roughness of the surface, roughness of the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FamilyNodes {
    /// Strengths of the surface's reflection, the first of them 0.
    pub specular_weight: [f64; 3],
    /// Its roughnesses.
    pub specular_roughness: [f64; 3],
    /// Roughnesses of the body, degrees.
    pub body_roughness_deg: [f64; 3],
}

/// The nodes that are used.
pub const FAMILY_NODES: FamilyNodes = FamilyNodes {
    specular_weight: [0.0, 0.4, 1.0],
    specular_roughness: [0.28, 0.42, 0.65],
    body_roughness_deg: [0.0, 12.0, 25.0],
};

/// Sizes of sheen at which it is known, on the family in the middle of [`FAMILY_NODES`].
pub const SHEEN: [f64; 2] = [0.4, 1.0];
/// What is known of how sheets reflect.
#[derive(Clone, Debug)]
pub struct Sheets {
    /// Sheets with a body of Oren and Nayar's and a surface of microfacets, over [`FAMILY_NODES`]: strength,
    /// roughness of the surface, roughness of the body, the last fastest.
    pub families: Vec<Departure>,
    /// What [`SHEEN`] changes.
    pub sheen: [Departure; 2],
    /// Sheets that were measured, each.
    pub measured: Vec<Departure>,
    /// What facets do not tell of measured sheets.
    pub instrument: Instrument,
}

/// By how much more or less an instrument of 45:0 says of a sheet than sheets that send the same to the
/// camera: standard deviations relative to the albedo.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instrument {
    /// In all wavebands alike.
    pub shared: f64,
    /// In each waveband for itself, smooth over the wavelengths.
    pub own: f64,
}
