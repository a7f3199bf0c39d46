//! Where the camera stood, and where the facets are in its picture.

use nalgebra::{DMatrix, DVector, Vector3};

use crate::error::Result;
use crate::geometry::Fold;
use crate::image::{Homography, Point, camera_position};
use crate::stream::Sample;

/// A camera before a fold, as the corners of the panels tell it.
pub struct Pose {
    /// Place of the camera in the fold's coordinates (across, along the crease, out of the opening), in depths of the panels.
    pub eye: Vector3<f64>,
    /// The direction of space, square to the view, that goes up in the picture.
    up: Vector3<f64>,
    outlines: [Homography; 2],
    centre: Point,
    half_diagonal: f64,
}

impl Pose {
    /// That of a photograph's sample; none if it has no corners, or they do not tell it.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if the corners are no panels.
    pub fn of(sample: &Sample, fold: &Fold) -> Result<Option<Self>> {
        let Some(framing) = sample.framing()? else { return Ok(None) };
        let [Some(panel0), Some(panel1)] = framing.panels else { return Ok(None) };
        let outline = |corners: [[f64; 2]; 4]| Homography::from_unit_square(corners.map(|[x, y]| Point::new(x, y)));
        let outlines = [outline(panel0)?, outline(panel1)?];
        let half = fold.angle_rad() / 2.0;
        let width = fold.width() / fold.depths()[0];
        // Seen in a mirror the other end of the crease comes first; the fold is the same.
        let corners = |way: f64| {
            let end = |side: f64| Vector3::new(0.0, 0.5 * way * side * width, 0.0);
            let outer = |x: f64, side: f64| end(side) + Vector3::new(x * half.sin(), 0.0, half.cos());
            let px = |panel: usize, n: usize| outlines[panel].corners()[n];
            vec![
                (end(-1.0), px(0, 0)),
                (end(1.0), px(0, 1)),
                (outer(-1.0, 1.0), px(0, 2)),
                (outer(-1.0, -1.0), px(0, 3)),
                (outer(1.0, 1.0), px(1, 2)),
                (outer(1.0, -1.0), px(1, 3)),
            ]
        };
        let seen = [1.0, -1.0].into_iter().map(|way| (way, corners(way)));
        let Some((way, seen, mut eye)) =
            seen.filter_map(|(way, seen)| Some((way, camera_position(&seen)?, seen))).map(|(w, e, s)| (w, s, e)).next()
        else {
            return Ok(None);
        };
        let mut up = upwards(&seen, eye);
        // Facets count from end 0: in the mirror the camera and what is up are on the other side.
        eye.y *= way;
        up.y *= way;
        let [width_px, height_px] = framing.size.map(|size| size as f64);
        Ok(Some(Self {
            eye,
            up,
            outlines,
            centre: Point::new(width_px / 2.0, height_px / 2.0),
            half_diagonal: 0.5 * width_px.hypot(height_px),
        }))
    }

    /// Square of the distance from the picture's centre, that of a corner being 1, of a place on a panel: shares of its width and depth.
    pub fn off_centre(&self, panel: usize, along: f64, depth: f64) -> f64 {
        let Point { x, y } = self.outlines[panel].to_image(along, depth);
        ((x - self.centre.x).powi(2) + (y - self.centre.y).powi(2)) / self.half_diagonal.powi(2)
    }

    /// The zenith, if people hold their cameras upright and the sun stands at this sine of its height.
    pub fn up(&self, sun: Vector3<f64>, sun_height: f64) -> Vector3<f64> {
        let beside = (self.up - self.up.dot(&sun) * sun).try_normalize(1e-9).unwrap_or_else(Vector3::y);
        sun_height * sun + (1.0 - sun_height * sun_height).sqrt() * beside
    }
}

/// The direction square to the view that rises most in the picture.
fn upwards(seen: &[(Vector3<f64>, Point)], eye: Vector3<f64>) -> Vector3<f64> {
    let count = seen.len();
    let middle = seen.iter().map(|(place, _)| place).sum::<Vector3<f64>>() / count as f64;
    let places = DMatrix::from_fn(count, 4, |row, k| if k == 3 { 1.0 } else { (seen[row].0 - middle)[k] });
    let rise = DVector::from_iterator(count, seen.iter().map(|(_, p)| -p.y));
    let slopes = places.svd(true, true).solve(&rise, 1e-9).unwrap_or_else(|_| DVector::zeros(4));
    let slope = Vector3::new(slopes[0], slopes[1], slopes[2]);
    let view = (eye - middle).normalize();
    (slope - slope.dot(&view) * view).try_normalize(1e-12).unwrap_or_else(Vector3::y)
}
