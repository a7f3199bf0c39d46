//! Position of a camera, from points of known position in its picture.

use nalgebra::{Const, Dyn, Matrix3, OMatrix, RowSVector, Vector3};

use super::point::Point;

/// Entries of a projection matrix, one of which is its scale.
const UNKNOWNS: usize = 12;
/// If a second solution with unit norm has a residual below this, the points are coplanar.
const PLANE: f64 = 1e-9;

/// Position of the pinhole that projects these points in space to their positions in the picture, by the
/// direct linear transform.
///
/// # Arguments
/// - `seen`: points in space, any unit, and in the undistorted picture, px; six or more, not coplanar.
///
/// # Returns
/// The position in the points' unit; none if they do not determine it, or are behind the camera or mirrored.
///
/// # Source
/// R. Hartley, A. Zisserman, *Multiple View Geometry* (2004), algorithm 7.1 without its last step, and
/// section 6.2.4.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use vfold::image::{Point, camera_position};
/// let cube = (0..8).map(|k| Vector3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2)));
/// // from (0, 0, -4) along z, the picture 100 px away
/// let seen: Vec<_> =
///     cube.map(|p| (p, Point::new(100.0 * p.x / (p.z + 4.0), 100.0 * p.y / (p.z + 4.0)))).collect();
/// assert!((camera_position(&seen).unwrap() - Vector3::new(0.0, 0.0, -4.0)).norm() < 1e-9);
/// assert_eq!(camera_position(&seen[..4]), None); // a plane
/// ```
#[must_use]
pub fn camera_position(seen: &[(Vector3<f64>, Point)]) -> Option<Vector3<f64>> {
    let (middle, size) = centre(seen.iter().map(|(place, _)| *place));
    let (image_middle, image_size) = centre(seen.iter().map(|(_, p)| Vector3::new(p.x, p.y, 0.0)));
    let rows = seen.iter().flat_map(|(place, p)| {
        let place = ((place - middle) / size).push(1.0).transpose();
        let p = (Vector3::new(p.x, p.y, 0.0) - image_middle) / image_size;
        [(0, p.x), (4, p.y)].map(|(first, seen)| {
            let mut row = RowSVector::<f64, UNKNOWNS>::zeros();
            row.fixed_columns_mut::<4>(first).copy_from(&place);
            row.fixed_columns_mut::<4>(8).copy_from(&(-seen * place));
            row
        })
    });
    let rows: Vec<_> = rows.collect();
    let svd = (rows.len() >= UNKNOWNS)
        .then(|| OMatrix::<f64, Dyn, Const<UNKNOWNS>>::from_rows(&rows).svd(false, true))?;
    let order = svd.singular_values.as_slice();
    let (least, _) = order.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1))?;
    let others = order.iter().enumerate().filter(|(k, _)| *k != least).map(|(_, value)| *value);
    if others.fold(f64::INFINITY, f64::min) < PLANE * svd.singular_values.max() {
        return None;
    }
    let projection = svd.v_t?.row(least).clone_owned();
    let turn = Matrix3::from_fn(|i, j| projection[4 * i + j]);
    let shift = Vector3::from_fn(|i, _| projection[4 * i + 3]);
    // x to the right, y down and depth make a right-handed system
    let in_front = |(place, _): &(Vector3<f64>, Point)| {
        let depth = (turn.row(2) * (place - middle) / size)[0] + shift.z;
        depth * turn.determinant() > 0.0
    };
    let position = -turn.try_inverse()? * shift;
    seen.iter().all(in_front).then(|| middle + size * position)
}

/// The mean of some points, and their mean distance from it.
fn centre(points: impl Iterator<Item = Vector3<f64>> + Clone) -> (Vector3<f64>, f64) {
    let count = points.clone().count() as f64;
    let middle = points.clone().sum::<Vector3<f64>>() / count;
    (middle, points.map(|point| (point - middle).norm()).sum::<f64>() / count)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // a test stops at the first surprise

    use super::*;
    use crate::forward::render::{Frame, Pinhole, Stand};
    use proptest::prelude::*;

    /// Points with their positions in the picture.
    type Seen = Vec<(Vector3<f64>, Point)>;

    /// A cube's corners in a picture of 2000 pixels, with errors up to a few `off_px`.
    fn seen(eye: Vector3<f64>, off_px: f64) -> Option<Seen> {
        let stand = Stand { eye, look_at: Vector3::new(0.3, 0.4, 0.5), up: Vector3::new(0.1, 1.0, 0.3) };
        let camera = Pinhole::with_field_of_view(&stand, 40.0, Frame::new(2000, 1500).ok()?).ok()?;
        let corner = |k: u8| Vector3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2));
        let off = |k: u8| off_px * f64::from(k % 3) - off_px;
        let point = |k: u8| {
            let p = camera.project(corner(k))?;
            Some((corner(k), Point::new(p.x + off(k), p.y + off(k + 1))))
        };
        (0..8).map(point).collect()
    }

    proptest! {
        #[test]
        fn the_camera_is_found_where_it_stood(
            direction in prop::array::uniform3(-1.0..1.0),
            distance in 2.0..8.0,
        ) {
            let Some(direction) = Vector3::from(direction).try_normalize(0.1) else { return Ok(()) };
            let eye = distance * direction;
            let Some(exact) = seen(eye, 0.0) else { return Ok(()) };
            prop_assert!((camera_position(&exact).unwrap() - eye).norm() < 1e-6 * distance);
            let clicked = seen(eye, 0.1).unwrap();
            prop_assert!((camera_position(&clicked).unwrap() - eye).norm() < 0.02 * distance);
            let mirrored: Vec<_> = exact.iter().map(|(place, p)| (*place, Point::new(-p.x, p.y))).collect();
            prop_assert_eq!(camera_position(&mirrored), None);
        }
    }
}
