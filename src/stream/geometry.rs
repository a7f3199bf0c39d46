//! The scene's geometry: a fold, or any surface as a mesh or by its kernel alone.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Scene;
use super::fields::BY_VKERNEL;
use super::mesh::MeshRecord;
use crate::error::{Error, Result};
use crate::geometry::Fold;

/// The surface that is lit.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(tag = "shape", rename_all = "lowercase")]
pub(super) enum GeometryRecord {
    /// Two rectangular panels that meet at a crease.
    Fold(FoldRecord),
    /// Flat facets in space.
    Mesh(MeshRecord),
    /// Facets of unknown shape, of which only the kernel is known.
    Kernel,
}

/// Two rectangular panels that meet at a crease.
#[derive(Serialize, Deserialize, JsonSchema)]
pub(super) struct FoldRecord {
    /// Angle between the panels, degrees; 180 is a flat sheet.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 180))]
    angle_deg: f64,
    /// Standard deviation of that angle, degrees, if it is known, as it is if a photograph showed the angle.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    angle_sd_deg: Option<f64>,
    /// Extent of panel 0 along the crease and away from it, in any unit.
    #[schemars(inner(range(min = 0)))]
    panel: [f64; 2],
    /// Extent of panel 1 away from the crease, in the same unit, if it differs from that of panel 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    panel1_depth: Option<f64>,
}

impl From<&Fold> for FoldRecord {
    fn from(fold: &Fold) -> Self {
        let [depth0, depth1] = fold.depths();
        Self {
            angle_deg: fold.angle_deg(),
            angle_sd_deg: None,
            panel: [fold.width(), depth0],
            panel1_depth: (!fold.is_symmetric()).then_some(depth1),
        }
    }
}

/// The error for another surface where a fold is needed.
#[must_use]
pub fn needs_fold() -> Error {
    let problem = "a fold is needed here, but this is another shape; make the scene with vkernel --angle-deg";
    Error::field("geometry", problem)
}

impl Scene {
    pub(super) fn geometry(&self) -> Result<GeometryRecord> {
        self.fields.require("geometry", BY_VKERNEL)
    }

    /// Sets the standard deviation of the fold's angle, degrees.
    ///
    /// # Errors
    /// [`Error::Field`] if the surface is not a fold.
    pub fn set_angle_sd_deg(&mut self, sd_deg: f64) -> Result<()> {
        let GeometryRecord::Fold(fold) = self.geometry()? else { return Err(needs_fold()) };
        self.fields.set("geometry", GeometryRecord::Fold(FoldRecord { angle_sd_deg: Some(sd_deg), ..fold }))
    }

    /// Standard deviation of the fold's angle, degrees; none if it was not stated, or there is no fold.
    ///
    /// # Errors
    /// [`Error::Field`] if the geometry is missing or unknown, or the standard deviation is impossible.
    pub fn angle_sd_deg(&self) -> Result<Option<f64>> {
        let GeometryRecord::Fold(FoldRecord { angle_sd_deg, .. }) = self.geometry()? else { return Ok(None) };
        match angle_sd_deg {
            Some(sd_deg) if !(sd_deg > 0.0 && sd_deg.is_finite()) => {
                let problem = format!("{sd_deg} is not a standard deviation; give degrees above 0");
                Err(Error::field("geometry.angle_sd_deg", problem))
            }
            known => Ok(known),
        }
    }

    /// The fold and its facets.
    ///
    /// # Errors
    /// [`Error::Field`] if they are missing or not those of a fold.
    pub fn fold(&self) -> Result<Fold> {
        self.fold_if_one()?.ok_or_else(needs_fold)
    }

    /// The same, or none if the surface is not a fold.
    ///
    /// # Errors
    /// [`Error::Field`] if the geometry is missing or unknown, or that of an impossible fold.
    pub fn fold_if_one(&self) -> Result<Option<Fold>> {
        let FoldRecord { angle_deg, panel: [width, depth], panel1_depth, .. } = match self.geometry()? {
            GeometryRecord::Fold(fold) => fold,
            GeometryRecord::Mesh(_) | GeometryRecord::Kernel => return Ok(None),
        };
        let facets = self.facet_grid()?;
        Fold::new(angle_deg, width, depth, facets.grid())
            .and_then(|fold| panel1_depth.map_or(Ok(fold), |depth| fold.with_panel1_depth(depth)))
            .map(|fold| Some(fold.with_spacing(facets.spacing())))
            .map_err(|e| Error::field("geometry", e))
    }
}
