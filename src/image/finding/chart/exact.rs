//! Refines the positions of a chart's patches by their edges.

use nalgebra::Matrix3;

use super::super::light::median;
use super::super::outline::Place;
use super::colours::PATCHES;
use super::flat::{Flat, PER_CELL};
use super::placement::patch;
use super::plane_map::{projective, seen};

/// Search range for a patch's edge, in points from its centre, and half the length of edge that is averaged.
const EDGE: [usize; 2] = [PER_CELL / 4, PER_CELL / 2];
const ALONG: isize = PER_CELL as isize / 4;
/// Smallest step of light between points at an edge, all channels together, relative to the sum of the
/// patch's light and this fraction of white.
const LEAST_STEP: f64 = 0.03;
const DARK: f64 = 0.03;
/// Fewest patches whose edges determine the chart's position.
const FEWEST: usize = 10;
/// Patches further off than this many times the median are excluded.
const OUTLYING: f64 = 3.0;

/// The chart's position by the edges of its patches.
#[derive(Debug, Clone, Copy)]
pub(super) struct Exact {
    /// From columns and rows to the picture, in the form of the map from which the flat chart was made.
    pub to_picture: Matrix3<f64>,
    /// Half of a patch's side, in cells.
    pub half: f64,
}

/// The chart's position by the midpoints between opposite edges of its patches.
pub(super) fn exact(flat: &Flat, to_picture: &Matrix3<f64>) -> Option<Exact> {
    let white = flat.colours().iter().flatten().copied().fold(0.0, f64::max);
    let sides = |k: usize| {
        let [left, right, top, bottom] =
            [(-1, 0), (1, 0), (0, -1), (0, 1)].map(|way| edge(flat, k, way, white));
        Some((k, [left?, right?, top?, bottom?]))
    };
    let sides: Vec<(usize, [f64; 4])> = (0..PATCHES).filter_map(sides).collect();
    if sides.len() < FEWEST {
        return None;
    }
    let centres: Vec<(usize, Place)> = sides
        .iter()
        .map(|(k, [left, right, top, bottom])| (*k, patch(*k) + Place::new(right - left, bottom - top) / 2.0))
        .collect();
    let half = median(
        sides
            .iter()
            .flat_map(|(_, [left, right, top, bottom])| [(left + right) / 2.0, (top + bottom) / 2.0])
            .collect(),
    );
    let pairs = |centres: &[(usize, Place)]| {
        centres.iter().map(|(k, centre)| (patch(*k), seen(to_picture, *centre))).collect::<Vec<_>>()
    };
    let first = projective(&pairs(&centres))?;
    let to_cells = to_picture.try_inverse()?;
    let off = |(k, centre): &(usize, Place)| (seen(&to_cells, seen(&first, patch(*k))) - centre).norm();
    let bound = OUTLYING * median(centres.iter().map(off).collect());
    let near: Vec<_> = centres.iter().copied().filter(|centre| off(centre) <= bound).collect();
    Some(Exact { to_picture: projective(&pairs(&near)).unwrap_or(first), half })
}

/// Distance of a patch's edge from its centre, in cells, in one of the four directions.
fn edge(flat: &Flat, k: usize, (right, down): (isize, isize), white: f64) -> Option<f64> {
    let light = |out: usize| {
        // point 0 lies half a point beyond the centre; leftwards and upwards, points count from -1
        let out = out as isize;
        let place = |way: isize| if way < 0 { -1 - out } else { out };
        let points = (-ALONG..ALONG).map(|along| match right {
            0 => flat.offset(k, along, place(down)),
            _ => flat.offset(k, place(right), along),
        });
        let sum = points.fold([0.0; 3], |sum, point| [0, 1, 2].map(|n| sum[n] + point[n]));
        sum.map(|sum| sum / (2.0 * ALONG as f64))
    };
    let profile: Vec<[f64; 3]> = (EDGE[0] - 1..=EDGE[1] + 1).map(light).collect();
    let own = profile[0].iter().copied().fold(0.0, f64::max) + DARK * white;
    let step =
        |pair: &[[f64; 3]]| (0..3).map(|n| (pair[1][n] - pair[0][n]).powi(2)).sum::<f64>().sqrt() / own;
    let steps: Vec<f64> = profile.windows(2).map(step).collect();
    let inner = &steps[1..steps.len() - 1];
    let (at, most) = inner.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1))?;
    let [before, after] = [steps[at], steps[at + 2]];
    let bend = before - 2.0 * most + after;
    if *most < LEAST_STEP || before > *most || after > *most || bend >= 0.0 {
        return None;
    }
    let offset = 0.5 * (before - after) / bend;
    // the step from one point's middle to the next
    Some(((EDGE[0] + at) as f64 + 1.0 + offset) / PER_CELL as f64)
}
