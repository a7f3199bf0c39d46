//! Columns along the crease: what a place sees of a strip's columns, those that are mirror images of each
//! other taken together.

use super::view::SeenStrip;

/// Distances that differ by less than this part of the width are the same.
const SAME: f64 = 1e-9;

/// Places along the crease and the columns that they look at, symmetric about the middle.
pub struct Columns {
    /// Distances along the crease that occur, positive and each once.
    distances: Vec<f64>,
    /// For every place and every edge of a column: the number of its distance, and 1 or -1 for the side it
    /// lies on.
    edges: Vec<Vec<(usize, f64)>>,
    /// Columns of one half, the middle one included.
    half: usize,
    /// What a column's mirror image shines relative to it.
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

    /// Adds `weight` times the shares of each place's light that land on the columns of `strip`, place by
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
