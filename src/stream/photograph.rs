//! What a sample records of the photograph it was measured in.

use std::path::Path;

use serde::Serialize;

use super::Sample;
use super::development::DevelopmentRecord;
use crate::error::Result;
use crate::image::{FacetMeasurement, Grid, PhotographInfo, Refinement};

/// The photograph, how its numbers were understood, and where the panels lie in it.
#[derive(Clone, Debug, Serialize)]
pub struct ImageRecord {
    file: String,
    width: usize,
    height: usize,
    stored_as: String,
    transfer: &'static str,
    black_level: Levels,
    white_level: Levels,
    #[serde(skip_serializing_if = "Option::is_none")]
    sensor: Option<SensorRecord>,
    #[serde(skip_serializing_if = "Option::is_none")]
    undone: Option<DevelopmentRecord>,
    pixels_sharing_noise: Vec<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    make: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    model: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    exposure_s: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    f_number: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    iso: Option<u32>,
    orientation: u32,
    /// By number; null where none was marked.
    panels: Vec<Option<[[f64; 2]; 4]>>,
    margin_px: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    distortion: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    refined: Option<RefinedRecord>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    notes: Vec<String>,
}

/// How far corners were moved to the edges around them, px, by panel, and where there was no edge.
#[derive(Clone, Debug, Serialize)]
struct RefinedRecord {
    moved_px: Vec<[f64; 4]>,
    sides_without_edge: Vec<String>,
}

/// A level for all channels, or one for each.
#[derive(Clone, Debug, Serialize)]
#[serde(untagged)]
enum Levels {
    All(f64),
    Each(Vec<f64>),
}

impl From<&[f64]> for Levels {
    fn from(levels: &[f64]) -> Self {
        match levels {
            [level] => Self::All(*level),
            levels => Self::Each(levels.to_vec()),
        }
    }
}

/// What was read of a RAW file's sensor.
#[derive(Clone, Debug, Serialize)]
struct SensorRecord {
    #[serde(skip_serializing_if = "Option::is_none")]
    mosaic: Option<String>,
    /// Left, top, width, height, px.
    area: [usize; 4],
}

impl ImageRecord {
    /// The record of a photograph with its panels, and of how many pixels share their noise, per channel.
    #[must_use]
    pub fn new(
        path: &Path,
        info: &PhotographInfo,
        panels: &[Grid],
        margin_px: f64,
        pixels_sharing_noise: &[f64],
    ) -> Self {
        let corners = |number: usize| {
            let panel = panels.iter().find(|panel| panel.panel == Some(number))?;
            Some(panel.outline.corners().map(|corner| [corner.x, corner.y]))
        };
        let count = panels.iter().filter_map(|panel| panel.panel).max().map_or(0, |last| last + 1);
        Self {
            file: path.display().to_string(),
            width: info.width,
            height: info.height,
            stored_as: info.format.clone(),
            transfer: info.transfer_used.name(),
            black_level: info.black_level.as_slice().into(),
            white_level: info.white_level.as_slice().into(),
            sensor: info
                .sensor
                .as_ref()
                .map(|sensor| SensorRecord { mosaic: sensor.mosaic.clone(), area: sensor.area }),
            undone: info.undone.as_ref().map(DevelopmentRecord::from),
            pixels_sharing_noise: pixels_sharing_noise.to_vec(),
            make: info.camera.make.clone(),
            model: info.camera.model.clone(),
            exposure_s: info.camera.exposure_s,
            f_number: info.camera.f_number,
            iso: info.camera.iso,
            orientation: info.camera.orientation.exif(),
            panels: (0..count).map(corners).collect(),
            margin_px,
            distortion: None,
            refined: None,
            notes: info.camera.notes.clone(),
        }
    }

    /// The record with the lens's coefficients and what refinement did, if they were asked for.
    #[must_use]
    pub fn with_placing(mut self, distortion: Option<[f64; 2]>, refinement: Option<&Refinement>) -> Self {
        self.distortion = distortion;
        self.refined = refinement.map(|refinement| RefinedRecord {
            moved_px: refinement.moved_px.clone(),
            sides_without_edge: refinement.sides_without_edge.clone(),
        });
        self
    }
}

impl Sample {
    /// Sets the facets as measured in a photograph.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if a number is not finite.
    pub fn set_photograph(&mut self, image: &ImageRecord, facets: &[FacetMeasurement]) -> Result<()> {
        let column = |pick: fn(&FacetMeasurement) -> Option<Vec<f64>>| facets.iter().map(pick).collect();
        self.fields.set("image", image)?;
        self.set_facets(
            &column(|facet| facet.mean.clone()),
            Some(&column(|facet| facet.standard_error.clone())),
            1,
        )?;
        self.fields.set("facet_pixels", facets.iter().map(|facet| facet.pixels).collect::<Vec<_>>())?;
        self.fields.set("facet_clipped", facets.iter().map(|facet| facet.clipped).collect::<Vec<_>>())?;
        self.fields
            .set("facet_not_finite", facets.iter().map(|facet| facet.not_finite).collect::<Vec<_>>())?;
        self.fields.set("facet_outliers", facets.iter().map(|facet| facet.outliers).collect::<Vec<_>>())
    }
}
