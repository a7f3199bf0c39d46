//! Files of surfaces.

use std::fmt::Write;

use vfold::stream::read_shape;
use vfold::surfaces::Shape;

use super::{assert_finite, taken, with_file};

pub fn obj(bytes: &[u8]) {
    read_as("obj", bytes);
}

pub fn ply(bytes: &[u8]) {
    read_as("ply", bytes);
}

pub fn json(bytes: &[u8]) {
    read_as("json", bytes);
}

fn read_as(ending: &str, bytes: &[u8]) {
    let shape = with_file(&format!("a.{ending}"), bytes, |path| taken(read_shape(path)));
    let Some((shape, _)) = shape else { return };
    assert!(!shape.is_empty());
    for facet in shape.facets() {
        let normal = facet.normal();
        assert!(facet.area() > 0.0 && (normal.norm() - 1.0).abs() < 1e-9, "{facet:?}");
        assert_finite("area", &[facet.area()]);
    }
    if !shape.is_two_sided() {
        assert_read_again(&shape);
    }
}

/// A surface written as JSON is read again as it was.
fn assert_read_again(shape: &Shape) {
    let corners: Vec<_> = (0..shape.len()).map(|facet| shape.corners(facet)).collect();
    let mut text = format!(r#"{{"vertices": {:?}, "facets": {corners:?}, "groups": ["#, shape.vertices());
    for (n, group) in shape.groups().iter().enumerate() {
        let comma = if n == 0 { "" } else { ", " };
        let (first, count) = (group.facets.start, group.facets.len());
        write!(text, r#"{comma}{{"name": "g", "facets": [{first}, {count}]}}"#).unwrap();
    }
    text += "]}";
    let (again, remarks) = with_file("b.json", text.as_bytes(), read_shape).unwrap();
    let ranges = |shape: &Shape| shape.groups().iter().map(|group| group.facets.clone()).collect::<Vec<_>>();
    assert!(remarks.iter().all(|remark| !remark.contains("left out")), "{remarks:?}");
    assert_eq!(again.vertices(), shape.vertices());
    assert_eq!((0..again.len()).map(|facet| again.corners(facet)).collect::<Vec<_>>(), corners);
    assert_eq!(ranges(&again), ranges(shape));
}
