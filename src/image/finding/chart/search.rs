//! The chart of a reduced picture: first at half its size, because noise breaks up blobs at full size.

use nalgebra::Matrix3;

use super::super::evidence::steps;
use super::super::plane::Plane;
use super::super::reduced::Reduced;
use super::blobs::blobs;
use super::lattice::lattices;
use super::placement::{Placement, placed};

/// Blur before changes of light are computed, px.
const BLUR_PX: f32 = 0.8;
/// A chart with this many patches seen and colours this near ends the search.
const SEEN: usize = 16;
const NEAR: f64 = 0.08;

/// The number of the photograph's pixels per pixel of a reduced picture or its half, and the map of the chart
/// there.
pub(super) fn searched(reduced: &Reduced) -> Option<(f64, Matrix3<f64>)> {
    let half = reduced.halved();
    let in_half = search(&half);
    let in_whole = if in_half.is_some_and(|found| is_good(&found)) { None } else { search(reduced) };
    let found = [(&half, in_half), (reduced, in_whole)].map(|(picture, found)| Some((picture.scale, found?)));
    let best =
        found.into_iter().flatten().min_by(|(_, a), (_, b)| a.departure.rms.total_cmp(&b.departure.rms));
    best.map(|(scale, found)| (scale as f64, found.to_picture))
}

fn is_good(placement: &Placement) -> bool {
    placement.blobs >= SEEN && placement.departure.rms < NEAR
}

/// The chart of a reduced picture with the smallest departure.
fn search(picture: &Reduced) -> Option<Placement> {
    let [xx, yy, _] = steps(&picture.even(), BLUR_PX);
    let values = xx.values.iter().zip(&yy.values).map(|(xx, yy)| (xx + yy).sqrt()).collect();
    let blobs = blobs(&Plane { width: picture.width, values });
    let light = picture.planes(|light| light);
    let mut best: Option<Placement> = None;
    lattices(&blobs, |lattice| {
        let least = best.map_or(f64::INFINITY, |best| best.departure.rms);
        if let Some(found) = placed(lattice, &light).filter(|found| found.departure.rms < least) {
            best = Some(found);
        }
        best.is_some_and(|best| is_good(&best))
    });
    best
}
