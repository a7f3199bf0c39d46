//! Parses corners as typed by a user, and checks that they are in the picture.

use super::homography::Homography;
use super::point::Point;
use crate::error::counted;
use crate::{Error, Result};

/// The corners of a panel, in input order.
pub const PANEL_CORNERS: [&str; 4] = ["crease end 0", "crease end 1", "outer end 1", "outer end 0"];

/// The outer corners of a chart's block of patches, in input order: clockwise from the first patch of an
/// upright chart.
pub const CHART_CORNERS: [&str; 4] =
    ["first patch", "end of the first row", "last patch", "start of the last row"];

/// The corners of a white card, in any order around it.
pub const WHITE_CORNERS: [&str; 4] = ["corner 1", "corner 2", "corner 3", "corner 4"];

/// Reads four corners, `"x,y x,y x,y x,y"`, in px.
///
/// # Arguments
/// - `flag`: the flag that holds the text, named in errors.
/// - `names`: of the four corners, in order; [`PANEL_CORNERS`] for a panel.
///
/// # Errors
/// [`Error::Usage`] unless there are four pairs of numbers that span a convex quadrilateral.
///
/// # Example
/// ```
/// use vfold::image::{PANEL_CORNERS, parse_corners};
/// let corners = parse_corners("--panel0", "332.1,462.5 345.3,77 121.9,11.9 103.9,442.2", &PANEL_CORNERS)?;
/// assert_eq!(corners[1].x, 345.3);
/// let short = parse_corners("--panel0", "332.1,462.5 345.3,77 121.9,11.9", &PANEL_CORNERS).unwrap_err();
/// assert!(short.to_string().starts_with("--panel0: found 3 corners instead of 4;"));
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn parse_corners(flag: &'static str, text: &str, names: &[&str; 4]) -> Result<[Point; 4]> {
    let remedy = || format!("write \"x,y x,y x,y x,y\" in this order: {}", names.join(", "));
    let found = text
        .split_whitespace()
        .map(|pair| {
            parse_point(pair)
                .ok_or_else(|| Error::usage(flag, format!("'{pair}' is not a pair x,y"), remedy()))
        })
        .collect::<Result<Vec<_>>>()?;
    let corners = <[Point; 4]>::try_from(found).map_err(|found| {
        Error::usage(flag, format!("found {} instead of 4", counted(found.len(), "corner")), remedy())
    })?;
    match Homography::from_unit_square(corners) {
        Err(Error::Corners { problem, .. }) => Err(Error::usage(flag, problem, remedy())),
        other => other.map(|_| corners),
    }
}

/// Parses `x,y`, px.
///
/// # Example
/// ```
/// use vfold::image::{Point, parse_point};
/// assert_eq!(parse_point("3,4.5"), Some(Point::new(3.0, 4.5)));
/// assert_eq!(parse_point("3"), None);
/// ```
#[must_use]
pub fn parse_point(pair: &str) -> Option<Point> {
    let (x, y) = pair.split_once(',')?;
    Some(Point::new(x.parse().ok()?, y.parse().ok()?))
}

/// Largest distance of a corner outside the picture, px: clicks on the very edge are often rounded outwards.
const TOLERANCE_PX: f64 = 1.0;

/// Whether a point is in a picture of `width` x `height` px, within one pixel.
pub(in crate::image) fn is_inside(p: Point, width: usize, height: usize) -> bool {
    (-TOLERANCE_PX..=width as f64 + TOLERANCE_PX).contains(&p.x)
        && (-TOLERANCE_PX..=height as f64 + TOLERANCE_PX).contains(&p.y)
}

/// Checks that the corners are in a picture of `width` x `height` px, within one pixel.
///
/// # Errors
/// [`Error::Corners`] with the corner's name and position and the picture's size; `region` names what the
/// corners bound.
///
/// # Example
/// ```
/// use vfold::image::{PANEL_CORNERS, Point, check_inside};
/// let corners = [(5.0, 5.0), (700.0, 5.0), (90.0, 90.0), (5.0, 90.0)].map(|(x, y)| Point::new(x, y));
/// let error = check_inside("panel 0", &corners, &PANEL_CORNERS, 640, 480).unwrap_err();
/// let problem = "panel 0: crease end 1 at (700, 5) is outside the picture of 640 x 480 px;";
/// assert!(error.to_string().starts_with(problem));
/// ```
pub fn check_inside(
    region: &str,
    corners: &[Point; 4],
    names: &[&str; 4],
    width: usize,
    height: usize,
) -> Result<()> {
    let Some(k) = corners.iter().position(|p| !is_inside(*p, width, height)) else { return Ok(()) };
    let (name, Point { x, y }) = (names[k], corners[k]);
    Err(Error::Corners {
        problem: format!("{region}: {name} at ({x}, {y}) is outside the picture of {width} x {height} px"),
        remedy: "give corners in px of the upright picture, origin at its top left corner".to_owned(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn usage(text: &str) -> String {
        let error = parse_corners("--panel1", text, &PANEL_CORNERS).unwrap_err();
        assert_eq!(error.exit_status(), 2);
        error.to_string()
    }

    #[test]
    fn what_is_wrong_with_a_text_is_said_with_the_flag() {
        assert!(usage("").starts_with("--panel1: found 0 corners instead of 4"));
        assert!(usage("1,2 3,4 5,6 7,8 9,10").contains("found 5 corners"));
        assert!(usage("1,2 3;4 5,6 7,8").contains("'3;4' is not a pair"));
        assert!(usage("0,0 9,9 9,0 0,9").contains("cross"));
        assert!(usage("0,0 inf,9 9,0 0,9").contains("corner 2 is not a finite number"));
        assert!(usage("0,0 9,0").ends_with("crease end 0, crease end 1, outer end 1, outer end 0"));
    }

    #[test]
    fn a_corner_may_lie_one_pixel_outside() {
        let corners = |x| [(0.0, 0.0), (x, 0.0), (x, 9.0), (0.0, 9.0)].map(|(x, y)| Point::new(x, y));
        assert!(check_inside("chart", &corners(11.0), &PANEL_CORNERS, 10, 10).is_ok());
        assert!(check_inside("chart", &corners(11.1), &PANEL_CORNERS, 10, 10).is_err());
    }
}
