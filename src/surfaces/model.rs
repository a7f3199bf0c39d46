//! The facet model of any surface with one reflectance: every light contributes the terms of its own
//! response.

use nalgebra::DMatrix;

use super::SurfaceResponse;
use crate::camera::CameraResponse;
use crate::forward::{FacetModel, Source, Terms};

impl FacetModel {
    /// A surface under several lights, each with the surface's response and the camera's response to its
    /// spectrum.
    ///
    /// # Example
    /// ```
    /// use nalgebra::dmatrix;
    /// use vfold::camera::CameraResponse;
    /// use vfold::forward::FacetModel;
    /// use vfold::surfaces::{DenseExchange, SurfaceResponse};
    /// // Two like patches hand half of their light to each other, and one is lit.
    /// let exchange = DenseExchange::new(&dmatrix![0.0, 0.5; 0.5, 0.0], &[1.0, 1.0], vec![0, 1]);
    /// let (response, _) = SurfaceResponse::solve(&exchange, &[1.0, 0.0], 1e-12)?;
    /// let eye = CameraResponse::from_weights(vec![vec![1.0]]);
    /// let rgb = FacetModel::of_surface(&[(response, eye)]).facet_rgb(&[0.8]);
    /// assert!((rgb[0] - 0.8 / (1.0 - 0.16)).abs() < 1e-14);
    /// # Ok::<(), vfold::Error>(())
    /// ```
    #[must_use]
    pub fn of_surface(lights: &[(SurfaceResponse, CameraResponse)]) -> Self {
        let poles: Vec<f64> =
            lights.iter().flat_map(|(response, _)| response.modes().poles.clone()).collect();
        let mut first = 0;
        let mut sources = Vec::new();
        for (response, camera) in lights {
            let modes = response.modes();
            let mut facets = DMatrix::zeros(response.facets(), poles.len());
            facets.columns_mut(first, modes.poles.len()).copy_from(&modes.residues);
            first += modes.poles.len();
            sources.push(Source { facets, camera: camera.clone() });
        }
        Self::of(Terms::One { poles, odd: false }, sources)
    }
}
