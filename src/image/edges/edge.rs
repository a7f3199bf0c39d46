//! The straight edge near a side of a panel.
//!
//! The pixels around the side are looked at in pieces along it. For each place where an edge may cross a piece, its pixels are
//! explained as two planes of light with the edge between them, mixed by area in the pixels that it crosses; the residuals of all
//! pieces and all channels together tell how likely each line is: a sheet may be as bright as the table, but not of its colour. A
//! step and a kink are both found so, to a fraction of a pixel, in noise that hides them in any one row of pixels. What smooth light
//! explains as well is no edge. Behind a sheet its shadow may end, too: up to the edge the sheet goes on as it is further inwards.

use nalgebra::{Matrix2, SMatrix, SVector, Vector2, Vector3};

use crate::image::photograph::{Photograph, Pixel};
use crate::image::placing::{Lens, Point, Quadrilateral};

/// Pieces along a side.
const PIECES: usize = 24;
/// Part of a side that is left out at each end, beyond the reach: other edges are near.
const END: f64 = 0.03;
/// Most of a side that is left out at each end.
const LONGEST_END: f64 = 0.25;
/// Pixels are looked at this much further away than an edge is looked for, px: they tell the light on both sides.
const FLANK_PX: f64 = 10.0;
/// How far a lens may spread an edge to either side, px, beyond what a pixel does; the likeliest is taken.
const BLURS_PX: [f64; 3] = [0.0, 2.0, 4.0];
/// A piece is at most this long, px: more pixels would tell more than the model is true.
const LONGEST_PX: f64 = 16.0;
/// Distances at which an edge is tried at each end of a side.
const PLACES: usize = 25;
/// An edge explains its pixels better than smooth light by at least this, in log likelihood.
const LEAST_GAIN: f64 = 20.0;
/// Residuals below this part of the light count as nothing.
const EXACT: f64 = 1e-3;
/// Numbers that explain a piece: two planes of light, or a polynomial across it.
const COEFFICIENTS: usize = 4;
/// A sheet goes on up to its edge if its light varies there by no more than this, relative to further inwards.
const UNEVEN: f64 = 2.0;
/// Pixels nearer to an edge than that may see what is beyond it, px.
const BESIDE_PX: f64 = 2.0;
/// How exactly a step is where the model of an edge has it, px, and a kink: light curves on both sides of a crease.
const STEP_SD_PX: f64 = 0.015;
const KINK_SD_PX: f64 = 0.5;

/// Where the edge at a side is: its distances from the side's two ends, px, as a normal distribution.
#[derive(Debug, Clone)]
pub(super) struct Edge {
    /// Inverse of the covariance.
    pub information: Matrix2<f64>,
    /// Information times mean.
    pub pull: Vector2<f64>,
    /// Standard deviation at the less certain end.
    pub sd_px: f64,
}

/// A side of a panel in the ideal picture.
pub(super) struct Side {
    from: Point,
    length: f64,
    along: Vector2<f64>,
}

/// Some pixels near a side.
struct Piece {
    /// Where it is along the side, from 0 to 1.
    place: f64,
    /// Distance from the side, px, and light.
    pixels: Vec<(f64, Vector3<f64>)>,
    /// Channels that tell something of their own: the three of a grey picture are one.
    channels: usize,
}

impl Side {
    pub fn new(from: Point, to: Point) -> Self {
        let length = from.distance(to);
        Self { from, length, along: Vector2::new(to.x - from.x, to.y - from.y) / length }
    }

    /// The direction in which distances from the side count.
    pub fn across(&self) -> Vector2<f64> {
        Vector2::new(-self.along.y, self.along.x)
    }

    /// The edge within `reach_px` of the side, if there is one. `inner`: a place on the sheet, if that ends here.
    pub fn edge(
        &self,
        photograph: &Photograph,
        lens: &Lens,
        reach_px: f64,
        inner: Option<Point>,
    ) -> Option<Edge> {
        let pieces = self.pieces(photograph, lens, reach_px);
        let inwards = inner.map(|inner| {
            Vector2::new(inner.x - self.from.x, inner.y - self.from.y).dot(&self.across()).signum()
        });
        let breaks = |piece: &Piece| inwards.map_or([0.0; PLACES], |inwards| piece.breaks(inwards, reach_px));
        let breaks: Vec<_> = pieces.iter().map(breaks).collect();
        let lines: Vec<[usize; 2]> =
            (0..PLACES * PLACES).map(|line| [line / PLACES, line % PLACES]).collect();
        let likelihoods = |blur_px| -> Vec<f64> {
            let gains = |(piece, breaks): (&Piece, &[f64; PLACES])| {
                let gains = piece.gains(&self.across(), blur_px, reach_px);
                (piece.place, std::array::from_fn(|place| gains[place] - breaks[place]))
            };
            let gains: Vec<_> = pieces.iter().zip(&breaks).map(gains).collect();
            lines.iter().map(|line| log_likelihood(&gains, *line)).collect()
        };
        let greatest = |likelihoods: &[f64]| likelihoods.iter().copied().fold(0.0, f64::max);
        let likelihoods =
            BLURS_PX.map(likelihoods).into_iter().max_by(|a, b| greatest(a).total_cmp(&greatest(b)))?;
        let greatest = greatest(&likelihoods);
        if greatest < LEAST_GAIN {
            return None;
        }
        let weighted = lines.iter().zip(&likelihoods).map(|(line, likelihood)| {
            let ends = line.map(|place| offset(place, reach_px));
            (Vector2::from(ends), (likelihood - greatest).exp())
        });
        let model_sd_px = if inner.is_some() { STEP_SD_PX } else { KINK_SD_PX };
        Some(Edge::of(weighted, reach_px, model_sd_px))
    }

    fn pieces(&self, photograph: &Photograph, lens: &Lens, reach_px: f64) -> Vec<Piece> {
        let end = (END + reach_px / self.length).min(LONGEST_END);
        let half = ((1.0 - 2.0 * end) / PIECES as f64).min(LONGEST_PX / self.length) / 2.0;
        let middle = |k: usize| end + (1.0 - 2.0 * end) * (k as f64 + 0.5) / PIECES as f64;
        let piece =
            |k| self.piece(photograph, lens, [middle(k) - half, middle(k) + half], reach_px + FLANK_PX);
        (0..PIECES).map(piece).collect()
    }

    /// The usable pixels between two places along the side, no further than `width_px` from it.
    fn piece(&self, photograph: &Photograph, lens: &Lens, places: [f64; 2], width_px: f64) -> Piece {
        let [a, b] = places.map(|place| place * self.length);
        let corners = [(a, -width_px), (b, -width_px), (b, width_px), (a, width_px)];
        let outline =
            Quadrilateral::new(&corners.map(|(along, across)| lens.distort(self.at(along, across))));
        let mut pixels = Vec::new();
        for y in outline.rows(photograph.height()) {
            for x in outline.touched_columns(y, photograph.width()) {
                let centre = lens.undistort(Point::new(x as f64 + 0.5, y as f64 + 0.5));
                let from = Vector2::new(centre.x - self.from.x, centre.y - self.from.y);
                let (along, across) = (from.dot(&self.along), from.dot(&self.across()));
                if let Pixel::Light(light) = photograph.pixel(x, y)
                    && (a..b).contains(&along)
                    && across.abs() <= width_px
                {
                    pixels.push((across, Vector3::from(light)));
                }
            }
        }
        let is_grey = pixels.iter().all(|(_, light)| light.max() <= light.min());
        Piece { place: (places[0] + places[1]) / 2.0, pixels, channels: if is_grey { 1 } else { 3 } }
    }

    fn at(&self, along: f64, across: f64) -> Point {
        let p = self.along * along + self.across() * across;
        Point::new(self.from.x + p.x, self.from.y + p.y)
    }
}

/// Distance from the side of a place that is tried.
fn offset(place: usize, reach_px: f64) -> f64 {
    reach_px * (2.0 * place as f64 / (PLACES - 1) as f64 - 1.0)
}

/// By how much the edge that passes the side's ends at two places explains all pieces better than smooth light.
fn log_likelihood(gains: &[(f64, [f64; PLACES])], [from, to]: [usize; 2]) -> f64 {
    let of_piece = |(place, gains): &(f64, [f64; PLACES])| {
        let crossing = from as f64 + (to as f64 - from as f64) * place;
        let below = (crossing as usize).min(PLACES - 2);
        let part = crossing - below as f64;
        gains[below] * (1.0 - part) + gains[below + 1] * part
    };
    gains.iter().map(of_piece).sum()
}

impl Piece {
    /// Gain in log likelihood of an edge at each of the places over none.
    fn gains(&self, across: &Vector2<f64>, blur_px: f64, reach_px: f64) -> [f64; PLACES] {
        let (count, exact) = (self.pixels.len() as f64, self.exact());
        let width_px = reach_px + FLANK_PX;
        let all = || self.pixels.iter();
        let smooth = residual(all(), |distance| {
            let d = distance / width_px;
            [1.0, d, d * d, d * d * d]
        });
        let gain = |place| {
            let edge = residual(all(), |distance| {
                let z = distance - offset(place, reach_px);
                let beyond = share_beyond(z, across, blur_px);
                [1.0 - beyond, (1.0 - beyond) * z, beyond, beyond * z]
            })?;
            let spare = count - COEFFICIENTS as f64 - 1.0;
            Some(0.5 * spare * self.sum_of_ln(smooth? + exact, edge + exact))
        };
        std::array::from_fn(|place| gain(place).filter(|gain| gain.is_finite()).unwrap_or(0.0))
    }

    /// By how much the light inside an edge at each of the places is less likely than it would be if the sheet went on up to there.
    fn breaks(&self, inwards: f64, reach_px: f64) -> [f64; PLACES] {
        let within = |least: f64| {
            let pixels = self.pixels.iter().filter(move |(distance, _)| inwards * distance > least);
            let count = pixels.clone().count() as f64;
            Some((residual(pixels, |distance| [1.0, distance])? / count + self.exact() / count, count))
        };
        let Some((further, _)) = within(reach_px) else { return [0.0; PLACES] };
        let usual = further * UNEVEN * UNEVEN;
        std::array::from_fn(|place| {
            within(inwards * offset(place, reach_px) + BESIDE_PX)
                .map_or(0.0, |(variance, count)| 0.5 * count * self.sum_of_ln(variance.sup(&usual), usual))
        })
    }

    /// Sums of squares that count as nothing.
    fn exact(&self) -> Vector3<f64> {
        let brightest = self.pixels.iter().fold(Vector3::zeros(), |most, (_, light)| light.abs().sup(&most));
        brightest.map(|light: f64| self.pixels.len() as f64 * (EXACT * light).powi(2))
    }

    /// Sum over the channels of the logarithms of ratios.
    fn sum_of_ln(&self, over: Vector3<f64>, under: Vector3<f64>) -> f64 {
        over.component_div(&under).iter().take(self.channels).map(|ratio| ratio.ln()).sum()
    }
}

/// Sum of squares that the best combination of basis functions of the distance leaves in each channel; none if there is no one best.
fn residual<'a, const COUNT: usize>(
    pixels: impl Iterator<Item = &'a (f64, Vector3<f64>)>,
    basis: impl Fn(f64) -> [f64; COUNT],
) -> Option<Vector3<f64>> {
    let mut normal = SMatrix::<f64, COUNT, COUNT>::zeros();
    let (mut right, mut squares, mut count) = (SMatrix::<f64, COUNT, 3>::zeros(), Vector3::zeros(), 0);
    for (distance, light) in pixels {
        let basis = SVector::from(basis(*distance));
        normal += basis * basis.transpose();
        right += basis * light.transpose();
        squares += light.component_mul(light);
        count += 1;
    }
    let explained = normal.cholesky()?.solve(&right).component_mul(&right).row_sum_tr();
    (count > 2 * COUNT).then_some((squares - explained).sup(&Vector3::zeros()))
}

/// Part of a pixel beyond a line with this unit normal, its centre lying `z` beyond it, if it saw by `blur_px` more to all sides.
fn share_beyond(z: f64, normal: &Vector2<f64>, blur_px: f64) -> f64 {
    let (wide, narrow) = (normal.amax() + blur_px, normal.amin().max(1e-3) + blur_px);
    let ramp = |x: f64| x.max(0.0).powi(2) / 2.0;
    let (outer, inner) = ((wide + narrow) / 2.0, (wide - narrow) / 2.0);
    match z {
        z if z <= -outer => 0.0,
        z if z >= outer => 1.0,
        z => (ramp(z + outer) - ramp(z + inner) - ramp(z - inner)) / (wide * narrow),
    }
}

impl Edge {
    /// Mean and covariance of weighted lines; of lines all equally likely, or likely at both ends of the reach, nothing is known.
    fn of(lines: impl Iterator<Item = (Vector2<f64>, f64)> + Clone, reach_px: f64, model_sd_px: f64) -> Self {
        let total: f64 = lines.clone().map(|(_, weight)| weight).sum();
        let mean = lines.clone().map(|(ends, weight)| ends * weight).sum::<Vector2<f64>>() / total;
        let square = |(ends, weight): (Vector2<f64>, f64)| (ends - mean) * (ends - mean).transpose() * weight;
        let covariance = lines.map(square).sum::<Matrix2<f64>>() / total
            + Matrix2::from_diagonal_element(model_sd_px.powi(2));
        let sd_px = covariance.diagonal().amax().sqrt();
        let nothing = 1.0 / (reach_px * reach_px / 3.0 + model_sd_px.powi(2));
        let known = covariance.try_inverse().and_then(|inverse| {
            let information = inverse - Matrix2::from_diagonal_element(nothing);
            information.cholesky().map(|_| Self { information, pull: inverse * mean, sd_px })
        });
        known.unwrap_or(Self { information: Matrix2::zeros(), pull: Vector2::zeros(), sd_px })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Against the mean over 400 x 400 points of the pixel.
        #[test]
        fn the_share_of_a_pixel_is_its_area(z in -1.0..1.0, angle in 0.0..6.3) {
            let normal = Vector2::new(f64::cos(angle), f64::sin(angle));
            let place = |k: usize| (k as f64 + 0.5) / 400.0 - 0.5;
            let beyond = |k: &usize| z + normal.x * place(k % 400) + normal.y * place(k / 400) > 0.0;
            let share = (0..160_000).filter(beyond).count() as f64 / 160_000.0;
            prop_assert!((share_beyond(z, &normal, 0.0) - share).abs() < 3e-3, "{share}");
        }
    }
}
