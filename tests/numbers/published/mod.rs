//! Numbers that others have published, or that others' programs compute from the same input: one source per
//! file, which names it.
//!
//! None is copied from what vfold prints. Reference values with 60 digits are in
//! `tests/numbers/reference_form_factors.rs`, random walks in `tests/numbers/shapes.rs`, other solvers'
//! estimates in `tests/tools/flat_sheets.rs`.

mod babelcolor;
mod cie15;
mod colour_science;
mod deeb;
mod dunkle;
mod hottel;
mod howell;
mod sharma;

use vfold::colorimetry::{Colorimeter, Observer};
use vfold::geometry::{FacetGrid, Fold};
use vfold::paper::form_factors;
use vfold::spectrum::{WavelengthGrid, illuminant};

/// Form factor from panel 0 to panel 1, whole panels.
fn between_panels(angle_deg: f64, width: f64, depths: [f64; 2]) -> f64 {
    let fold = Fold::new(angle_deg, width, depths[0], FacetGrid { rows: 1, cols: 1 }).unwrap();
    form_factors(&fold.with_panel1_depth(depths[1]).unwrap()).form_factor(0, 0, 0, 0)
}

/// A light and an observer on all wavelengths of the built-in illuminants.
fn meter(light: &str, observer: Observer) -> (WavelengthGrid, Colorimeter) {
    let grid = WavelengthGrid::uniform(380.0, 780.0, 5.0).unwrap();
    let meter = Colorimeter::new(&grid, &illuminant(light).unwrap(), observer).unwrap();
    (grid, meter)
}

fn chromaticity([x, y, z]: [f64; 3]) -> [f64; 2] {
    [x / (x + y + z), y / (x + y + z)]
}

fn assert_near(got: &[f64], want: &[f64], tolerance: f64, what: &str) {
    assert_eq!(got.len(), want.len(), "{what}");
    for (g, w) in got.iter().zip(want) {
        assert!((g - w).abs() < tolerance, "{what}: {got:?}, published {want:?}");
    }
}
