//! PLY files (Stanford polygons), text or binary: vertices and faces; the format has no groups.

use std::io::Read;
use std::path::Path;

use ply_rs_bw::parser::Parser;
use ply_rs_bw::ply::{DefaultElement, Property};

use super::{Shape, file};
use crate::error::{Error, Result};

/// Reads a surface; colours, normals and other properties are ignored.
///
/// # Returns
/// As [`Shape::new`].
///
/// # Errors
/// [`Error::File`] if the file cannot be read, else [`Error::Shape`] with its name.
pub fn read(path: &Path) -> Result<(Shape, Vec<String>)> {
    surface(&mut file::open(path)?).map_err(|e| e.of_file(path))
}

fn surface(file: &mut impl Read) -> Result<(Shape, Vec<String>)> {
    let broken = |problem: String| Error::shape(problem, "export the surface again");
    let parsed = Parser::<DefaultElement>::new().read_ply(file);
    let first_line = |text: String| text.lines().next().unwrap_or_default().trim_end_matches('.').to_owned();
    let ply = parsed.map_err(|e| broken(format!("not a PLY file: {}", first_line(e.to_string()))))?;
    let elements = |name: &str| ply.payload.get(name).map(Vec::as_slice).unwrap_or_default();
    let vertex = |element: &DefaultElement| {
        let [x, y, z] = ["x", "y", "z"].map(|axis| element.get(axis).and_then(number));
        Some([x?, y?, z?])
    };
    let face = |element: &DefaultElement| {
        let corners = ["vertex_indices", "vertex_index"].iter().find_map(|name| element.get(*name));
        let corners = corners.and_then(Property::to_u32_list)?;
        Some(corners.into_iter().map(|corner| corner as usize).collect::<Vec<_>>())
    };
    let vertices: Option<Vec<_>> = elements("vertex").iter().map(vertex).collect();
    let faces: Option<Vec<_>> = elements("face").iter().map(face).collect();
    let (Some(vertices), Some(faces)) = (vertices, faces) else {
        return Err(broken("a vertex lacks x, y or z, or a face its vertex_indices".to_owned()));
    };
    Shape::new(vertices, faces, Vec::new())
}

fn number(property: &Property) -> Option<f64> {
    match *property {
        Property::Float(x) => Some(f64::from(x)),
        Property::Double(x) => Some(x),
        Property::Char(x) => Some(f64::from(x)),
        Property::UChar(x) => Some(f64::from(x)),
        Property::Short(x) => Some(f64::from(x)),
        Property::UShort(x) => Some(f64::from(x)),
        Property::Int(x) => Some(f64::from(x)),
        Property::UInt(x) => Some(f64::from(x)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEADER: &str = "ply\nformat ascii 1.0\nelement vertex 4\n\
                          property float x\nproperty double y\nproperty float z\n\
                          element face 2\nproperty list uchar int vertex_indices\nend_header\n";

    fn read_text(text: &str) -> Result<(Shape, Vec<String>)> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.ply");
        std::fs::write(&path, text).unwrap();
        read(&path)
    }

    #[test]
    fn faces_keep_their_order() {
        let (shape, _) =
            read_text(&format!("{HEADER}0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n4 3 2 1 0\n")).unwrap();
        assert_eq!((shape.corners(0), shape.corners(1)), (&[0, 1, 2][..], &[3, 2, 1, 0][..]));
    }

    #[test]
    fn broken_files_are_one_line() {
        for body in
            ["", "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n", "0 0 0\n1 0 0\n1 1 0\nnan 1 0\n3 0 1 2\n3 0 2 3\n"]
        {
            let error = read_text(&format!("{HEADER}{body}")).unwrap_err().to_string();
            assert!(error.contains("a.ply: ") && !error.contains('\n'), "{error}");
        }
    }
}
