//! Position of two directions in the grid of a table.

use std::sync::LazyLock;

/// Grid nodes in the angles of incidence and exit, and in the azimuth between the directions.
pub(super) const ANGLES: usize = 20;
pub(super) const AZIMUTHS: usize = 16;
/// Largest angle, degrees; more grazing directions are clamped to it.
pub(super) const STEEPEST_DEG: f64 = 86.0;
/// Body and surface.
pub(super) const PARTS: usize = 2;

/// A position in the grid of a table.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// Index of the first number of the cell.
    pub(super) first: u32,
    /// Weights of the corners of the cell: those of its own angles of incidence and exit, of the next angle
    /// of exit, of the next angle of incidence, and of both.
    pub(super) corners: [f32; 4],
    /// Position between its azimuth and the next.
    pub(super) azimuth: f32,
}

impl Place {
    pub(super) fn of(cos_in: f64, cos_out: f64, cos_between: f64) -> Self {
        let sines = ((1.0 - cos_in * cos_in) * (1.0 - cos_out * cos_out)).max(1e-24).sqrt();
        let cos_azimuth = ((cos_between - cos_in * cos_out) / sines).clamp(-1.0, 1.0);
        let [(light, a), (eye, b)] =
            [cos_in, cos_out].map(|cos| cell(cos.acos().to_degrees() / STEEPEST_DEG, &NODES.0));
        let (azimuth, c) = cell(cos_azimuth.acos().to_degrees() / 180.0, &NODES.1);
        let first = PARTS * ((light * ANGLES + eye) * AZIMUTHS + azimuth);
        let corners = [(1.0 - a) * (1.0 - b), (1.0 - a) * b, a * (1.0 - b), a * b];
        Self { first: first as u32, corners, azimuth: c }
    }
}

/// Nodes of angles and azimuths as fractions of their ranges, denser towards grazing angles and the mirror
/// direction.
static NODES: LazyLock<([f64; ANGLES], [f64; AZIMUTHS])> = LazyLock::new(|| (nodes(), nodes()));

/// `1 − (1 − x)^1.5` with x evenly spaced from 0 to 1.
fn nodes<const N: usize>() -> [f64; N] {
    std::array::from_fn(|k| 1.0 - (1.0 - k as f64 / (N - 1) as f64).powf(1.5))
}

/// The cell that contains a fraction of the range, and the position within it.
fn cell<const N: usize>(share: f64, nodes: &[f64; N]) -> (usize, f32) {
    let share = share.min(1.0);
    // with so few nodes, comparing all is faster than searching
    let low = nodes[1..N - 1].iter().filter(|node| **node <= share).count();
    (low, ((share - nodes[low]) / (nodes[low + 1] - nodes[low])) as f32)
}
