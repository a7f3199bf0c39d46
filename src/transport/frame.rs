//! A panel's own coordinates: away from the crease, along it, and along the normal.

use nalgebra::{Matrix3, Point3, Vector3};

use crate::geometry::Fold;

/// A panel, and the positions of sun and eye in its own coordinates, whose origin is the middle of the
/// crease.
pub(super) struct Frame {
    /// Unit vector towards the sun.
    pub sun: Vector3<f64>,
    /// The eye, in the fold's unit.
    pub eye: Vector3<f64>,
    /// Depth of this panel and of the other.
    pub depth: f64,
    pub other_depth: f64,
    /// Length of the crease.
    pub width: f64,
    /// Sine and cosine of the opening angle.
    pub sin: f64,
    pub cos: f64,
}

impl Frame {
    pub fn new(fold: &Fold, panel: usize, sun: &Vector3<f64>, eye: &Point3<f64>) -> Self {
        let (sin, cos) = (fold.angle_rad() / 2.0).sin_cos();
        let side = if panel == 0 { -1.0 } else { 1.0 };
        let axes = Matrix3::new(side * sin, 0.0, cos, 0.0, 1.0, 0.0, -side * cos, 0.0, sin);
        let (sin, cos) = fold.angle_rad().sin_cos();
        Self {
            sun: axes * sun.normalize(),
            eye: axes * eye.coords,
            depth: fold.depths()[panel],
            other_depth: fold.depths()[1 - panel],
            width: fold.width(),
            sin,
            cos,
        }
    }

    /// Irradiance from the sun.
    pub fn lit(&self) -> f64 {
        self.sun.z.max(0.0)
    }

    /// Direction to the eye from the point at distance `out` from the crease and `along` it.
    pub fn to_eye(&self, [out, along]: [f64; 2]) -> Vector3<f64> {
        (self.eye - Vector3::new(out, along, 0.0)).normalize()
    }
}
