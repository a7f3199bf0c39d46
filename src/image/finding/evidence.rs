//! Evidence of each pixel for steps and ridges of light in any direction.
//!
//! Steps are the structure tensor of all channels together (S. Di Zenzo, *A note on the gradient of a
//! multi-image*, 1986), bright ridges the second derivatives of their sum: a crease between panels that look
//! alike is a ridge and no step.

use rayon::prelude::*;

use super::outline::Place;
use super::plane::Plane;

/// Strengths of a step and of a ridge that score one half, in square roots of light per pixel.
const HALF_STEP: f64 = 0.006;
const HALF_RIDGE: f64 = 0.004;
/// Fraction of a side omitted at either end: other sides begin there.
const END: f64 = 0.05;
/// Pieces of a side, each of which needs an edge.
const PIECES: usize = 6;

/// A symmetric tensor: xx, yy and xy, and a zero that fills a vector of the processor.
#[derive(Debug, Clone, Copy)]
struct Tensor([f32; 4]);

/// Tensors of every pixel.
pub(super) struct Evidence {
    pub width: usize,
    pub height: usize,
    steps: Vec<Tensor>,
    fine: Vec<Tensor>,
    coarse: Vec<Tensor>,
}

/// The four pixels around a place: the number of the first, and the weights of all.
#[derive(Clone, Copy)]
struct Around {
    first: usize,
    weights: [f32; 4],
}

/// How well an edge lies along a side, each from 0 to 1.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Support {
    /// As a step, and as a ridge.
    pub step: f64,
    pub ridge: f64,
    /// Of the piece with the weakest edge, step or ridge.
    pub weakest: f64,
}

/// The structure tensor of planes blurred by `sigma_px`: xx, yy and xy.
pub(super) fn steps(channels: &[Plane; 3], sigma_px: f32) -> [Plane; 3] {
    // Scharr's operator
    let (slope, smooth) = ([-1.0, 0.0, 1.0], [3.0 / 32.0, 10.0 / 32.0, 3.0 / 32.0]);
    let slopes = channels.each_ref().map(|plane| {
        let blurred = plane.blurred(sigma_px);
        [blurred.filtered(&slope, &smooth), blurred.filtered(&smooth, &slope)]
    });
    let sum = |a: usize, b: usize| Plane {
        width: channels[0].width,
        values: (0..channels[0].values.len())
            .into_par_iter()
            .map(|k| slopes.iter().map(|slopes| slopes[a].values[k] * slopes[b].values[k]).sum())
            .collect(),
    };
    [sum(0, 0), sum(1, 1), sum(0, 1)]
}

/// Second derivatives of a plane blurred by `sigma_px`, times `sigma_px`: xx, yy and xy.
pub(super) fn curvatures(plane: &Plane, sigma_px: f32) -> [Plane; 3] {
    let blurred = plane.blurred(sigma_px);
    let curve = [sigma_px, -2.0 * sigma_px, sigma_px];
    let (smooth, slope) = ([0.25, 0.5, 0.25], [-0.5, 0.0, 0.5]);
    let scaled = slope.map(|weight: f32| weight * sigma_px);
    [blurred.filtered(&curve, &smooth), blurred.filtered(&smooth, &curve), blurred.filtered(&scaled, &slope)]
}

impl Tensor {
    /// Its value along a unit vector.
    #[inline(always)]
    fn along(&self, way: Place) -> f32 {
        let Self([xx, yy, xy, _]) = self;
        let (x, y) = (way.x as f32, way.y as f32);
        x * x * xx + y * y * yy + 2.0 * x * y * xy
    }
}

impl Evidence {
    pub fn new(steps: &[Plane; 3], fine: &[Plane; 3], coarse: &[Plane; 3]) -> Self {
        let width = steps[0].width;
        let tensors = |[xx, yy, xy]: &[Plane; 3]| -> Vec<Tensor> {
            let pixel = |k: usize| Tensor([xx.values[k], yy.values[k], xy.values[k], 0.0]);
            (0..xx.values.len()).into_par_iter().map(pixel).collect()
        };
        let [steps, fine, coarse] = [steps, fine, coarse].map(tensors);
        Self { width, height: steps.len() / width, steps, fine, coarse }
    }

    /// Strength of a step and of a ridge at a place, across the unit vector `across`; none outside the
    /// picture.
    #[inline]
    pub fn at(&self, place: Place, across: Place) -> Option<(f64, f64)> {
        let around = self.around(place)?;
        let step = self.between(&self.steps, around).along(across);
        let ridge = -self.between(&self.fine, around).along(across);
        Some((f64::from(step.max(0.0).sqrt()), f64::from(ridge.max(0.0))))
    }

    /// Strength of a step alone.
    #[inline]
    pub fn step_at(&self, place: Place, across: Place) -> Option<f64> {
        let step = self.between(&self.steps, self.around(place)?).along(across);
        Some(f64::from(step.max(0.0).sqrt()))
    }

    #[inline(always)] // of the innermost loop
    fn around(&self, place: Place) -> Option<Around> {
        let (x, y) = ((place.x - 0.5) as f32, (place.y - 0.5) as f32);
        if !(x >= 0.0 && y >= 0.0) {
            return None;
        }
        let (i, j) = (x as usize, y as usize);
        if i + 1 >= self.width || j + 1 >= self.height {
            return None;
        }
        let (right, down) = (x - i as f32, y - j as f32);
        let weights =
            [(1.0 - right) * (1.0 - down), right * (1.0 - down), (1.0 - right) * down, right * down];
        Some(Around { first: j * self.width + i, weights })
    }

    #[inline(always)]
    fn between(&self, tensors: &[Tensor], Around { first, weights }: Around) -> Tensor {
        let above = &tensors[first..][..2];
        let below = &tensors[first + self.width..][..2];
        let mut mean = [0.0; 4];
        for (n, mean) in mean.iter_mut().enumerate() {
            *mean = weights[0] * above[0].0[n]
                + weights[1] * above[1].0[n]
                + weights[2] * below[0].0[n]
                + weights[3] * below[1].0[n];
        }
        Tensor(mean)
    }

    /// Strength of a step and downward curvature of light across the unit vector `across`, at coarse scale,
    /// in the pixel at a place.
    pub fn coarse_at(&self, place: Place, across: Place) -> Option<(f64, f64)> {
        let inside = place.x >= 0.0 && place.y >= 0.0;
        let (x, y) = (place.x as usize, place.y as usize);
        if !inside || x >= self.width || y >= self.height {
            return None;
        }
        let k = y * self.width + x;
        let (step, curvature) = (self.steps[k].along(across), self.coarse[k].along(across));
        Some((f64::from(step.max(0.0).sqrt()), f64::from(-curvature)))
    }

    /// How well an edge lies along a side: at each of `places` along it, the best of several `offsets_px`
    /// across it counts.
    pub fn support(&self, (from, to): (Place, Place), places: usize, offsets_px: &[f64]) -> Support {
        let length = (to - from).norm();
        if length < 1.0 {
            return Support::default();
        }
        let along = (to - from) / length;
        let across = Place::new(-along.y, along.x);
        let mut pieces = [[0.0; 3]; PIECES]; // steps, ridges, places
        for k in 0..places {
            let place =
                from + along * (length * (END + (1.0 - 2.0 * END) * (k as f64 + 0.5) / places as f64));
            let found = offsets_px.iter().filter_map(|offset| self.at(place + across * *offset, across));
            if let Some((step, ridge)) = found.reduce(|a, b| (a.0.max(b.0), a.1.max(b.1))) {
                let piece = &mut pieces[k * PIECES / places];
                piece[0] += step / (step + HALF_STEP);
                piece[1] += ridge / (ridge + HALF_RIDGE);
                piece[2] += 1.0;
            }
        }
        let [steps, ridges, count] = [0, 1, 2].map(|n| pieces.iter().map(|piece| piece[n]).sum::<f64>());
        if count < 1.0 {
            return Support { step: 0.5, ridge: 0.5, weakest: 0.5 };
        }
        let seen = pieces.iter().filter(|piece| piece[2] > 0.0);
        let least = |n: usize| seen.clone().map(|piece| piece[n] / piece[2]).fold(1.0, f64::min);
        let weakest = least(0).max(least(1));
        Support { step: steps / count, ridge: ridges / count, weakest }
    }

    /// Fraction of a quadrilateral's inside with steps stronger than `least`.
    pub fn inner_edges(&self, quad: &super::outline::Quad, least: f64) -> f64 {
        const ACROSS: usize = 7;
        let (mut seen, mut edges) = (0.0, 0.0);
        for k in 0..ACROSS * ACROSS {
            let part = |n: usize| 0.12 + 0.76 * n as f64 / (ACROSS - 1) as f64;
            let (u, v) = (part(k / ACROSS), part(k % ACROSS));
            let place =
                (quad[0] * (1.0 - v) + quad[1] * v) * (1.0 - u) + (quad[3] * (1.0 - v) + quad[2] * v) * u;
            if let Some(around) = self.around(place) {
                let Tensor([xx, yy, ..]) = self.between(&self.steps, around);
                seen += 1.0;
                edges += f64::from(f64::from(xx + yy) > least * least);
            }
        }
        if seen > 0.0 { edges / seen } else { 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::super::synthetic::{off, outline, views};

    #[test]
    fn sides_have_an_edge_and_lines_beside_them_have_none() {
        let (_, evidence, _) = views();
        let support = |fold: super::super::outline::Outline, side: usize| {
            evidence.support(fold.side(side), 24, &[-1.0, 0.0, 1.0])
        };
        for side in 1..7 {
            let (at, neighbours) = (support(outline(), side), support(off(25.0), side));
            assert!(at.step > 0.7 && at.weakest > 0.8, "{side}: {at:?}");
            assert!(neighbours.step < at.step - 0.2, "{side}: {neighbours:?}");
        }
        assert!(support(outline(), 0).ridge > 0.7, "{:?}", support(outline(), 0));
    }

    #[test]
    fn a_panel_has_no_edges_inside_and_a_strip_along_its_side_has() {
        let (_, evidence, _) = views();
        let [panel, _] = outline().panels();
        assert!(evidence.inner_edges(&panel, 0.03) < 0.01);
        // three of its seven rows of places run along the edge
        let [c0, c1, a1, a0] = panel;
        let narrow = [c1, a1, a1 - (a0 - a1) * 0.02, c1 - (c0 - c1) * 0.02];
        assert!(evidence.inner_edges(&narrow, 0.03) > 0.2);
    }
}
