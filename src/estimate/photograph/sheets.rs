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
    /// Changes of that radiance with the shape of the fold and the place of the sun: facet by
    /// [`POWERS`](crate::sheet::POWERS) for each of [`CHANGES`].
    /// `None` if it has none.
    pub changes: Option<DMatrix<f64>>,
}

/// Radii of the crease at which changes with it are tabulated, in panel depths.
pub const CREASE_RADII: [f64; 2] = [0.012, 0.03];
/// Number of changes: with the crease rounded at each of [`CREASE_RADII`], per degree by which the facet's
/// own panel bows, and per degree of the sun's tilt.
pub const CHANGES: usize = 4;

impl Departure {
    /// The departure of a Lambertian sheet itself.
    #[must_use]
    pub fn none(like: &Radiance) -> Self {
        Self { radiance: Radiance::zeros(like.nrows(), like.ncols()), reflectance: [1.0, 0.0], changes: None }
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
            if let Some(changes) = &other.changes {
                let own =
                    self.changes.get_or_insert_with(|| DMatrix::zeros(changes.nrows(), changes.ncols()));
                add(own.as_mut_slice(), share, changes.as_slice());
            }
            let departed = other.reflectance.iter().zip(&reference);
            for (sum, (other, reference)) in self.reflectance.iter_mut().zip(departed) {
                *sum += share * (other - reference);
            }
        }
    }
}

/// Nodes of the grid of a formula's parameters: specular weights, the first of which is 0.
pub const SPECULAR_WEIGHTS: [f64; 3] = [0.0, 0.4, 1.0];
/// Specular roughnesses.
pub const SPECULAR_ROUGHNESSES: [f64; 3] = [0.28, 0.42, 0.65];
/// Body roughnesses, degrees.
pub const BODY_ROUGHNESSES_DEG: [f64; 3] = [0.0, 12.0, 25.0];
/// Values of sheen for which it is tabulated, in the middle of that grid.
pub const SHEEN: [f64; 2] = [0.4, 1.0];

/// Errors of the 45:0 reflectance of a measured sheet inferred from its facets by means of the others,
/// relative to the albedo: common to all bands (6.3 to 6.7 %, each left out in turn on two folds), and in
/// addition in each band, smooth over the wavelengths (for the six that were photographed).
pub const INSTRUMENT_SHARED: f64 = 0.065;
/// The addition in each band.
pub const INSTRUMENT_OWN: f64 = 0.06;

/// Known reflection of sheets.
#[derive(Clone, Debug)]
pub struct Sheets {
    /// Sheets with an Oren-Nayar body and a microfacet surface, over the grid of specular weights, specular
    /// roughnesses and body roughnesses, the last varying fastest.
    pub families: Vec<Departure>,
    /// Changes by [`SHEEN`].
    pub sheen: [Departure; 2],
    /// The measured sheets.
    pub measured: Vec<Departure>,
}
