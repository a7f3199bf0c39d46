//! Which parts of a bent sheet a facet shows: facets divide the quadrilateral between the bottom of the
//! crease and an outer edge.

use nalgebra::{Matrix2, Vector2};

use super::section::Strip;

/// Rows that begin nearer to the crease than this, as a share of the depth, are divided where strips end.
const DIVIDED: f64 = 0.2;

/// A point that stands for part of a row of facets.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Row that it belongs to.
    pub row: usize,
    /// Share of the row's area in the picture.
    pub weight: f64,
    /// Strip of the panel.
    pub strip: usize,
    /// Where on the strip, from 0 to 1 outwards.
    pub share: f64,
}

/// Points of the rows that end at `edges` (shares of the depth from 0 to 1) on the strips of one panel, seen
/// from far away in the direction `view` (x, z).
///
/// The panel as clicked is the flat one from the first strip's near end to the last one's far end.
pub fn samples(strips: &[Strip], edges: &[f64], view: Vector2<f64>) -> Vec<Sample> {
    let (Some(first), Some(last)) = (strips.first(), strips.last()) else { return Vec::new() };
    let across =
        Matrix2::from_columns(&[last.far - first.near, view]).try_inverse().unwrap_or_else(Matrix2::identity);
    // Where the ends of strips appear, never nearer to the crease than what hides them.
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

/// The middle of `part` of a row.
fn sample(row: usize, edge: &[f64], part: &[f64], nodes: &[f64]) -> Sample {
    let middle = 0.5 * (part[0] + part[1]);
    let strip = nodes.partition_point(|node| *node <= middle).clamp(1, nodes.len() - 1) - 1;
    let share = (middle - nodes[strip]) / (nodes[strip + 1] - nodes[strip]);
    Sample { row, weight: (part[1] - part[0]) / (edge[1] - edge[0]), strip, share }
}
