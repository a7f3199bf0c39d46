//! What is found in photographs: edges of panels, patches of a chart.

use vfold::calibrate::{Calibration, Patch};
use vfold::image::{
    Grid, Homography, Lens, LensEstimate, Marked, Photograph, Point, ReadOptions, corner_orders, measure,
    measure_patches, refine, write_linear,
};

use super::drawn::Drawn;
use super::{assert_finite, taken, with_file};

/// Moves the corners of one panel, or of two at a crease, to edges of a picture.
pub fn refined(bytes: &[u8]) {
    let mut drawn = Drawn::from(bytes);
    let photograph = picture(&mut drawn);
    let Some(lens) = lens(&photograph, &mut drawn) else { return };
    let [a, b, c, d, e, f] = std::array::from_fn(|_| point(&photograph, &mut drawn));
    let mut panels = vec![Marked { panel: 0, corners: [a, b, c, d], joints: [0, 1, 2, 3] }];
    if drawn.below(2) == 1 {
        panels.push(Marked { panel: 1, corners: [a, b, e, f], joints: [0, 1, 4, 5] });
    }
    if panels.iter().any(|panel| taken(Homography::from_unit_square(panel.corners)).is_none()) {
        return;
    }
    let reach_px = drawn.one_of(&[6.0, 1.0, 1e-9, 30.0, 100.0]);
    let Some(found) = taken(refine(&photograph, &panels, &LensEstimate::stated(lens), reach_px)) else {
        return;
    };
    assert_finite("moved", found.moved_px.iter().flatten());
    let grids =
        found.panels.iter().map(|corners| Ok(Grid::even(Homography::through(lens, *corners)?, [2, 3])));
    let Some(grids) = taken(grids.collect::<vfold::Result<Vec<_>>>()) else { return };
    for facet in taken(measure(&photograph, &grids, 0.0)).iter().flatten() {
        assert_finite("facets", facet.mean.iter().chain(&facet.standard_error).flatten());
    }
}

/// Calibrates by a chart in a picture, in each order of its corners.
pub fn chart(bytes: &[u8]) {
    let mut drawn = Drawn::from(bytes);
    let photograph = picture(&mut drawn);
    let Some(lens) = lens(&photograph, &mut drawn) else { return };
    let corners = std::array::from_fn(|_| point(&photograph, &mut drawn));
    let size = [1 + drawn.below(4), 1 + drawn.below(6)];
    let expected: Vec<[f64; 3]> = (0..size[0] * size[1])
        .map(|_| std::array::from_fn(|_| drawn.one_of(&[1.0, 1.0, 1e-9, 1e9]) * drawn.coarse([0.01, 1.0])))
        .collect();
    for corners in corner_orders(corners) {
        let Some(measured) = taken(measure_patches(&photograph, "chart", corners, lens, size)) else {
            continue;
        };
        let patch = |(measured, expected): (&vfold::image::FacetMeasurement, &[f64; 3])| {
            Some(Patch {
                name: String::new(),
                measured: measured.mean.clone()?,
                standard_error: measured.standard_error.clone()?,
                expected: expected.to_vec(),
            })
        };
        let patches: Option<Vec<_>> = measured.iter().zip(&expected).map(patch).collect();
        let Some(patches) = patches else { continue };
        assert_finite(
            "patches",
            patches.iter().flat_map(|patch| patch.measured.iter().chain(&patch.standard_error)),
        );
        taken(Calibration::fit(&patches, drawn.below(3))).iter().for_each(assert_calibrates);
    }
}

fn assert_calibrates(calibration: &Calibration) {
    let exposure = [calibration.exposure(), calibration.exposure_sd()];
    assert!(exposure[0] > 0.0 && exposure[1] >= 0.0, "{exposure:?}");
    assert_finite("exposure", &exposure);
    let values = [-1.0, 0.0, 1e-3, 0.5, 1.0, 1e3].map(|light| calibration.value(0, light));
    assert_finite("values", &values);
}

/// Planes of light with a step between them, the same in tiles, and noise; of any size and brightness.
fn picture(drawn: &mut Drawn) -> Photograph {
    let [width, height] = [drawn.one_of(&[48, 64, 20, 7, 1, 130]), drawn.one_of(&[48, 40, 16, 5, 1])];
    let ending = drawn.one_of(&["exr", "png"]);
    let bright = drawn.one_of(&[1.0, 1.0, 1.2, 1e-30, 1e30]);
    let [a, b, c, kink, step] = std::array::from_fn(|_| drawn.coarse([-1.0, 1.0]));
    let noise = drawn.one_of(&[0.0, 1e-3, 0.1, 1.0]);
    let tile: [u8; 16] = std::array::from_fn(|_| drawn.byte());
    let light = |k: usize| {
        let (x, y) = ((k % width) as f64 / width as f64, (k / width) as f64 / height as f64);
        let side = a * x + b * y + c / 2.0;
        let rough = f64::from(tile[(k.wrapping_mul(2_654_435_761) >> 7) % tile.len()]) / 255.0;
        bright * (0.4 + kink * side.max(0.0) + if side > 0.0 { step } else { 0.0 } + noise * rough)
    };
    let rgb: Vec<f64> =
        (0..width * height).flat_map(|k| [light(k), 0.9 * light(k), 0.5 * light(k)]).collect();
    with_file(&format!("drawn.{ending}"), &[], |path| {
        write_linear(path, width, height, &rgb).unwrap();
        Photograph::open(path, &ReadOptions::default()).unwrap()
    })
}

fn lens(photograph: &Photograph, drawn: &mut Drawn) -> Option<Lens> {
    let bent = drawn.below(3) == 0;
    let k = [drawn.coarse([-0.5, 0.5]), drawn.coarse([-0.5, 0.5])];
    if bent { taken(Lens::new(k, photograph.width(), photograph.height())) } else { Some(Lens::STRAIGHT) }
}

/// A point in the picture or near it.
fn point(photograph: &Photograph, drawn: &mut Drawn) -> Point {
    let mut along = |length: usize| length as f64 * drawn.coarse([-0.1, 1.1]);
    Point::new(along(photograph.width()), along(photograph.height()))
}
