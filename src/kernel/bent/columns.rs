//! Columns along the crease: what a point sees of the columns of a strip, with mirror images combined.

use super::Symmetry;
use super::view::SeenStrip;

/// Distances that differ by less than this fraction of the width count as equal.
const SAME: f64 = 1e-9;

/// Points along the crease and the columns that they see, symmetric about the middle.
pub struct Columns {
    /// The distinct distances along the crease, positive.
    distances: Vec<f64>,
    /// For every point and column edge: the index of its distance, and 1 or -1 for its side.
    edges: Vec<Vec<(usize, f64)>>,
    /// Number of columns in one half, including the middle one.
    half: usize,
}

impl Columns {
    /// `count` columns of equal width on `[-width/2, width/2]` seen from `places`.
    pub fn seen_from(places: &[f64], count: usize, width: f64) -> Self {
        let mut distances: Vec<f64> = Vec::new();
        let mut number = |offset: f64| {
            let known = distances.iter().position(|distance| (distance - offset.abs()).abs() < SAME * width);
            let number = known.unwrap_or_else(|| {
                distances.push(offset.abs());
                distances.len() - 1
            });
            (number, offset.signum())
        };
        let edge = |n: usize| (n as f64 / count as f64 - 0.5) * width;
        let mut edges = Vec::with_capacity(places.len());
        for place in places {
            edges.push((0..=count).map(|n| number(edge(n) - place)).collect());
        }
        Self { distances, edges, half: count.div_ceil(2) }
    }

    /// Adds `weight` times the shares of each point's light that land on the columns of `strip`: for light of
    /// each [`Symmetry`], point by column of one half.
    pub fn add_shares(&self, strip: &SeenStrip, weight: f64, shares: &mut [Vec<f64>; 2]) {
        let up_to: Vec<f64> = self.distances.iter().map(|y| weight * strip.up_to(*y)).collect();
        for (point, edges) in self.edges.iter().enumerate() {
            let last = edges.len() - 2;
            for (n, pair) in edges.windows(2).enumerate() {
                let [from, to] = [pair[0], pair[1]].map(|(number, side)| side * up_to[number]);
                let (place, is_mirrored) = (point * self.half + n.min(last - n), n > last - n);
                for (shares, symmetry) in shares.iter_mut().zip(Symmetry::BOTH) {
                    shares[place] += if is_mirrored { symmetry.sign() * (to - from) } else { to - from };
                }
            }
        }
    }
}
