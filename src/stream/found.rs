//! What `vextract --find` prints: where the fold is in a photograph, in the form of regions.

use std::path::Path;

use serde::Serialize;

use super::named::Named;
use crate::error::{Error, Result};
use crate::image::{FoldAngle, FoundFold, Photograph};

/// A fold, as a file of regions has it.
#[derive(Serialize)]
struct FoundRecord {
    /// Name of the picture's file.
    image: String,
    /// Size of the upright picture, px.
    width: usize,
    height: usize,
    #[serde(flatten)]
    panels: Named<[[f64; 2]; 4]>,
    confidence: f64,
    #[serde(flatten)]
    angle: Option<AngleRecord>,
}

/// The angle that the corners tell.
#[derive(Serialize)]
struct AngleRecord {
    angle_deg: f64,
    angle_sd_deg: f64,
    /// Width and depth of the panels, if they are not square.
    #[serde(skip_serializing_if = "Option::is_none")]
    panel: Option<[f64; 2]>,
}

impl From<&FoldAngle> for AngleRecord {
    fn from(found: &FoldAngle) -> Self {
        let depth = rounded(found.depths[0], PARTS_OF_DEPTH);
        let is_square = (depth - 1.0).abs() < 1.0 / PARTS_OF_DEPTH;
        Self {
            angle_deg: rounded(found.angle_deg, PARTS_OF_DEGREE),
            angle_sd_deg: rounded(found.angle_sd_deg, PARTS_OF_DEGREE).max(1.0 / PARTS_OF_DEGREE),
            panel: (!is_square).then_some([1.0, depth]),
        }
    }
}

/// A photograph in which there is none.
#[derive(Serialize)]
struct NotFoundRecord {
    image: String,
    found: bool,
    reason: String,
}

/// Corners in so many parts of a pixel are as exact as any.
const PARTS_OF_A_PIXEL: f64 = 1e3;
const PARTS_OF_CONFIDENCE: f64 = 1e4;
const PARTS_OF_DEGREE: f64 = 1e2;
const PARTS_OF_DEPTH: f64 = 1e3;

fn rounded(value: f64, parts: f64) -> f64 {
    (value * parts).round() / parts
}

/// A line that says where a fold is, and how far it is open if its corners tell, which `--regions` reads.
///
/// # Errors
/// [`Error::Field`] if it has no form in JSON.
pub fn found_line(
    image: &Path,
    photograph: &Photograph,
    found: &FoundFold,
    angle: Option<&FoldAngle>,
) -> Result<String> {
    let corners = found
        .panels
        .map(|panel| panel.map(|corner| [corner.x, corner.y].map(|place| rounded(place, PARTS_OF_A_PIXEL))));
    let panels = corners.into_iter().enumerate().map(|(number, corners)| (format!("panel{number}"), corners));
    line(&FoundRecord {
        image: name(image),
        width: photograph.width(),
        height: photograph.height(),
        panels: Named(panels.collect()),
        confidence: rounded(found.confidence, PARTS_OF_CONFIDENCE),
        angle: angle.map(AngleRecord::from),
    })
}

/// A line that says why there is no fold.
///
/// # Errors
/// [`Error::Field`] if it has no form in JSON.
pub fn not_found_line(image: &Path, reason: &str) -> Result<String> {
    line(&NotFoundRecord { image: name(image), found: false, reason: reason.to_owned() })
}

fn name(image: &Path) -> String {
    image.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

fn line(record: &impl Serialize) -> Result<String> {
    serde_json::to_string(record).map_err(|e| Error::field("image", e))
}
