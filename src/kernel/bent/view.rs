//! Form factors from a point of a sheet, bent only across the crease, to strips along the crease.

use std::f64::consts::TAU;

use nalgebra::Vector2;

use super::section::Strip;

/// Points closer to the horizon than this fraction of a strip's distance count as on it.
const HORIZON: f64 = 1e-12;

/// A strip as seen from a point, clipped at the point's horizon.
///
/// Horizons and strips run along the crease, so a clipped strip is a strip again.
pub struct SeenStrip {
    near: Vector2<f64>,
    far: Vector2<f64>,
    normal: Vector2<f64>,
}

impl SeenStrip {
    /// `strip` from `point` on a strip with unit normal `normal`; `None` if they do not see each other.
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

    /// Share of the light leaving the point that lands on the strip between the point's position along the
    /// crease and a distance `y` > 0 from it.
    ///
    /// # Source
    /// Lambert's formula for polygons (*Photometria*, 1760), for a rectangle with two sides along the crease:
    /// the side in the plane across the crease through the point contributes nothing.
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
