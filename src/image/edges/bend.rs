//! The distortion of a lens, from the bend of straight sides.
//!
//! The sides of panels opposite the crease are straight in space, even if the sheet bows, so that only the
//! lens bends their pictures: by k1, the side's distance from the picture's centre, and the square of the
//! place along it.

use rayon::prelude::*;

use super::edge::{EdgeModel, Side};
use crate::image::photograph::Photograph;
use crate::image::placing::{Lens, LensEstimate, Point};

/// Bend of a side cut by hand, relative to its length.
const CUT_SD: f64 = 0.002;
/// Bends up to this many standard deviations are considered, and at least so many px.
const REACH_SDS: f64 = 3.0;
const LEAST_REACH_PX: f64 = 1.0;

/// A straight side of a sheet in the ideal picture: its ends, and another point of the sheet.
pub(super) struct StraightSide {
    pub ends: [Point; 2],
    pub inner: Point,
}

/// The lens under which the sides are straight.
///
/// # Arguments
/// - `known`: the lens as known without them.
/// - `now`: the lens of the ideal picture; its standard deviation limits the search.
/// - `model`: as for [`Side::look`].
///
/// # Returns
/// The lens, and how far the middle of any side was from the line between its ends, px.
pub(super) fn straightening_lens(
    photograph: &Photograph,
    [known, now]: [&LensEstimate; 2],
    sides: &[StraightSide],
    model: EdgeModel,
) -> (LensEstimate, f64) {
    let size = [photograph.width(), photograph.height()];
    let seen = |StraightSide { ends, inner }: &StraightSide| {
        let side = Side::new(ends[0], ends[1]);
        let per_k1 = bend_per_k1(size, &side, *ends);
        let reach_px = (REACH_SDS * now.k1_sd * per_k1.abs()).max(LEAST_REACH_PX);
        let [bend_px, sd_px] = side.bend_px(photograph, &now.lens, (reach_px, *inner), model)?;
        let weight = per_k1 / (sd_px * sd_px + (CUT_SD * ends[0].distance(ends[1])).powi(2));
        Some((per_k1, weight, bend_px))
    };
    let seen: Vec<_> = sides.par_iter().filter_map(seen).collect();
    let already = now.lens.coefficients()[0] - known.lens.coefficients()[0];
    let (mut information, mut pull, mut most_px) = (known.k1_sd.powi(-2), 0.0, 0.0_f64);
    for (per_k1, weight, bend_px) in seen {
        information += weight * per_k1;
        pull += weight * (bend_px + per_k1 * already);
        most_px = most_px.max(bend_px.abs());
    }
    match known.lens.with_k1_more(pull / information, size) {
        Ok(lens) => (LensEstimate { lens, k1_sd: information.sqrt().recip() }, most_px),
        Err(_) => (*now, 0.0),
    }
}

/// Bend of a straight side by a lens, px, per unit of its k1.
fn bend_per_k1(size: [usize; 2], side: &Side, ends: [Point; 2]) -> f64 {
    const SMALL: f64 = 1e-3;
    let Ok(lens) = Lens::new([SMALL, 0.0], size[0], size[1]) else { return 0.0 };
    let middle = |[a, b]: [Point; 2]| Point::new((a.x + b.x) / 2.0, (a.y + b.y) / 2.0);
    let (line, seen) = (middle(ends.map(|end| lens.distort(end))), lens.distort(middle(ends)));
    side.across_px(line, seen) / SMALL
}
