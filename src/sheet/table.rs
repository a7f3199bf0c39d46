//! Reflection of measured sheets, as a table over the directions.
//!
//! Fits of measured materials (A. Sztrajman et al., "Neural BRDF representation and importance sampling", Computer Graphics Forum 2021; the
//! measurements: J. Dupuy, W. Jakob, SIGGRAPH Asia 2018, and J. Nielsen et al., SIGGRAPH Asia 2015), sampled by `share/make-shapes.py`.

use std::sync::{Arc, LazyLock, OnceLock};

use half::f16;

use super::{Parts, Shape};
use crate::error::{Error, Result};

const NAMES: &str = include_str!("../../share/sheet-shapes.txt");
const TABLES: &[u8] = include_bytes!("../../share/sheet-shapes.npy");
/// Nodes of the angles of incidence and exit and of the azimuth between the directions.
const ANGLES: usize = 20;
const AZIMUTHS: usize = 16;
/// Last of the angles, degrees: what grazes more counts as this.
const STEEPEST_DEG: f64 = 86.0;
/// Body and surface.
const PARTS: usize = 2;

/// A place in the grid of a table.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// First number of the cell.
    first: u32,
    /// How far into the cell: angles of incidence and exit, azimuth.
    into: [f32; 3],
}

impl Place {
    pub(super) fn of(cos_in: f64, cos_out: f64, cos_between: f64) -> Self {
        let sines = ((1.0 - cos_in * cos_in) * (1.0 - cos_out * cos_out)).max(1e-24).sqrt();
        let cos_azimuth = ((cos_between - cos_in * cos_out) / sines).clamp(-1.0, 1.0);
        let [(light, a), (eye, b)] =
            [cos_in, cos_out].map(|cos| cell(cos.acos().to_degrees() / STEEPEST_DEG, &NODES.0));
        let (azimuth, c) = cell(cos_azimuth.acos().to_degrees() / 180.0, &NODES.1);
        let first = PARTS * ((light * ANGLES + eye) * AZIMUTHS + azimuth);
        Self { first: first as u32, into: [a, b, c] }
    }
}

/// Nodes of angles and azimuths as shares of their ranges: narrow towards grazing angles and the mirror's direction.
static NODES: LazyLock<([f64; ANGLES], [f64; AZIMUTHS])> = LazyLock::new(|| (nodes(), nodes()));

/// `1 − (1 − x)^1.5`, x even from 0 to 1.
fn nodes<const N: usize>() -> [f64; N] {
    std::array::from_fn(|k| 1.0 - (1.0 - k as f64 / (N - 1) as f64).powf(1.5))
}

/// The cell of a share of the range, and how far into it.
fn cell<const N: usize>(share: f64, nodes: &[f64; N]) -> (usize, f32) {
    let share = share.min(1.0);
    // of few nodes it is faster to compare all than to search
    let low = nodes[1..N - 1].iter().filter(|node| **node <= share).count();
    (low, ((share - nodes[low]) / (nodes[low + 1] - nodes[low])) as f32)
}

/// Body and surface of one material.
#[derive(Clone, Debug)]
pub(super) struct Table(Arc<[f32]>);

impl Table {
    /// The table whose angle of exit is nowhere beyond that of incidence, completed by reciprocity.
    fn of_half(half: &[f32]) -> Self {
        let row = PARTS * AZIMUTHS;
        let mut table = vec![0.0; ANGLES * ANGLES * row];
        let pairs = (0..ANGLES).flat_map(|a| (0..=a).map(move |b| (a, b)));
        for ((a, b), values) in pairs.zip(half.chunks_exact(row)) {
            for start in [(a * ANGLES + b) * row, (b * ANGLES + a) * row] {
                table[start..start + row].copy_from_slice(values);
            }
        }
        Self(table.into())
    }

    pub(super) fn at(&self, angles: &super::Angles) -> [f64; 2] {
        const STEPS: [usize; 2] = [PARTS * AZIMUTHS * ANGLES, PARTS * AZIMUTHS];
        let Place { first, into: [a, b, c] } = angles.place;
        let mut sums = [0.0_f32; PARTS];
        let corners =
            [(0, 0, (1.0 - a) * (1.0 - b)), (0, 1, (1.0 - a) * b), (1, 0, a * (1.0 - b)), (1, 1, a * b)];
        for (light, eye, weight) in corners {
            let start = first as usize + light * STEPS[0] + eye * STEPS[1];
            if let [body, surface, next_body, next_surface] = self.0[start..start + 2 * PARTS] {
                sums[0] += weight * (body + c * (next_body - body));
                sums[1] += weight * (surface + c * (next_surface - surface));
            }
        }
        sums.map(f64::from)
    }
}

/// Shapes of measured sheets: papers, felts, card, a leaf, cloth, flat paints; in the order of [`measured_names`].
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
