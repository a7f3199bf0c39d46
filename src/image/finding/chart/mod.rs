//! Locates a colour chart of 24 patches in a photograph, with a confidence.
//!
//! Four rows of six patches, as on ColorChecker Classic, Passport and Nano:
//!
//! 1. [`blobs`]: places of uniform light;
//! 2. [`lattice`], [`plane_map`]: those that form rows and columns in arbitrary perspective;
//! 3. [`placement`], [`colours`], [`search`]: four rows of six, in any rotation, whose colours are a linear
//!    map of the chart's, whatever the light and camera;
//! 4. [`flat`], [`exact`]: the exact ends of the patches, at full resolution.
//!
//! A hand, a shadow or the edge of the picture that hides part of a chart changes its colours, from which the
//! confidence is computed.

mod blobs;
mod colours;
mod exact;
mod flat;
mod lattice;
mod placement;
mod plane_map;
mod search;
#[cfg(test)]
mod synthetic;

use nalgebra::Matrix3;

use super::outline::Place;
use super::reduced::Reduced;
use crate::image::photograph::Photograph;
use crate::image::placing::{Homography, Lens, Point, is_inside};
use colours::{COLUMNS, PATCHES, ROWS, departure};
use exact::exact;
use flat::Flat;
use placement::patch;
use plane_map::{projective, seen};
use search::searched;

/// A chart of four rows of six patches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DetectedChart {
    /// Outer corners of the block of patches, px of the upright picture, in the order of
    /// [`CHART_CORNERS`](crate::image::CHART_CORNERS).
    pub corners: [Point; 4],
    /// Probability that all are within a third of a patch of their true positions.
    pub confidence: f64,
}

/// Rounds of the search for patches' edges.
const ROUNDS: usize = 2;
/// Number of clues behind the confidence.
pub const CLUES: usize = 2;
/// Their weights, fitted by `benches/find_fit.py`.
const OFFSET: f64 = -13.88;
const WEIGHTS: [f64; CLUES] = [-1.516, -8.188];
/// Half of a patch's side in cells if its edges are not found: that of a Classic.
const HALF: f64 = 0.44;

impl DetectedChart {
    /// Rows and columns of its patches.
    pub const GRID: [usize; 2] = [ROWS, COLUMNS];
    /// From this confidence on a chart is used without review: among pictures left out of the fit, none at or
    /// above it was wrong.
    pub const SURE: f64 = 0.97;

    /// Whether it may be used without review.
    #[must_use]
    pub fn is_sure(&self) -> bool {
        self.confidence >= Self::SURE
    }
}

/// Finds the colour chart in a photograph.
///
/// # Arguments
/// - `lens`: distortion of the picture; without it the chart's sides are straight.
///
/// # Returns
/// The best match, right or not; none if nothing is similar or the chart is not entirely in the picture.
///
/// # Example
/// ```
/// use vfold::image::{Lens, Photograph, find_chart};
/// let grey = Photograph::from_light(240, 200, vec![0.2; 240 * 200])?;
/// assert_eq!(find_chart(&grey, &Lens::STRAIGHT), None);
/// # Ok::<(), vfold::Error>(())
/// ```
#[must_use]
pub fn find_chart(photograph: &Photograph, lens: &Lens) -> Option<DetectedChart> {
    weighed_chart(photograph, lens).map(|(found, _)| found)
}

/// The same, and the clues behind its confidence, for fitting: logarithms of its patches' rms and largest
/// departures from the chart's colours.
#[must_use]
pub fn weighed_chart(photograph: &Photograph, lens: &Lens) -> Option<(DetectedChart, [f64; CLUES])> {
    most_alike(photograph, &Reduced::of(photograph), lens)
}

/// The same, with the reduced photograph.
pub(super) fn most_alike(
    photograph: &Photograph,
    reduced: &Reduced,
    lens: &Lens,
) -> Option<(DetectedChart, [f64; CLUES])> {
    let (scale, to_picture) = searched(reduced)?;
    let mut map = ideal(lens, &to_picture, scale)?;
    let mut half = HALF;
    for _ in 0..ROUNDS {
        let Some(found) = exact(&Flat::of(photograph, lens, &map), &map) else { break };
        (map, half) = (found.to_picture, found.half);
    }
    let corners = corners(lens, &map, half);
    let is_whole = corners.iter().all(|corner| is_inside(*corner, photograph.width(), photograph.height()));
    if !is_whole || Homography::through(*lens, corners).is_err() {
        return None;
    }
    let departure = departure(&Flat::of(photograph, lens, &map).colours())?;
    let clues = [departure.rms.ln(), departure.worst.ln()];
    let log_odds = OFFSET + WEIGHTS.iter().zip(&clues).map(|(weight, clue)| weight * clue).sum::<f64>();
    Some((DetectedChart { corners, confidence: 1.0 / (1.0 + (-log_odds).exp()) }, clues))
}

/// The map to the undistorted photograph, from a map to a reduced picture whose pixels are `scale` of the
/// photograph's wide.
fn ideal(lens: &Lens, to_picture: &Matrix3<f64>, scale: f64) -> Option<Matrix3<f64>> {
    let pair = |k: usize| {
        let at = seen(to_picture, patch(k)) * scale;
        let ideal = lens.undistort(Point::new(at.x, at.y));
        (patch(k), Place::new(ideal.x, ideal.y))
    };
    projective(&(0..PATCHES).map(pair).collect::<Vec<_>>())
}

/// The outer corners of the block of patches.
fn corners(lens: &Lens, map: &Matrix3<f64>, half: f64) -> [Point; 4] {
    let [right, bottom] = [COLUMNS, ROWS].map(|count| count as f64 - 1.0 + half);
    [(-half, -half), (right, -half), (right, bottom), (-half, bottom)].map(|(x, y)| {
        let ideal = seen(map, Place::new(x, y));
        lens.distort(Point::new(ideal.x, ideal.y))
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // a test stops at the first surprise

    use proptest::prelude::*;

    use super::super::synthetic::{outline, picture};
    use super::synthetic::{HEIGHT, WIDTH, drawn, drawn_through, photograph, tilted};
    use super::*;

    fn found(photograph: &Photograph) -> Option<DetectedChart> {
        find_chart(photograph, &Lens::STRAIGHT).filter(DetectedChart::is_sure)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]

        /// Turned by any angle, even upside down, and leaning away to any side.
        #[test]
        fn charts_are_found_where_they_are(
            turn_deg in 0.0..360.0,
            lean in prop::array::uniform2(-0.5..0.5),
            width in 0.35..0.7,
        ) {
            let corners = tilted(turn_deg, lean, width);
            let found = found(&drawn(corners, |_, colour| colour));
            prop_assert!(found.is_some(), "none at {corners:?}");
            let off = found.map(|found| [0, 1, 2, 3].map(|k| found.corners[k].distance(corners[k])));
            let patch_px = width * WIDTH as f64 / 6.0;
            prop_assert!(off.iter().flatten().all(|off| *off < 0.06 * patch_px), "{off:?}");
        }
    }

    #[test]
    fn what_the_lens_bends_is_undone() {
        let lens = Lens::new([-0.05, 0.0], WIDTH, HEIGHT).unwrap();
        let corners = tilted(20.0, [0.2, 0.1], 0.8);
        let found = find_chart(&drawn_through(lens, corners, |_, colour| colour), &lens).unwrap();
        let off = [0, 1, 2, 3].map(|k| found.corners[k].distance(corners[k]));
        assert!(found.is_sure() && off.iter().all(|off| *off < 1.5), "{off:?}");
    }

    #[test]
    fn a_covered_chart_is_not_claimed() {
        let corners = tilted(10.0, [0.1, 0.2], 0.6);
        for hidden in 0..PATCHES {
            let hand = |k: usize, colour| if k == hidden { [0.4, 0.25, 0.2] } else { colour };
            // a hand may look like light skin, which is patch 1
            assert!(hidden == 1 || found(&drawn(corners, hand)).is_none(), "{hidden}");
        }
    }

    #[test]
    fn patches_of_other_colours_or_greys_are_no_chart() {
        let corners = tilted(0.0, [0.0, 0.0], 0.6);
        let grey = |k: usize, _| [0.05 + 0.2 * (k * 7 % 5) as f64; 3];
        assert_eq!(found(&drawn(corners, grey)), None);
        let turned_colours = |_: usize, [r, g, b]: [f64; 3]| [g * g, b.sqrt(), (r - 0.5).abs()];
        assert_eq!(found(&drawn(corners, turned_colours)), None);
    }

    #[test]
    fn a_chart_cut_by_the_edge_is_none() {
        let cut =
            tilted(0.0, [0.0, 0.0], 0.6).map(|corner| Point::new(corner.x + 0.4 * WIDTH as f64, corner.y));
        assert_eq!(found(&drawn(cut, |_, colour| colour)), None);
    }

    #[test]
    fn tiles_and_folds_are_no_charts() {
        let tile = |x: f64, y: f64| {
            let is_joint = (x / 40.0).fract().min((y / 40.0).fract()) < 0.1;
            if is_joint {
                [0.1; 3]
            } else {
                [0.5, 0.45, 0.4].map(|light| light + 0.05 * (x * y / 1600.0).floor().sin())
            }
        };
        assert_eq!(found(&photograph(tile)), None);
        let checkers = |x: f64, y: f64| [[0.1, 0.7][((x / 30.0) as usize + (y / 30.0) as usize) % 2]; 3];
        assert_eq!(found(&photograph(checkers)), None);
        assert_eq!(found(&picture(&outline(), 1)), None);
    }
}
