//! Wavefront OBJ files: vertices, faces in order, objects and groups.

use std::io::Read;
use std::panic::catch_unwind;
use std::path::Path;

use tobj::{LoadError, LoadOptions, Model};

use super::{Group, Shape, file};
use crate::error::{Error, Result};

/// Faces with fewer corners are lines and points, which a file may also contain.
const CORNERS_MIN: usize = 3;

/// Reads a surface; normals, textures, materials, lines and points are ignored.
///
/// # Returns
/// As [`Shape::new`].
///
/// # Errors
/// [`Error::File`] if the file cannot be read, else [`Error::Shape`] with its name.
///
/// # Example
/// ```
/// use vfold::surfaces::obj;
/// let path = tempfile::tempdir().unwrap().path().join("v.obj");
/// # std::fs::create_dir_all(path.parent().unwrap()).unwrap();
/// std::fs::write(&path, "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ng left\nf 1 2 3 4\n").unwrap();
/// let (shape, _) = obj::read(&path)?;
/// assert_eq!(shape.groups()[0].name, "left");
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn read(path: &Path) -> Result<(Shape, Vec<String>)> {
    let mut bytes = Vec::new();
    file::open(path)?.read_to_end(&mut bytes).map_err(|e| Error::file(path.display(), e))?;
    if let Some(line) = line_of_no_index(&bytes) {
        let problem = format!("line {line}: a corner of a face has no index");
        return Err(Error::shape(problem, "export the surface again").of_file(path));
    }
    let models = parse(&bytes)
        .map_err(|e| Error::shape(format!("not an OBJ file: {e}"), "export the surface again"))
        .and_then(|(models, _)| surface(&models));
    models.map_err(|e| e.of_file(path))
}

/// Parses the file; the parser uses indices before it checks their bounds, and may panic.
fn parse(bytes: &[u8]) -> tobj::LoadResult {
    let no_materials = |_: &Path| Ok(Default::default());
    let read = || tobj::load_obj_buf(&mut &bytes[..], &LoadOptions::default(), no_materials);
    catch_unwind(read).unwrap_or(Err(LoadError::FaceVertexOutOfBounds))
}

/// The line of a face with a number of more digits than any index: the parser would reduce it modulo 2⁶⁴.
fn line_of_no_index(bytes: &[u8]) -> Option<usize> {
    const DIGITS_MAX: usize = 10;
    let is_long = |digits: &[u8]| digits.len() > DIGITS_MAX;
    let is_wrong = |line: &[u8]| {
        line.trim_ascii_start().starts_with(b"f") && line.split(|byte| !byte.is_ascii_digit()).any(is_long)
    };
    bytes.split(|byte| *byte == b'\n').position(is_wrong).map(|line| line + 1)
}

fn surface(models: &[Model]) -> Result<(Shape, Vec<String>)> {
    let (mut vertices, mut faces, mut groups) = (Vec::new(), Vec::new(), Vec::<Group>::new());
    for Model { name, mesh } in models {
        let (first, first_face) = (vertices.len(), faces.len());
        vertices.extend(mesh.positions.chunks_exact(3).map(|point| [point[0], point[1], point[2]]));
        let mut indices = mesh.indices.iter().map(|index| first + *index as usize);
        let triangles = mesh.indices.len() / 3 * usize::from(mesh.face_arities.is_empty());
        let sides = mesh.face_arities.iter().copied().chain(std::iter::repeat_n(3, triangles));
        let all = sides.map(|sides| indices.by_ref().take(sides as usize).collect::<Vec<_>>());
        faces.extend(all.filter(|corners| corners.len() >= CORNERS_MIN));
        match groups.last_mut() {
            // a change of material within a group does not start a new one
            Some(last) if last.name == *name => last.facets.end = faces.len(),
            _ => groups.push(Group { name: name.clone(), facets: first_face..faces.len() }),
        }
    }
    Shape::new(vertices, faces, groups)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read_text(text: &str) -> Result<(Shape, Vec<String>)> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.obj");
        std::fs::write(&path, text).unwrap();
        read(&path)
    }

    #[test]
    fn quads_and_triangles_of_several_groups_keep_their_order() {
        let vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n";
        let faces = "g a\nf 1 2 3 4\nusemtl red\nf 4/1/1 3/1/1 2/1/1\nl 1 2\ng b c\n\
                     f -4 -2 -3\nf -4//1 -1//1 -2//1\n";
        let (shape, _) = read_text(&format!("{vertices}{faces}")).unwrap();
        let sides: Vec<_> = (0..4).map(|n| shape.corners(n).len()).collect();
        assert_eq!(sides, [4, 3, 3, 3]);
        let groups: Vec<_> = shape.groups().iter().map(|g| (g.name.as_str(), g.facets.clone())).collect();
        assert_eq!(groups[0], ("a", 0..2));
        assert_eq!(groups[1].1, 2..4);
    }

    #[test]
    fn broken_files_are_one_line() {
        for text in [
            "",
            "v 0 0\n",
            "v 0 0 0\nf 1 2 3\n",
            "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
            "f 1 99999999999 3\n",
        ] {
            let error = read_text(text).unwrap_err().to_string();
            assert!(error.contains("a.obj: ") && !error.contains('\n'), "{error}");
        }
    }
}
