//! Quadrilaterals bounded by segments on three sides, or on two opposite ones.

use rayon::prelude::*;

use super::chains::Segment;
use super::evidence::Evidence;
use super::light::LogLight;
use super::outline::{Place, Quad, area, cross, may_be_rectangle};

/// A quadrilateral with its similarity to a panel.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scored {
    pub quad: Quad,
    pub score: f64,
}

/// Arms tried at either end of a segment, the longest first.
const ARMS: usize = 14;
/// Least length of an arm, px, and least sine of its angle with the segment.
const LEAST_ARM_PX: f64 = 10.0;
const LEAST_SINE: f64 = 0.25;
/// Arms with at least this ratio of lengths are not made equal.
const EQUAL: f64 = 0.9;
/// Opposite sides: largest sine of their angle, least length, px, and largest ratio of their lengths.
const PARALLEL_SINE: f64 = 0.5;
const LEAST_OPPOSITE_PX: f64 = 15.0;
const UNEQUAL: f64 = 1.67;
/// Largest distance between the ends of segments and their meeting point, px and relative to their length;
/// larger if they meet outside the picture.
const MEET_PX: f64 = 8.0;
const MEET: f64 = 0.15;
const MEET_OUTSIDE_PX: f64 = 10.0;
const MEET_OUTSIDE: f64 = 0.35;
/// Quadrilaterals that pass the first look, and the closer second one.
const GLANCED_AT: usize = 9000;
const LOOKED_AT: usize = 2500;
/// Least strength of a step inside a panel.
const INNER_STEP: f64 = 0.03;
/// Quadrilaterals differ if a corner is off by more than this, px and relative to their size.
const APART_PX: f64 = 2.5;
const APART: f64 = 0.03;

/// The quadrilaterals most similar to panels, at most `most`.
pub(super) fn quads(segments: &[Segment], evidence: &Evidence, light: &LogLight, most: usize) -> Vec<Scored> {
    let mut all: Vec<Quad> = (0..segments.len())
        .into_par_iter()
        .flat_map_iter(|base| [with_arms(segments, base, evidence), opposite(segments, base)].concat())
        .filter(may_be_rectangle)
        .collect();
    let glance = |quad: &Quad| sides_score(quad, evidence, 6, &[0.0]);
    all = best_of(all, glance, GLANCED_AT).into_iter().map(|scored| scored.quad).collect();
    let look = |quad: &Quad| {
        let inner = evidence.inner_edges(quad, INNER_STEP);
        sides_score(quad, evidence, 12, &[-1.5, 0.0, 1.5]) - 2.5 * (inner - 0.03).max(0.0)
    };
    let looked_at = best_of(all, look, LOOKED_AT);
    let judged = looked_at
        .into_par_iter()
        .map(|Scored { quad, score }| Scored { quad, score: score - 5.0 * light.unevenness(&quad).min(0.3) });
    let mut judged: Vec<Scored> = judged.collect();
    judged.sort_by(|a, b| b.score.total_cmp(&a.score));
    different(judged, most)
}

/// The quadrilaterals with the highest scores.
fn best_of(quads: Vec<Quad>, score: impl Fn(&Quad) -> f64 + Sync, most: usize) -> Vec<Scored> {
    let scored = quads.into_par_iter().map(|quad| Scored { quad, score: score(&quad) });
    let mut scored: Vec<Scored> = scored.collect();
    if scored.len() > most {
        scored.select_nth_unstable_by(most, |a, b| b.score.total_cmp(&a.score));
        scored.truncate(most);
    }
    scored
}

/// Score of the edges along the sides, one of which may be missing, and of the size.
fn sides_score(quad: &Quad, evidence: &Evidence, places: usize, offsets_px: &[f64]) -> f64 {
    let mut sides = [0, 1, 2, 3].map(|k| {
        let support = evidence.support((quad[k], quad[(k + 1) % 4]), places, offsets_px);
        support.step.max(0.85 * support.ridge)
    });
    sides.sort_by(f64::total_cmp);
    let size = area(quad).abs().sqrt();
    sides[1] + sides[2] + sides[3] + sides[0].max(0.5) + 0.6 * (size / 60.0).ln().clamp(-2.0, 1.2)
}

/// The first of each group of similar ones, in order.
fn different(quads: Vec<Scored>, most: usize) -> Vec<Scored> {
    let mut kept: Vec<(Scored, Quad)> = Vec::new();
    for scored in quads {
        if kept.len() == most {
            break;
        }
        let named = from_top_left(&scored.quad);
        let apart = APART_PX.max(APART * area(&scored.quad).abs().sqrt());
        let far = |other: &Quad| (0..4).map(|k| (named[k] - other[k]).amax()).fold(0.0, f64::max);
        if kept.iter().all(|(_, other)| far(other) >= apart) {
            kept.push((scored, named));
        }
    }
    kept.into_iter().map(|(scored, _)| scored).collect()
}

/// The same quadrilateral clockwise from the corner nearest to the top left.
fn from_top_left(quad: &Quad) -> Quad {
    let first = (0..4).min_by(|a, b| quad[*a].sum().total_cmp(&quad[*b].sum())).unwrap_or(0);
    let step = if area(quad) > 0.0 { 1 } else { 3 };
    [0, 1, 2, 3].map(|k| quad[(first + k * step) % 4])
}

/// Intersection of two segments' lines, and its distance along the first from its start, px; none if
/// parallel.
fn meeting(a: &Segment, b: &Segment) -> Option<(Place, f64)> {
    let along = (a.to - a.from).normalize();
    let sine = cross(along, b.to - b.from);
    let far = cross(b.from - a.from, b.to - b.from) / sine;
    far.is_finite().then(|| (a.from + along * far, far))
}

/// Which ends of a segment lie near the point of its line at distance `far` from its start.
fn ends_near(segment: &Segment, far: f64, is_outside: bool) -> [bool; 2] {
    let length = segment.length();
    let reach =
        if is_outside { MEET_OUTSIDE_PX.max(MEET_OUTSIDE * length) } else { MEET_PX.max(MEET * length) };
    [far.abs() < reach, (far - length).abs() < reach]
}

/// Quadrilaterals on a base with an arm at either end.
fn with_arms(segments: &[Segment], base: usize, evidence: &Evidence) -> Vec<Quad> {
    let [first, second] = arms(segments, base, evidence);
    let base = segments[base].to - segments[base].from;
    let mut quads = Vec::new();
    for (foot, tip) in &first {
        for (other_foot, other_tip) in &second {
            let (arm, other) = (tip - foot, other_tip - other_foot);
            if cross(base, arm) * cross(base, other) <= 0.0 {
                continue;
            }
            quads.push([*foot, *other_foot, *other_tip, *tip]);
            let (length, other_length) = (arm.norm(), other.norm());
            if length.min(other_length) < EQUAL * length.max(other_length) {
                for same in [length, other_length] {
                    let (tip, other_tip) =
                        (foot + arm * (same / length), other_foot + other * (same / other_length));
                    quads.push([*foot, *other_foot, other_tip, tip]);
                }
            }
        }
    }
    quads
}

/// Feet and tips of the arms at either end of a base.
fn arms(segments: &[Segment], base: usize, evidence: &Evidence) -> [Vec<(Place, Place)>; 2] {
    let on = &segments[base];
    let along = (on.to - on.from).normalize();
    let [width, height] = [evidence.width, evidence.height].map(|side| side as f64);
    let mut arms: [Vec<(f64, Place, Place)>; 2] = [Vec::new(), Vec::new()];
    for (k, arm) in segments.iter().enumerate() {
        let length = arm.length();
        if k == base || length < LEAST_ARM_PX || cross(along, arm.to - arm.from).abs() < LEAST_SINE * length {
            continue;
        }
        let (Some((foot, far)), Some((_, far_on_arm))) = (meeting(on, arm), meeting(arm, on)) else {
            continue;
        };
        let outside = foot.x < 2.0 || foot.y < 2.0 || foot.x > width - 2.0 || foot.y > height - 2.0;
        let tips = [(0, arm.to), (1, arm.from)];
        let on_arm = ends_near(arm, far_on_arm, outside);
        for (end, is_near) in ends_near(on, far, outside).into_iter().enumerate().filter(|(_, near)| *near) {
            debug_assert!(is_near);
            let meets = tips.iter().filter(|(at, tip)| on_arm[*at] && (tip - foot).norm() > LEAST_ARM_PX);
            arms[end].extend(meets.map(|(_, tip)| (length, foot, *tip)));
        }
    }
    arms.map(|mut arms| {
        arms.sort_by(|a, b| b.0.total_cmp(&a.0));
        arms.into_iter().take(ARMS).map(|(_, foot, tip)| (foot, tip)).collect()
    })
}

/// Quadrilaterals between a segment and possible opposite sides among later segments.
fn opposite(segments: &[Segment], first: usize) -> Vec<Quad> {
    let one = &segments[first];
    let (way, length) = (one.to - one.from, one.length());
    let quad = |other: &Segment| {
        let (other_way, other_length) = (other.to - other.from, other.length());
        let ratio = length / other_length;
        let fits = length.min(other_length) >= LEAST_OPPOSITE_PX
            && (1.0 / UNEQUAL..UNEQUAL).contains(&ratio)
            && cross(way, other_way).abs() < PARALLEL_SINE * length * other_length;
        let (from, to) =
            if way.dot(&other_way) < 0.0 { (other.to, other.from) } else { (other.from, other.to) };
        fits.then_some([one.from, one.to, to, from])
    };
    segments[first + 1..].iter().filter_map(quad).collect()
}

#[cfg(test)]
mod tests {
    use super::super::evidence::{curvatures, steps};
    use super::super::plane::Plane;
    use super::super::segments::{FINE_PX, RIDGE_PX, segments};
    use super::super::synthetic::{outline, views};
    use super::*;

    #[test]
    fn both_panels_are_among_the_best() {
        let (reduced, evidence, light) = views();
        let channels = reduced.even();
        let sum = Plane::sum(&channels);
        let segments = segments(&channels, &steps(&channels, FINE_PX), &curvatures(&sum, RIDGE_PX));
        let found = quads(&segments, &evidence, &light, 60);
        for panel in outline().panels() {
            let far = |quad: &Quad| {
                let (quad, panel) = (from_top_left(quad), from_top_left(&panel));
                (0..4).map(|k| (quad[k] - panel[k]).norm()).fold(0.0, f64::max)
            };
            let nearest = found.iter().map(|scored| far(&scored.quad)).fold(f64::INFINITY, f64::min);
            assert!(nearest < 6.0, "{nearest}");
        }
    }
}
