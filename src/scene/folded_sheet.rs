//! A fold of a sheet that is not Lambertian, seen from the position of a camera.

use nalgebra::{DMatrix, Point3, Vector3};
use ndarray::{Array2, Axis};

use super::FoldSetting;
use crate::camera::CameraResponse;
use crate::error::{Error, Result};
use crate::estimate::photograph::chebyshev::nodes;
use crate::geometry::{FacetGrid, Fold, Light, Spacing};
use crate::kernel::quadrature::Lagrange;
use crate::sheet::Shape;
use crate::transport::departures;

/// The difference between a sheet and a Lambertian one.
pub struct FoldedSheet {
    shape: Shape,
    nodes: Lagrange,
    /// Additional radiance of the facets: facet by node.
    beyond: Array2<f64>,
    camera: CameraResponse,
}

impl FoldSetting {
    /// A sheet of this shape in this fold, seen from `eye` in the fold's unit, on the facets of the scene or
    /// on `finer` ones.
    ///
    /// # Errors
    /// [`Error::Field`] if the scene has a card, panels of different depth, or more than one light.
    pub fn folded_sheet(
        &self,
        shape: Shape,
        eye: Vector3<f64>,
        finer: Option<FacetGrid>,
    ) -> Result<FoldedSheet> {
        if let Some(why) = self.unmodelled()? {
            return Err(why.refused());
        }
        let fold = match finer {
            Some(grid) => self.fold.with_facets(grid)?.with_spacing(Spacing::Uniform),
            None => self.fold,
        };
        Ok(FoldedSheet::new(&fold, &self.light, self.lighting()?.sun, shape, eye))
    }
}

impl FoldedSheet {
    fn new(fold: &Fold, light: &Light, camera: CameraResponse, shape: Shape, eye: Vector3<f64>) -> Self {
        let nodes = nodes();
        let all =
            departures(fold, &light.towards(), &Point3::from(eye), std::slice::from_ref(&shape), &nodes);
        let beyond = all.index_axis(Axis(0), 0).to_owned();
        Self { shape, nodes: Lagrange::new(&nodes), beyond, camera }
    }

    /// Albedo in every waveband of a sheet with this 45:0 reflectance.
    ///
    /// # Errors
    /// [`Error::Usage`] if no such sheet has it: its surface alone reflects more, or it would reflect more
    /// light than it receives.
    pub fn albedo(&self, reflectance: &[f64]) -> Result<Vec<f64>> {
        let [slope, offset] = self.shape.slope_and_offset();
        let of = |reflectance: &f64| {
            let albedo = (reflectance - offset) / slope;
            if (0.0..=1.0).contains(&albedo) {
                return Ok(albedo);
            }
            let problem = format!(
                "no sheet with this surface reflects {reflectance} at 45°:0°, but {:.3} to {:.3}",
                offset.max(0.0),
                slope + offset
            );
            Err(Error::usage(
                "--reflectance",
                problem,
                "stay in that range, or reduce --specular-weight, --body-roughness-deg or --sheen",
            ))
        };
        reflectance.iter().map(of).collect()
    }

    /// Additional values of the facets under the sun compared with a Lambertian sheet of this albedo: facet
    /// by channel.
    #[must_use]
    pub fn beyond(&self, albedo: &[f64]) -> DMatrix<f64> {
        let (facets, nodes) = self.beyond.dim();
        let mut shares = vec![0.0; nodes];
        let mut rgb = DMatrix::zeros(facets, self.camera.channels());
        for (band, albedo) in albedo.iter().enumerate() {
            if !self.camera.sees(band) {
                continue;
            }
            self.nodes.at(*albedo, &mut shares);
            for (facet, beyond) in self.beyond.axis_iter(Axis(0)).enumerate() {
                let light: f64 = beyond.iter().zip(&shares).map(|(beyond, share)| beyond * share).sum();
                for channel in 0..rgb.ncols() {
                    rgb[(facet, channel)] += light * self.camera.channel(channel)[band];
                }
            }
        }
        rgb
    }
}
