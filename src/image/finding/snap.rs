//! Moves corners to the intersections of lines along the strongest edges near the sides.

use nalgebra::{Matrix2, Vector2};

use super::evidence::Evidence;
use super::outline::{Outline, Place, SIDES};

/// Places along a side at which the strongest edge is searched for.
const PLACES: usize = 32;
/// Fraction of a side omitted at either end.
const END: f64 = 0.06;
/// Distance between samples across a side, px.
const STEP_PX: f64 = 0.5;
/// Search distance for an edge, relative to the side's length and with an offset in px.
const REACH: f64 = 0.12;
const REACH_PX: f64 = 2.0;
/// Loss of weight of an edge at the end of the search distance.
const FAR: f64 = 0.5;
/// A step of this size scores one half.
const HALF: f64 = 0.006;
/// Fewest places that define a line.
const FEWEST: usize = 6;
/// Largest distance from the line of a place on it, px.
const ON_LINE_PX: f64 = 1.5;
const ROUNDS: usize = 2;
/// Weight that holds a corner at its position.
const HOLD: f64 = 0.02;

/// The distances of a line from the two ends of a side, px, and its weight, from 0 to 1.
struct Line {
    from_px: f64,
    to_px: f64,
    weight: f64,
}

/// A fold with its sides moved to edges within `reach_px`.
pub(super) fn snapped(fold: &Outline, evidence: &Evidence, reach_px: f64) -> Outline {
    (0..ROUNDS)
        .fold(*fold, |fold, round| moved(&fold, evidence, reach_px / (1 + round) as f64, 3.0 * reach_px))
}

fn moved(fold: &Outline, evidence: &Evidence, reach_px: f64, furthest_px: f64) -> Outline {
    let mut normal = [Matrix2::from_diagonal_element(HOLD); 6];
    let mut right = [Vector2::zeros(); 6];
    for (side, (i, j)) in SIDES.into_iter().enumerate() {
        let (from, to) = fold.side(side);
        let length = (to - from).norm();
        let reach = reach_px.min(REACH * length + REACH_PX);
        let Some(line) = line((from, to), evidence, reach, side == 0) else { continue };
        let across = perpendicular((to - from) / length);
        let (from, to) = (from + across * line.from_px, to + across * line.to_px);
        let across = perpendicular((to - from).normalize());
        for corner in [i, j] {
            let off = (from - fold.0[corner]).dot(&across);
            normal[corner] += across * across.transpose() * line.weight;
            right[corner] += across * (off * line.weight);
        }
    }
    let corner = |k: usize| {
        let step = normal[k].try_inverse().map_or_else(Vector2::zeros, |inverse| inverse * right[k]);
        fold.0[k] + step.cap_magnitude(furthest_px)
    };
    Outline([0, 1, 2, 3, 4, 5].map(corner))
}

fn perpendicular(along: Place) -> Place {
    Place::new(-along.y, along.x)
}

/// The line along the strongest edge near a side; a crease may be a ridge.
fn line((from, to): (Place, Place), evidence: &Evidence, reach_px: f64, is_crease: bool) -> Option<Line> {
    let length = (to - from).norm();
    if length < 4.0 {
        return None;
    }
    let along = (to - from) / length;
    let across = perpendicular(along);
    let (mut found, mut strengths) = (Vec::with_capacity(PLACES), Vec::new());
    for k in 0..PLACES {
        let part = END + (1.0 - 2.0 * END) * (k as f64 + 0.5) / PLACES as f64;
        strengths_across(
            from + along * (part * length),
            across,
            evidence,
            reach_px,
            is_crease,
            &mut strengths,
        );
        if let Some((offset_px, strength)) = strongest(&strengths) {
            found.push((part, offset_px, strength / (strength + HALF)));
        }
    }
    if found.len() < FEWEST {
        return None;
    }
    let (from_px, to_px) = robust_line(&found, reach_px);
    let is_on = |(part, offset, _): &&(f64, f64, f64)| {
        (offset - from_px - (to_px - from_px) * part).abs() < ON_LINE_PX
    };
    let weight = found.iter().filter(is_on).map(|(_, _, weight)| weight).sum::<f64>() / PLACES as f64;
    (weight > 0.02).then_some(Line { from_px, to_px, weight })
}

/// Strengths of edges at places across a side, [`STEP_PX`] apart and as many on either side of `place`.
fn strengths_across(
    place: Place,
    across: Place,
    evidence: &Evidence,
    reach_px: f64,
    is_crease: bool,
    strengths: &mut Vec<f64>,
) {
    let steps = (reach_px / STEP_PX).ceil() as i32;
    strengths.clear();
    for n in -steps..=steps {
        let place = place + across * (STEP_PX * f64::from(n));
        let strength = if is_crease {
            evidence.at(place, across).map(|(step, ridge)| step.max(ridge))
        } else {
            evidence.step_at(place, across)
        };
        let off = f64::from(n) / f64::from(steps + 1);
        strengths.push((1.0 - FAR * off * off) * strength.unwrap_or_default());
    }
}

/// Distance of the strongest edge from the middle one of places across a side, px, and its strength.
fn strongest(strengths: &[f64]) -> Option<(f64, f64)> {
    let (at, best) = strengths.iter().copied().enumerate().max_by(|a, b| a.1.total_cmp(&b.1))?;
    if best <= 0.0 {
        return None;
    }
    let between = match (at.checked_sub(1).map(|k| strengths[k]), strengths.get(at + 1)) {
        (Some(before), Some(after)) if before - 2.0 * best + after < 0.0 => {
            0.5 * (before - after) / (before - 2.0 * best + after)
        }
        _ => 0.0,
    };
    Some((STEP_PX * (at as f64 - (strengths.len() / 2) as f64 + between), best))
}

/// Offsets at both ends of the line fitted to offsets along a side, with outliers weighing less in each
/// round.
fn robust_line(found: &[(f64, f64, f64)], reach_px: f64) -> (f64, f64) {
    let mut offsets: Vec<f64> = found.iter().map(|(_, offset, _)| *offset).collect();
    let middle = offsets.len() / 2;
    let (mut from, mut slope) = (*offsets.select_nth_unstable_by(middle, f64::total_cmp).1, 0.0);
    for round in 0..8 {
        let scale = (0.5 * reach_px * 0.6_f64.powi(round)).max(0.6);
        let (mut normal, mut right) = (Matrix2::zeros(), Vector2::zeros());
        for (part, offset, weight) in found {
            let off = (offset - from - slope * part) / scale;
            let weight = weight / (1.0 + off * off).powi(2);
            let basis = Vector2::new(1.0, *part);
            normal += basis * basis.transpose() * weight;
            right += basis * (offset * weight);
        }
        normal[(1, 1)] += 1e-3 * normal[(0, 0)]; // an uncertain line stays parallel to the side
        let Some(inverse) = normal.try_inverse() else { break };
        let fit = inverse * right;
        (from, slope) = (fit[0], fit[1]);
    }
    (from, from + slope)
}

#[cfg(test)]
mod tests {
    use super::super::synthetic::{off, outline, views};
    use super::*;

    #[test]
    fn corners_three_pixels_off_go_to_the_edges() {
        let (_, evidence, _) = views();
        let found = snapped(&off(3.0), &evidence, 5.0);
        assert!(found.distance_px(&outline()) < 1.2, "{}", found.distance_px(&outline()));
    }
}
