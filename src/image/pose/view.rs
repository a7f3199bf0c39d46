//! Positions of a fold's corners in the picture, as a function of the unknowns.

use nalgebra::{Rotation3, SVector, Vector2, Vector3};

/// Numbers that determine the positions of six corners, in the order of the constants below.
pub(super) const UNKNOWNS: usize = 11;
/// Angle between the panels, radians.
pub(super) const ANGLE: usize = 0;
/// Rotation of the fold from its initial orientation, a rotation vector of three numbers.
pub(super) const TURN: usize = 1;
/// Position of the crease's middle in the undistorted picture, two numbers.
pub(super) const MIDDLE: usize = 4;
/// Logarithm of the apparent size of a length equal to the crease at the distance of its middle.
pub(super) const LN_SIZE: usize = 6;
/// Logarithm of the focal length.
pub(super) const LN_FOCAL: usize = 7;
/// Distortion coefficient of the lens.
pub(super) const K1: usize = 8;
/// Logarithm of the depth of panel 0, in lengths of the crease.
pub(super) const LN_DEPTH: usize = 9;
/// Logarithm of the depth of panel 1 over that of panel 0.
pub(super) const LN_DEPTH_RATIO: usize = 10;

/// The unknowns. Lengths in the picture are relative to half its shorter side, the unit of
/// [`Lens`](crate::image::Lens), and measured from its middle.
pub(super) type Unknowns = SVector<f64, UNKNOWNS>;

/// Crease ends 0 and 1, outer ends 1 and 0 of panel 0, the same of panel 1.
pub(super) type Corners = [Vector2<f64>; 6];

/// The corners in space as in [`Fold::panels`](crate::geometry::Fold::panels), with a crease of length 1.
fn in_space(unknowns: &Unknowns) -> [Vector3<f64>; 6] {
    let (sin, cos) = (unknowns[ANGLE] / 2.0).sin_cos();
    let depth = unknowns[LN_DEPTH].exp();
    let (out0, out1) = (depth * Vector3::new(-sin, 0.0, cos), Vector3::new(sin, 0.0, cos));
    let out1 = depth * unknowns[LN_DEPTH_RATIO].exp() * out1;
    let [end0, end1] = [-0.5, 0.5].map(|y| Vector3::new(0.0, y, 0.0));
    [end0, end1, end1 + out0, end0 + out0, end1 + out1, end0 + out1]
}

/// Positions of the corners as seen by a camera, for a fold with the initial orientation `held`; x to the
/// right, y down, z away from the camera. None unless all are in front of the camera.
pub(super) fn seen(unknowns: &Unknowns, held: &Rotation3<f64>) -> Option<Corners> {
    let turned = Rotation3::new(unknowns.fixed_rows::<3>(TURN).into_owned()) * held;
    let focal = unknowns[LN_FOCAL].exp();
    let away = focal / unknowns[LN_SIZE].exp();
    let middle = away * Vector3::new(unknowns[MIDDLE] / focal, unknowns[MIDDLE + 1] / focal, 1.0);
    let corners = in_space(unknowns).map(|corner| turned * corner + middle);
    let is_before = corners.iter().all(|corner| corner.z > 0.0);
    is_before.then(|| {
        corners.map(|corner| {
            let ideal = corner.xy() * (focal / corner.z);
            ideal * (1.0 + unknowns[K1] * ideal.norm_squared())
        })
    })
}
