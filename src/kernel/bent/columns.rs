//! Columns along the crease: what a point sees of the columns of a strip, with mirror images combined.

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
    /// Light of a column's mirror image relative to its own.
    image: f64,
}

impl Columns {
    /// `count` columns of equal width on `[-width/2, width/2]` seen from `places`, in light whose mirror
    /// image about the middle is `image` times itself.
    pub fn seen_from(places: &[f64], count: usize, width: f64, image: f64) -> Self {
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
        Self { distances, edges, half: count.div_ceil(2), image }
    }

    /// Adds `weight` times the shares of each point's light that land on the columns of `strip`: point by
    /// column of one half.
    pub fn add_shares(&self, strip: &SeenStrip, weight: f64, shares: &mut [f64]) {
        let up_to: Vec<f64> = self.distances.iter().map(|y| weight * strip.up_to(*y)).collect();
        for (edges, shares) in self.edges.iter().zip(shares.chunks_exact_mut(self.half)) {
            let last = edges.len() - 2;
            for (n, pair) in edges.windows(2).enumerate() {
                let [from, to] = [pair[0], pair[1]].map(|(number, side)| side * up_to[number]);
                shares[n.min(last - n)] += if n <= last - n { to - from } else { self.image * (to - from) };
            }
        }
    }
}
