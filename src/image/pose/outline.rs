//! The six corners of a fold in the unit of its camera.

use nalgebra::Vector2;

use super::view::Corners;
use crate::image::placing::{Lens, Point, cross};

/// The corners of a fold held with end 0 of the crease at the bottom and panel 0 on the left, or rotated.
#[derive(Debug, Clone, Copy)]
pub(super) struct Outline {
    pub corners: Corners,
    /// Side of a square with the mean area of the panels.
    pub side: f64,
    /// Whether panel 0 is the one on the right.
    is_swapped: bool,
}

impl Outline {
    /// From panels with these corners, px, in a picture of this size; none if the panels are not on opposite
    /// sides of a crease.
    pub fn of(panels: &[[Point; 4]; 2], lens: &Lens, size: [f64; 2], unit_px: f64) -> Option<Self> {
        let panels = panels.map(|panel| panel.map(|corner| lens.undistort(corner)));
        let areas = panels.map(|panel| twice_area(panel) / 2.0);
        let is_swapped = areas[0] > 0.0;
        let [left, right] = if is_swapped { [panels[1], panels[0]] } else { panels };
        let place = |p: Point| Vector2::new(p.x - size[0] / 2.0, p.y - size[1] / 2.0) / unit_px;
        let crease = [0, 1].map(|end| (place(left[end]) + place(right[end])) / 2.0);
        let outer = [left[2], left[3], right[2], right[3]].map(place);
        let corners = [crease[0], crease[1], outer[0], outer[1], outer[2], outer[3]];
        let side = ((areas[0].abs() + areas[1].abs()) / 2.0).sqrt() / unit_px;
        // also false for corners that the lens cannot image, which are NaN
        (areas[0] * areas[1] < 0.0).then_some(Self { corners, side, is_swapped })
    }

    /// Reorders numbers of panels 0 and 1 to the panels on the left and right, or back.
    pub fn in_order<T: Copy>(&self, [a, b]: [T; 2]) -> [T; 2] {
        if self.is_swapped { [b, a] } else { [a, b] }
    }
}

/// Twice the area of a quadrilateral, positive if clockwise as seen.
fn twice_area([a, b, c, d]: [Point; 4]) -> f64 {
    cross(a, b, c) + cross(a, c, d)
}
