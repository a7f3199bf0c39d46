//! The scene's geometry: a fold and its facets.

use serde::{Deserialize, Serialize};

use super::Scene;
use super::surface::MeshRecord;
use crate::error::{Error, Result};
use crate::geometry::{FacetGrid, Fold, Spacing};

/// A fold, or what [`super::surface`] knows.
#[derive(Serialize, Deserialize)]
#[serde(tag = "shape", rename_all = "lowercase")]
pub(super) enum GeometryRecord {
    Fold(FoldRecord),
    Mesh(MeshRecord),
    Kernel,
}

#[derive(Serialize, Deserialize)]
pub(super) struct FoldRecord {
    angle_deg: f64,
    panel: [f64; 2],
    /// Where it differs from panel 0's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    panel1_depth: Option<f64>,
}

#[derive(Serialize, Deserialize)]
struct FacetsRecord {
    panels: usize,
    rows: usize,
    cols: usize,
    /// Uniform if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    spacing: Option<SpacingRecord>,
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum SpacingRecord {
    Uniform,
    Graded,
}

impl Scene {
    pub(super) fn set_fold(&mut self, fold: &Fold) -> Result<()> {
        let [depth0, depth1] = fold.depths();
        let record = FoldRecord {
            angle_deg: fold.angle_deg(),
            panel: [fold.width(), depth0],
            panel1_depth: (!fold.is_symmetric()).then_some(depth1),
        };
        self.fields.set("geometry", GeometryRecord::Fold(record))?;
        let FacetGrid { rows, cols } = fold.facets();
        let spacing = match fold.spacing() {
            Spacing::Uniform => None,
            Spacing::Graded => Some(SpacingRecord::Graded),
        };
        self.fields.set("facets", FacetsRecord { panels: 2, rows, cols, spacing })
    }

    pub(super) fn geometry(&self) -> Result<GeometryRecord> {
        self.fields.require("geometry", "make the scene with vkernel")
    }

    /// Whether the surface is a fold, with a response of its own kind.
    ///
    /// # Errors
    /// [`Error::Field`] if the geometry is missing or unknown.
    pub fn is_fold(&self) -> Result<bool> {
        Ok(matches!(self.geometry()?, GeometryRecord::Fold(_)))
    }

    /// The fold and its facets.
    ///
    /// # Errors
    /// [`Error::Field`] if they are missing or not those of a fold.
    pub fn fold(&self) -> Result<Fold> {
        let GeometryRecord::Fold(record) = self.geometry()? else {
            let problem =
                "a fold is needed here, and this is another shape; make the scene with vkernel --angle-deg";
            return Err(Error::field("geometry", problem));
        };
        let facets: FacetsRecord = self.fields.require("facets", "make the scene with vkernel")?;
        let grid = FacetGrid { rows: facets.rows, cols: facets.cols };
        let [width, depth] = record.panel;
        let spacing = match facets.spacing {
            None | Some(SpacingRecord::Uniform) => Spacing::Uniform,
            Some(SpacingRecord::Graded) => Spacing::Graded,
        };
        Fold::new(record.angle_deg, width, depth, grid)
            .and_then(|fold| record.panel1_depth.map_or(Ok(fold), |depth| fold.with_panel1_depth(depth)))
            .map(|fold| fold.with_spacing(spacing))
            .map_err(|e| Error::field("geometry", e))
    }
}
