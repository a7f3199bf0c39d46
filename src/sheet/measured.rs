//! The built-in measured sheets.

use std::sync::OnceLock;

use half::f16;

use super::place::{ANGLES, AZIMUTHS, PARTS};
use super::table::Table;
use super::{Parts, Shape};
use crate::error::{Error, Result};

const NAMES: &str = include_str!("../../share/sheet-shapes.txt");
const TABLES: &[u8] = include_bytes!("../../share/sheet-shapes.npy");

/// Shapes of measured sheets (papers, felts, card, a leaf, cloth, flat paints), in the order of
/// [`measured_names`].
///
/// # Errors
/// Only if the embedded table is damaged.
pub fn measured() -> Result<&'static [Shape]> {
    static SHAPES: OnceLock<Vec<Shape>> = OnceLock::new();
    if let Some(shapes) = SHAPES.get() {
        return Ok(shapes);
    }
    let numbers: Vec<f16> = npyz::NpyFile::new(TABLES)
        .and_then(npyz::NpyFile::into_vec)
        .map_err(|e| Error::file("share/sheet-shapes.npy", e))?;
    let numbers: Vec<f32> = numbers.into_iter().map(f32::from).collect();
    let halves = numbers.chunks_exact(ANGLES * (ANGLES + 1) / 2 * AZIMUTHS * PARTS);
    let shapes = halves.map(|half| Shape::of(Parts::Table(Table::of_half(half)))).collect();
    Ok(SHAPES.get_or_init(|| shapes))
}

/// Names of the measured sheets.
///
/// # Example
/// ```
/// use vfold::sheet::{measured, measured_names};
/// assert_eq!(measured()?.len(), measured_names().count());
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn measured_names() -> impl Iterator<Item = &'static str> {
    NAMES.lines()
}
