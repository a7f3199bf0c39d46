//! Calibration by a chart: a path-traced photograph whose exposure is known, and charts with errors as real
//! ones have.

use std::fs::File;
use std::path::Path;

use nalgebra::{DMatrix, DVector};
use serde_json::Value;
use vfold::calibrate::{Calibration, Patch};
use vfold::camera::CameraResponse;
use vfold::forward::noise::Noise;
use vfold::forward::{Lighting, OpenLight};
use vfold::geometry::{FacetGrid, Fold, Light};
use vfold::image::{Lens, Photograph, Point, ReadOptions, measure_patches};
use vfold::spectrum::{Outside, WavelengthGrid, camera, illuminant, reflectances};

use crate::common::is_there;

const SIDECAR: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/reference/e_chart_purple_45.json");
const PHOTO: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/photos/e_chart_purple_45.tif");

fn sidecar() -> Value {
    serde_json::from_reader(File::open(SIDECAR).unwrap()).unwrap()
}

fn numbers<const N: usize>(value: &Value) -> [f64; N] {
    std::array::from_fn(|k| value[k].as_f64().unwrap())
}

/// What colour-science makes of the 24 patches at exposure 1: white is 1 in green.
fn expected(sidecar: &Value) -> Vec<[f64; 3]> {
    let white = sidecar["white_rgb"][1].as_f64().unwrap();
    let rgb = sidecar["chart_rgb_true"].as_array().unwrap();
    rgb.iter().map(|rgb| numbers(rgb).map(|value| value / white)).collect()
}

/// The path-traced chart's block of patches.
fn chart_corners(sidecar: &Value) -> [Point; 4] {
    [(0, 0), (5, 1), (23, 2), (18, 3)].map(|(patch, corner)| {
        let [x, y] = numbers(&sidecar["chart_px"][patch]["corners_TL_TR_BR_BL"][corner]);
        Point::new(x, y)
    })
}

#[test]
fn flat_patches_are_those_of_colour_science() {
    let sidecar = sidecar();
    let grid = WavelengthGrid::uniform(400.0, 700.0, 5.0).unwrap();
    let sensitivities: Vec<_> = camera("canon-5d-mark-ii").unwrap().channels;
    let sensitivities: Vec<_> = sensitivities.iter().map(|c| c.on(&grid, Outside::Zero).unwrap()).collect();
    let light = illuminant("D50").unwrap().on(&grid, Outside::Refuse).unwrap();
    let response = CameraResponse::new(&grid, &sensitivities, &light).unwrap();
    let fold = Fold::new(45.0, 1.0, 1.0, FacetGrid { rows: 1, cols: 1 }).unwrap();
    let light = Light::new(&fold, 0.0, 0.0, 0.0).unwrap();
    let lighting = Lighting { light, sun: response.clone(), sky: response };
    for (patch, expected) in reflectances("cc24").unwrap().iter().zip(expected(&sidecar)) {
        let rgb = OpenLight::from(&lighting).flat_rgb(1.0, &patch.on(&grid, Outside::Refuse).unwrap());
        for (got, want) in rgb.iter().zip(expected) {
            assert!((got / want - 1.0).abs() < 1e-5, "{}: {rgb:?}, not {expected:?}", patch.name());
        }
    }
}

/// 40 dB of noise at white; patches and exposure as the path tracer had them.
#[test]
fn a_photographed_chart_tells_its_exposure() {
    if !is_there(PHOTO) {
        return;
    }
    let sidecar = sidecar();
    let photograph = Photograph::open(Path::new(PHOTO), &ReadOptions::default()).unwrap();
    let measured =
        measure_patches(&photograph, "chart", chart_corners(&sidecar), Lens::STRAIGHT, [4, 6]).unwrap();
    let patches: Vec<_> = measured
        .into_iter()
        .zip(expected(&sidecar))
        .map(|(measured, expected)| Patch {
            name: String::new(),
            measured: measured.mean.unwrap(),
            standard_error: measured.standard_error.unwrap(),
            expected: expected.to_vec(),
        })
        .collect();
    let calibration = Calibration::fit(&patches, 1).unwrap();
    let error = calibration.exposure() / sidecar["white_rgb"][1].as_f64().unwrap() - 1.0;
    let residuals = calibration.residual_rms(&patches);
    println!("exposure {:+.3} %, residuals {residuals:.5?}", 100.0 * error);
    assert!(error.abs() < 1e-3 && residuals.iter().all(|residual| *residual < 2e-3));
}

/// Standard normal numbers, another row for each `stream`.
fn normal<const N: usize>(stream: u64) -> [f64; N] {
    let mut numbers = [0.0; N];
    Noise { sd: 1.0, photon: 0.0 }.add(&mut numbers, 5, stream);
    numbers
}

/// A camera that is not quite the scene's: gain, stray light, curvature.
struct Camera {
    gain: f64,
    offset: f64,
    curvature: f64,
}

impl Camera {
    fn photograph(&self, light: f64) -> f64 {
        let light = self.gain * light;
        light * (1.0 + self.curvature * light) + self.offset
    }
}

/// Red of a chart whose patches are off by 2 % each, with the noise of the mean over a hundred pixels.
fn imperfect_chart(camera: &Camera, expected: &[[f64; 3]], stream: u64) -> Vec<Patch> {
    let (off, noise) = (normal::<24>(2 * stream), normal::<24>(2 * stream + 1));
    let patch = |(k, expected): (usize, &[f64; 3])| Patch {
        name: String::new(),
        measured: vec![camera.photograph(expected[0] * (1.0 + 0.02 * off[k])) + 3e-4 * noise[k]],
        standard_error: vec![3e-4],
        expected: vec![expected[0]],
    };
    expected.iter().enumerate().map(patch).collect()
}

/// Least squares with some powers of what was measured, every patch with its `weight`; evaluated at
/// `measured`.
fn least_squares(patches: &[Patch], powers: &[i32], weight: fn(f64) -> f64, measured: f64) -> f64 {
    let weight = |row: usize| weight(patches[row].expected[0]);
    let term = |row: usize, col: usize| weight(row) * patches[row].measured[0].powi(powers[col]);
    let matrix = DMatrix::from_fn(patches.len(), powers.len(), term);
    let values = DVector::from_fn(patches.len(), |row, _| weight(row) * patches[row].expected[0]);
    let coefficients = matrix.svd(true, true).solve(&values, 0.0).unwrap();
    powers.iter().zip(&coefficients).map(|(power, coefficient)| coefficient * measured.powi(*power)).sum()
}

/// Rms error, percent, at shares of white over 300 charts: of the calibration, of the paper's words taken
/// literally, and of a polynomial through the origin fitted to relative errors.
fn errors_percent(camera: impl Fn(&[f64; 3]) -> Camera, shares: [f64; 3]) -> [[f64; 3]; 3] {
    let sidecar = sidecar();
    let (expected, white) = (expected(&sidecar), numbers::<3>(&sidecar["white_rgb"]));
    let mut squares = [[0.0; 3]; 3];
    for chart in 0..300 {
        let camera = camera(&normal(10_000 + chart));
        let patches = imperfect_chart(&camera, &expected, chart);
        let calibration = Calibration::fit(&patches, 0).unwrap();
        for (k, share) in shares.into_iter().enumerate() {
            let light = share * white[0] / white[1];
            let measured = camera.photograph(light);
            let got = [
                calibration.value(0, measured) / calibration.exposure(),
                least_squares(&patches, &[0, 1, 2], |_| 1.0, measured),
                least_squares(&patches, &[1, 2], f64::recip, measured),
            ];
            got.iter()
                .zip(&mut squares)
                .for_each(|(got, sums)| sums[k] += (got / light - 1.0).powi(2) / 300.0);
        }
    }
    squares.map(|sums| sums.map(|sum| 100.0 * sum.sqrt()))
}

#[test]
fn dark_facets_stay_right_where_plain_least_squares_fails() {
    for (what, offset_sd, curvature_sd, limits) in [
        ("gain", 0.0, 0.0, [2.8, 0.8, 0.6]),
        ("gain and curvature", 0.0, 0.05, [2.8, 0.8, 0.6]),
        ("gain, curvature and stray light", 0.003, 0.05, [3.5, 0.8, 0.6]),
    ] {
        let camera = |random: &[f64; 3]| Camera {
            gain: 0.7 * (1.0 + 0.1 * random[0]),
            offset: offset_sd * random[1],
            curvature: curvature_sd * random[2],
        };
        let [ours, plain, origin] = errors_percent(camera, [0.03, 0.1, 0.3]);
        println!(
            "{what}: {ours:.2?} %, plain {plain:.2?} %, origin {origin:.2?} % at 3, 10 and 30 % of white"
        );
        assert!(ours.iter().zip(&limits).all(|(ours, limit)| ours < limit), "{what}");
        assert!(ours[0] < plain[0] / 2.0, "{what}");
    }
}

#[test]
fn standard_deviations_follow_the_slope() {
    let camera = Camera { gain: 0.6, offset: 2e-3, curvature: -0.05 };
    let patches = imperfect_chart(&camera, &expected(&sidecar()), 1);
    let calibration = Calibration::fit(&patches, 0).unwrap();
    for measured in [-0.01, 0.0, 0.02, 0.2, 0.26, 0.5, 3.0] {
        let difference = calibration.value(0, measured + 1e-6) - calibration.value(0, measured - 1e-6);
        let sd = calibration.sd(0, measured, 1e-3);
        assert!((sd / (difference / 2e-6 * 1e-3) - 1.0).abs() < 1e-6 && sd > 0.0, "{measured}");
    }
}

#[test]
fn what_is_no_chart_is_refused() {
    let expected = expected(&sidecar());
    let camera = Camera { gain: 0.7, offset: 0.0, curvature: 0.0 };
    let good = imperfect_chart(&camera, &expected, 1);
    let refused = |spoil: &dyn Fn(usize, &mut Patch)| {
        let mut patches = good.clone();
        patches.iter_mut().enumerate().for_each(|(k, patch)| spoil(k, patch));
        Calibration::fit(&patches, 0).unwrap_err().to_string()
    };
    let turned = refused(&|k, patch| patch.measured = good[23 - k].measured.clone());
    assert!(turned.contains("off by") || turned.contains("does not rise"), "{turned}");
    let curved = refused(&|_, patch| patch.measured[0] = patch.measured[0].powf(1.0 / 2.2));
    assert!(curved.contains("off by"), "{curved}");
    assert!(refused(&|_, patch| patch.measured[0] = 0.0).contains("does not rise"));
    assert!(refused(&|k, patch| patch.expected[0] *= f64::from(u8::from(k != 5))).contains("be black"));
    assert!(
        refused(&|k, patch| patch.measured.truncate(usize::from(k != 5))).contains("one number per channel")
    );
    assert!(Calibration::fit(&[], 0).is_err());
}
