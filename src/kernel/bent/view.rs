//! How much of its view a point of a sheet that is bent across the crease only has filled with a strip that
//! runs along it.

use std::f64::consts::TAU;

use nalgebra::Vector2;

use super::section::Strip;

/// Nearer to a point's horizon than this part of a strip's distance counts as on it.
const HORIZON: f64 = 1e-12;

/// A strip as a point sees it, with what lies below the horizon of either left out.
///
/// A horizon runs along the crease, as the strips do, so that what it leaves of a strip is a strip.
pub struct SeenStrip {
    near: Vector2<f64>,
    far: Vector2<f64>,
    normal: Vector2<f64>,
}

impl SeenStrip {
    /// `strip` from `point` on a strip with unit normal `normal`; none if they do not see each other.
    pub fn new(point: Vector2<f64>, normal: Vector2<f64>, strip: &Strip) -> Option<Self> {
        let (mut near, mut far) = (strip.near - point, strip.far - point);
        let least = HORIZON * (near.norm() + far.norm());
        if strip.normal.dot(&near) > -least {
            return None;
        }
        let [low, high] = [near, far].map(|end| normal.dot(&end));
        if low <= least && high <= least {
            return None;
        }
        let crossing = near + (far - near) * (low / (low - high));
        if low < 0.0 {
            near = crossing;
        }
        if high < 0.0 {
            far = crossing;
        }
        Some(Self { near, far, normal })
    }

    /// Share of the light leaving the point that lands on the strip between the point's place along the
    /// crease and `y` from it, for `y` > 0.
    ///
    /// # Source
    /// Lambert's formula for polygons (*Photometria*, 1760) for a rectangle with two sides along the crease:
    /// the side in the plane of the point's place along the crease gives nothing.
    pub fn up_to(&self, y: f64) -> f64 {
        let (a, b, n) = (self.near, self.far, self.normal);
        let along = |end: Vector2<f64>| {
            let distance = end.norm();
            if distance > 0.0 { cross(n, end) / distance * (y / distance).atan() } else { 0.0 }
        };
        let span = cross(a, b).hypot(y * (b - a).norm());
        let across =
            if span > 0.0 { -y * cross(n, b - a) / span * span.atan2(a.dot(&b) + y * y) } else { 0.0 };
        ((along(a) - along(b) + across) / TAU).abs()
    }
}

fn cross(a: Vector2<f64>, b: Vector2<f64>) -> f64 {
    a.x * b.y - a.y * b.x
}
