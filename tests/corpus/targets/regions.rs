//! JSON files beside photographs: regions, and what a camera did.

use std::path::Path;

use vfold::image::Homography;
use vfold::stream::{RegionsFile, read_development};

use super::{assert_finite, taken, with_file};

pub fn regions(bytes: &[u8]) {
    let Some(file) = with_file("regions.json", bytes, |path| taken(RegionsFile::open(path))) else { return };
    for size in [[640, 480], [1, 1], [65_535, 300]] {
        let Some(regions) = taken(file.of(Path::new("a.exr"), size)) else { continue };
        for corners in regions.panels.values().chain(&regions.chart).chain(&regions.white) {
            assert_finite("corners", corners.iter().flat_map(|corner| [&corner.x, &corner.y]));
            if let Some(map) = taken(Homography::from_unit_square(*corners)) {
                let middle = map.to_image(0.5, 0.5);
                assert_finite("middle", &[middle.x, middle.y]);
            }
        }
    }
}

pub fn development(bytes: &[u8]) {
    with_file("undo.json", bytes, |path| taken(read_development(path.to_str().unwrap())));
}
