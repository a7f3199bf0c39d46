//! The straight edge near a side of a panel.
//!
//! Pixels around the side are examined in pieces along it ([`super::piece`]); the residuals of all pieces and
//! channels together give the likelihood of each line. Steps and kinks are both located to a fraction of a
//! pixel, even in noise that hides them in any single row of pixels. A lens blurs all edges of a picture
//! alike, so the outer sides determine one blur jointly: a single side might prefer the blurred end of a
//! nearby shadow to a sharp edge.

use nalgebra::{Matrix2, Vector2, Vector3};

use super::piece::{BLURS, PLACES, Piece, offset};
use crate::image::photograph::{Photograph, Pixel};
use crate::image::placing::{Lens, Point, Quadrilateral};

/// Pieces along a side.
const PIECES: usize = 24;
/// Fraction of a side omitted at each end, in addition to the reach, because other edges are near.
const END: f64 = 0.03;
/// Largest fraction of a side omitted at each end.
const LONGEST_END: f64 = 0.25;
/// Pixels up to this distance beyond the search range are used, px, to determine the light on both sides.
const FLANK_PX: f64 = 10.0;
/// Longest piece, px: more pixels would be more precise than the model is accurate.
const LONGEST_PX: f64 = 16.0;
/// Minimum gain in log likelihood of an edge over smooth light.
const LEAST_GAIN: f64 = 20.0;
/// Accuracy of the model for the position of a step, px, and of a kink: light curves on both sides of a
/// crease.
const STEP_SD_PX: f64 = 0.015;
const KINK_SD_PX: f64 = 0.5;
/// An edge counts as elsewhere if its middle is further away than both of these, px and relative to the
/// reach.
const ELSEWHERE_PX: f64 = 1.5;
const ELSEWHERE: f64 = 0.25;
/// Largest penalty in log likelihood that a piece may give a line where something, such as a finger, may hide
/// the side.
pub(in crate::image) const MOST_OF_PIECE: f64 = 60.0;
/// A side votes against a blur by at most this fraction of its support for the best one.
const MOST_AGAINST: f64 = 0.25;

/// What an edge looks like in the picture.
#[derive(Debug, Clone, Copy)]
pub(super) struct EdgeModel {
    /// The picture's blur, by number.
    pub blur: usize,
    /// Largest penalty of a piece for a line, in log likelihood.
    pub most_of_piece: f64,
}

/// Position of the edge at a side: its distances from the side's two ends, px, as a normal distribution.
#[derive(Debug, Clone)]
pub(in crate::image) struct Edge {
    /// Inverse of the covariance.
    pub information: Matrix2<f64>,
    /// Information times mean.
    pub pull: Vector2<f64>,
    /// Standard deviation at the less certain end.
    pub sd_px: f64,
    /// Gain in log likelihood over smooth light.
    pub gain: f64,
    /// Gain in log likelihood over the best edge elsewhere.
    pub lead: f64,
}

/// A side of a panel in the ideal picture.
pub(super) struct Side {
    from: Point,
    length: f64,
    along: Vector2<f64>,
}

impl Side {
    pub fn new(from: Point, to: Point) -> Self {
        let length = from.distance(to);
        Self { from, length, along: Vector2::new(to.x - from.x, to.y - from.y) / length }
    }

    /// The direction in which distances from the side are measured.
    pub fn across(&self) -> Vector2<f64> {
        Vector2::new(-self.along.y, self.along.x)
    }

    /// How far `to` is beyond `from` in that direction, px.
    pub fn across_px(&self, from: Point, to: Point) -> f64 {
        Vector2::new(to.x - from.x, to.y - from.y).dot(&self.across())
    }

    /// Evidence of the pixels within `reach_px` of the side for an edge, under each of the blurs. `inner`: a
    /// point on the sheet, if the sheet ends at this side; `most_of_piece`: largest penalty of a piece for a
    /// line, in log likelihood.
    pub fn look(
        &self,
        photograph: &Photograph,
        lens: &Lens,
        reach_px: f64,
        inner: Option<Point>,
        blurs: &[usize],
        most_of_piece: f64,
    ) -> Look {
        let pieces = self.pieces(photograph, lens, reach_px);
        let inwards = inner.map(|inner| self.inwards(inner));
        let of_blur = |blur: &usize| {
            let gains = self.gains(&pieces, inwards, reach_px, EdgeModel { blur: *blur, most_of_piece });
            let likelihoods =
                |gains: &[_]| -> Vec<f64> { lines().map(|line| log_likelihood(gains, line)).collect() };
            // a single blur needs no vote
            let says = if blurs.len() > 1 { greatest(&likelihoods(&gains.steps)) } else { 0.0 };
            Blurred { blur: *blur, says, likelihoods: likelihoods(&gains.whole) }
        };
        Look { reach_px, ends_here: inner.is_some(), blurred: blurs.iter().map(of_blur).collect() }
    }

    /// Distance of the edge's middle from the line between its ends, px, in the direction of
    /// [`across`](Self::across), and its standard deviation, if there is an edge within `reach_px` that ends
    /// the sheet, on which `inner` is.
    pub fn bend_px(
        &self,
        photograph: &Photograph,
        lens: &Lens,
        (reach_px, inner): (f64, Point),
        model: EdgeModel,
    ) -> Option<[f64; 2]> {
        let pieces = self.pieces(photograph, lens, reach_px);
        let straight = self.gains(&pieces, Some(self.inwards(inner)), reach_px, model).whole;
        let likelihood = |bend: usize| {
            let bent = straight.iter().map(|(place, gains)| (*place, moved(gains, bend, *place)));
            let bent: Vec<_> = bent.collect();
            lines().map(|line| log_likelihood(&bent, line)).fold(0.0, f64::max)
        };
        let likelihoods: [f64; PLACES] = std::array::from_fn(likelihood);
        let gain = greatest(&likelihoods);
        let weight = |bend: usize| (likelihoods[bend] - gain).exp();
        let mean_of = |value: &dyn Fn(f64) -> f64| {
            let bends = || (0..PLACES).map(|bend| (offset(bend, reach_px), weight(bend)));
            bends().map(|(bend_px, weight)| weight * value(bend_px)).sum::<f64>()
                / bends().map(|(_, weight)| weight).sum::<f64>()
        };
        let mean = mean_of(&|bend_px| bend_px);
        let step_px = offset(1, reach_px) - offset(0, reach_px);
        let variance = mean_of(&|bend_px| (bend_px - mean).powi(2)) + step_px * step_px / 12.0;
        (gain >= LEAST_GAIN).then(|| [mean, (variance + STEP_SD_PX.powi(2)).sqrt()])
    }

    /// Whether `inner` lies in the direction of [`across`](Self::across), 1, or the opposite one, -1.
    fn inwards(&self, inner: Point) -> f64 {
        self.across_px(self.from, inner).signum()
    }

    /// Gains of an edge at each place of each piece.
    fn gains(
        &self,
        pieces: &[Piece],
        inwards: Option<f64>,
        reach_px: f64,
        EdgeModel { blur, most_of_piece }: EdgeModel,
    ) -> Gains {
        let of_piece = |piece: &Piece| {
            let of_one = piece.gains(&self.across(), blur, reach_px);
            let breaks = inwards.map_or([0.0; PLACES], |inwards| piece.breaks(inwards, reach_px, blur));
            // what may hide a side is as dark as a shadow
            let shadowed = inwards.filter(|_| most_of_piece.is_infinite());
            let gains = shadowed.map_or(of_one, |inwards| {
                let before = piece.gains_before_shadow((&self.across(), inwards), blur, reach_px);
                std::array::from_fn(|place| of_one[place].max(before[place]))
            });
            let most = gains.iter().copied().fold(0.0, f64::max);
            let gains = gains.map(|gain| gain.max(most - most_of_piece));
            let whole = |place: usize| gains[place] - breaks[place].min(2.0 * most_of_piece);
            ((piece.place, gains), (piece.place, std::array::from_fn(whole)))
        };
        let (steps, whole) = pieces.iter().map(of_piece).unzip();
        Gains { steps, whole }
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
                if (a..b).contains(&along)
                    && across.abs() <= width_px
                    && let Pixel::Light(light) = photograph.pixel(x, y)
                {
                    pixels.push((across, Vector3::from(light)));
                }
            }
        }
        Piece::new((places[0] + places[1]) / 2.0, width_px, pixels)
    }

    fn at(&self, along: f64, across: f64) -> Point {
        let p = self.along * along + self.across() * across;
        Point::new(self.from.x + p.x, self.from.y + p.y)
    }
}

/// Gains in log likelihood of an edge at each place over smooth light, for each piece of a side with its
/// position along it.
struct Gains {
    /// Of a step or kink.
    steps: Vec<(f64, [f64; PLACES])>,
    /// The same for a sheet that continues up to there.
    whole: Vec<(f64, [f64; PLACES])>,
}

/// Evidence of the pixels near a side for an edge.
pub(super) struct Look {
    reach_px: f64,
    /// Whether the sheet ends at the side.
    ends_here: bool,
    blurred: Vec<Blurred>,
}

/// That evidence under one blur.
struct Blurred {
    blur: usize,
    /// Log likelihood of the best line, whatever the sheet looks like inside of it; 0 if there is none.
    says: f64,
    /// Gain of each of [`lines`] over smooth light, summed over all pieces, in log likelihood.
    likelihoods: Vec<f64>,
}

/// The blur that all outer sides favour together, none of them weighing more for being longer or brighter.
pub(super) fn common_blur(looks: &[Look]) -> usize {
    let outer = || looks.iter().filter(|look| look.ends_here);
    let vote = |blur: &usize| {
        let of_side = |look: &Look| {
            let most = look.blurred.iter().map(|blurred| blurred.says).fold(1.0, f64::max);
            let says =
                look.blurred.iter().find(|blurred| blurred.blur == *blur).map_or(0.0, |blurred| blurred.says);
            ((says - most) / most).max(-MOST_AGAINST)
        };
        outer().map(of_side).sum::<f64>()
    };
    (0..BLURS).max_by(|a, b| vote(a).total_cmp(&vote(b))).unwrap_or(0)
}

impl Look {
    /// The edge, if any: under this blur if the sheet ends at the side, else under the most probable blur.
    pub fn edge(&self, blur: usize) -> Option<Edge> {
        let usable = self.blurred.iter().filter(|blurred| !self.ends_here || blurred.blur == blur);
        let with_gain = usable.map(|blurred| (greatest(&blurred.likelihoods), &blurred.likelihoods));
        let (gain, likelihoods) = with_gain.max_by(|a, b| a.0.total_cmp(&b.0))?;
        if gain < LEAST_GAIN {
            return None;
        }
        let weighted = lines().zip(likelihoods).map(|(line, likelihood)| {
            let ends = line.map(|place| offset(place, self.reach_px));
            (Vector2::from(ends), (likelihood - gain).exp())
        });
        let model_sd_px = if self.ends_here { STEP_SD_PX } else { KINK_SD_PX };
        let lead = gain - elsewhere(likelihoods, gain, self.reach_px);
        Some(Edge { gain, lead, ..Edge::of(weighted, self.reach_px, model_sd_px) })
    }
}

/// The greatest likelihood, at least 0.
fn greatest(likelihoods: &[f64]) -> f64 {
    likelihoods.iter().copied().fold(0.0, f64::max)
}

/// Lines across the side's two ends, by the places at which they cross them.
fn lines() -> impl Iterator<Item = [usize; 2]> + Clone {
    (0..PLACES * PLACES).map(|line| [line / PLACES, line % PLACES])
}

/// The likelihood of the best line away from the one with the `greatest`.
fn elsewhere(likelihoods: &[f64], greatest: f64, reach_px: f64) -> f64 {
    let middle = |line: [usize; 2]| (offset(line[0], reach_px) + offset(line[1], reach_px)) / 2.0;
    let all = || lines().zip(likelihoods);
    let Some((best, _)) = all().find(|(_, likelihood)| **likelihood >= greatest) else { return 0.0 };
    let apart = ELSEWHERE_PX.max(ELSEWHERE * reach_px);
    let others = all().filter(|(line, _)| (middle(*line) - middle(best)).abs() > apart);
    others.map(|(_, likelihood)| *likelihood).fold(0.0, f64::max)
}

/// Gain over smooth light of the edge that crosses the side's ends at two places, summed over all pieces.
fn log_likelihood(gains: &[(f64, [f64; PLACES])], [from, to]: [usize; 2]) -> f64 {
    let of_piece = |(place, gains): &(f64, [f64; PLACES])| {
        between(gains, from as f64 + (to as f64 - from as f64) * place)
    };
    gains.iter().map(of_piece).sum()
}

/// Gains of a piece at this position along a side, at places along a parabola whose middle is at the place
/// `bend` instead of the side itself.
fn moved(gains: &[f64; PLACES], bend: usize, position: f64) -> [f64; PLACES] {
    let middle = bend as f64 - (PLACES / 2) as f64;
    let by = 4.0 * position * (1.0 - position) * middle;
    std::array::from_fn(|place| between(gains, place as f64 + by))
}

/// Gain at a fractional place; beyond the reach as at its end.
fn between(gains: &[f64; PLACES], place: f64) -> f64 {
    let place = place.clamp(0.0, (PLACES - 1) as f64);
    let below = (place as usize).min(PLACES - 2);
    let part = place - below as f64;
    gains[below] * (1.0 - part) + gains[below + 1] * part
}

impl Edge {
    /// Mean and covariance of weighted lines; no information if all lines are equally probable, or those at
    /// both ends of the reach are.
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
            information.cholesky().map(|_| (information, inverse * mean))
        });
        let (information, pull) = known.unwrap_or_default();
        Self { information, pull, sd_px, gain: 0.0, lead: 0.0 }
    }
}
