//! RAW files of real cameras beside `LibRaw`, which rawpy brings: levels, filters, where the picture begins,
//! and the light of its sites.
//!
//! Such files are large, and whose they are is seldom said: none is here. Put some into the folder
//! `VFOLD_RAW_FILES` to test with them; the `PowerShot` and EOS cameras of 2000 to 2004 wrote CRW files of 3
//! MB.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;
use vfold::image::{Photograph, Pixel, ReadOptions};

use crate::common::left_out;

const LIBRAW: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/tools/raw_files/libraw.py");
/// Black levels may be a camera's own or the mean of dark sites: apart by this much of a number of the
/// sensor.
const BLACK: f64 = 1.5;
/// Light of sites, of white: black levels differ, and an old Kodak's curve is rounded by one and not by the
/// other.
const LIGHT: f64 = 5e-4;
/// Programs differ in how much of a sensor is picture by a few rows and columns.
const EDGE_PX: f64 = 12.0;

#[test]
fn files_of_cameras_are_read_as_libraw_reads_them() {
    let Some(folder) = std::env::var_os("VFOLD_RAW_FILES") else {
        left_out("VFOLD_RAW_FILES names no folder: RAW files of real cameras are not read beside LibRaw");
        return;
    };
    let python = std::env::var("VFOLD_RAWPY").unwrap_or_else(|_| "python3".to_owned());
    if !Command::new(&python).args(["-c", "import rawpy"]).output().is_ok_and(|run| run.status.success()) {
        left_out("rawpy is not installed: RAW files of real cameras are not read beside LibRaw");
        return;
    }
    let mut files: Vec<PathBuf> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    for file in files {
        match Photograph::open(&file, &ReadOptions::default()) {
            Ok(photograph) => compare(&python, &file, &photograph),
            Err(error) => println!("{error}"),
        }
    }
}

fn compare(python: &str, file: &Path, photograph: &Photograph) {
    let info = photograph.info();
    let (name, sensor) = (file.display(), info.sensor.as_ref().unwrap());
    let [column, row, width, height] = sensor.area;
    let at = |k: usize, size: usize| 1 + k * (size - 3) / 11;
    let places: Vec<_> = (0..12).flat_map(|i| (0..12).map(move |j| (at(i, width), at(j, height)))).collect();
    let run = Command::new(python)
        .args([LIBRAW.as_ref(), file.as_os_str()])
        .args([column, row].map(|place| place.to_string()))
        .args(places.iter().map(|(x, y)| format!("{x},{y}")))
        .output()
        .unwrap();
    assert!(run.status.success(), "{name}: {}", String::from_utf8_lossy(&run.stderr));
    let libraw: Value = serde_json::from_slice(&run.stdout).unwrap();
    let numbers = |value: &Value| -> Vec<f64> {
        value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
    };
    let (black, white) = (numbers(&libraw["black"]), libraw["white"].as_f64().unwrap());
    println!("{name}: area {:?}, LibRaw {}", sensor.area, libraw["visible"]);
    println!(
        "    black {:?}, LibRaw {black:?}; white {:?}, LibRaw {white}",
        info.black_level, info.white_level
    );
    assert_eq!(sensor.mosaic.as_deref(), libraw["mosaic"].as_str(), "{name}");
    let edges = |[x, y, width, height]: [f64; 4]| [x, y, x + width, y + height];
    let theirs: [f64; 4] = numbers(&libraw["visible"]).try_into().unwrap();
    for (ours, theirs) in edges(sensor.area.map(|px| px as f64)).into_iter().zip(edges(theirs)) {
        assert!((ours - theirs).abs() <= EDGE_PX, "{name}: an edge at {ours}, LibRaw has it at {theirs}");
    }
    for (colour, theirs) in black.iter().enumerate() {
        let (ours, white_here) = (info.black_level[colour], info.white_level[colour]);
        assert!((ours - theirs).abs() < BLACK, "{name}: black {ours}, LibRaw {theirs}");
        assert!((white_here - white).abs() < 0.01 * white, "{name}: white {white_here}, LibRaw {white}");
    }
    for ((x, y), values) in places.into_iter().zip(libraw["values"].as_array().unwrap()) {
        // clipped in one of nine sites
        let Pixel::Light(light) = photograph.pixel(x, y) else { continue };
        for (colour, value) in numbers(values).into_iter().enumerate() {
            let (black, white) = (info.black_level[colour], info.white_level[colour]);
            let off = (light[colour] - (value - black) / (white - black)).abs();
            assert!(off < LIGHT, "{name}: ({x}, {y}) is off by {off}");
        }
    }
}
