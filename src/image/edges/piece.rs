//! The pixels along a piece of a side, and how well an edge at each of several distances explains them.
//!
//! The model is two planes of light with the edge between them, mixed by area in the pixels that the edge
//! crosses: a sheet may be as bright as the table, but of another colour. A change that smooth light explains
//! as well is no edge. Nor may the edge be the end of a sheet's shadow: up to its edge the sheet must
//! continue as it is further inwards, and the strongest edge may lie beyond that of the sheet.

use std::ops::Range;

use nalgebra::{Vector2, Vector3};

use super::fit::{COEFFICIENTS, Fit, OF_A_SIDE, Share, Sums};

/// Distances at which an edge is tried.
pub(super) const PLACES: usize = 25;
/// Extra spread of an edge by the lens to either side, px, in addition to that of a pixel.
const BLURS_PX: [f64; BLURS] = [0.0, 2.0, 4.0, 9.0];
pub(super) const BLURS: usize = 4;
/// Clearance between the sheet pixels examined and an edge, for each blur, px, in addition to
/// [`CLEARANCE_PX`].
const CLEAR_PX: [f64; BLURS] = [0.0, 0.0, 3.0, 6.75];
/// Least extent of a pixel that its corners have across an edge, px: steeper shares lose digits in sums.
const NARROWEST_PX: f64 = 0.02;
/// Residuals below this fraction of the light count as zero.
const EXACT: f64 = 1e-3;
/// Largest variation of a sheet's light up to its edge, relative to that further inwards.
const UNEVEN: f64 = 2.0;
/// Pixels nearer to an edge than this may see beyond it, px.
const CLEARANCE_PX: f64 = 2.0;
/// Least width of what lies between a sheet's edge and another one, beyond that clearance, px.
const STRIP_PX: f64 = 1.0;
/// Distance between the places at which the strongest edge is sought, px.
const SOUGHT_PX: f64 = 0.5;

/// The pixels of a piece of a side.
pub(super) struct Piece {
    /// Its position along the side, from 0 to 1.
    pub place: f64,
    /// Their greatest distance from the side, px, the unit of all others.
    width_px: f64,
    /// Distances of the pixels, sorted.
    distances: Vec<f64>,
    /// Sums over the first k pixels, for k from none to all.
    sums: Vec<Sums>,
    /// Sums of squares that count as zero.
    exact: Vector3<f64>,
    /// Sums of squares that smooth light leaves, if it is determined.
    smooth: Option<Vector3<f64>>,
    /// Independent channels: the three of a grey picture count as one.
    channels: usize,
}

/// Distance of a tried place from the side.
pub(super) fn offset(place: usize, reach_px: f64) -> f64 {
    reach_px * (2.0 * place as f64 / (PLACES - 1) as f64 - 1.0)
}

impl Piece {
    /// Some pixels, each with its distance from the side, px, at most `width_px`, and its light.
    pub fn new(place: f64, width_px: f64, mut pixels: Vec<(f64, Vector3<f64>)>) -> Self {
        let is_grey = pixels.iter().all(|(_, light)| light.max() <= light.min());
        let brightest = pixels.iter().fold(Vector3::zeros(), |most, (_, light)| light.abs().sup(&most));
        let exact = brightest.map(|light: f64| pixels.len() as f64 * (EXACT * light).powi(2));
        pixels.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let count = pixels.len();
        let (mut distances, mut sums) = (Vec::with_capacity(count), Vec::with_capacity(count + 1));
        sums.push(Sums::default());
        for (distance_px, light) in pixels {
            let distance = distance_px / width_px;
            distances.push(distance);
            sums.push(sums[sums.len() - 1].with(distance, &light));
        }
        let channels = if is_grey { 1 } else { 3 };
        let mut piece = Self { place, width_px, distances, sums, exact, smooth: None, channels };
        piece.smooth = piece.left_by(piece.all(), &Fit::smooth(piece.all()));
        piece
    }

    /// Gain in log likelihood of an edge at each place over none.
    pub fn gains(&self, across: &Vector2<f64>, blur: usize, reach_px: f64) -> [f64; PLACES] {
        let spread_px = spread_px(across, BLURS_PX[blur]);
        std::array::from_fn(|place| self.gain(offset(place, reach_px), spread_px).unwrap_or(0.0))
    }

    /// The same of a sheet that ends at each place, if the strongest edge is that of its shadow beyond;
    /// infinitely small where light does not change between the place and that edge, or that edge ends no
    /// shadow.
    pub fn gains_before_shadow(
        &self,
        (across, inwards): (&Vector2<f64>, f64),
        blur: usize,
        reach_px: f64,
    ) -> [f64; PLACES] {
        let (spread_px, clear_px) = (spread_px(across, BLURS_PX[blur]), CLEARANCE_PX + CLEAR_PX[blur]);
        let gains = || {
            let furthest_px = self.width_px - clear_px - STRIP_PX;
            let sought = (0..=(2.0 * furthest_px / SOUGHT_PX) as usize)
                .map(|n| n as f64 * SOUGHT_PX - furthest_px)
                .filter_map(|edge_px| Some((self.gain(edge_px, spread_px)?, edge_px)));
            let (gain_of_other, other_px) = sought.max_by(|a, b| a.0.total_cmp(&b.0))?;
            let [further, end, strip] = [-clear_px, clear_px, clear_px + STRIP_PX]
                .map(|inside_px| self.nearer_than(other_px + inwards * inside_px));
            let count = self.distances.len();
            let [inside, strip, beyond] = if inwards > 0.0 {
                [end..count, end..strip, 0..further]
            } else {
                [0..end, strip..end, further..count]
            };
            if !self.is_darker(&strip, &beyond) {
                return None;
            }
            let usual = self.usual(inwards, reach_px)? * inside.len() as f64;
            let one_plane = self.sums_of(&inside).residual()? + usual;
            // of the place and of the second plane in each channel, by the Bayesian information criterion
            let penalty = 0.5 * (inside.len() as f64).ln() * (1.0 + OF_A_SIDE * self.channels as f64);
            let of_place = |place: usize| {
                let edge_px = offset(place, reach_px);
                let two_planes = (inwards * (edge_px - other_px) >= clear_px + STRIP_PX)
                    .then(|| self.edge_residual(&inside, edge_px, spread_px))??;
                let step = spare(&inside) * self.sum_of_ln(one_plane, two_planes + usual) - penalty;
                (step > 0.0).then_some(gain_of_other + step)
            };
            Some(std::array::from_fn(|place| of_place(place).unwrap_or(f64::NEG_INFINITY)))
        };
        gains().unwrap_or([f64::NEG_INFINITY; PLACES])
    }

    /// Loss in log likelihood of the light inside an edge at each place, compared with a sheet that continues
    /// up to there.
    pub fn breaks(&self, inwards: f64, reach_px: f64, blur: usize) -> [f64; PLACES] {
        let Some(usual) = self.usual(inwards, reach_px) else { return [0.0; PLACES] };
        std::array::from_fn(|place| {
            self.unevenness(inwards, inwards * offset(place, reach_px) + CLEARANCE_PX + CLEAR_PX[blur])
                .map_or(0.0, |(variance, count)| 0.5 * count * self.sum_of_ln(variance.sup(&usual), usual))
        })
    }

    /// The largest variance of a sheet's light that is not unusual up to its edge.
    fn usual(&self, inwards: f64, reach_px: f64) -> Option<Vector3<f64>> {
        self.unevenness(inwards, reach_px).map(|(further, _)| further * UNEVEN * UNEVEN)
    }

    /// Variance of the light about a plane, over the pixels whose distance times `inwards` exceeds
    /// `least_px`, and their number.
    fn unevenness(&self, inwards: f64, least_px: f64) -> Option<(Vector3<f64>, f64)> {
        let sums = self.sums_beyond(least_px, inwards);
        Some(((sums.residual()? + self.exact) / sums.count(), sums.count()))
    }

    /// Gain in log likelihood of an edge at this distance from the side over none.
    fn gain(&self, edge_px: f64, spread_px: [f64; 2]) -> Option<f64> {
        let all = 0..self.distances.len();
        let edge = self.edge_residual(&all, edge_px, spread_px)?;
        let gain = spare(&all) * self.sum_of_ln(self.smooth? + self.exact, edge + self.exact);
        Some(gain).filter(|gain| gain.is_finite())
    }

    /// Sums over all pixels.
    fn all(&self) -> &Sums {
        &self.sums[self.distances.len()]
    }

    /// Number of pixels with smaller distances.
    fn nearer_than(&self, distance_px: f64) -> usize {
        let distance = distance_px / self.width_px;
        self.distances.partition_point(|other| *other < distance)
    }

    /// Sums over the pixels whose distance times `inwards`, 1 or -1, exceeds `least_px`.
    fn sums_beyond(&self, least_px: f64, inwards: f64) -> Sums {
        let first = &self.sums[self.nearer_than(inwards * least_px)];
        if inwards > 0.0 { self.all().without(first) } else { *first }
    }

    /// Sums over some of the pixels.
    fn sums_of(&self, pixels: &Range<usize>) -> Sums {
        self.sums[pixels.end].without(&self.sums[pixels.start])
    }

    /// Whether some of the pixels are darker in the mean than others, in every channel.
    fn is_darker(&self, some: &Range<usize>, others: &Range<usize>) -> bool {
        let [some, others] = [some, others].map(|pixels| self.sums_of(pixels).mean());
        some.iter().zip(others.iter()).all(|(some, others)| some < others)
    }

    /// Residual, over some of the pixels, of two planes of light that meet at this distance from the side.
    fn edge_residual(
        &self,
        pixels: &Range<usize>,
        edge_px: f64,
        [wide_px, narrow_px]: [f64; 2],
    ) -> Option<Vector3<f64>> {
        let [wide, narrow, edge] = [wide_px, narrow_px, edge_px].map(|px| px / self.width_px);
        let (outer_px, inner_px) = ((wide_px + narrow_px) / 2.0, (wide_px - narrow_px) / 2.0);
        let up_to = |from_edge: f64| {
            let end = self.nearer_than(edge_px + from_edge).clamp(pixels.start, pixels.end);
            self.sums_of(&(pixels.start..end))
        };
        let ends = [up_to(-outer_px), up_to(-inner_px), up_to(inner_px), up_to(outer_px)];
        let all = self.sums_of(pixels);
        let shares = shares_beyond(wide, narrow).map(|share| shifted(share, edge));
        self.left_by(&all, &Fit::of_planes(ends.each_ref(), shares, &all))
    }

    /// Sum of squared residuals of a fit in each channel; none if the fit is not unique or pixels are too
    /// few.
    fn left_by(&self, pixels: &Sums, fit: &Fit) -> Option<Vector3<f64>> {
        let left = (pixels.light_squares - fit.explained()?).sup(&Vector3::zeros());
        (pixels.count() > 2.0 * COEFFICIENTS as f64).then_some(left)
    }

    /// Sum over the channels of the logarithms of ratios.
    fn sum_of_ln(&self, over: Vector3<f64>, under: Vector3<f64>) -> f64 {
        over.component_div(&under).iter().take(self.channels).map(|ratio| ratio.ln()).sum()
    }
}

/// Half the number of residuals of an edge's fit that noise determines.
fn spare(pixels: &Range<usize>) -> f64 {
    0.5 * (pixels.len() as f64 - COEFFICIENTS as f64 - 1.0)
}

/// Extents across a line with this unit normal of a pixel widened by `blur_px`, the longer first.
fn spread_px(normal: &Vector2<f64>, blur_px: f64) -> [f64; 2] {
    [normal.amax() + blur_px, normal.amin().max(NARROWEST_PX) + blur_px]
}

/// Fraction of a pixel with these extents across a line that lies beyond it, as a polynomial of how far its
/// centre does: where the line cuts a corner, two opposite sides, and another corner.
fn shares_beyond(wide: f64, narrow: f64) -> [Share; 3] {
    let (outer, inner) = ((wide + narrow) / 2.0, (wide - narrow) / 2.0);
    let [outer_square, inner_square] = [outer * outer, inner * inner];
    let shares = [
        [outer_square, 2.0 * outer, 1.0],
        [outer_square - inner_square, 2.0 * narrow, 0.0],
        [outer_square - 2.0 * inner_square, 2.0 * outer, -1.0],
    ];
    shares.map(|share| share.map(|factor| factor / (2.0 * wide * narrow)))
}

/// The polynomial of the distance from a line as one of the distance from the side, from which the line is
/// this far.
fn shifted([constant, slope, bend]: Share, line: f64) -> Share {
    [constant - line * (slope - line * bend), slope - 2.0 * line * bend, bend]
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // a test stops at the first surprise

    use super::*;
    use proptest::prelude::*;

    /// Two planes of light that pixels near the edge mix by their shares leave nothing, and leave something
    /// where the edge is tried elsewhere.
    #[test]
    fn an_edge_explains_its_pixels_by_sums() {
        for (blur_px, across) in [(0.0, Vector2::new(0.0, 1.0)), (2.0, Vector2::new(0.6, 0.8))] {
            let (edge_px, width_px) = (1.3, 16.0);
            let [wide, narrow] = spread_px(&across, blur_px);
            let (outer, inner) = ((wide + narrow) / 2.0, (wide - narrow) / 2.0);
            let ramp = |x: f64| x.max(0.0).powi(2) / 2.0;
            let share = |z: f64| match z {
                z if z >= outer => 1.0,
                z => (ramp(z + outer) - ramp(z + inner) - ramp(z - inner)) / (wide * narrow),
            };
            let pixel = |k: u32| {
                let distance = f64::from(k) * 0.0799 - 15.9;
                let beyond = share(distance - edge_px);
                let planes = [0.8 - 0.01 * distance, 0.1 + 0.02 * distance];
                let light = planes[0] * (1.0 - beyond) + planes[1] * beyond;
                (distance, Vector3::new(light, 0.5 * light, 0.3 + light))
            };
            let piece = Piece::new(0.5, width_px, (0..400).map(pixel).collect());
            let left = |edge_px| piece.edge_residual(&(0..400), edge_px, [wide, narrow]).unwrap().amax();
            assert!(left(edge_px) < 1e-6 && left(edge_px + 0.5) > 1e-3, "{blur_px}: {}", left(edge_px));
        }
    }

    proptest! {
        /// Against the mean over 400 x 400 points of the pixel.
        #[test]
        fn the_share_of_a_pixel_is_its_area(z in -1.0..1.0, angle in 0.0..6.3) {
            let normal = Vector2::new(f64::cos(angle), f64::sin(angle));
            let place = |k: usize| (k as f64 + 0.5) / 400.0 - 0.5;
            let beyond = |k: &usize| z + normal.x * place(k % 400) + normal.y * place(k / 400) > 0.0;
            let share = (0..160_000).filter(beyond).count() as f64 / 160_000.0;
            let [wide, narrow] = spread_px(&normal, 0.0);
            let (outer, inner) = ((wide + narrow) / 2.0, (wide - narrow) / 2.0);
            let ends = [-outer, -inner, inner, outer];
            let found = match ends.iter().filter(|end| **end <= z).count() {
                0 => 0.0,
                4 => 1.0,
                cut => {
                    let [constant, slope, bend] = shifted(shares_beyond(wide, narrow)[cut - 1], 0.3);
                    constant + (z + 0.3) * (slope + (z + 0.3) * bend)
                }
            };
            prop_assert!((found - share).abs() < 3e-3, "{found} {share}");
        }
    }
}
