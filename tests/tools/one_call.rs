//! The library's one call measures what the tools measure, to the last digit.

use std::fs;
use std::path::Path;

use serde_json::Value;
use vfold::image::{Photograph, Pixel, Point, ReadOptions, write_linear};
use vfold::measure::{Setup, sheet};

use crate::common::Workdir;

const PHOTOS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/photos");

/// Corners as a sidecar has them, in the order of `--panel0`.
fn corners(path: &Path) -> [[Point; 4]; 2] {
    let sidecar: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    ["A", "B"].map(|panel| {
        ["crease_0", "crease_1", "outer_1", "outer_0"].map(|corner| {
            let place = &sidecar["panels_px"][panel][corner];
            Point::new(place[0].as_f64().unwrap(), place[1].as_f64().unwrap())
        })
    })
}

fn check(file: &str, camera: Option<&str>, illuminant: Option<&str>, exposure: Option<f64>) {
    let photo = Path::new(PHOTOS).join(file);
    let corners = corners(&photo.with_extension("json"));
    let photograph = Photograph::open(&photo, &ReadOptions::default()).unwrap();
    let setup = Setup { camera, illuminant, exposure, ..Setup::new(50.0, corners).unwrap() };
    let measured = sheet(&photograph, &setup).unwrap();

    let flag = |name: &str, value: Option<String>| value.map(|value| format!("--{name} {value} "));
    let flags = [
        flag("camera", camera.map(str::to_owned)),
        flag("illuminant", illuminant.map(str::to_owned)),
        flag("exposure", exposure.map(|exposure| exposure.to_string())),
    ];
    let [panel0, panel1] = corners.map(|panel| panel.map(|Point { x, y }| format!("{x},{y}")).join(" "));
    let run = Workdir::new().sh(&format!(
        "vkernel --angle-deg 50 | vextract -q '{}' {} --panel0 '{panel0}' --panel1 '{panel1}' | vestimate -q",
        photo.display(),
        flags.into_iter().flatten().collect::<String>()
    ));
    assert_eq!(run.status, 0, "{file}: {}", run.stderr);
    let sample: Value = serde_json::from_str(run.stdout.lines().last().unwrap()).unwrap();
    let told = &sample["estimate"];
    let estimate = &measured.estimate;
    assert_eq!(told["wavelengths_nm"], Value::from(measured.wavelengths_nm), "{file}");
    assert_eq!(told["reflectance"], Value::from(estimate.reflectance.clone()), "{file}");
    assert_eq!(told["reflectance_sd"], Value::from(estimate.reflectance_sd().unwrap()), "{file}");
    assert_eq!(told["exposure"], Value::from(estimate.exposure), "{file}");
    assert_eq!(told["verdict"]["level"], measured.verdict.level.name(), "{file}");
    assert_eq!(told["verdict"]["because"], measured.verdict.because, "{file}");
    let findings = estimate.findings.iter().map(|finding| finding.what.as_str());
    let said = told["findings"].as_array().into_iter().flatten();
    assert!(said.map(|finding| finding["what"].as_str().unwrap()).eq(findings), "{file}: {told}");
}

/// Like the tools, it refuses a picture without colours whose file has three channels.
#[test]
fn a_grey_picture_is_refused() {
    let photo = Path::new(PHOTOS).join("a_ideal_magenta_50.exr");
    let photograph = Photograph::open(&photo, &ReadOptions::default()).unwrap();
    let (width, height) = (photograph.width(), photograph.height());
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let grey = |(x, y)| match photograph.pixel(x, y) {
        Pixel::Light([red, ..]) => [red; 3],
        _ => [0.0; 3],
    };
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("grey.exr");
    write_linear(&file, width, height, &pixels.flat_map(grey).collect::<Vec<_>>()).unwrap();
    let camera = Some("canon-5d-mark-ii");
    let corners = corners(&photo.with_extension("json"));
    let setup = Setup { camera, illuminant: Some("D65"), ..Setup::new(50.0, corners).unwrap() };
    let grey = Photograph::open(&file, &ReadOptions::default()).unwrap();
    let error = sheet(&grey, &setup).unwrap_err().to_string();
    assert!(error.contains("a grey picture saved as RGB"), "{error}");
}

#[test]
fn the_library_measures_what_the_tools_measure() {
    check("a_ideal_magenta_50.exr", Some("canon-5d-mark-ii"), Some("D65"), None);
    // of another camera, in light that nobody stated
    check("a_ideal_magenta_50.exr", Some("nikon-d5100"), None, Some(0.9));
    // whose camera EXIF names, and which was developed for the eye
    check("f_srgb_blue_flower_50.jpg", None, None, None);
}
