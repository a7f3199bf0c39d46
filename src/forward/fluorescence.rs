//! A fluorescent sheet: it reflects light, and also emits light of longer wavelengths than it absorbs.

use nalgebra::DMatrix;

use super::families::Family;
use super::model::FacetModel;
use crate::error::{Error, Result};

/// A surface made of one matte sheet that, where light falls on it directly, reflects it and emits a fraction
/// of what white would reflect.
///
/// Both bounce alike: B = (I − ρK)⁻¹ (ρ + f) E₀ in every waveband, where f is that fraction.
#[derive(Clone, Copy, Debug)]
pub struct Fluorescing<'a> {
    model: &'a FacetModel,
    reflectance: &'a [f64],
    fluorescence: &'a [f64],
}

impl<'a> Fluorescing<'a> {
    /// A sheet of this `reflectance` and `fluorescence`, the latter relative to white in the same light, one
    /// number from 0 per waveband.
    ///
    /// # Errors
    /// [`Error::Field`] if a part of the surface has a known reflectance: light reflected by it would excite
    /// the sheet by an amount that `fluorescence` does not specify.
    ///
    /// # Example
    /// ```
    /// use nalgebra::dmatrix;
    /// use vfold::camera::CameraResponse;
    /// use vfold::forward::{FacetModel, Fluorescing};
    /// use vfold::surfaces::{DenseExchange, SurfaceResponse};
    /// // Two like patches hand half of their light to each other, and one is lit.
    /// let exchange = DenseExchange::new(&dmatrix![0.0, 0.5; 0.5, 0.0], &[1.0, 1.0], vec![0, 1]);
    /// let (response, _) = SurfaceResponse::solve(&exchange, &[1.0, 0.0], 1e-12)?;
    /// let model = FacetModel::of_surface(&[(response, CameraResponse::from_weights(vec![vec![1.0]]))]);
    /// let rgb = Fluorescing::new(&model, &[0.8], &[0.1])?.facet_rgb();
    /// assert!((rgb[0] - 0.9 / (1.0 - 0.16)).abs() < 1e-14);
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn new(model: &'a FacetModel, reflectance: &'a [f64], fluorescence: &'a [f64]) -> Result<Self> {
        if model.is_of_one_sheet() {
            return Ok(Self { model, reflectance, fluorescence });
        }
        let problem = "fluorescence is not computed beside parts of known reflectance; \
                       fold the sheet alone";
        Err(Error::field("fluorescence", problem))
    }

    /// RGB of every facet at exposure 1, as [`FacetModel::facet_rgb`].
    #[must_use]
    pub fn facet_rgb(&self) -> DMatrix<f64> {
        self.model.facet_rgb(self.reflectance) + self.emitted(Family::gain)
    }

    /// The part of it that has bounced more than `bounces` times, as [`FacetModel::facet_rgb_after`].
    #[must_use]
    pub fn facet_rgb_after(&self, bounces: u32) -> DMatrix<f64> {
        let emitted = self.emitted(|family, r, g| family.gain_after(bounces, r, g));
        self.model.facet_rgb_after(bounces, self.reflectance) + emitted
    }

    /// RGB of emitted light with its bounces, which multiply it by `gain`.
    fn emitted(&self, gain: impl Fn(&Family, f64, f64) -> f64) -> DMatrix<f64> {
        self.model.rgb_of(self.reflectance, Some(self.fluorescence), gain)
    }
}
