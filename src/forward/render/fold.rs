//! A photograph of a fold: the light on its panels, which varies smoothly.

use nalgebra::{DMatrix, Vector3};

use super::{Frame, Picture, Pinhole, Stand, Viewpoint};
use crate::error::Result;
use crate::geometry::{FacetGrid, Fold};
use crate::image::Point;

/// Cells of a panel on which light is computed: rows away from the crease, columns along it.
const CELLS: FacetGrid = FacetGrid { rows: 160, cols: 96 };
/// Distance of the camera, in sizes of the fold.
const DISTANCE: f64 = 7.0;

/// A fold placed as in [`Fold::panels`], and the camera that sees it.
#[derive(Clone, Debug)]
pub struct FoldView {
    frame: Frame,
    camera: Pinhole,
    panels: [Surface; 2],
}

/// A panel in space, lit on one side.
#[derive(Clone, Debug)]
struct Surface {
    corners: [Vector3<f64>; 4],
    /// 1 if (crease x outwards) points to the lit side, -1 if away from it.
    lit_side: f64,
}

impl FoldView {
    /// A view into the fold. Unless `viewpoint` says otherwise, it is seen from slightly off its bisecting
    /// plane, with the crease upright and panel 0 on the left.
    ///
    /// # Errors
    /// As [`Viewpoint::camera`].
    ///
    /// # Example
    /// ```
    /// use vfold::forward::render::{FoldView, Frame, Viewpoint};
    /// use vfold::geometry::{FacetGrid, Fold};
    /// let fold = Fold::new(45.0, 1.0, 1.0, FacetGrid { rows: 10, cols: 10 })?;
    /// let corners = FoldView::new(&fold, &Viewpoint::default(), Frame::new(640, 480)?)?.corners();
    /// let [(0, panel0), (1, panel1)] = corners.as_slice() else { panic!("both panels are seen") };
    /// assert_eq!(panel0[0], panel1[0]); // both begin at one end of the crease
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn new(fold: &Fold, viewpoint: &Viewpoint, frame: Frame) -> Result<Self> {
        let [panel0, panel1] = fold.panels().map(|panel| panel.corners);
        let panels =
            [Surface { corners: panel0, lit_side: 1.0 }, Surface { corners: panel1, lit_side: -1.0 }];
        let points = [panel0, panel1].concat();
        let camera = viewpoint.camera(usual_stand(fold), &points, frame)?;
        Ok(Self { frame, camera, panels })
    }

    /// The panels wholly in front of the camera: their indices and their corners in the picture (crease end
    /// 0, crease end 1, outer end 1, outer end 0).
    #[must_use]
    pub fn corners(&self) -> Vec<(usize, [Point; 4])> {
        let seen = |panel: &Surface| self.camera.project_all(panel.corners);
        self.panels.iter().enumerate().filter_map(|(k, panel)| Some((k, seen(panel)?))).collect()
    }

    /// Position of the camera, in the unit of the fold.
    #[must_use]
    pub fn eye(&self) -> Vector3<f64> {
        self.camera.position()
    }

    /// The cells of a panel on which a picture needs the light.
    #[must_use]
    pub fn grid(&self) -> FacetGrid {
        CELLS
    }

    /// Renders the light on the cells of both panels (cell by channel, in the order of [`FoldView::grid`], up
    /// to three channels) before a black background.
    #[must_use]
    pub fn take(&self, light: &DMatrix<f64>) -> Picture {
        Picture::take(self.frame, &self.camera, |eye, sight| {
            let hits =
                self.panels.iter().enumerate().filter_map(|(k, panel)| Some((k, panel.hit(eye, sight)?)));
            match hits.min_by(|(_, a), (_, b)| a.distance.total_cmp(&b.distance)) {
                Some((panel, Hit { lit: true, u, v, .. })) => interpolate(light, panel, u, v),
                _ => [0.0; 3],
            }
        })
    }
}

/// Intersection of a line of sight with a panel.
struct Hit {
    distance: f64,
    /// Position along the crease and away from it, both from 0 to 1.
    u: f64,
    v: f64,
    lit: bool,
}

impl Surface {
    /// T. Möller, B. Trumbore, *Fast, minimum storage ray/triangle intersection* (1997), for a parallelogram.
    fn hit(&self, eye: Vector3<f64>, sight: Vector3<f64>) -> Option<Hit> {
        let [start, end, _, outer] = self.corners;
        let (along, out) = (end - start, outer - start);
        let across = sight.cross(&out);
        let determinant = along.dot(&across);
        let from = eye - start;
        let u = from.dot(&across) / determinant;
        let other = from.cross(&along);
        let v = sight.dot(&other) / determinant;
        let distance = out.dot(&other) / determinant;
        let inside = (0.0..=1.0).contains(&u) && (0.0..=1.0).contains(&v) && distance > 0.0;
        inside.then_some(Hit { distance, u, v, lit: determinant * self.lit_side > 0.0 })
    }
}

/// Bilinear interpolation between the centres of the cells.
fn interpolate(light: &DMatrix<f64>, panel: usize, u: f64, v: f64) -> [f64; 3] {
    let along = |position: f64, cells: usize| {
        let position = (position * cells as f64 - 0.5).clamp(0.0, (cells - 1) as f64);
        let first = (position as usize).min(cells - 2);
        (first, position - first as f64)
    };
    let ((col, right), (row, out)) = (along(u, CELLS.cols), along(v, CELLS.rows));
    let cell = |row: usize, col: usize| (panel * CELLS.rows + row) * CELLS.cols + col;
    let across = |row: usize, channel: usize| {
        (1.0 - right) * light[(cell(row, col), channel)] + right * light[(cell(row, col + 1), channel)]
    };
    let value = |channel: usize| (1.0 - out) * across(row, channel) + out * across(row + 1, channel);
    std::array::from_fn(|channel| if channel < light.ncols() { value(channel) } else { 0.0 })
}

/// A position inside the fold's opening, so that neither panel hides the other. It is rolled by two degrees,
/// so that no edge is parallel to a row of pixels.
fn usual_stand(fold: &Fold) -> Stand {
    let aside = (fold.angle_rad() / 6.0).min(0.1);
    let direction = Vector3::new(aside.sin(), -0.12, aside.cos()).normalize();
    let [depth0, depth1] = fold.depths();
    let look_at = Vector3::new(0.0, 0.0, depth0 * (fold.angle_rad() / 2.0).cos() / 2.0);
    let eye = look_at + DISTANCE * fold.width().hypot(depth0.max(depth1)) * direction;
    Stand { eye, look_at, up: Vector3::new(0.035, 1.0, 0.0) }
}
