//! The record of the photograph in which a sample was measured.

use std::path::Path;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::development::DevelopmentRecord;
use super::{Sample, colours};
use crate::error::Result;
use crate::image::{
    FacetMeasurement, FileStamp, FoldAngle, Framing, Grid, Lens, Making, OtherFold, PhotographInfo, Point,
    Processing, Refinement,
};

/// The photograph, how its numbers were interpreted, and where the panels are in it.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct ImageRecord {
    /// Path of the file, as it was stated.
    file: String,
    /// Size of the file, bytes; absent if it was read from a pipe.
    #[serde(skip_serializing_if = "Option::is_none")]
    file_bytes: Option<u64>,
    /// When the file was last changed, seconds after 1970-01-01T00:00Z.
    #[serde(skip_serializing_if = "Option::is_none")]
    file_modified_s: Option<f64>,
    /// SHA-256 checksum of the file, as sha256sum prints it; absent if it was read from a pipe.
    #[serde(skip_serializing_if = "Option::is_none")]
    sha256: Option<String>,
    /// When the picture was taken: date and time by the camera's clock, with the difference from UTC if it is
    /// known.
    #[serde(skip_serializing_if = "Option::is_none")]
    taken: Option<String>,
    /// Width of the upright picture, px.
    width: usize,
    /// Height of the upright picture, px.
    height: usize,
    /// Format of the file, bits per sample and colours.
    stored_as: String,
    /// The transfer curve that was undone: srgb, or linear if there was none.
    transfer: &'static str,
    /// The stored number that means no light.
    black_level: Levels,
    /// The stored number that means the value 1.
    white_level: Levels,
    /// For each channel the largest stored number, if it is below the white level: pixels that reach it count
    /// as clipped; null for a channel that reaches the white level.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    ends_at: Vec<Option<f64>>,
    /// The darkest stored number of each channel, if it is similar in all of them, as when the black level
    /// was not subtracted.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    darkest: Vec<f64>,
    /// What was read of the sensor, if it is a RAW file.
    #[serde(skip_serializing_if = "Option::is_none")]
    sensor: Option<SensorRecord>,
    /// The camera's processing that was undone.
    #[serde(skip_serializing_if = "Option::is_none")]
    undone: Option<DevelopmentRecord>,
    /// Whether the picture appears to have been developed for viewing, and none of that was undone.
    #[serde(skip_serializing_if = "is_false")]
    developed: bool,
    /// Processing that the noise of the numbers reveals: `curve`, `matrix`, or `white_curve`
    /// for the picture of `--white`.
    #[serde(skip_serializing_if = "Option::is_none")]
    processing: Option<ProcessingRecord>,
    /// Number of neighbouring pixels that share their noise, so that together they count as one, per channel;
    /// 1 if pixels are independent.
    pixels_sharing_noise: Vec<f64>,
    /// Maker of the camera, as the file names it.
    #[serde(skip_serializing_if = "Option::is_none")]
    make: Option<String>,
    /// Model of the camera, as the file names it.
    #[serde(skip_serializing_if = "Option::is_none")]
    model: Option<String>,
    /// Exposure time, s.
    #[serde(skip_serializing_if = "Option::is_none")]
    exposure_s: Option<f64>,
    /// F-number: focal length divided by the diameter of the aperture.
    #[serde(skip_serializing_if = "Option::is_none")]
    f_number: Option<f64>,
    /// ISO sensitivity.
    #[serde(skip_serializing_if = "Option::is_none")]
    iso: Option<u32>,
    /// Value that a perfect white diffuser under 1000 lx has with this exposure time, f-number and ISO;
    /// absent if the numbers are not those of the sensor.
    #[schemars(range(min = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    white_per_klx: Option<f64>,
    /// Orientation of the stored picture as a number of EXIF, 1 to 8: 1 is upright.
    #[schemars(range(min = 1, max = 8))]
    orientation: u32,
    /// Four corners of each panel, [x, y] each, in pixels of the upright picture; null for a panel that was
    /// not marked.
    panels: Vec<Option<[[f64; 2]; 4]>>,
    /// Sides of the panels along which the sheet has no edge, such as `the outer side of panel 0`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    open_sides: Vec<String>,
    /// The fold that the corners show, if they do not fit that of the scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    other_fold: Option<OtherFoldRecord>,
    /// Distance from the panels' edges within which pixels are left out, px.
    margin_px: f64,
    /// Distortion by the lens: the coefficients K1 and K2 of `vextract --distortion`, stated or by the bend
    /// of the panels' outer sides.
    #[serde(skip_serializing_if = "Option::is_none")]
    distortion: Option<[f64; 2]>,
    /// How far the corners were moved to the edges around them.
    #[serde(skip_serializing_if = "Option::is_none")]
    refined: Option<RefinedRecord>,
    /// Probability that all corners are right, if the panels were detected rather than marked.
    #[schemars(inner(range(min = 0, max = 1)))]
    #[serde(skip_serializing_if = "Option::is_none")]
    detection_confidence: Option<f64>,
    /// Faults of the file that did no harm.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    notes: Vec<String>,
}

/// Processing of numbers that appear to be those of the sensor.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum ProcessingRecord {
    /// The numbers have a curve such as that of sRGB.
    Curve,
    /// A matrix mixed the channels.
    Matrix,
    /// The picture of `vextract --white` has a curve such as that of sRGB.
    WhiteCurve,
}

impl From<Processing> for ProcessingRecord {
    fn from(processing: Processing) -> Self {
        match processing {
            Processing::Curve => Self::Curve,
            Processing::Matrix => Self::Matrix,
            Processing::CurveOfFlatField => Self::WhiteCurve,
        }
    }
}

impl From<ProcessingRecord> for Processing {
    fn from(record: ProcessingRecord) -> Self {
        match record {
            ProcessingRecord::Curve => Self::Curve,
            ProcessingRecord::Matrix => Self::Matrix,
            ProcessingRecord::WhiteCurve => Self::CurveOfFlatField,
        }
    }
}

/// A fold as its corners show it.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, JsonSchema)]
struct OtherFoldRecord {
    /// Angle between the panels, degrees.
    angle_deg: f64,
    /// Standard deviation of the angle, degrees.
    angle_sd_deg: f64,
    /// Depths of panels 0 and 1 over their width.
    depths: [f64; 2],
    /// Whether its panels have other proportions than those of the scene, so that not only the angle differs.
    other_panels: bool,
}

impl From<OtherFold> for OtherFoldRecord {
    fn from(OtherFold { fold, has_other_panels }: OtherFold) -> Self {
        let FoldAngle { angle_deg, angle_sd_deg, depths } = fold;
        Self { angle_deg, angle_sd_deg, depths, other_panels: has_other_panels }
    }
}

impl From<OtherFoldRecord> for OtherFold {
    fn from(record: OtherFoldRecord) -> Self {
        let OtherFoldRecord { angle_deg, angle_sd_deg, depths, other_panels } = record;
        Self { fold: FoldAngle { angle_deg, angle_sd_deg, depths }, has_other_panels: other_panels }
    }
}

/// How far the corners were moved to the edges around them.
#[derive(Clone, Debug, Serialize, JsonSchema)]
struct RefinedRecord {
    /// Distance by which each corner was moved, px, four per panel.
    #[schemars(inner(inner(range(min = 0))))]
    moved_px: Vec<[f64; 4]>,
    /// Sides at which no edge was found: they were left where they were marked.
    sides_without_edge: Vec<String>,
}

/// A level of the sensor.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
enum Levels {
    /// For all channels.
    All(f64),
    /// For each channel.
    Each(Vec<f64>),
}

impl Levels {
    fn of(&self, channel: usize) -> Option<f64> {
        match self {
            Self::All(level) => Some(*level),
            Self::Each(levels) => levels.get(channel).copied(),
        }
    }
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
#[derive(Clone, Debug, Serialize, JsonSchema)]
struct SensorRecord {
    /// Colours of the filters from the area's top left corner, row by row, such as RGGB; absent if there are
    /// none.
    #[serde(skip_serializing_if = "Option::is_none")]
    mosaic: Option<String>,
    /// Left column, top row, width and height of the area that was read, in pixels of the whole sensor as
    /// stored.
    area: [usize; 4],
}

impl ImageRecord {
    /// The record of a photograph with its panels and, per channel, the number of pixels that share their
    /// noise.
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
            file_bytes: info.file.map(|file| file.bytes),
            file_modified_s: info.file.map(|file| file.modified_s),
            sha256: None,
            taken: info.camera.taken.time.as_ref().or(info.camera.taken.clock.as_ref()).cloned(),
            width: info.width,
            height: info.height,
            stored_as: info.format.clone(),
            transfer: info.transfer_used.name(),
            black_level: info.black_level.as_slice().into(),
            white_level: info.white_level.as_slice().into(),
            ends_at: info.ends_at.clone(),
            darkest: info.darkest.clone(),
            sensor: info
                .sensor
                .as_ref()
                .map(|sensor| SensorRecord { mosaic: sensor.mosaic.clone(), area: sensor.area }),
            undone: info.undone.as_ref().map(DevelopmentRecord::from),
            developed: info.is_developed(),
            processing: None,
            pixels_sharing_noise: pixels_sharing_noise.to_vec(),
            make: info.camera.make.clone(),
            model: info.camera.model.clone(),
            exposure_s: info.camera.exposure_s,
            f_number: info.camera.f_number,
            iso: info.camera.iso,
            white_per_klx: info.white_per_klx(),
            orientation: info.camera.orientation.exif(),
            panels: (0..count).map(corners).collect(),
            open_sides: Vec::new(),
            other_fold: None,
            margin_px,
            distortion: None,
            refined: None,
            detection_confidence: None,
            notes: info.camera.notes.clone(),
        }
    }

    /// The record with the file's checksum, if it is a regular file.
    #[must_use]
    pub fn with_checksum(mut self, sha256: Option<String>) -> Self {
        self.sha256 = sha256;
        self
    }

    /// The record with the detected processing of the numbers, if any.
    #[must_use]
    pub fn with_processing(mut self, processing: Option<Processing>) -> Self {
        self.processing = processing.map(ProcessingRecord::from);
        self
    }

    /// The record with the names of sides along which no edge of the sheet lies.
    #[must_use]
    pub fn with_open_sides(mut self, open_sides: Vec<String>) -> Self {
        self.open_sides = open_sides;
        self
    }

    /// The record with the fold that agrees better with the corners than the scene's.
    #[must_use]
    pub fn with_other_fold(mut self, other_fold: Option<OtherFold>) -> Self {
        self.other_fold = other_fold.map(OtherFoldRecord::from);
        self
    }

    /// The record with the lens coefficients and the results of refinement, if requested.
    #[must_use]
    pub fn with_placing(mut self, lens: Option<Lens>, refinement: Option<&Refinement>) -> Self {
        self.distortion = lens.map(|lens| lens.coefficients());
        self.refined = refinement.map(|refinement| RefinedRecord {
            moved_px: refinement.moved_px.clone(),
            sides_without_edge: refinement.sides_without_edge.clone(),
        });
        self
    }

    /// The record with the probability that detected panels are right; none for stated ones.
    #[must_use]
    pub fn with_confidence(mut self, confidence: Option<f64>) -> Self {
        self.detection_confidence = confidence;
        self
    }
}

fn is_false(value: &bool) -> bool {
    !value
}

/// The fields that are read from the record of a photograph.
#[derive(Deserialize)]
struct FramingRecord {
    width: u32,
    height: u32,
    panels: Vec<Option<[[f64; 2]; 4]>>,
    #[serde(default)]
    margin_px: f64,
}

/// The fields that are read from the camera's settings.
#[derive(Deserialize)]
struct SettingsRecord {
    white_per_klx: Option<f64>,
}

/// The fields that are read on how a photograph was made.
#[derive(Deserialize)]
struct MakingRecord {
    #[serde(default)]
    developed: bool,
    processing: Option<ProcessingRecord>,
    #[serde(default)]
    open_sides: Vec<String>,
    other_fold: Option<OtherFoldRecord>,
    #[serde(default)]
    darkest: Vec<f64>,
    black_level: Option<Levels>,
    white_level: Option<Levels>,
    #[serde(default)]
    make: String,
    #[serde(default)]
    model: String,
    file_bytes: Option<u64>,
    file_modified_s: Option<f64>,
}

impl MakingRecord {
    /// Height of the first channel's darkest numbers above black, white being 1.
    fn darkest_part(&self) -> Option<f64> {
        let level = |levels: &Option<Levels>| levels.as_ref()?.of(0);
        let (darkest, black, white) =
            (self.darkest.first()?, level(&self.black_level)?, level(&self.white_level)?);
        Some((darkest - black) / (white - black))
    }
}

impl From<MakingRecord> for Making {
    fn from(record: MakingRecord) -> Self {
        let stamp = |bytes, modified_s| FileStamp { bytes, modified_s };
        Self {
            unsubtracted_black: record.darkest_part(),
            is_developed: record.developed,
            processing: record.processing.map(Processing::from),
            open_sides: record.open_sides,
            other_fold: record.other_fold.map(OtherFold::from),
            taken_by: (record.make, record.model),
            file: record.file_bytes.zip(record.file_modified_s).map(|(bytes, s)| stamp(bytes, s)),
        }
    }
}

impl Sample {
    /// How the photograph was made; the default if the sample has none.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if the photograph's record is invalid.
    pub fn making(&self) -> Result<Making> {
        let record: Option<MakingRecord> = self.fields.get("image")?;
        Ok(record.map(Making::from).unwrap_or_default())
    }

    /// Value of a perfect white diffuser under 1000 lx in the photograph, from the camera's settings; none if
    /// they are unknown.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if the photograph's record is invalid.
    pub fn white_per_klx(&self) -> Result<Option<f64>> {
        let record: Option<SettingsRecord> = self.fields.get("image")?;
        Ok(record.and_then(|settings| settings.white_per_klx).filter(|white| *white > 0.0))
    }

    /// Positions of the panels in the photograph; none unless the sample has two panels.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if the photograph's record is invalid.
    pub fn framing(&self) -> Result<Option<Framing>> {
        let record: Option<FramingRecord> = self.fields.get("image")?;
        Ok(record.and_then(|FramingRecord { width, height, panels, margin_px }| {
            let panels = <[_; 2]>::try_from(panels).ok()?;
            let corners = |panel: [[f64; 2]; 4]| panel.map(|[x, y]| Point::new(x, y));
            let panels = panels.map(|panel| panel.map(corners));
            Some(Framing { panels, size: [width, height].map(f64::from), margin_px })
        }))
    }

    /// Sets the facets measured in a photograph.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if a number is not finite.
    pub fn set_photograph(&mut self, image: &ImageRecord, facets: &[FacetMeasurement]) -> Result<()> {
        let column = |name: &str, pick: fn(&FacetMeasurement) -> Option<Vec<f64>>| {
            colours::values(name, &facets.iter().map(pick).collect())
        };
        self.fields.set("image", image)?;
        let rgb = column("facet_rgb", |facet| facet.mean.clone())?;
        let sd = column("facet_sd", |facet| facet.standard_error.clone())?;
        self.set_facets(&rgb, Some(&sd), 1)?;
        self.fields.set("facet_pixels", facets.iter().map(|facet| facet.pixels).collect::<Vec<_>>())?;
        self.fields.set("facet_clipped", facets.iter().map(|facet| facet.clipped).collect::<Vec<_>>())?;
        self.fields
            .set("facet_not_finite", facets.iter().map(|facet| facet.not_finite).collect::<Vec<_>>())?;
        self.fields.set("facet_outliers", facets.iter().map(|facet| facet.outliers).collect::<Vec<_>>())
    }
}
