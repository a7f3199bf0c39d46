//! Where a colour chart of 24 patches is in a photograph, and how sure that is.
//!
//! Four rows of six patches, as ColorChecker Classic, Passport and Nano have them:
//!
//! 1. [`blobs`]: places of even light;
//! 2. [`lattice`], [`plane_map`]: those of them that lie in rows and columns, in any perspective;
//! 3. [`placement`], [`colours`]: the four rows of six, turned any way, whose colours a linear map makes of the chart's, whatever light and camera are;
//! 4. [`flat`], [`exact`]: exactly where its patches end, in the whole picture.
//!
//! Blobs are looked for in a picture of half the size too: noise breaks them up, and blur hides them.

mod blobs;
mod colours;
mod exact;
mod flat;
mod lattice;
mod placement;
mod plane_map;

use nalgebra::Matrix3;

use super::evidence::steps;
use super::outline::Place;
use super::plane::Plane;
use super::reduced::Reduced;
use crate::image::photograph::Photograph;
use crate::image::placing::{Homography, Lens, Point, is_inside};
use blobs::blobs;
use colours::{COLUMNS, PATCHES, ROWS, departure};
use exact::exact;
use flat::Flat;
use lattice::lattices;
use placement::{Placement, patch, placed};
use plane_map::{projective, seen};

/// A chart of four rows of six patches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FoundChart {
    /// Outer corners of the block of patches, px of the upright picture, in the order of [`CHART_CORNERS`](crate::image::CHART_CORNERS).
    pub corners: [Point; 4],
    /// Probability that all of them are within a third of a patch of where they should be.
    pub confidence: f64,
}

/// Blur before changes of light are looked at, px.
const BLUR_PX: f32 = 0.8;
/// A chart with so many patches seen and so little left unexplained is not looked for further.
const SEEN: usize = 16;
const EXPLAINED: f64 = 0.01;
/// Rounds in which patches' edges are looked for.
const ROUNDS: usize = 2;

pub fn find_chart(photograph: &Photograph, lens: &Lens) -> Option<FoundChart> {
    weighed_chart(photograph, lens).map(|(found, _)| found)
}

pub fn weighed_chart(photograph: &Photograph, lens: &Lens) -> Option<(FoundChart, [f64; 5])> {
    let reduced = Reduced::of(photograph);
    let mut best: Option<(f64, Placement)> = None;
    for (scale, picture) in [(2.0, reduced.halved()), (1.0, reduced.clone())] {
        let found = search(&picture);
        let is_better = |found: &Placement| {
            best.is_none_or(|(_, best)| found.departure.unexplained < best.departure.unexplained)
        };
        if let Some(found) = found.filter(is_better) {
            best = Some((scale * reduced.scale as f64, found));
        }
        if best.is_some_and(|(_, best)| is_good(&best)) {
            break;
        }
    }
    let (scale, placement) = best?;
    let mut map = ideal(lens, &placement.to_picture, scale)?;
    let mut last = None;
    for _ in 0..ROUNDS {
        let flat = Flat::of(photograph, lens, &map);
        let Some(found) = exact(&flat, &map) else { break };
        map = found.to_picture;
        last = Some(found);
    }
    let found = last?;
    let flat = Flat::of(photograph, lens, &map);
    let departure = departure(&flat.colours())?;
    let corners = corners(lens, &map, found.half);
    let is_whole = corners.iter().all(|corner| is_inside(*corner, photograph.width(), photograph.height()));
    let weighed = [
        departure.unexplained,
        departure.worst,
        placement.blobs as f64,
        found.patches as f64,
        found.off,
    ];
    let confidence = 1.0;
    (is_whole && Homography::through(*lens, corners).is_ok()).then_some((FoundChart { corners, confidence }, weighed))
}

fn is_good(placement: &Placement) -> bool {
    placement.blobs >= SEEN && placement.departure.unexplained < EXPLAINED
}

/// The chart of a reduced picture that departs least from one.
fn search(picture: &Reduced) -> Option<Placement> {
    let [xx, yy, _] = steps(&picture.even(), BLUR_PX);
    let values = xx.values.iter().zip(&yy.values).map(|(xx, yy)| (xx + yy).sqrt()).collect();
    let blobs = blobs(&Plane { width: picture.width, values });
    let light = picture.planes(|light| light);
    let mut best: Option<Placement> = None;
    lattices(&blobs, |lattice| {
        let least = best.map_or(f64::INFINITY, |best| best.departure.unexplained);
        if let Some(found) = placed(lattice, &light).filter(|found| found.departure.unexplained < least) {
            best = Some(found);
        }
        best.is_some_and(|best| is_good(&best))
    });
    best
}

/// The map to the photograph without what its lens bends, from one to the picture that so many of its pixels are a pixel of.
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
