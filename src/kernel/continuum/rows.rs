//! Across a panel: a Nyström rule in the logarithm of the distance from the crease.

use std::f64::consts::PI;

use nalgebra::DMatrix;

use super::Resolution;
use crate::geometry::Fold;
use crate::kernel::quadrature::{Lagrange, Rule};

/// Nodes across a panel, from the crease outwards; the first stands for the strip next to the crease.
pub(super) struct Rows {
    angle: Angle,
    /// Ends of the rule's panels in ln s, from the crease strip to the outer edge at 0.
    ends: Vec<f64>,
    rule: Rule,
    distance: Vec<f64>,
    weight: Vec<f64>,
}

/// Trigonometry of the opening angle, in forms that keep their digits.
#[derive(Clone, Copy)]
struct Angle {
    sin: f64,
    cos: f64,
    half_sin: f64,
}

impl Angle {
    /// Squared distance across the crease.
    fn q2(self, s: f64, t: f64) -> f64 {
        (s - t).powi(2) + 4.0 * s * t * self.half_sin * self.half_sin
    }

    /// The kernel of an endlessly long fold: eq. (2) over π, integrated along the crease.
    fn long_kernel(self, s: f64, t: f64) -> f64 {
        self.sin * self.sin * s * t / (2.0 * self.q2(s, t).powf(1.5))
    }

    /// `∫₀^end` of [`Angle::long_kernel`] over t.
    fn long_share(self, s: f64, end: f64) -> f64 {
        0.5 * (1.0 + (end * self.cos - s) / self.q2(s, end).sqrt())
    }

    /// Share that a strip along the crease of an endlessly long fold hands to its twin (Hottel's crossed strings).
    fn crease_share(self) -> f64 {
        1.0 - self.half_sin
    }
}

impl Rows {
    pub(super) fn new(fold: &Fold, resolution: &Resolution) -> Self {
        let theta = fold.angle_rad();
        let angle = Angle { sin: theta.sin(), cos: theta.cos(), half_sin: (theta / 2.0).sin() };
        let start = (resolution.crease_strip * (fold.width() / fold.depths()[0]).min(1.0)).ln();
        let ends = graded_ends(start, resolution.row_panel, theta);
        let rule = Rule::gauss_legendre(resolution.row_order);
        let strip = start.exp();
        let (mut distance, mut weight) = (vec![0.5 * strip], vec![strip]);
        for (u, w) in ends.windows(2).flat_map(|ends| rule.on(ends[0], ends[1])) {
            distance.push(u.exp());
            weight.push(w * u.exp());
        }
        Self { angle, ends, rule, distance, weight }
    }

    pub(super) fn len(&self) -> usize {
        self.distance.len()
    }

    /// Coordinates of the function 1.
    pub(super) fn uniform(&self) -> impl Iterator<Item = f64> + '_ {
        self.weight.iter().map(|w| w.sqrt())
    }

    /// Squared distance across the crease between nodes `i` and `j`.
    pub(super) fn q2(&self, i: usize, j: usize) -> f64 {
        self.angle.q2(self.distance[i], self.distance[j])
    }

    /// Least and largest distance between nodes of the two panels.
    pub(super) fn distances(&self) -> (f64, f64) {
        let pairs = (0..self.len()).flat_map(|i| (i..self.len()).map(move |j| self.q2(i, j)));
        let (least, largest) = pairs.fold((f64::INFINITY, 0.0_f64), |(a, b), q2| (a.min(q2), b.max(q2)));
        (least.sqrt(), largest.sqrt())
    }

    /// Factor of the correlation integral for nodes `i` and `j`.
    pub(super) fn factor(&self, i: usize, j: usize) -> f64 {
        let (s, t) = (self.distance[i], self.distance[j]);
        self.angle.sin * self.angle.sin * s * t / PI * (self.weight[i] * self.weight[j]).sqrt()
    }

    /// What the rule misses of an endlessly long fold's exchange: entries with the crease strip, and the diagonal.
    pub(super) fn missed(&self) -> (Vec<f64>, Vec<f64>) {
        let strip = self.weight[0];
        let found =
            |i: usize, j: usize| self.angle.long_kernel(self.distance[i], self.distance[j]) * self.weight[j];
        let with_strip = |i: usize| self.angle.long_share(self.distance[i], strip);
        let strip_missed = (0..self.len())
            .map(|i| match i {
                0 => self.angle.crease_share() - found(0, 0),
                _ => (with_strip(i) - found(i, 0)) * (self.weight[i] / strip).sqrt(),
            })
            .collect();
        let diagonal = (0..self.len())
            .map(|i| match i {
                0 => 0.0,
                _ => {
                    let rest: f64 = (1..self.len()).map(|j| found(i, j)).sum();
                    self.angle.long_share(self.distance[i], 1.0) - with_strip(i) - rest
                }
            })
            .collect();
        (strip_missed, diagonal)
    }

    /// Means over `count` facet rows of the function through the nodes: facet row by node.
    pub(super) fn means(&self, count: usize) -> DMatrix<f64> {
        let order = self.rule.nodes.len();
        let fine = Rule::gauss_legendre(order + 4);
        let lagrange = Lagrange::new(&self.rule.nodes);
        let mut pool = DMatrix::zeros(count, self.len());
        for row in 0..count {
            let (low, high) = (row as f64 / count as f64, (row + 1) as f64 / count as f64);
            let overlap = (high.min(self.weight[0]) - low).max(0.0);
            pool[(row, 0)] = overlap / self.weight[0].sqrt();
            for (panel, ends) in self.ends.windows(2).enumerate() {
                let (from, to) = (ends[0].max(low.ln()), ends[1].min(high.ln()));
                if from >= to {
                    continue;
                }
                for (u, w) in fine.on(from, to) {
                    let local = (2.0 * u - ends[0] - ends[1]) / (ends[1] - ends[0]);
                    for (k, value) in lagrange.at(local).into_iter().enumerate() {
                        let node = 1 + panel * order + k;
                        pool[(row, node)] += value * w * u.exp() / self.weight[node].sqrt();
                    }
                }
            }
        }
        pool * count as f64
    }
}

/// Ends of panels from `start` (a logarithm) to 0. Near the outer edge, where light leaves, radiosity varies over θ times
/// the depth: panels shrink to that towards it.
fn graded_ends(start: f64, longest: f64, theta: f64) -> Vec<f64> {
    let mut ends = vec![0.0];
    let mut length = longest.min(2.2 * theta);
    let mut end = 0.0;
    while end - length > start + 0.3 * length {
        end -= length;
        ends.push(end);
        length = longest.min(2.0 * length);
    }
    ends.push(start);
    ends.reverse();
    ends
}
