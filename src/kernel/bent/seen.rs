//! The parts of a bent sheet visible in each facet: facets divide the quadrilateral between the bottom of the
//! crease and an outer edge.

use nalgebra::{Matrix2, Vector2};

use super::section::Strip;

/// Rows that begin closer to the crease than this fraction of the depth are divided at strip boundaries.
const DIVIDED: f64 = 0.2;

/// A point representing part of a row of facets.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Its row.
    pub row: usize,
    /// Its share of the row's area in the picture.
    pub weight: f64,
    /// Its strip of the panel.
    pub strip: usize,
    /// Position on the strip, from 0 to 1 outwards.
    pub share: f64,
}

/// Points of the rows between `edges` (fractions of the depth from 0 to 1) on the strips of one panel, seen
/// from far away in the direction `view` (x, z).
///
/// The panel as marked is the flat one from the first strip's near end to the last one's far end.
pub fn samples(strips: &[Strip], edges: &[f64], view: Vector2<f64>) -> Vec<Sample> {
    let (Some(first), Some(last)) = (strips.first(), strips.last()) else { return Vec::new() };
    let across =
        Matrix2::from_columns(&[last.far - first.near, view]).try_inverse().unwrap_or_else(Matrix2::identity);
    // Apparent positions of strip ends, never closer to the crease than strips that hide them.
    let mut nodes = vec![0.0_f64];
    for strip in strips {
        let appears = (across * (strip.far - first.near)).x;
        nodes.push(appears.clamp(nodes[nodes.len() - 1], 1.0));
    }
    let rows = edges.windows(2).enumerate();
    rows.flat_map(|(row, edge)| {
        let inside =
            nodes.iter().copied().filter(|node| edge[0] < DIVIDED && *node > edge[0] && *node < edge[1]);
        let ends: Vec<f64> = std::iter::once(edge[0]).chain(inside).chain([edge[1]]).collect();
        let parts: Vec<Sample> = ends.windows(2).map(|part| sample(row, edge, part, &nodes)).collect();
        parts
    })
    .collect()
}

/// The middle of one `part` of a row.
fn sample(row: usize, edge: &[f64], part: &[f64], nodes: &[f64]) -> Sample {
    let middle = 0.5 * (part[0] + part[1]);
    let strip = nodes.partition_point(|node| *node <= middle).clamp(1, nodes.len() - 1) - 1;
    let share = (middle - nodes[strip]) / (nodes[strip + 1] - nodes[strip]);
    Sample { row, weight: (part[1] - part[0]) / (edge[1] - edge[0]), strip, share }
}
