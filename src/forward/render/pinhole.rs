//! A camera without lens errors: the projection between space and picture.

use nalgebra::Vector3;

use crate::error::{Error, Result};
use crate::image::Point;

/// Share of the picture filled by its subject.
const FILL: f64 = 0.84;
/// Maximum number of pixels in a picture.
const MOST_PIXELS: usize = 1 << 28;
/// Directions whose angle has a smaller sine than this count as parallel.
const PARALLEL: f64 = 1e-6;

/// Width and height of a picture, px.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frame {
    width: usize,
    height: usize,
}

impl Frame {
    /// A picture of `width` x `height` px.
    ///
    /// # Errors
    /// [`Error::Usage`] for a picture without pixels or of more than 2²⁸.
    pub fn new(width: usize, height: usize) -> Result<Self> {
        if width == 0 || height == 0 || width.saturating_mul(height) > MOST_PIXELS {
            let problem = format!("{width}x{height} is not the size of a picture");
            return Err(Error::usage("--render-size", problem, "give WIDTHxHEIGHT, such as 640x480"));
        }
        Ok(Self { width, height })
    }

    /// Pixels in a row.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows of pixels.
    #[must_use]
    pub fn height(&self) -> usize {
        self.height
    }

    fn sides(&self) -> [f64; 2] {
        [self.width as f64, self.height as f64]
    }
}

/// Position and orientation of a camera, in the unit of its subject.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stand {
    /// The pinhole.
    pub eye: Vector3<f64>,
    /// A point on the optical axis.
    pub look_at: Vector3<f64>,
    /// The upward direction in the picture; only its component across the line of sight matters.
    pub up: Vector3<f64>,
}

/// The stated part of how a subject is viewed; the subject determines the rest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Viewpoint {
    /// See [`Stand::eye`].
    pub eye: Option<Vector3<f64>>,
    /// See [`Stand::look_at`].
    pub look_at: Option<Vector3<f64>>,
    /// See [`Stand::up`].
    pub up: Option<Vector3<f64>>,
    /// Horizontal field of view, degrees; `None` fits the picture to its subject.
    pub field_of_view_deg: Option<f64>,
}

impl Viewpoint {
    /// The camera for a subject with these outermost `points`, with `usual` in place of what is not stated.
    ///
    /// # Errors
    /// As [`Pinhole::framing`] and [`Pinhole::with_field_of_view`].
    pub fn camera(&self, usual: Stand, points: &[Vector3<f64>], frame: Frame) -> Result<Pinhole> {
        let stand = Stand {
            eye: self.eye.unwrap_or(usual.eye),
            look_at: self.look_at.unwrap_or(usual.look_at),
            up: self.up.unwrap_or(usual.up),
        };
        match self.field_of_view_deg {
            Some(degrees) => Pinhole::with_field_of_view(&stand, degrees, frame),
            None => Pinhole::framing(&stand, points, frame),
        }
    }
}

/// A camera without lens errors.
#[derive(Clone, Debug, PartialEq)]
pub struct Pinhole {
    position: Vector3<f64>,
    right: Vector3<f64>,
    up: Vector3<f64>,
    forward: Vector3<f64>,
    /// Distance of the picture from the pinhole, px.
    focal_px: f64,
    /// Where the optical axis meets the picture.
    centre: Point,
}

impl Pinhole {
    /// A camera with a horizontal field of view of `degrees` in (0, 180) and the optical axis in the middle.
    ///
    /// # Errors
    /// [`Error::Usage`] for other angles, an eye at the point it looks at, or an up along the line of sight.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use vfold::forward::render::{Frame, Pinhole, Stand};
    /// use vfold::image::Point;
    /// let stand = Stand { eye: Vector3::new(0.0, 0.0, 2.0), look_at: Vector3::zeros(), up: Vector3::y() };
    /// let camera = Pinhole::with_field_of_view(&stand, 90.0, Frame::new(200, 100)?)?; // 100 px away
    /// let seen = camera.project(Vector3::new(1.0, 0.5, 0.0)).unwrap();
    /// assert!((seen.x - 150.0).abs() < 1e-9 && (seen.y - 25.0).abs() < 1e-9);
    /// assert_eq!(camera.project(Vector3::new(0.0, 0.0, 3.0)), None); // behind it
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn with_field_of_view(stand: &Stand, degrees: f64, frame: Frame) -> Result<Self> {
        if !(degrees > 0.0 && degrees < 180.0) {
            let problem = format!("{degrees} is out of range");
            return Err(Error::usage("--field-of-view-deg", problem, "give degrees between 0 and 180"));
        }
        let [width, height] = frame.sides();
        let focal_px = width / 2.0 / (degrees.to_radians() / 2.0).tan();
        Ok(Self { focal_px, centre: Point::new(width / 2.0, height / 2.0), ..Self::at(stand)? })
    }

    /// A camera whose picture fits the subject with these outermost `points`: they fill 84 % of its width or
    /// height.
    ///
    /// # Errors
    /// [`Error::Usage`] if a point is not in front of the camera, all points coincide in the picture, the eye
    /// is at the point it looks at, or up is along the line of sight.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use vfold::forward::render::{Frame, Pinhole, Stand};
    /// let stand = Stand { eye: Vector3::new(5.0, 0.0, 9.0), look_at: Vector3::zeros(), up: Vector3::y() };
    /// let square =
    ///     [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| Vector3::new(x, y, 0.0));
    /// let camera = Pinhole::framing(&stand, &square, Frame::new(100, 100)?)?;
    /// let y = square.map(|corner| camera.project(corner).unwrap().y);
    /// assert!((y[1] - 92.0).abs() < 1e-9 && (y[2] - 8.0).abs() < 1e-9);
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn framing(stand: &Stand, points: &[Vector3<f64>], frame: Frame) -> Result<Self> {
        let camera = Self::at(stand)?;
        let seen: Option<Vec<Point>> = points.iter().map(|point| camera.project(*point)).collect();
        let seen = seen.ok_or_else(|| {
            Error::usage(
                "--eye",
                "part of the subject lies behind the camera",
                "move the camera further away, or give --field-of-view-deg",
            )
        })?;
        let [x, y] = [|p: &Point| p.x, |p: &Point| p.y].map(|pick| range(seen.iter().map(pick)));
        let [width, height] = frame.sides();
        let focal_px = FILL * (width / (x[1] - x[0])).min(height / (y[1] - y[0]));
        if !(focal_px > 0.0 && focal_px.is_finite()) {
            let problem = "the subject is seen as a single point";
            return Err(Error::usage("--eye", problem, "move the camera nearer, or elsewhere"));
        }
        let middle = |[low, high]: [f64; 2], side: f64| 0.5 * side - 0.5 * focal_px * (low + high);
        Ok(Self { focal_px, centre: Point::new(middle(x, width), middle(y, height)), ..camera })
    }

    /// The camera with its picture at unit distance.
    fn at(stand: &Stand) -> Result<Self> {
        let sight = stand.look_at - stand.eye;
        let forward = sight.try_normalize(0.0).filter(|forward| forward.iter().all(|x| x.is_finite()));
        let forward = forward.ok_or_else(|| {
            let problem = "the camera is at the point that it looks at";
            Error::usage("--eye", problem, "give another position, or --look-at")
        })?;
        let across = forward.cross(&stand.up);
        let right = across.try_normalize(PARALLEL * stand.up.norm()).ok_or_else(|| {
            let problem = "it points along the line of sight";
            Error::usage("--up", problem, "give a direction across it")
        })?;
        let up = right.cross(&forward);
        Ok(Self { position: stand.eye, right, up, forward, focal_px: 1.0, centre: Point::new(0.0, 0.0) })
    }

    /// The pinhole.
    #[must_use]
    pub fn position(&self) -> Vector3<f64> {
        self.position
    }

    /// Position of a point in the picture, px; `None` if the point is not in front of the camera.
    #[must_use]
    pub fn project(&self, point: Vector3<f64>) -> Option<Point> {
        let from = point - self.position;
        let depth = from.dot(&self.forward);
        let px = |along: f64| self.focal_px * along / depth;
        (depth > 0.0).then(|| {
            Point::new(self.centre.x + px(from.dot(&self.right)), self.centre.y - px(from.dot(&self.up)))
        })
    }

    /// Positions of several points; `None` if any of them is not in front of the camera.
    #[must_use]
    pub fn project_all<const N: usize>(&self, points: [Vector3<f64>; N]) -> Option<[Point; N]> {
        let seen: Option<Vec<Point>> = points.iter().map(|point| self.project(*point)).collect();
        seen?.try_into().ok()
    }

    /// Unit vector from the camera through a point of its picture.
    #[must_use]
    pub fn line_of_sight(&self, at: Point) -> Vector3<f64> {
        let (x, y) = (at.x - self.centre.x, self.centre.y - at.y);
        (self.right * x + self.up * y + self.forward * self.focal_px).normalize()
    }
}

fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)])
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // a test stops at the first surprise

    use super::*;
    use proptest::prelude::*;

    fn stand(eye: [f64; 3], up: [f64; 3]) -> Stand {
        Stand { eye: eye.into(), look_at: Vector3::zeros(), up: up.into() }
    }

    #[test]
    fn a_camera_that_sees_nothing_is_refused() {
        let frame = Frame::new(9, 9).unwrap();
        let refused = |eye, up, points: &[Vector3<f64>]| {
            Pinhole::framing(&stand(eye, up), points, frame).unwrap_err().to_string()
        };
        let (ahead, up) = (Vector3::new(0.0, 0.0, -1.0), [0.0, 1.0, 0.0]);
        assert!(refused([0.0; 3], up, &[ahead]).contains("the point that it looks at"));
        assert!(refused([f64::NAN, 0.0, 0.0], up, &[ahead]).contains("the point that it looks at"));
        assert!(refused([0.0, 0.0, 1.0], [0.0, 0.0, 1.0], &[ahead]).contains("--up: it points along"));
        assert!(refused([0.0, 0.0, 1.0], up, &[Vector3::new(0.0, 0.0, 2.0)]).contains("behind the camera"));
        assert!(refused([0.0, 0.0, 1.0], up, &[ahead]).contains("a single point"));
        assert!(Pinhole::with_field_of_view(&stand([1.0; 3], up), 180.0, frame).is_err());
        assert!(Frame::new(0, 5).is_err() && Frame::new(1 << 20, 1 << 20).is_err());
    }

    proptest! {
        /// Points on the line of sight through a point of the picture project back onto it.
        #[test]
        fn a_line_of_sight_is_seen_as_a_point(
            eye in prop::array::uniform3(-3.0..3.0),
            x in 0.0..64.0,
            y in 0.0..48.0,
            degrees in 5.0..150.0,
            distance in 0.1..9.0,
        ) {
            let stand = stand(eye, [0.1, 1.0, 0.2]);
            let camera = Pinhole::with_field_of_view(&stand, degrees, Frame::new(64, 48).unwrap());
            let Ok(camera) = camera else { return Ok(()) };
            let sight = camera.line_of_sight(Point::new(x, y));
            let seen = camera.project(camera.position() + distance * sight).unwrap();
            prop_assert!((seen.x - x).hypot(seen.y - y) < 1e-9, "{seen:?}");
        }
    }
}
