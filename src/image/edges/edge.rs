//! The straight edge near a side of a panel.
//!
//! The pixels around the side are looked at in pieces along it ([`super::piece`]): the residuals of all
//! pieces and all channels together tell how likely each line is. A step and a kink are both found so, to a
//! fraction of a pixel, in noise that hides them in any one row of pixels. A lens blurs all edges of a
//! picture alike; which blur it is, all outer sides tell together: one side alone might take the blurred end
//! of a shadow beside a sharp edge.

use nalgebra::{Matrix2, Vector2, Vector3};

use super::piece::{BLURS, PLACES, Piece, offset};
use crate::image::photograph::{Photograph, Pixel};
use crate::image::placing::{Lens, Point, Quadrilateral};

/// Pieces along a side.
const PIECES: usize = 24;
/// Part of a side that is left out at each end, beyond the reach: other edges are near.
const END: f64 = 0.03;
/// Most of a side that is left out at each end.
const LONGEST_END: f64 = 0.25;
/// Pixels are looked at this much further away than an edge is looked for, px: they tell the light on both
/// sides.
const FLANK_PX: f64 = 10.0;
/// A piece is at most this long, px: more pixels would tell more than the model is true.
const LONGEST_PX: f64 = 16.0;
/// An edge explains its pixels better than smooth light by at least this, in log likelihood.
const LEAST_GAIN: f64 = 20.0;
/// How exactly a step is where the model of an edge has it, px, and a kink: light curves on both sides of a
/// crease.
const STEP_SD_PX: f64 = 0.015;
const KINK_SD_PX: f64 = 0.5;
/// An edge is elsewhere if its middle is further away than this, px and relative to the reach.
const ELSEWHERE_PX: f64 = 1.5;
const ELSEWHERE: f64 = 0.25;
/// What a piece says against a line counts no more than this where something may hide the side there, as a
/// finger does.
pub(in crate::image) const MOST_OF_PIECE: f64 = 60.0;
/// A side speaks against a blur by at most this part of what it says for the best.
const MOST_AGAINST: f64 = 0.25;

/// Where the edge at a side is: its distances from the side's two ends, px, as a normal distribution.
#[derive(Debug, Clone)]
pub(in crate::image) struct Edge {
    /// Inverse of the covariance.
    pub information: Matrix2<f64>,
    /// Information times mean.
    pub pull: Vector2<f64>,
    /// Standard deviation at the less certain end.
    pub sd_px: f64,
    /// By how much it explains the pixels better than smooth light, in log likelihood,
    pub gain: f64,
    /// and better than the best edge elsewhere.
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

    /// The direction in which distances from the side count.
    pub fn across(&self) -> Vector2<f64> {
        Vector2::new(-self.along.y, self.along.x)
    }

    /// What the pixels within `reach_px` of the side say of an edge under each of the blurs. `inner`: a place
    /// on the sheet, if that ends here; `most_of_piece`: what a piece may say against a line, in log
    /// likelihood.
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
        let inwards = inner.map(|inner| {
            Vector2::new(inner.x - self.from.x, inner.y - self.from.y).dot(&self.across()).signum()
        });
        let of_blur = |blur: &usize| {
            let of_piece = |piece: &Piece| {
                let gains = piece.gains(&self.across(), *blur, reach_px, reach_px + FLANK_PX);
                let most = gains.iter().copied().fold(0.0, f64::max);
                let gains = gains.map(|gain| gain.max(most - most_of_piece));
                let breaks = inwards.map_or([0.0; PLACES], |inwards| piece.breaks(inwards, reach_px, *blur));
                let whole = |place: usize| gains[place] - breaks[place].min(2.0 * most_of_piece);
                ((piece.place, gains), (piece.place, std::array::from_fn(whole)))
            };
            let (steps, whole): (Vec<_>, Vec<_>) = pieces.iter().map(of_piece).unzip();
            let likelihoods = |gains: &[_]| lines().map(|line| log_likelihood(gains, line)).collect();
            let of_steps: Vec<f64> = likelihoods(&steps);
            Blurred { blur: *blur, says: greatest(&of_steps), likelihoods: likelihoods(&whole) }
        };
        Look { reach_px, ends_here: inner.is_some(), blurred: blurs.iter().map(of_blur).collect() }
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
        Piece::new((places[0] + places[1]) / 2.0, pixels)
    }

    fn at(&self, along: f64, across: f64) -> Point {
        let p = self.along * along + self.across() * across;
        Point::new(self.from.x + p.x, self.from.y + p.y)
    }
}

/// What the pixels near a side say of an edge.
pub(super) struct Look {
    reach_px: f64,
    /// Whether the sheet ends at the side.
    ends_here: bool,
    blurred: Vec<Blurred>,
}

/// What they say under one blur.
struct Blurred {
    blur: usize,
    /// What speaks for the best line, in log likelihood, whatever the sheet is like inside of it: 0 if there
    /// is none.
    says: f64,
    /// By how much each of [`lines`] explains all pieces better than smooth light, in log likelihood.
    likelihoods: Vec<f64>,
}

/// The blur that all outer sides say together, none of them louder for being longer or brighter.
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
    /// The edge, if there is one; under a blur, if the sheet ends there, else under the most probable.
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

/// The greatest likelihood, 0 if all are less.
fn greatest(likelihoods: &[f64]) -> f64 {
    likelihoods.iter().copied().fold(0.0, f64::max)
}

/// Lines past a side's ends, by the places that they pass there.
fn lines() -> impl Iterator<Item = [usize; 2]> + Clone {
    (0..PLACES * PLACES).map(|line| [line / PLACES, line % PLACES])
}

/// The likelihood of the best line that is not where the one with the `greatest` is.
fn elsewhere(likelihoods: &[f64], greatest: f64, reach_px: f64) -> f64 {
    let middle = |line: [usize; 2]| (offset(line[0], reach_px) + offset(line[1], reach_px)) / 2.0;
    let all = || lines().zip(likelihoods);
    let Some((best, _)) = all().find(|(_, likelihood)| **likelihood >= greatest) else { return 0.0 };
    let apart = ELSEWHERE_PX.max(ELSEWHERE * reach_px);
    let others = all().filter(|(line, _)| (middle(*line) - middle(best)).abs() > apart);
    others.map(|(_, likelihood)| *likelihood).fold(0.0, f64::max)
}

/// By how much the edge that passes the side's ends at two places explains all pieces better than smooth
/// light.
fn log_likelihood(gains: &[(f64, [f64; PLACES])], [from, to]: [usize; 2]) -> f64 {
    let of_piece = |(place, gains): &(f64, [f64; PLACES])| {
        let crossing = from as f64 + (to as f64 - from as f64) * place;
        let below = (crossing as usize).min(PLACES - 2);
        let part = crossing - below as f64;
        gains[below] * (1.0 - part) + gains[below + 1] * part
    };
    gains.iter().map(of_piece).sum()
}

impl Edge {
    /// Mean and covariance of weighted lines; of lines all equally likely, or likely at both ends of the
    /// reach, nothing is known.
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
