//! Positions: points of the picture, panels and charts in it, the lens and the camera.

mod corners;
mod distortion;
mod fold_pose;
mod framing;
mod grid;
mod homography;
mod lens_estimate;
mod pixel_area;
mod point;
mod pose;

pub(in crate::image) use corners::is_inside;
pub use corners::{CHART_CORNERS, PANEL_CORNERS, WHITE_CORNERS, check_inside, parse_corners, parse_point};
pub use distortion::Lens;
pub use fold_pose::{CameraPose, camera_pose};
pub use framing::Framing;
pub use grid::Grid;
pub use homography::Homography;
pub(in crate::image) use homography::square_to_quadrilateral;
pub use lens_estimate::LensEstimate;
pub(in crate::image) use pixel_area::{Quadrilateral, Sides, sense};
pub use point::Point;
pub(in crate::image) use point::cross;
pub use pose::camera_position;
