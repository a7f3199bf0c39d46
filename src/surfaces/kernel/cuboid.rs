//! Oriented boxes that contain a cluster of patches.

use crate::geometry::Vec3;

/// A box.
#[derive(Clone, Debug)]
pub(super) struct Cuboid {
    /// Three orthogonal unit vectors.
    pub(super) axes: [Vec3; 3],
    /// Its range along each axis.
    pub(super) spans: [[f64; 2]; 3],
}

impl Cuboid {
    /// The bounding box of points along `axes`.
    pub(super) fn round<'a>(axes: [Vec3; 3], points: impl Iterator<Item = &'a Vec3> + Clone) -> Self {
        let span = |axis: Vec3| {
            let places = points.clone().map(|point| point.dot(&axis));
            places.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
        };
        Self { axes, spans: axes.map(span) }
    }

    /// Its eight corners.
    pub(super) fn corners(&self) -> [Vec3; 8] {
        let corner = |n: usize| (0..3).map(|axis| self.axes[axis] * self.spans[axis][n >> axis & 1]).sum();
        std::array::from_fn(corner)
    }

    /// Half its extent along each axis.
    pub(super) fn halves(&self) -> [f64; 3] {
        self.spans.map(|[low, high]| 0.5 * (high - low))
    }

    /// Half its largest extent.
    pub(super) fn reach(&self) -> f64 {
        self.halves().into_iter().fold(0.0, f64::max)
    }

    /// A lower bound on the distance between two boxes.
    pub(super) fn gap(&self, other: &Self) -> f64 {
        self.gap_to(&other.corners()).max(other.gap_to(&self.corners()))
    }

    /// Distance to the bounding box of points along the same axes.
    fn gap_to(&self, points: &[Vec3]) -> f64 {
        let other = Self::round(self.axes, points.iter());
        let apart = |([low, high], [from, to]): ([f64; 2], [f64; 2])| (from - high).max(low - to).max(0.0);
        self.spans.into_iter().zip(other.spans).map(|pair| apart(pair).powi(2)).sum::<f64>().sqrt()
    }
}
