//! Regions marked in a photograph: positions of panels, chart and white card.
//!
//! ```json
//! {"image": "fold.dng", "width": 6000, "height": 4000,
//!  "panel0": [[332, 462], [345, 77], [122, 12], [104, 442]],
//!  "panel1": [[332, 462], [345, 77], [485, 17], [472, 446]],
//!  "chart":  [[700, 90], [980, 95], [975, 290], [695, 280]],
//!  "white":  [[700, 400], [800, 400], [800, 480], [700, 480]]}
//! ```
//! Corners are `[x, y]` in px from the top left corner of the upright picture: for a panel in the order of
//! [`PANEL_CORNERS`](crate::image::PANEL_CORNERS), for a chart in that of
//! [`CHART_CORNERS`](crate::image::CHART_CORNERS), for a white card in any order around it. Panels are
//! numbered from 0 in the order of the scene. All fields may be absent or null.
//! - `image`: the photograph's file name, with or without its extension and folder. A list of regions
//!   requires it; in a single object it is a remark.
//! - `confidence`: for corners from `vextract --find`, the probability that they are right.
//! - `chart_confidence`: the same for a chart; such a chart is used where possible.
//! - `white_candidates`: areas that may be white paper or a card, by `vextract --find`; not used before one
//!   is copied to `white`.
//! - `angle_deg`, `angle_sd_deg`: the angle of the fold and its standard deviation, degrees, as derived from
//!   the corners by `vextract --find`; `panel`: width of its panels along the crease and their depth, in any
//!   unit, if they are not square. `vkernel` reads these.
//! - `found`: false if no fold was found, and `reason`, why.
//! - `width`, `height`: size of the picture in which the corners were found, px. On a photograph of the same
//!   shape but another size, such as the original of a preview, corners are scaled; one of another shape is
//!   refused.

use std::collections::BTreeMap;
use std::path::Path;

use schemars::{JsonSchema, Schema};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use super::named::Named;
use super::{Fields, Sample};
use crate::error::{Error, Result};
use crate::image::{Homography, Point};

/// Fields other than those of the panels.
const FIELDS: [&str; 13] = [
    "chart",
    "white",
    "white_candidates",
    "image",
    "width",
    "height",
    "confidence",
    "chart_confidence",
    "angle_deg",
    "angle_sd_deg",
    "panel",
    "found",
    "reason",
];

/// Four corners, px of the upright picture.
pub type Corners = [Point; 4];

/// Regions marked in a photograph.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Regions {
    /// Panels by their numbers.
    pub panels: BTreeMap<usize, Corners>,
    /// The block of a chart's patches.
    pub chart: Option<Corners>,
    /// A white card.
    pub white: Option<Corners>,
    /// The photograph's file name.
    pub image: Option<String>,
    /// Width and height of the picture in which the corners were found, px.
    pub size: Option<[usize; 2]>,
    /// Probability that the corners of detected panels are right, 0 to 1.
    pub confidence: Option<f64>,
    /// The same for a detected chart.
    pub chart_confidence: Option<f64>,
    /// Angle between the panels, degrees, and its standard deviation.
    pub angle_deg: Option<f64>,
    /// See `angle_deg`.
    pub angle_sd_deg: Option<f64>,
    /// Width of the panels along the crease and their depth, in any unit.
    pub panel: Option<[f64; 2]>,
    /// Reason why none were found.
    pub missing: Option<String>,
}

/// Where panels are in a picture: `panel0`, `panel1` and so on have four corners each, [x, y] in pixels of
/// the upright picture, in the order of `vextract --panel0`.
#[derive(Serialize, JsonSchema)]
#[schemars(transform = describe_panels)]
pub(super) struct RegionsRecord {
    /// Name of the picture's file.
    image: String,
    /// Width of the picture, px.
    width: usize,
    /// Height of the picture, px.
    height: usize,
    #[serde(flatten)]
    panels: Named<[[f64; 2]; 4]>,
}

/// Describes the panels, which have no doc comment of their own in the schema.
fn describe_panels(schema: &mut Schema) {
    if let Some(panel) = schema.pointer_mut("/additionalProperties").and_then(Value::as_object_mut) {
        let text = "Corners of panel NAME (panel0, panel1 and so on), [x, y] each, in pixels.";
        panel.insert("description".to_owned(), text.into());
    }
}

impl Regions {
    /// The regions in the fields of an object; `path` is its file, for errors.
    pub(super) fn from_fields(path: &str, fields: &Fields) -> Result<Self> {
        let names = || fields.names();
        if let Some(unknown) = names().find(|name| panel_number(name).is_none() && !FIELDS.contains(name)) {
            let remedy = format!("the fields are panel0, panel1, .., {}", FIELDS.join(", "));
            return Err(Error::regions(path, format!("there is no field '{unknown}'"), remedy));
        }
        let marked = |name: &str| corners(path, fields, name);
        let panel = |name| Some(marked(name).transpose()?.map(|corners| (panel_number(name), corners)));
        let panels = names().filter(|name| panel_number(name).is_some()).filter_map(panel);
        let panels: Vec<_> = panels.collect::<Result<_>>()?;
        let pixels = |name: &str| read::<usize>(path, fields, name, "give a number of pixels");
        let size = match (pixels("width")?, pixels("height")?) {
            (Some(width), Some(height)) if width > 0 && height > 0 => Some([width, height]),
            (None, None) => None,
            _ => {
                let problem = "fields 'width' and 'height' are not two numbers above 0";
                return Err(Error::regions(path, problem, "give both or neither"));
            }
        };
        let is_missing = read(path, fields, "found", "give true or false")? == Some(false);
        let above_0 = |name: &str| match read::<f64>(path, fields, name, "give degrees")? {
            Some(degrees) if !(degrees > 0.0 && degrees <= 180.0) => {
                let problem = format!("field '{name}': {degrees} is out of range");
                Err(Error::regions(path, problem, "give degrees above 0 and up to 180"))
            }
            degrees => Ok(degrees),
        };
        let reason =
            read(path, fields, "reason", "give text")?.unwrap_or_else(|| "no fold was found".to_owned());
        Ok(Self {
            panels: panels.into_iter().filter_map(|(number, corners)| Some((number?, corners))).collect(),
            chart: marked("chart")?,
            white: marked("white")?,
            image: read(path, fields, "image", "give a file name")?,
            size,
            confidence: read(path, fields, "confidence", "give a number from 0 to 1")?,
            chart_confidence: read(path, fields, "chart_confidence", "give a number from 0 to 1")?,
            angle_deg: above_0("angle_deg")?,
            angle_sd_deg: above_0("angle_sd_deg")?,
            panel: read(
                path,
                fields,
                "panel",
                "give its width along the crease and its depth, such as [1, 0.7]",
            )?,
            missing: is_missing.then_some(reason),
        })
    }

    /// The same regions in a picture of another size.
    pub(super) fn scaled_to(&self, path: &str, [width, height]: [usize; 2]) -> Result<Self> {
        let Some(size) = self.size else { return Ok(self.clone()) };
        let [w, h] = size.map(|px| px as f64);
        let (x_scale, y_scale) = (width as f64 / w, height as f64 / h);
        // a preview's sides are rounded to whole pixels
        if (x_scale - y_scale).abs() > x_scale / w + y_scale / h {
            let problem =
                format!("corners of a picture of {w} x {h} px, but this one has {width} x {height} px");
            return Err(Error::regions(path, problem, "mark them in this photograph, uncropped and upright"));
        }
        let mut scaled = self.clone();
        let targets = [&mut scaled.chart, &mut scaled.white].into_iter().flatten();
        for corner in scaled.panels.values_mut().chain(targets).flatten() {
            *corner = Point::new(x_scale * corner.x, y_scale * corner.y);
        }
        Ok(scaled)
    }

    /// The same regions, with those of `others` where absent.
    #[must_use]
    pub fn or(self, others: Self) -> Self {
        let chart_confidence =
            if self.chart.is_some() { self.chart_confidence } else { others.chart_confidence };
        Self {
            panels: others.panels.into_iter().chain(self.panels).collect(), // the last of equals remains
            chart: self.chart.or(others.chart),
            white: self.white.or(others.white),
            image: self.image.or(others.image),
            size: self.size.or(others.size),
            confidence: self.confidence.or(others.confidence),
            chart_confidence,
            angle_deg: self.angle_deg.or(others.angle_deg),
            angle_sd_deg: self.angle_sd_deg.or(others.angle_sd_deg),
            panel: self.panel.or(others.panel),
            missing: self.missing.or(others.missing),
        }
    }
}

impl Sample {
    /// Records the panels' positions in the picture taken of the sample.
    ///
    /// # Errors
    /// As [`Fields::set`].
    pub fn set_panel_regions(
        &mut self,
        image: &Path,
        [width, height]: [usize; 2],
        panels: &[(usize, Corners)],
    ) -> Result<()> {
        let panel = |(number, corners): &(usize, Corners)| {
            (format!("panel{number}"), corners.map(|corner| [corner.x, corner.y]))
        };
        let image = image.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let panels = Named(panels.iter().map(panel).collect());
        self.fields.set("regions", RegionsRecord { image, width, height, panels })
    }
}

/// The number in `panel7`.
fn panel_number(name: &str) -> Option<usize> {
    let number = name.strip_prefix("panel")?.parse().ok()?;
    (name == format!("panel{number}")).then_some(number)
}

fn read<T: DeserializeOwned>(path: &str, fields: &Fields, name: &str, remedy: &str) -> Result<Option<T>> {
    fields.get(name).map_err(|e| Error::regions(path, e.to_string(), remedy))
}

fn corners(path: &str, fields: &Fields, name: &str) -> Result<Option<Corners>> {
    let corners: Option<[[f64; 2]; 4]> = read(path, fields, name, "give four corners [x, y]")?;
    let corners = corners.map(|corners| corners.map(|[x, y]| Point::new(x, y)));
    match corners.map(Homography::from_unit_square) {
        Some(Err(Error::Corners { problem, remedy })) => {
            Err(Error::regions(path, format!("field '{name}': {problem}"), remedy))
        }
        _ => Ok(corners),
    }
}
