//! Polynomial interpolation in a box: each basis function is one at one of its nodes and zero at all others.

use std::f64::consts::PI;

use super::cuboid::Cuboid;
use crate::geometry::Vec3;
use crate::kernel::quadrature::Lagrange;

/// Least distance of the sources of an interpolated function, in halves of the largest extent of its box.
pub(super) const GAP: f64 = 1.5;

/// Chebyshev nodes of a box, in rows along its axes.
#[derive(Clone, Debug)]
pub(super) struct Grid {
    axes: [Vec3; 3],
    lines: [Line; 3],
    pub(super) nodes: Vec<Vec3>,
}

/// The nodes along an axis.
#[derive(Clone, Debug)]
struct Line {
    middle: f64,
    half: f64,
    nodes: Vec<f64>,
    through: Lagrange,
}

/// Number of nodes of a box along each axis, for functions with no singularity nearer than [`GAP`], to
/// `tolerance`.
///
/// Trefethen, *Approximation Theory and Approximation Practice*, theorem 8.2.
pub(super) fn orders(cuboid: &Cuboid, tolerance: f64) -> [usize; 3] {
    let gap = GAP * cuboid.reach();
    cuboid.halves().map(|half| (-tolerance.ln() / (gap / half).asinh()) as usize + 1)
}

impl Grid {
    pub(super) fn new(cuboid: &Cuboid, tolerance: f64) -> Self {
        let (spans, orders) = (cuboid.spans, orders(cuboid, tolerance));
        let lines = [0, 1, 2].map(|axis| Line::new(spans[axis], orders[axis]));
        let [x, y, z] = [0, 1, 2].map(|axis| {
            let place = |t: &f64| (lines[axis].middle + lines[axis].half * t) * cuboid.axes[axis];
            lines[axis].nodes.iter().map(place).collect::<Vec<Vec3>>()
        });
        let rows = x.iter().flat_map(|x| y.iter().map(move |y| x + y));
        let nodes = rows.flat_map(|xy| z.iter().map(move |z| xy + z)).collect();
        Self { axes: cuboid.axes, lines, nodes }
    }

    /// Weights of the nodes at a point.
    pub(super) fn weights(&self, point: &Vec3) -> Vec<f64> {
        let [x, y, z] = [0, 1, 2].map(|axis| self.lines[axis].weights(point.dot(&self.axes[axis])));
        let rows = x.iter().flat_map(|x| y.iter().map(move |y| x * y));
        rows.flat_map(|xy| z.iter().map(move |z| xy * z)).collect()
    }

    /// Most nodes along an axis.
    pub(super) fn order(&self) -> usize {
        self.lines.iter().map(|line| line.nodes.len()).max().unwrap_or(0)
    }
}

impl Line {
    fn new([low, high]: [f64; 2], order: usize) -> Self {
        let nodes: Vec<f64> = (0..order).map(|k| (PI * (k as f64 + 0.5) / order as f64).cos()).collect();
        Self { middle: 0.5 * (low + high), half: 0.5 * (high - low), through: Lagrange::new(&nodes), nodes }
    }

    fn weights(&self, place: f64) -> Vec<f64> {
        let mut weights = vec![1.0; self.nodes.len()];
        if weights.len() > 1 {
            self.through.at((place - self.middle) / self.half, &mut weights);
        }
        weights
    }
}
