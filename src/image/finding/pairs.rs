//! Folds: two quadrilaterals with a common side, or one divided where light has its sharpest ridge.

use super::evidence::Evidence;
use super::light::LogLight;
use super::outline::{Outline, Place, Quad, between, centre, cross};
use super::quads::Scored;

/// Largest distance between the ends of a common side, px and relative to the side.
const SHARED_PX: f64 = 4.0;
const SHARED: f64 = 0.07;
/// Largest distance between the middles of a common side, px, whatever its length.
const MOST_APART_PX: f64 = 28.0;
/// Largest ratio of the panels' depths.
const DEEPER: f64 = 4.5;
/// Places across a quadrilateral where it may be divided, places along it, and the distance to either side of
/// a ridge.
const CUTS: usize = 40;
const ALONG: usize = 10;
const AWAY: usize = 5;
/// Least height of a ridge, in logarithms of light, that divides a quadrilateral.
const LEAST_RIDGE: f64 = 0.01;

/// Pairs of quadrilaterals on either side of a common side, with the sum of their scores.
pub(super) fn pairs(quads: &[Scored]) -> Vec<(f64, Outline)> {
    let sides: Vec<(usize, Quad)> = quads
        .iter()
        .enumerate()
        .flat_map(|(n, scored)| (0..4).map(move |k| (n, [0, 1, 2, 3].map(|c| scored.quad[(k + c) % 4]))))
        .collect();
    let mut folds = Vec::new();
    for (n, (i, a)) in sides.iter().enumerate() {
        for (j, b) in &sides[n + 1..] {
            // four successive sides belong to one quadrilateral
            if i == j || (a[0] + a[1] - b[0] - b[1]).norm_squared() > 4.0 * MOST_APART_PX * MOST_APART_PX {
                continue;
            }
            if let Some((gap, outline)) = fold(a, b) {
                folds.push((quads[*i].score + quads[*j].score - 2.0 * gap, outline));
            }
        }
    }
    folds
}

/// The fold of two quadrilaterals whose first sides coincide, and the gap between those.
fn fold(a: &Quad, b: &Quad) -> Option<(f64, Outline)> {
    let ends = |b: [Place; 2]| (a[0] - b[0]).norm().max((a[1] - b[1]).norm());
    // neighbours with the same orientation traverse their common side in opposite directions
    let b = if ends([b[1], b[0]]) < ends([b[0], b[1]]) { [b[1], b[0], b[3], b[2]] } else { *b };
    let length = (a[1] - a[0]).norm().min((b[1] - b[0]).norm());
    let gap = ends([b[0], b[1]]);
    let way = a[1] - a[0];
    let opposite = cross(way, centre(a) - a[0]) * cross(way, centre(&b) - a[0]) < 0.0;
    if gap >= SHARED_PX.max(SHARED * length) || !opposite {
        return None;
    }
    let outline = Outline([(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0, a[2], a[3], b[2], b[3]]);
    let depths = outline.panels().map(|panel| ((panel[2] + panel[3] - panel[0] - panel[1]) / 2.0).norm());
    let alike = depths[0].max(depths[1]) < DEEPER * depths[0].min(depths[1]);
    alike.then_some((gap / length, outline))
}

/// Folds of single quadrilaterals, divided in either direction.
pub(super) fn halves(quads: &[Scored], light: &LogLight) -> Vec<Outline> {
    let turned = |quad: Quad| [quad, [quad[1], quad[2], quad[3], quad[0]]];
    quads.iter().flat_map(|scored| turned(scored.quad)).filter_map(|quad| half(&quad, light)).collect()
}

fn half(quad: &Quad, light: &LogLight) -> Option<Outline> {
    let part = |n: usize, of: usize| (n as f64 + 0.5) / of as f64;
    let ends = |u: f64| (between(quad[0], quad[1], u), between(quad[3], quad[2], u));
    let brightness = |n: usize| {
        let (from, to) = ends(part(n, CUTS));
        let at = |k: usize| Some(light.at(between(from, to, part(k, ALONG)))?.mean());
        let mut seen: Vec<f64> = (0..ALONG).filter_map(at).collect();
        seen.sort_by(f64::total_cmp);
        seen.get(seen.len() / 2).copied()
    };
    let profile: Vec<f64> = (0..CUTS).map(brightness).collect::<Option<_>>()?;
    let ridge = |n: usize| 2.0 * profile[n] - profile[n - AWAY] - profile[n + AWAY];
    let cut = (AWAY..CUTS - AWAY).max_by(|a, b| ridge(*a).total_cmp(&ridge(*b)))?;
    let (from, to) = ends(part(cut, CUTS));
    (ridge(cut) > LEAST_RIDGE).then(|| Outline([from, to, quad[3], quad[0], quad[2], quad[1]]))
}

/// The same folds with one or both ends of the crease on the straight line between outer corners: the ends of
/// two panels are often seen in one line.
pub(super) fn straightened(fold: &Outline) -> Vec<Outline> {
    const LEAST_PX: f64 = 4.0;
    let c = &fold.0;
    let crossing = |end: usize, from: Place, to: Place| {
        let crease = c[1] - c[0];
        let part = cross(c[0] - from, crease) / cross(to - from, crease);
        let place = between(from, to, part);
        ((0.1..0.9).contains(&part) && (place - c[end]).amax() > LEAST_PX).then_some(place)
    };
    let ends = [crossing(0, c[3], c[5]), crossing(1, c[2], c[4])];
    let moved = |first: Option<Place>, second: Option<Place>| {
        let mut moved = *fold;
        moved.0[0] = first.unwrap_or(c[0]);
        moved.0[1] = second.unwrap_or(c[1]);
        moved
    };
    let mut folds: Vec<Outline> = Vec::new();
    folds.extend(ends[0].map(|_| moved(ends[0], None)));
    folds.extend(ends[1].map(|_| moved(None, ends[1])));
    folds.extend(ends[0].and(ends[1]).map(|_| moved(ends[0], ends[1])));
    folds
}

/// The fold with the ends of the crease moved along the outline to the ridge or step of light.
pub(super) fn slid(fold: &Outline, evidence: &Evidence) -> Outline {
    const STEPS: i32 = 7;
    const STEP: f64 = 0.05;
    let c = &fold.0;
    let along = |end: usize, [to_a, to_b]: [usize; 2], step: i32| {
        between(c[end], c[if step < 0 { to_a } else { to_b }], f64::from(step.abs()) * STEP)
    };
    let mut best = (f64::NEG_INFINITY, [c[0], c[1]]);
    for i in -STEPS..=STEPS {
        for j in -STEPS..=STEPS {
            let ends = [along(0, [3, 5], i), along(1, [2, 4], j)];
            let (step, bend) = crease_like(ends, evidence);
            let ridge = (bend.max(0.0) / 0.006).tanh();
            let score = step.max(ridge) + 0.3 * ridge - 0.012 * f64::from(i.abs() + j.abs());
            if score > best.0 {
                best = (score, ends);
            }
        }
    }
    let mut moved = *fold;
    [moved.0[0], moved.0[1]] = best.1;
    moved
}

/// Mean strength of a step along a line, from 0 to 1, and mean coarse curvature of light across it.
fn crease_like([from, to]: [Place; 2], evidence: &Evidence) -> (f64, f64) {
    const PLACES: usize = 30;
    let along = (to - from).normalize();
    let across = Place::new(-along.y, along.x);
    let place = |k: usize| between(from, to, 0.08 + 0.84 * (k as f64 + 0.5) / PLACES as f64);
    let found = (0..PLACES).filter_map(|k| evidence.coarse_at(place(k), across));
    let (count, step, bend) = found.fold((0.0, 0.0, 0.0), |(count, steps, bends), (step, bend)| {
        (count + 1.0, steps + step / (step + 0.006), bends + bend)
    });
    if count > 0.0 { (step / count, bend / count) } else { (0.0, 0.0) }
}

#[cfg(test)]
mod tests {
    use super::super::outline::area;
    use super::super::synthetic::{outline, views};
    use super::*;

    #[test]
    fn two_panels_make_a_fold_and_one_with_itself_none() {
        let [a, b] = outline().panels();
        // corners may start anywhere, in either orientation
        let quads = [a, [b[2], b[1], b[0], b[3]]].map(|quad| Scored { quad, score: 1.0 });
        let found = pairs(&quads);
        assert!(found.iter().any(|(_, fold)| fold.distance_px(&outline()) < 1e-9));
        assert!(pairs(&quads[..1]).is_empty());
    }

    #[test]
    fn a_hexagon_is_cut_at_its_ridge() {
        let (_, evidence, light) = views();
        let c = outline().0;
        let whole = [c[3], c[5], c[4], c[2]];
        assert!(area(&whole).abs() > 0.0);
        let cut = halves(&[Scored { quad: whole, score: 1.0 }], &light);
        let on_crease =
            |fold: &&Outline| (fold.0[0].x - 159.0).abs() < 6.0 && (fold.0[1].x - 159.0).abs() < 6.0;
        let Some(fold) = cut.iter().find(on_crease) else { unreachable!("{cut:?}") };
        // the crease ends below the line between outer corners
        assert!(straightened(&outline()).iter().all(|other| other.distance_px(&outline()) > 4.0));
        let moved = slid(fold, &evidence);
        assert!((moved.0[0].x - 159.0).abs() < 8.0, "{moved:?}");
    }
}
