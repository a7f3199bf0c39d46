//! Position of the camera relative to a fold, from the corners of its panels.

use nalgebra::{Point3, Vector3};

use super::point::Point;
use super::pose::camera_position;
use crate::geometry::Fold;

/// Position of a camera in the coordinates of [`Fold::panels`], with crease end 0 at negative y, in facet
/// order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraPose {
    /// In the fold's unit of length.
    pub position: Point3<f64>,
    /// Whether the corners were marked as in a mirror image, with y reversed.
    pub mirrored: bool,
}

/// Position of the camera for a fold whose panels appear at these corners.
///
/// # Arguments
/// - `panels`: corners in the undistorted picture, px: crease end 0, crease end 1, outer end 1, outer end 0
///   of panels 0 and 1.
///
/// # Returns
/// The pose; none if the corners determine no position from which both panels are visible.
///
/// # Example
/// ```
/// use vfold::geometry::{FacetGrid, Fold};
/// use vfold::image::{Point, camera_pose};
/// let fold = Fold::new(90.0, 1.0, 1.0, FacetGrid { rows: 1, cols: 1 })?;
/// // seen from (0, 0, 5) along -z, y upwards, the picture 100 px away
/// let seen = fold.panels().map(|panel| {
///     panel.corners.map(|p| Point::new(100.0 * p.x / (5.0 - p.z), -100.0 * p.y / (5.0 - p.z)))
/// });
/// let pose = camera_pose(&fold, &seen).unwrap();
/// assert!((pose.position.z - 5.0).abs() < 1e-6 && !pose.mirrored);
/// # Ok::<(), vfold::Error>(())
/// ```
#[must_use]
pub fn camera_pose(fold: &Fold, panels: &[[Point; 4]; 2]) -> Option<CameraPose> {
    let corners = fold.panels().map(|panel| panel.corners);
    [false, true].into_iter().find_map(|mirrored| {
        let side = if mirrored { -1.0 } else { 1.0 };
        let in_space = |place: &Vector3<f64>| Vector3::new(place.x, side * place.y, place.z);
        // the crease's ends once, the outer corners of both panels
        let outer = [(0, 2), (0, 3), (1, 2), (1, 3)];
        let seen: Vec<_> = [(0, 0), (0, 1)]
            .into_iter()
            .chain(outer)
            .map(|(panel, corner): (usize, usize)| (in_space(&corners[panel][corner]), panels[panel][corner]))
            .collect();
        let place = camera_position(&seen)?;
        Some(CameraPose { position: Point3::from(in_space(&place)), mirrored })
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // a test stops at the first surprise

    use super::*;
    use crate::geometry::FacetGrid;

    /// Corners of a rendered photograph (`real/one_none`) and the position of its camera, in panel depths.
    #[test]
    fn a_photographs_pose_is_where_its_camera_was() {
        let point = |[x, y]: [f64; 2]| Point::new(x, y);
        let crease = [[258.541218, 286.961719], [252.027891, 29.007156]];
        let panels = [
            [crease[0], crease[1], [104.064971, 50.8201172], [113.965896, 336.777254]].map(point),
            [crease[0], crease[1], [340.983175, 46.9353452], [346.68048, 336.651208]].map(point),
        ];
        let fold = Fold::new(48.0, 1.0, 1.0, FacetGrid { rows: 10, cols: 10 }).unwrap();
        let truth = Point3::new(0.96547, 1.10338, 8.36309);
        let pose = camera_pose(&fold, &panels).unwrap();
        assert!((pose.position - truth).norm() < 0.01 && !pose.mirrored, "{pose:?}");
        // marked from the other end of the crease, facets are numbered in reverse
        let turned = panels.map(|[a, b, c, d]| [b, a, d, c]);
        let pose = camera_pose(&fold, &turned).unwrap();
        let truth = Point3::new(truth.x, -truth.y, truth.z);
        assert!((pose.position - truth).norm() < 0.01 && pose.mirrored, "{pose:?}");
    }
}
