//! Regions of photographs as a file says them: where panels, chart and white card are.
//!
//! The file holds one JSON object, for every photograph, or a list of them, one a photograph:
//!
//! ```json
//! {"image": "fold.dng", "width": 6000, "height": 4000,
//!  "panel0": [[332, 462], [345, 77], [122, 12], [104, 442]],
//!  "panel1": [[332, 462], [345, 77], [485, 17], [472, 446]],
//!  "chart":  [[700, 90], [980, 95], [975, 290], [695, 280]],
//!  "white":  [[700, 400], [800, 400], [800, 480], [700, 480]]}
//! ```
//! Corners are `[x, y]` in px from the top left corner of the upright picture: of a panel in the order of
//! [`PANEL_CORNERS`](crate::image::PANEL_CORNERS), of a chart in that of [`CHART_CORNERS`](crate::image::CHART_CORNERS), of a
//! white card in any order round it. All fields may be absent or null.
//! - `image`: the photograph's file name, with or without its ending and without its folder. A list needs it; in a single
//!   object it is a remark.
//! - `width`, `height`: size of the picture in which the corners were found, px. On a photograph of the same shape but
//!   another size, such as the original of a preview, corners are scaled; one of another shape is refused.

use std::collections::HashSet;
use std::path::Path;

use serde_json::Value;

use super::{Fields, json_file};
use crate::error::{Error, Result};
use crate::image::{Homography, Point};

const EXAMPLE: &str = "{\"panel0\": [[x, y], [x, y], [x, y], [x, y]], ..} or a list of such objects";

const FIELDS: [&str; 7] = ["panel0", "panel1", "chart", "white", "image", "width", "height"];

/// Four corners, px of the upright picture.
pub type Corners = [Point; 4];

/// What is marked in a photograph.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Regions {
    /// Panel 0.
    pub panel0: Option<Corners>,
    /// Panel 1.
    pub panel1: Option<Corners>,
    /// The block of a chart's patches.
    pub chart: Option<Corners>,
    /// A white card.
    pub white: Option<Corners>,
    /// The photograph's file name.
    pub image: Option<String>,
    /// Width and height of the picture in which the corners were found, px.
    pub size: Option<[usize; 2]>,
}

/// A file of regions.
#[derive(Clone, Debug, PartialEq)]
pub struct RegionsFile {
    path: String,
    /// One that holds for every photograph, or one a photograph.
    entries: Vec<Regions>,
    is_list: bool,
}

impl RegionsFile {
    /// Reads a file of regions.
    ///
    /// # Errors
    /// [`Error::File`] if it cannot be read, [`Error::Record`] with the line if it is no JSON; [`Error::Regions`], with the field, if
    /// it is not as this module says.
    ///
    /// # Example
    /// ```
    /// use std::path::Path;
    /// use vfold::stream::RegionsFile;
    /// let folder = tempfile::tempdir().unwrap();
    /// let path = folder.path().join("regions.json");
    /// std::fs::write(&path, r#"{"panel0": [[0, 0], [9, 0], [9, 9], [0, 9]], "width": 10, "height": 10}"#).unwrap();
    /// let file = RegionsFile::open(&path)?;
    /// let regions = file.of(Path::new("photo.tif"), [100, 100])?; // ten times as large
    /// assert_eq!(regions.panel0.unwrap()[1].x, 90.0);
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn open(path: &Path) -> Result<Self> {
        let path = path.display().to_string();
        let value: Value = json_file::read(&path, EXAMPLE)?;
        let is_list = value.is_array();
        let objects = match value {
            Value::Array(objects) => objects,
            object => vec![object],
        };
        let entry = |(n, object): (usize, Value)| {
            let Value::Object(map) = object else {
                return Err(Error::regions(
                    &path,
                    format!("entry {n} is no object"),
                    format!("write {EXAMPLE}"),
                ));
            };
            Regions::from_fields(&path, &Fields(map))
        };
        let entries = objects.into_iter().enumerate().map(entry).collect::<Result<Vec<_>>>()?;
        let file = Self { path, entries, is_list };
        if is_list { file.check_names() } else { Ok(()) }.map(|()| file)
    }

    /// Every entry of a list needs a name of its own.
    fn check_names(&self) -> Result<()> {
        let mut seen = HashSet::new();
        for (n, entry) in self.entries.iter().enumerate() {
            let Some(image) = &entry.image else {
                let problem = format!("entry {n} of the list has no field 'image'");
                return Err(Error::regions(&self.path, problem, "name its photograph"));
            };
            if !seen.insert(image) {
                let problem = format!("field 'image': '{image}' comes twice");
                return Err(Error::regions(&self.path, problem, "keep one of the two entries"));
            }
        }
        Ok(())
    }

    /// The regions of the photograph `image`, scaled to its upright `size`, px.
    ///
    /// # Errors
    /// [`Error::Regions`] if a list does not name the photograph, or the corners were found in a picture of another shape.
    pub fn of(&self, image: &Path, size: [usize; 2]) -> Result<Regions> {
        let names = [image.file_name(), image.file_stem()].map(|name| name.and_then(|name| name.to_str()));
        let named = |name: &Option<&str>| self.entries.iter().find(|entry| entry.image.as_deref() == *name);
        let entry = if self.is_list {
            names.iter().filter(|name| name.is_some()).find_map(named)
        } else {
            self.entries.first()
        };
        let entry = entry.ok_or_else(|| {
            let problem = format!("no entry of the list has '{}' as its 'image'", image.display());
            Error::regions(&self.path, problem, "add one; names are compared without folders")
        })?;
        entry.scaled_to(&self.path, size)
    }
}

impl Regions {
    fn from_fields(path: &str, fields: &Fields) -> Result<Self> {
        if let Some(unknown) = fields.0.keys().find(|key| !FIELDS.contains(&key.as_str())) {
            let remedy = format!("the fields are {}", FIELDS.join(", "));
            return Err(Error::regions(path, format!("there is no field '{unknown}'"), remedy));
        }
        let wrong = |remedy: &'static str| move |e: Error| Error::regions(path, e.to_string(), remedy);
        let corners = |name: &str| -> Result<Option<Corners>> {
            let read = fields.get(name).map_err(wrong("give four corners [x, y]"))?;
            let corners = read.map(|corners: [[f64; 2]; 4]| corners.map(|[x, y]| Point::new(x, y)));
            match corners.map(Homography::from_unit_square) {
                Some(Err(Error::Corners { problem, remedy })) => {
                    Err(Error::regions(path, format!("field '{name}': {problem}"), remedy))
                }
                _ => Ok(corners),
            }
        };
        let pixels = |name: &str| fields.get::<usize>(name).map_err(wrong("give a number of pixels"));
        let size = match (pixels("width")?, pixels("height")?) {
            (Some(width), Some(height)) if width > 0 && height > 0 => Some([width, height]),
            (None, None) => None,
            _ => {
                let problem = "fields 'width' and 'height' are not two numbers above 0";
                return Err(Error::regions(path, problem, "give both or neither"));
            }
        };
        Ok(Self {
            panel0: corners("panel0")?,
            panel1: corners("panel1")?,
            chart: corners("chart")?,
            white: corners("white")?,
            image: fields.get("image").map_err(wrong("give a file name"))?,
            size,
        })
    }

    /// The same regions in a picture of another size.
    fn scaled_to(&self, path: &str, [width, height]: [usize; 2]) -> Result<Self> {
        let Some(size) = self.size else { return Ok(self.clone()) };
        let [w, h] = size.map(|px| px as f64);
        let (x_scale, y_scale) = (width as f64 / w, height as f64 / h);
        // a preview's sides are rounded to whole pixels
        if (x_scale - y_scale).abs() > x_scale / w + y_scale / h {
            let problem =
                format!("corners of a picture of {w} x {h} px, used on one of {width} x {height} px");
            return Err(Error::regions(path, problem, "find them in this photograph, uncropped and upright"));
        }
        let mut scaled = self.clone();
        let Self { panel0, panel1, chart, white, .. } = &mut scaled;
        for corner in [panel0, panel1, chart, white].into_iter().flatten().flatten() {
            *corner = Point::new(x_scale * corner.x, y_scale * corner.y);
        }
        Ok(scaled)
    }

    /// The same regions, those of `others` where they have none.
    #[must_use]
    pub fn or(self, others: Self) -> Self {
        Self {
            panel0: self.panel0.or(others.panel0),
            panel1: self.panel1.or(others.panel1),
            chart: self.chart.or(others.chart),
            white: self.white.or(others.white),
            image: self.image.or(others.image),
            size: self.size.or(others.size),
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // a test stops at the first surprise

    use super::*;

    const SQUARE: &str = "[[0,0],[8,0],[8,8],[0,8]]";

    fn open(text: &str) -> Result<RegionsFile> {
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), text).unwrap();
        RegionsFile::open(file.path())
    }

    fn refused(text: &str) -> String {
        open(text).unwrap_err().to_string()
    }

    #[test]
    fn a_fault_is_named_with_its_field() {
        assert!(refused("").contains("EOF while parsing"));
        assert!(refused("7").contains("entry 0 is no object"));
        assert!(
            refused(r#"{"panle0": 1}"#).contains("no field 'panle0'; the fields are panel0, panel1, chart")
        );
        assert!(refused(r#"{"panel0": [[0,0],[8,0],[8,8]]}"#).contains("field 'panel0': invalid length 3"));
        assert!(
            refused(r#"{"chart": [[0,0],[8,8],[8,0],[0,8]]}"#).contains("field 'chart': the sides cross")
        );
        assert!(refused(r#"{"white": [[0,0],[8,0],[8,8],[0,"8"]]}"#).contains("field 'white': invalid type"));
        assert!(refused(r#"{"width": 10}"#).contains("'width' and 'height'"));
        assert!(refused(r#"{"width": 10, "height": -1}"#).contains("field 'height'"));
        assert!(refused(r#"[{"image": 3}]"#).contains("field 'image'"));
        assert!(refused(r#"[{"image": "a.tif"}, {}]"#).contains("entry 1 of the list has no field 'image'"));
        assert!(refused(r#"[{"image": "a"}, {"image": "a"}]"#).contains("'a' comes twice"));
    }

    #[test]
    fn a_list_is_searched_by_name_and_an_object_holds_for_all() {
        let list = open(&format!(r#"[{{"image": "a", "panel0": {SQUARE}}}, {{"image": "b.tif"}}]"#)).unwrap();
        let of = |name: &str| list.of(Path::new(name), [9, 9]);
        assert!(of("folder/a.png").unwrap().panel0.is_some() && of("b.tif").unwrap().panel0.is_none());
        assert!(of("b.png").unwrap_err().to_string().contains("'b.png'"));
        let all = open(&format!(r#"{{"image": "a.tif", "panel0": {SQUARE}, "panel1": null}}"#)).unwrap();
        assert!(all.of(Path::new("b.tif"), [9, 9]).unwrap().panel0.is_some());
    }

    #[test]
    fn corners_of_a_preview_are_scaled_and_those_of_a_crop_refused() {
        let file = open(&format!(r#"{{"panel0": {SQUARE}, "width": 1024, "height": 683}}"#)).unwrap();
        let corners = file.of(Path::new("a"), [6000, 4000]).unwrap().panel0.unwrap();
        assert_eq!(corners[2], Point::new(8.0 * 6000.0 / 1024.0, 8.0 * 4000.0 / 683.0));
        let crop = file.of(Path::new("a"), [6000, 3900]).unwrap_err().to_string();
        assert!(crop.contains("1024 x 683 px") && crop.contains("6000 x 3900 px"), "{crop}");
    }
}
