//! A file of regions: one object of [`Regions`] for all photographs, a list with one for each, or a stream of
//! vforward, whose samples contain them in the field `regions`.

use std::collections::HashMap;
use std::path::Path;

use serde_json::Value;

use super::{Fields, Regions, json_file};
use crate::error::{Error, Result};
use crate::files::composed;

const EXAMPLE: &str = "{\"panel0\": [[x, y], [x, y], [x, y], [x, y]], ..} or a list of such objects";

/// A file of regions.
#[derive(Clone, Debug, PartialEq)]
pub struct RegionsFile {
    path: String,
    /// One entry for all photographs, or one for each.
    entries: Vec<Regions>,
    /// For a list: indices of entries by the photograph's name.
    places: Option<HashMap<String, usize>>,
}

impl RegionsFile {
    /// Reads a file of regions, or standard input for `-`.
    ///
    /// # Errors
    /// [`Error::File`] if it cannot be read, [`Error::Record`] with the line if it is no JSON;
    /// [`Error::Regions`], with the field, if its form differs from this module's.
    ///
    /// # Example
    /// ```
    /// use std::path::Path;
    /// use vfold::stream::RegionsFile;
    /// let folder = tempfile::tempdir().unwrap();
    /// let path = folder.path().join("regions.json");
    /// let text = r#"{"panel0": [[0, 0], [9, 0], [9, 9], [0, 9]], "width": 10, "height": 10}"#;
    /// std::fs::write(&path, text).unwrap();
    /// let file = RegionsFile::open(&path)?;
    /// let regions = file.of(Path::new("photo.tif"), [100, 100])?; // ten times as large
    /// assert_eq!(regions.panels[&0][1].x, 90.0);
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn open(path: &Path) -> Result<Self> {
        let path = path.display().to_string();
        let values: Vec<Value> = json_file::read_all(&path, EXAMPLE)?;
        let in_a_list = values.iter().any(Value::is_array);
        let objects: Vec<Value> = values.into_iter().flat_map(objects).collect();
        if objects.is_empty() {
            return Err(Error::regions(&path, "it holds no regions", format!("write {EXAMPLE}")));
        }
        let is_list = in_a_list || objects.len() > 1;
        let entry = |(n, object): (usize, Value)| {
            if !object.is_object() {
                let problem = format!("entry {n} is not an object");
                return Err(Error::regions(&path, problem, format!("write {EXAMPLE}")));
            }
            Regions::from_fields(&path, &Fields::of(&object)?)
        };
        let entries = objects.into_iter().enumerate().map(entry).collect::<Result<Vec<_>>>()?;
        let places = if is_list { Some(places(&path, &entries)?) } else { None };
        Ok(Self { path, entries, places })
    }

    /// The regions of the only photograph in the file.
    ///
    /// # Errors
    /// [`Error::Regions`] if there are several photographs.
    pub fn only(&self) -> Result<&Regions> {
        match self.entries.as_slice() {
            [only] => Ok(only),
            entries => {
                let problem = format!("regions of {} photographs, but one is needed", entries.len());
                Err(Error::regions(&self.path, problem, "keep one of them"))
            }
        }
    }

    /// The regions of the photograph `image`, scaled to its upright `size`, px.
    ///
    /// # Errors
    /// [`Error::Regions`] if a list does not contain the photograph, or the corners belong to a picture of
    /// another shape.
    pub fn of(&self, image: &Path, size: [usize; 2]) -> Result<Regions> {
        let names = [image.file_name(), image.file_stem()];
        let mut names = names.into_iter().flatten().filter_map(|name| Some(composed(name.to_str()?)));
        let entry = match &self.places {
            Some(places) => names.find_map(|name| places.get(&name)).map(|at| &self.entries[*at]),
            None => self.entries.first(),
        };
        let entry = entry.ok_or_else(|| {
            let problem = format!("no entry of the list has '{}' as its 'image'", image.display());
            Error::regions(&self.path, problem, "add one; names are compared without folders")
        })?;
        entry.scaled_to(&self.path, size)
    }
}

/// Indices of the photographs' entries in a list.
///
/// # Errors
/// [`Error::Regions`] unless every entry has a different name.
fn places(path: &str, entries: &[Regions]) -> Result<HashMap<String, usize>> {
    let mut places = HashMap::new();
    for (n, entry) in entries.iter().enumerate() {
        let Some(image) = &entry.image else {
            let problem = format!("entry {n} of the list has no field 'image'");
            return Err(Error::regions(path, problem, "name its photograph"));
        };
        if places.insert(composed(image), n).is_some() {
            let problem = format!("field 'image': '{image}' occurs twice");
            return Err(Error::regions(path, problem, "keep one of the two entries"));
        }
    }
    Ok(places)
}

/// The objects in a JSON value: items of a list, the regions of a record, or the value itself.
fn objects(value: Value) -> Vec<Value> {
    match value {
        Value::Array(objects) => objects,
        Value::Object(mut record) if record.contains_key("kind") => {
            record.remove("regions").into_iter().collect()
        }
        object => vec![object],
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // a test stops at the first surprise

    use super::*;
    use crate::image::Point;

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
        assert!(refused("").contains("it holds no regions") && refused("[]").contains("it holds no regions"));
        assert!(refused("{").contains("EOF while parsing"));
        assert!(refused("7").contains("entry 0 is not an object"));
        assert!(
            refused(r#"{"panle0": 1}"#)
                .contains("no field 'panle0'; the fields are panel0, panel1, .., chart")
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
        assert!(refused(r#"[{"image": "a"}, {"image": "a"}]"#).contains("'a' occurs twice"));
    }

    #[test]
    fn a_list_is_searched_by_name_and_an_object_holds_for_all() {
        let list = open(&format!(r#"[{{"image": "a", "panel0": {SQUARE}}}, {{"image": "b.tif"}}]"#)).unwrap();
        let of = |name: &str| list.of(Path::new(name), [9, 9]);
        assert!(
            of("folder/a.png").unwrap().panels.contains_key(&0) && of("b.tif").unwrap().panels.is_empty()
        );
        assert!(of("b.png").unwrap_err().to_string().contains("'b.png'"));
        let composed = open("[{\"image\": \"\u{e9}.tif\"}]").unwrap();
        assert!(composed.of(Path::new("e\u{301}.tif"), [9, 9]).is_ok());
        assert!(refused("[{\"image\": \"\u{e9}\"}, {\"image\": \"e\u{301}\"}]").contains("occurs twice"));
        let all = open(&format!(r#"{{"image": "a.tif", "panel0": {SQUARE}, "panel1": null}}"#)).unwrap();
        assert!(all.of(Path::new("b.tif"), [9, 9]).unwrap().panels.contains_key(&0));
    }

    #[test]
    fn a_stream_has_them_in_its_samples() {
        let sample = |regions: &str| format!("{{\"kind\": \"sample\"{regions}}}\n");
        let marked = sample(&format!(", \"regions\": {{\"image\": \"w.exr\", \"panel3\": {SQUARE}}}"));
        let stream = open(&format!("{{\"kind\": \"scene\"}}\n{marked}{}", sample(""))).unwrap();
        assert!(stream.of(Path::new("noisy.tif"), [9, 9]).unwrap().panels.contains_key(&3));
        assert!(refused(&sample("")).contains("it holds no regions"));
    }

    #[test]
    fn corners_of_a_preview_are_scaled_and_those_of_a_crop_refused() {
        let file = open(&format!(r#"{{"panel0": {SQUARE}, "width": 1024, "height": 683}}"#)).unwrap();
        let corners = file.of(Path::new("a"), [6000, 4000]).unwrap().panels[&0];
        assert_eq!(corners[2], Point::new(8.0 * 6000.0 / 1024.0, 8.0 * 4000.0 / 683.0));
        let crop = file.of(Path::new("a"), [6000, 3900]).unwrap_err().to_string();
        assert!(crop.contains("1024 x 683 px") && crop.contains("6000 x 3900 px"), "{crop}");
    }
}
