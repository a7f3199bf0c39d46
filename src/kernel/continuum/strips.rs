//! One direction of a panel: Legendre polynomials on strips.

use nalgebra::DMatrix;

use crate::kernel::quadrature::{Rule, legendre_series};
use crate::solve::dot;

/// Consecutive strips, each with the same number of polynomials: together an orthonormal basis.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Strips {
    pub(super) ends: Vec<[f64; 2]>,
    pub(super) order: usize,
}

impl Strips {
    /// Strips between consecutive `edges`.
    pub(super) fn new(edges: &[f64], order: usize) -> Self {
        Self { ends: edges.windows(2).map(|ends| [ends[0], ends[1]]).collect(), order }
    }

    /// Number of functions.
    pub(super) fn len(&self) -> usize {
        self.ends.len() * self.order
    }

    /// Means of the functions over intervals: interval by function, ordered by degree and strip, the latter
    /// varying fastest.
    pub(super) fn means(&self, intervals: &[[f64; 2]]) -> DMatrix<f64> {
        let strips = self.ends.len();
        let mut means = DMatrix::zeros(intervals.len(), self.order * strips);
        let rule = Rule::gauss_legendre(self.order.div_ceil(2));
        for (interval, [low, high]) in intervals.iter().enumerate() {
            for (n, strip) in self.ends.iter().enumerate() {
                let (from, to) = (strip[0].max(*low), strip[1].min(*high));
                if from >= to {
                    continue;
                }
                let (points, weights): (Vec<f64>, Vec<f64>) = rule.on(from, to).unzip();
                for (b, values) in polynomials(*strip, &points, self.order).column_iter().enumerate() {
                    means[(interval, b * strips + n)] = dot(values.as_slice(), &weights) / (high - low);
                }
            }
        }
        means
    }
}

/// Normalised Legendre polynomials of a strip at these points: point by degree, up to `order` degrees.
pub(super) fn polynomials(strip: [f64; 2], points: &[f64], order: usize) -> DMatrix<f64> {
    let length = strip[1] - strip[0];
    let places: Vec<_> = points.iter().map(|x| (2.0 * x - strip[0] - strip[1]) / length).collect();
    let mut values = DMatrix::zeros(points.len(), order);
    legendre_series(&places, values.as_mut_slice());
    for (b, mut values) in values.column_iter_mut().enumerate() {
        values *= ((2 * b + 1) as f64 / length).sqrt();
    }
    values
}

/// Edges of strips from `low` to `high`. The first and last strips are at most this wide, and the distance of
/// an edge from the end it is graded to is at most `growth` times that of the edge before.
pub(super) fn graded(low: f64, high: f64, first: f64, last: f64, growth: f64) -> Vec<f64> {
    let middle = match (first < high - low, last < high - low) {
        (_, false) => high,
        (false, true) => low,
        // A strip may grow with its distance from the end it is graded to: both gradings meet in the middle.
        (true, true) => 0.5 * (low + high),
    };
    let from = |end: f64, towards: f64, narrowest: f64| {
        let length = (towards - end).abs();
        // Rounding must not add a step to a whole number of them.
        let steps = ((length / narrowest).ln() / growth.ln() - 1e-9).ceil().max(0.0);
        let ratio = if steps > 0.0 { (length / narrowest).powf(steps.recip()) } else { 1.0 };
        (0..=steps as usize).map(move |k| end + (towards - end) * ratio.powf(k as f64 - steps))
    };
    let mut edges = vec![low];
    if middle > low {
        edges.extend(from(low, middle, first));
    }
    if middle < high {
        let falling: Vec<f64> = from(high, middle, last).collect();
        edges.extend(falling.into_iter().rev().skip(1));
        edges.push(high);
    }
    edges
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_are_graded_to_both_ends() {
        for (first, last) in [(1e-4, 0.02), (0.1, 5.0), (5.0, 0.1), (5.0, 5.0)] {
            let edges = graded(0.0, 1.0, first, last, 4.0);
            assert_eq!((edges[0], edges[edges.len() - 1]), (0.0, 1.0), "{edges:?}");
            assert!(edges.windows(2).all(|ends| ends[1] > ends[0]), "{edges:?}");
            assert!(edges[1] <= first * (1.0 + 1e-9));
            assert!(1.0 - edges[edges.len() - 2] <= last * (1.0 + 1e-9));
        }
    }
}
