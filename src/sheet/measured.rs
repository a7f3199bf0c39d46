//! The built-in measured sheets.

use std::io;
use std::sync::OnceLock;

use half::f16;

use super::place::{ANGLES, AZIMUTHS, PARTS};
use super::table::Table;
use super::{Parts, Shape};
use crate::error::{Error, Result};

const NAMES: &str = "share/sheet-shapes.txt";
const SHEETS: &str = include_str!("../../share/sheet-shapes.txt");
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
    let shape = |(half, (_, levelling)): (&[f32], (_, &str))| -> Result<Shape> {
        let levelling = levelling.parse().map_err(|e| Error::file(NAMES, io::Error::other(e)))?;
        Ok(Shape::of(Parts::Table(Table::of_half(half)), levelling))
    };
    let shapes = halves.zip(sheets()).map(shape).collect::<Result<_>>()?;
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
    sheets().map(|(name, _)| name)
}

/// The name of each sheet, and by how much light scattered often levels its body.
fn sheets() -> impl Iterator<Item = (&'static str, &'static str)> {
    SHEETS.lines().map(|line| line.split_once(' ').unwrap_or((line, "")))
}
