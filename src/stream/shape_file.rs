//! Surfaces in files: OBJ, PLY, and JSON for the output of other programs.
//!
//! ```json
//! {"vertices": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], "facets": [[0, 1, 2, 3]],
//!  "groups": [{"name": "floor", "facets": [0, 1]}], "two_sided": false}
//! ```
//! Facets are lists of three or four vertex indices, from 0, counter-clockwise seen from the reflecting side;
//! a group has its first facet and their number. Groups and `two_sided` may be absent.

use std::path::Path;

use serde::Deserialize;

use super::json_file;
use crate::error::{Error, Result};
use crate::surfaces::{Group, Shape, obj, ply};

const EXAMPLE: &str = "{\"vertices\": [[x, y, z], ..], \"facets\": [[0, 1, 2, 3], ..]}";

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ShapeFile {
    vertices: Vec<[f64; 3]>,
    facets: Vec<Vec<usize>>,
    #[serde(default)]
    groups: Vec<GroupRecord>,
    #[serde(default)]
    two_sided: bool,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct GroupRecord {
    name: String,
    facets: [usize; 2],
}

/// Reads a surface from a `.obj`, `.ply` or `.json` file.
///
/// # Returns
/// As [`Shape::new`].
///
/// # Errors
/// [`Error::File`] if it cannot be read, [`Error::Shape`] or [`Error::Record`] with its name if it contains
/// no surface.
///
/// # Example
/// ```
/// use vfold::stream::read_shape;
/// let folder = tempfile::tempdir().unwrap();
/// let path = folder.path().join("floor.json");
/// let text = r#"{"vertices": [[0, 0, 0], [1, 0, 0], [1, 1, 0]], "facets": [[0, 1, 2]],
///     "two_sided": true}"#;
/// std::fs::write(&path, text).unwrap();
/// assert_eq!(read_shape(&path)?.0.len(), 2);
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn read_shape(path: &Path) -> Result<(Shape, Vec<String>)> {
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    match ending.to_ascii_lowercase().as_str() {
        "obj" => obj::read(path),
        "ply" => ply::read(path),
        "json" => read_json(path).map_err(|e| e.of_file(path)),
        _ => Err(Error::shape("its name shows no format", "end it in .obj, .ply or .json").of_file(path)),
    }
}

fn read_json(path: &Path) -> Result<(Shape, Vec<String>)> {
    let file: ShapeFile = json_file::read(&path.display().to_string(), EXAMPLE)?;
    let group = |GroupRecord { name, facets: [first, count] }| Group {
        name,
        facets: first..first.saturating_add(count),
    };
    let groups = file.groups.into_iter().map(group).collect();
    let (shape, remarks) = Shape::new(file.vertices, file.facets, groups)?;
    Ok((if file.two_sided { shape.with_backs()? } else { shape }, remarks))
}
