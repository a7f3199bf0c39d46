//! A picture of the Cornell box, from its published geometry, camera and reflectances, where they are at
//! hand.

use std::fmt::Write;
use std::path::Path;

use serde_json::Value;
use vfold::image::{Photograph, Pixel, ReadOptions};

use crate::common::{Workdir, is_there};

const SCENES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data/scenes");
/// Cells of a wall in each direction; its corners do not lie in one plane, and each cell is two triangles.
const CELLS: usize = 2;
/// Width and height of the picture, px.
const SIZE: f64 = 120.0;

#[test]
fn the_box_looks_like_its_picture() {
    if !is_there(SCENES) {
        return;
    }
    let file = std::fs::File::open(Path::new(SCENES).join("cornell_box_empty.json")).unwrap();
    let scene: Value = serde_json::from_reader(file).unwrap();
    let (folder, pictures) = (Workdir::new(), tempfile::tempdir().unwrap());
    let path = pictures.path().join("box.exr");
    // the camera's film is 25 mm wide, 35 mm behind its pinhole
    let run = folder.sh(&format!(
        "cat > box.obj <<'END'
{}END
        for colour in 2 3 4; do cut -d, -f1,$colour {SCENES}/cornell_box_reflectance.csv > $colour.csv; done
        vkernel --shape box.obj --light point:278,500,279.5 --tolerance 0.05 -o box.json -q
        vforward box.json --reflectance 2.csv --material right_wall=3.csv --material left_wall=4.csv \
            --illuminant D65 --eye 278,273,-800 --look-at 278,273,0 --up 0,1,0 --field-of-view-deg {} \
            --render-size {SIZE}x{SIZE} --render {} -o sample.ndjson -q",
        mesh(&scene),
        2.0 * f64::atan(0.0125 / 0.035).to_degrees(),
        path.display()
    ));
    assert_eq!((run.status, run.stdout.as_str(), run.stderr.as_str()), (0, "", ""));
    let picture = Photograph::open(&path, &ReadOptions::default()).unwrap();
    let [left, right, floor, ceiling, back] =
        [[5.0, 60.0], [115.0, 60.0], [60.0, 112.0], [60.0, 8.0], [60.0, 60.0]].map(|at| light(&picture, at));
    let redness = |rgb: [f64; 3]| rgb[0] / rgb[1];
    assert!(redness(left) > 2.0 * redness(back) && redness(right) < 0.7 * redness(back));
    for white in [floor, ceiling, back] {
        assert!(redness(white) > 1.05 * redness(right) && redness(white) < 0.7 * redness(left));
    }
    edges_are_where_they_are_seen(&picture, &scene);
}

/// The back wall's corners, projected by hand: light changes across its left and right edges.
fn edges_are_where_they_are_seen(picture: &Photograph, scene: &Value) {
    let focal_px = SIZE * 0.035 / 0.025;
    let back = &scene["surfaces"][2];
    assert_eq!(back["name"], "back_wall");
    for (corner, inwards) in [(0, 1.0), (1, -1.0)] {
        let at = |axis: usize| back["vertices"][corner][axis].as_f64().unwrap();
        let x = SIZE / 2.0 + focal_px * (278.0 - at(0)) / (at(2) + 800.0); // x to the left
        let [wall, beside] = [inwards, -inwards].map(|way| light(picture, [x + 2.0 * way, 60.0]));
        assert!(
            (wall[0] / wall[1] / (beside[0] / beside[1]) - 1.0).abs() > 0.2,
            "{corner}: {wall:?} {beside:?}"
        );
    }
}

fn light(picture: &Photograph, [x, y]: [f64; 2]) -> [f64; 3] {
    let Pixel::Light(light) = picture.pixel(x as usize, y as usize) else { panic!("no light at {x}, {y}") };
    light
}

/// The walls as OBJ.
fn mesh(scene: &Value) -> String {
    let mut obj = String::new();
    for (n, wall) in scene["surfaces"].as_array().unwrap().iter().enumerate() {
        let corner = |k: usize, axis: usize| wall["vertices"][k][axis].as_f64().unwrap();
        writeln!(obj, "g {}", wall["name"].as_str().unwrap()).unwrap();
        for k in 0..(CELLS + 1) * (CELLS + 1) {
            let (u, v) = ((k % (CELLS + 1)) as f64 / CELLS as f64, (k / (CELLS + 1)) as f64 / CELLS as f64);
            let at = |axis: usize| {
                (1.0 - v) * ((1.0 - u) * corner(0, axis) + u * corner(1, axis))
                    + v * ((1.0 - u) * corner(3, axis) + u * corner(2, axis))
            };
            writeln!(obj, "v {} {} {}", at(0), at(1), at(2)).unwrap();
        }
        for k in 0..CELLS * CELLS {
            let first = 1 + n * (CELLS + 1) * (CELLS + 1) + k / CELLS * (CELLS + 1) + k % CELLS;
            let [a, b, c, d] = [first, first + 1, first + CELLS + 2, first + CELLS + 1];
            writeln!(obj, "f {a} {b} {c}\nf {a} {c} {d}").unwrap();
        }
    }
    obj
}
