//! Decides which nodes of a lattice are the patches of a chart, and which is the first.

use std::collections::BTreeMap;

use super::super::outline::Place;
use super::super::plane::Plane;
use super::colours::{COLUMNS, Colours, Departure, PATCHES, ROWS, departure};
use super::lattice::{Lattice, Node};
use super::plane_map::{projective, seen};
use nalgebra::Matrix3;

/// Fewest blobs on the patches of a chart, and least fraction of the lattice's blobs on them.
const FEWEST: usize = 10;
const LEAST_PART: f64 = 0.6;
/// Most nodes by which a chart may begin beyond the lattice's blobs.
const BEYOND: i32 = 2;
/// Half of the part of a cell whose light is sampled, and the number of samples in each direction.
const MIDDLE: f64 = 0.22;
const PLACES: usize = 5;
/// Colours with a larger departure belong to something else.
const MOST_OFF: f64 = 0.4;

/// A chart on a lattice.
#[derive(Debug, Clone, Copy)]
pub(super) struct Placement {
    /// From columns and rows of the chart, the first patch's centre being (0, 0), to the picture, px.
    pub to_picture: Matrix3<f64>,
    pub departure: Departure,
    /// Number of patches that are blobs.
    pub blobs: usize,
}

/// The lattice node of a chart's patch, in each of the four turns, up to a translation.
fn turned(k: usize, turn: usize) -> Node {
    let (column, row) = ((k % COLUMNS) as i32, (k / COLUMNS) as i32);
    let (last_column, last_row) = (COLUMNS as i32 - 1, ROWS as i32 - 1);
    match turn {
        0 => [column, row],
        1 => [last_row - row, column],
        2 => [last_column - column, last_row - row],
        _ => [row, last_column - column],
    }
}

/// The placement of a chart on a lattice with the best match of colours.
pub(super) fn placed(lattice: &Lattice, light: &[Plane; 3]) -> Option<Placement> {
    let span = |n: usize| {
        let all = lattice.nodes.keys().map(|node| node[n]);
        (all.clone().min().unwrap_or(0), all.max().unwrap_or(0))
    };
    let (columns, rows) = (span(0), span(1));
    let mut known: BTreeMap<Node, Option<[f64; 3]>> = BTreeMap::new();
    let mut best: Option<Placement> = None;
    for turn in 0..4 {
        let nodes: [Node; PATCHES] = std::array::from_fn(|k| turned(k, turn));
        let [width, height] = if turn % 2 == 0 { [COLUMNS, ROWS] } else { [ROWS, COLUMNS] }.map(|n| n as i32);
        for x in columns.0 - BEYOND..=columns.1 + BEYOND - width + 1 {
            for y in rows.0 - BEYOND..=rows.1 + BEYOND - height + 1 {
                let nodes = nodes.map(|[i, j]| [i + x, j + y]);
                let blobs = nodes.iter().filter(|node| lattice.nodes.contains_key(*node)).count();
                if blobs < FEWEST || (blobs as f64) < LEAST_PART * lattice.nodes.len() as f64 {
                    continue;
                }
                let mut colour =
                    |node: Node| *known.entry(node).or_insert_with(|| at_node(lattice, node, light));
                let colours: Option<Vec<[f64; 3]>> = nodes.iter().map(|node| colour(*node)).collect();
                let Some(departure) = colours.and_then(|all| departure(&Colours::try_from(all).ok()?)) else {
                    continue;
                };
                if departure.rms < best.map_or(MOST_OFF, |best| best.departure.rms) {
                    let to_picture = on_chart(lattice, &nodes);
                    best = to_picture.map(|to_picture| Placement { to_picture, departure, blobs }).or(best);
                }
            }
        }
    }
    best
}

/// The map of a chart whose patches are on these nodes.
fn on_chart(lattice: &Lattice, nodes: &[Node; PATCHES]) -> Option<Matrix3<f64>> {
    let pair = |(k, node): (usize, &Node)| (patch(k), seen(&lattice.to_picture, place(*node)));
    projective(&nodes.iter().enumerate().map(pair).collect::<Vec<_>>())
}

fn place([i, j]: Node) -> Place {
    Place::new(f64::from(i), f64::from(j))
}

/// Column and row of a patch.
pub(super) fn patch(k: usize) -> Place {
    Place::new((k % COLUMNS) as f64, (k / COLUMNS) as f64)
}

/// The mean light around a node; none if it is outside the picture.
fn at_node(lattice: &Lattice, node: Node, light: &[Plane; 3]) -> Option<[f64; 3]> {
    let width = light[0].width;
    let height = light[0].values.len() / width;
    let offset = |n: usize| MIDDLE * (2.0 * n as f64 / (PLACES - 1) as f64 - 1.0);
    let mut sum = [0.0; 3];
    for n in 0..PLACES * PLACES {
        let p = seen(&lattice.to_picture, place(node) + Place::new(offset(n % PLACES), offset(n / PLACES)));
        let is_inside = p.x >= 0.0 && p.y >= 0.0 && p.x < width as f64 && p.y < height as f64;
        let k = is_inside.then(|| p.y as usize * width + p.x as usize)?;
        sum.iter_mut().zip(light).for_each(|(sum, light)| *sum += f64::from(light.values[k]));
    }
    Some(sum.map(|sum| sum / (PLACES * PLACES) as f64))
}
