//! Position of the camera, and of the facets in its picture.

use nalgebra::{DMatrix, DVector, Vector2, Vector3};

use crate::error::Result;
use crate::geometry::Fold;
use crate::image::{Framing, Homography, Point, camera_pose};
use crate::kernel::bent::View;

/// Depth within which the scale of the picture at the crease is found, in panel depths.
const NEAR: f64 = 0.05;

/// A camera before a fold, located by the corners of the panels.
pub struct Pose {
    /// Position of the camera in the fold's coordinates (across, along the crease, out of the opening) and
    /// unit.
    pub eye: Vector3<f64>,
    /// The direction in space, perpendicular to the view, that points up in the picture.
    up: Vector3<f64>,
    outlines: [Homography; 2],
    centre: Point,
    half_diagonal: f64,
    margin_px: f64,
}

impl Pose {
    /// From a photograph; `None` if the corners do not determine the pose.
    ///
    /// # Errors
    /// [`crate::Error::Corners`] if the corners do not bound panels.
    pub fn of(framing: &Framing, fold: &Fold) -> Result<Option<Self>> {
        let [Some(panel0), Some(panel1)] = framing.panels else { return Ok(None) };
        let panels = [panel0, panel1];
        let Some(eye) = camera_pose(fold, &panels) else { return Ok(None) };
        let outlines = [Homography::from_unit_square(panels[0])?, Homography::from_unit_square(panels[1])?];
        let [width, height] = framing.size;
        Ok(Some(Self {
            eye: eye.position.coords,
            up: upwards(fold, &panels, eye.position.coords),
            outlines,
            centre: Point::new(width / 2.0, height / 2.0),
            half_diagonal: 0.5 * width.hypot(height),
            margin_px: framing.margin_px,
        }))
    }

    /// Squared distance of a point on a panel from the picture's centre, relative to that of the picture's
    /// corners. The point is given as fractions of the panel's width and depth.
    pub fn off_centre(&self, panel: usize, along: f64, depth: f64) -> f64 {
        let Point { x, y } = self.outlines[panel].to_image(along, depth);
        ((x - self.centre.x).powi(2) + (y - self.centre.y).powi(2)) / self.half_diagonal.powi(2)
    }

    /// How the picture shows the fold. Facets are read from pixels that show one panel alone, at least half a
    /// pixel from the crease.
    pub fn view(&self) -> View {
        let unread = |outline: &Homography| {
            let [crease, end, inside] =
                [(0.5, 0.0), (1.0, 0.0), (0.5, NEAR)].map(|(along, depth)| outline.to_image(along, depth));
            let along = (Vector2::new(end.x, end.y) - Vector2::new(crease.x, crease.y)).normalize();
            let depth_px = along.perp(&Vector2::new(inside.x - crease.x, inside.y - crease.y)).abs() / NEAR;
            (0.5 * (along.x.abs() + along.y.abs()) + self.margin_px) / depth_px
        };
        View { towards: self.eye.normalize(), unread: self.outlines.each_ref().map(unread) }
    }

    /// The zenith, if the sine of the sun's elevation is `sun_height`: on the side of the stated zenith or,
    /// without one, of the camera's upward direction.
    pub fn up(&self, sun: Vector3<f64>, sun_height: f64, stated: Option<Vector3<f64>>) -> Vector3<f64> {
        let up = stated.unwrap_or(self.up);
        let sideways = (up - up.dot(&sun) * sun).try_normalize(1e-9).unwrap_or_else(Vector3::y);
        sun_height * sun + (1.0 - sun_height * sun_height).sqrt() * sideways
    }
}

/// The direction perpendicular to the view that rises most steeply in the picture.
fn upwards(fold: &Fold, panels: &[[Point; 4]; 2], eye: Vector3<f64>) -> Vector3<f64> {
    let corners = fold.panels().map(|panel| panel.corners);
    let seen: Vec<_> = (0..8).map(|n| (corners[n / 4][n % 4], panels[n / 4][n % 4])).collect();
    let middle = seen.iter().map(|(place, _)| place).sum::<Vector3<f64>>() / seen.len() as f64;
    let places = DMatrix::from_fn(seen.len(), 4, |n, k| if k == 3 { 1.0 } else { (seen[n].0 - middle)[k] });
    let rise = DVector::from_iterator(seen.len(), seen.iter().map(|(_, p)| -p.y));
    let slopes = places.svd(true, true).solve(&rise, 1e-9).unwrap_or_else(|_| DVector::zeros(4));
    let slope = Vector3::new(slopes[0], slopes[1], slopes[2]);
    let view = (eye - middle).normalize();
    (slope - slope.dot(&view) * view).try_normalize(1e-12).unwrap_or_else(Vector3::y)
}
