//! Known reflection of sheets: departures of non-Lambertian sheets from a Lambertian one of the same albedo.

use nalgebra::DMatrix;

use crate::solve::dense::add;

/// Radiance of all facets at the albedo nodes: facet by node.
pub type Radiance = DMatrix<f64>;

/// Departure of a sheet from a Lambertian one.
#[derive(Clone, Debug)]
pub struct Departure {
    /// Additional radiance of its facets, at the albedo nodes.
    pub radiance: Radiance,
    /// Its 45:0 reflectance is the first number times its albedo, plus the second.
    pub reflectance: [f64; 2],
}

impl Departure {
    /// The departure of a Lambertian sheet itself.
    #[must_use]
    pub fn none(like: &Radiance) -> Self {
        Self { radiance: Radiance::zeros(like.nrows(), like.ncols()), reflectance: [1.0, 0.0] }
    }

    /// Its difference from another.
    #[must_use]
    pub fn less(&self, other: &Self) -> Self {
        let mut difference = self.clone();
        difference.add(-1.0, other, [0.0; 2]);
        difference
    }

    /// Adds a multiple of another, whose reflectance counts relative to `reference`.
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

/// Nodes of the grid of formula parameters: specular weight and roughness, body roughness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FamilyNodes {
    /// Specular weights, the first of which is 0.
    pub specular_weight: [f64; 3],
    /// Specular roughnesses.
    pub specular_roughness: [f64; 3],
    /// Body roughnesses, degrees.
    pub body_roughness_deg: [f64; 3],
}

/// The nodes used.
pub const FAMILY_NODES: FamilyNodes = FamilyNodes {
    specular_weight: [0.0, 0.4, 1.0],
    specular_roughness: [0.28, 0.42, 0.65],
    body_roughness_deg: [0.0, 12.0, 25.0],
};

/// Values of sheen for which it is tabulated, with the middle of [`FAMILY_NODES`].
pub const SHEEN: [f64; 2] = [0.4, 1.0];
/// Known reflection of sheets.
#[derive(Clone, Debug)]
pub struct Sheets {
    /// Sheets with an Oren-Nayar body and a microfacet surface, over [`FAMILY_NODES`]: specular weight,
    /// specular roughness, body roughness, the last varying fastest.
    pub families: Vec<Departure>,
    /// Changes by [`SHEEN`].
    pub sheen: [Departure; 2],
    /// The measured sheets.
    pub measured: Vec<Departure>,
    /// Properties of measured sheets that facets do not reveal.
    pub instrument: Instrument,
}

/// Differences in the 45:0 reading of an instrument between sheets that look the same to the camera: standard
/// deviations relative to the albedo.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instrument {
    /// Common to all wavebands.
    pub shared: f64,
    /// In each waveband by itself, smooth over the wavelengths.
    pub own: f64,
}
