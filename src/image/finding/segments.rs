//! The straight edges and ridges of a picture, most significant first.

use super::chains::{EdgeMap, Segment};
use super::outline::Place;
use super::plane::Plane;

/// Blurs for steps, px, and the weakest step under each.
pub(super) const FINE_PX: f32 = 1.0;
const FINE_STEP: f32 = 0.006;
const COARSE_PX: f32 = 2.2;
const COARSE_STEP: f32 = 0.003;
/// Compensates the loss of a coarse step's strength by blurring.
const COARSE_GAIN: f64 = 1.6;
/// Blur for ridges, px, and the weakest one.
pub(super) const RIDGE_PX: f32 = 2.0;
const RIDGE: f32 = 0.002;
/// Fewest pixels of a step, and of a ridge.
const STEP_PIXELS: usize = 12;
const RIDGE_PIXELS: usize = 16;
/// Strengths are limited to these.
const STRONGEST_STEP: f64 = 0.05;
const STRONGEST_RIDGE: f64 = 0.03;
/// Segments that are kept.
const MOST_STEPS: usize = 140;
const MOST_RIDGES: usize = 40;
/// Most pieces that are joined: grass yields many thousands.
const MOST_PIECES: usize = 1200;
/// Segments whose ends are both this near to another's are the same, px.
const SAME_PX: f64 = 2.0;
/// Largest distance of pieces from their common line, px, and its increase per length of the gap between
/// them.
const OFF_PX: f64 = 1.6;
const OFF_PER_GAP: f64 = 0.02;
/// The longest gap between pieces of one line, relative to the line so far and in px,
const GAP: f64 = 0.6;
const GAP_PX: f64 = 60.0;
/// and the shortest piece beyond it, relative to the gap.
const PIECE_PER_GAP: f64 = 0.35;

/// The straight edges of a picture: steps of its channels, and ridges.
///
/// `fine` is the structure tensor under [`FINE_PX`], `curvatures` the second derivatives under [`RIDGE_PX`].
pub(super) fn segments(channels: &[Plane; 3], fine: &[Plane; 3], curvatures: &[Plane; 3]) -> Vec<Segment> {
    let coarse = || super::evidence::steps(channels, COARSE_PX);
    let (fine_steps, (coarse_steps, ridges)) = rayon::join(
        || joined(EdgeMap::steps(fine).chains(FINE_STEP, STEP_PIXELS)),
        || {
            rayon::join(
                || joined(EdgeMap::steps(&coarse()).chains(COARSE_STEP, STEP_PIXELS)),
                || joined(EdgeMap::ridges(curvatures).chains(RIDGE, RIDGE_PIXELS)),
            )
        },
    );
    let coarse_steps =
        coarse_steps.into_iter().map(|step| Segment { strength: COARSE_GAIN * step.strength, ..step });
    let steps: Vec<Segment> = fine_steps.into_iter().chain(coarse_steps).collect();
    let mut kept = most_telling(steps, STRONGEST_STEP, MOST_STEPS);
    kept.extend(most_telling(ridges, STRONGEST_RIDGE, MOST_RIDGES));
    kept
}

/// The longest and strongest segments, without duplicates.
fn most_telling(mut segments: Vec<Segment>, strongest: f64, most: usize) -> Vec<Segment> {
    let telling =
        |segment: &Segment| segment.length() * segment.cover * segment.strength.min(strongest).sqrt();
    segments.sort_by(|a, b| telling(b).total_cmp(&telling(a)));
    let mut kept: Vec<Segment> = Vec::new();
    for segment in segments {
        if kept.len() == most {
            break;
        }
        if kept.iter().all(|other| !is_same(&segment, other)) {
            kept.push(segment);
        }
    }
    kept
}

fn is_same(a: &Segment, b: &Segment) -> bool {
    let near = |p: Place, q: Place| (p - q).norm() < SAME_PX;
    near(a.from, b.from) && near(a.to, b.to) || near(a.from, b.to) && near(a.to, b.from)
}

/// Pieces of one line joined, together with the pieces that they grew from: a line may continue beyond a
/// corner.
fn joined(mut pieces: Vec<Segment>) -> Vec<Segment> {
    pieces.sort_by(|a, b| b.length().total_cmp(&a.length()));
    pieces.truncate(MOST_PIECES);
    let lengths: Vec<f64> = pieces.iter().map(Segment::length).collect();
    let mut used = vec![false; pieces.len()];
    let mut lines = Vec::new();
    for n in 0..pieces.len() {
        if used[n] {
            continue;
        }
        used[n] = true;
        let (mut line, mut covered, mut has_grown) = (pieces[n], lengths[n], false);
        loop {
            // pieces are sorted, so the longest comes first
            let grown = Line::of(&line);
            let continues = |k: &usize| !used[*k] && grown.continues_with(&pieces[*k], lengths[*k]);
            let Some(next) = (n + 1..pieces.len()).find(continues) else { break };
            used[next] = true;
            line = union(&line, covered, &pieces[next]);
            covered += lengths[next];
            has_grown = true;
        }
        line.cover = (covered / line.length()).min(1.0);
        lines.push(line);
        if has_grown {
            lines.push(pieces[n]);
        }
    }
    lines
}

/// A line that may be continued by pieces.
struct Line {
    from: Place,
    along: Place,
    length: f64,
}

impl Line {
    fn of(segment: &Segment) -> Self {
        let length = segment.length();
        Self { from: segment.from, along: (segment.to - segment.from) / length, length }
    }

    /// Whether a piece of this length lies on the line beyond one of its ends, not too far away.
    fn continues_with(&self, piece: &Segment, piece_length: f64) -> bool {
        let ends = [piece.from - self.from, piece.to - self.from];
        let off = self.along.perp(&ends[0]).abs().max(self.along.perp(&ends[1]).abs());
        // most pieces are elsewhere
        if off > OFF_PX + OFF_PER_GAP * GAP_PX {
            return false;
        }
        let [a, b] = [self.along.dot(&ends[0]), self.along.dot(&ends[1])];
        let (low, high) = (a.min(b), a.max(b));
        let gap = (low - self.length).max(-high);
        let beyond = gap.max(0.0);
        off < OFF_PX + OFF_PER_GAP * beyond
            && gap > -0.3 * piece_length
            && gap < (GAP * self.length.max(20.0)).min(GAP_PX)
            && piece_length > PIECE_PER_GAP * beyond
            && (low < -1.0 || high > self.length + 1.0)
    }
}

/// The line through two pieces, `covered` being the length of the first that has pixels.
fn union(line: &Segment, covered: f64, piece: &Segment) -> Segment {
    let weights = [covered, covered, piece.length(), piece.length()];
    let total: f64 = weights.iter().sum();
    let ends = [line.from, line.to, piece.from, piece.to];
    let middle = ends.iter().zip(weights).map(|(end, weight)| end * weight).sum::<Place>() / total;
    let (mut xx, mut yy, mut xy) = (0.0, 0.0, 0.0);
    for (end, weight) in ends.iter().zip(weights) {
        let d = end - middle;
        xx += weight * d.x * d.x;
        yy += weight * d.y * d.y;
        xy += weight * d.x * d.y;
    }
    let angle = 0.5 * (2.0 * xy).atan2(xx - yy);
    let along = Place::new(angle.cos(), angle.sin());
    let places = ends.map(|end| along.dot(&(end - middle)));
    let [low, high] =
        [places.iter().copied().fold(f64::MAX, f64::min), places.iter().copied().fold(f64::MIN, f64::max)];
    let strength = (line.strength * covered + piece.strength * piece.length()) / (covered + piece.length());
    Segment { from: middle + along * low, to: middle + along * high, strength, ..*line }
}

#[cfg(test)]
mod tests {
    use super::super::evidence::{curvatures, steps};
    use super::*;

    /// A turned square that is brighter than its background has four edges at its sides.
    #[test]
    fn the_sides_of_a_square_are_found() {
        let (width, turn) = (160, 0.3_f64);
        let inside = |k: usize| {
            let d = Place::new((k % width) as f64 - 79.5, (k / width) as f64 - 79.5);
            let (x, y) = (d.x * turn.cos() + d.y * turn.sin(), d.y * turn.cos() - d.x * turn.sin());
            // a pixel on the edge sees both sides
            ((40.5 - x.abs()).clamp(0.0, 1.0) * (40.5 - y.abs()).clamp(0.0, 1.0)) as f32
        };
        let plane = Plane { width, values: (0..width * width).map(|k| 0.3 + 0.4 * inside(k)).collect() };
        let channels = [plane.clone(), plane.clone(), plane];
        let sum = Plane::sum(&channels);
        let found = segments(&channels, &steps(&channels, FINE_PX), &curvatures(&sum, RIDGE_PX));
        let sides = found.iter().filter(|segment| segment.length() > 70.0).count();
        assert!(sides >= 4, "{found:?}");
        let off = |segment: &Segment| {
            let along = (segment.to - segment.from).normalize();
            along.perp(&(Place::new(80.0, 80.0) - segment.from)).abs()
        };
        for segment in &found[..4] {
            assert!((off(segment) - 40.0).abs() < 0.3, "{segment:?}");
        }
    }
}
