//! Output of `vextract --find`: positions of fold and chart in a photograph, in the form of regions.

use std::path::Path;

use serde::Serialize;

use super::named::Named;
use crate::error::{Error, Result};
use crate::image::{Detections, FoldAngle, Photograph, Point};

/// A fold and a chart in the form of a regions file; or the reason why there is no fold.
#[derive(Serialize)]
struct DetectionRecord {
    /// Name of the picture's file.
    image: String,
    #[serde(flatten)]
    size: Option<Size>,
    #[serde(flatten)]
    fold: FoldRecord,
    #[serde(flatten)]
    chart: Option<ChartRecord>,
    /// Areas that may be white paper or a card.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    white_candidates: Vec<[[f64; 2]; 4]>,
}

/// The angle derived from the corners.
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

/// Size of the upright picture, px.
#[derive(Serialize)]
struct Size {
    width: usize,
    height: usize,
}

#[derive(Serialize)]
#[serde(untagged)]
enum FoldRecord {
    Detected {
        #[serde(flatten)]
        panels: Named<[[f64; 2]; 4]>,
        confidence: f64,
        #[serde(flatten)]
        angle: Option<AngleRecord>,
    },
    Missing {
        found: bool,
        reason: String,
    },
}

#[derive(Serialize)]
struct ChartRecord {
    chart: [[f64; 2]; 4],
    chart_confidence: f64,
}

/// Corners are rounded to this fraction of a pixel, which is accurate enough.
const PARTS_OF_A_PIXEL: f64 = 1e3;
const PARTS_OF_CONFIDENCE: f64 = 1e4;
const PARTS_OF_DEGREE: f64 = 1e2;
const PARTS_OF_DEPTH: f64 = 1e3;

/// A line, readable by `--regions`, with the position and angle of a fold, or the reason for its absence, and
/// the positions of a chart and of what may be white.
///
/// # Errors
/// [`Error::Field`] if it has no form in JSON.
pub fn detection_line(
    image: &Path,
    photograph: &Photograph,
    found: &Detections,
    angle: Option<&FoldAngle>,
) -> Result<String> {
    let fold = match &found.fold {
        Ok(found) => {
            let panel = |(number, panel)| (format!("panel{number}"), corners(panel));
            FoldRecord::Detected {
                panels: Named(found.panels.into_iter().enumerate().map(panel).collect()),
                confidence: rounded(found.confidence, PARTS_OF_CONFIDENCE),
                angle: angle.map(AngleRecord::from),
            }
        }
        Err(none) => missing(none.to_string()),
    };
    let chart = found.chart.as_ref().map(|chart| ChartRecord {
        chart: corners(chart.corners),
        chart_confidence: rounded(chart.confidence, PARTS_OF_CONFIDENCE),
    });
    let white_candidates: Vec<_> = found.white_candidates.iter().copied().map(corners).collect();
    let has_corners =
        matches!(fold, FoldRecord::Detected { .. }) || chart.is_some() || !white_candidates.is_empty();
    let size = has_corners.then(|| Size { width: photograph.width(), height: photograph.height() });
    line(&DetectionRecord { image: name(image), size, fold, chart, white_candidates })
}

/// A line that states why nothing is found in an unreadable photograph.
///
/// # Errors
/// [`Error::Field`] if it has no form in JSON.
pub fn no_detection_line(image: &Path, reason: &str) -> Result<String> {
    line(&DetectionRecord {
        image: name(image),
        size: None,
        fold: missing(reason.to_owned()),
        chart: None,
        white_candidates: Vec::new(),
    })
}

fn missing(reason: String) -> FoldRecord {
    FoldRecord::Missing { found: false, reason }
}

fn corners(of: [Point; 4]) -> [[f64; 2]; 4] {
    of.map(|corner| [corner.x, corner.y].map(|place| rounded(place, PARTS_OF_A_PIXEL)))
}

fn rounded(value: f64, parts: f64) -> f64 {
    (value * parts).round() / parts
}

fn name(image: &Path) -> String {
    image.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

fn line(record: &impl Serialize) -> Result<String> {
    serde_json::to_string(record).map_err(|e| Error::field("image", e))
}
