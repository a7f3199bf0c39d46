//! The six corners of a fold in a picture, and its quadrilaterals.

use nalgebra::Vector2;

use crate::image::placing::Point;

/// A place in the picture or a vector in it, px.
pub(super) type Place = Vector2<f64>;

/// Four corners in order around a quadrilateral.
pub(super) type Quad = [Place; 4];

/// The corners of a fold: crease ends 0 and 1, outer ends 1 and 0 of one panel, outer ends 1 and 0 of the
/// other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Outline(pub [Place; 6]);

/// The corners that each side joins: the crease, then the sides of each panel from end 1 around to end 0.
pub(super) const SIDES: [(usize, usize); 7] = [(0, 1), (1, 2), (2, 3), (3, 0), (1, 4), (4, 5), (5, 0)];
/// The corners of each panel, in the order of [`PANEL_CORNERS`](crate::image::PANEL_CORNERS).
const PANELS: [[usize; 4]; 2] = [[0, 1, 2, 3], [0, 1, 4, 5]];
/// Equivalent orders of the corners of one fold: its ends, its panels or both swapped.
const NAMINGS: [[usize; 6]; 4] =
    [[0, 1, 2, 3, 4, 5], [1, 0, 3, 2, 5, 4], [0, 1, 4, 5, 2, 3], [1, 0, 5, 4, 3, 2]];

/// Least length, px, of the longest side and of the side of a square of the same area.
const LEAST_PX: f64 = 14.0;
/// Least length of the shortest side, relative to [`LEAST_PX`].
const SHORTEST: f64 = 0.7;
/// Largest difference of opposite sides, relative to the longer one, for a rectangle seen from not too near.
const LEAST_PARALLEL: f64 = 0.45;
/// Least sine of an angle between adjacent sides.
const LEAST_SINE: f64 = 0.12;
/// Largest ratio of the longest side to the shortest.
const LONGEST: f64 = 8.0;

/// Twice the signed area of the triangle between two vectors.
pub(super) fn cross(a: Place, b: Place) -> f64 {
    a.perp(&b)
}

/// The area of a quadrilateral, px², positive if clockwise as seen.
pub(super) fn area(quad: &Quad) -> f64 {
    0.5 * cross(quad[0] - quad[2], quad[1] - quad[3])
}

/// Whether a place is inside a convex quadrilateral of either orientation.
pub(super) fn is_inside(quad: &Quad, place: Place) -> bool {
    let side = |k: usize| cross(quad[(k + 1) % 4] - quad[k], place - quad[k]);
    let sides = [0, 1, 2, 3].map(side);
    sides.iter().all(|side| *side > 0.0) || sides.iter().all(|side| *side < 0.0)
}

/// The middle of a quadrilateral's corners.
pub(super) fn centre(quad: &Quad) -> Place {
    quad.iter().sum::<Place>() / 4.0
}

/// The point at this fraction of the way from `a` to `b`.
pub(super) fn between(a: Place, b: Place, part: f64) -> Place {
    a + (b - a) * part
}

/// Whether a sufficiently distant rectangle may look like this: convex, not tiny, nearly a parallelogram.
pub(super) fn may_be_rectangle(quad: &Quad) -> bool {
    let sides = [0, 1, 2, 3].map(|k| quad[(k + 1) % 4] - quad[k]);
    let lengths = sides.map(|side| side.norm());
    let turns = [0, 1, 2, 3].map(|k| cross(sides[k], sides[(k + 1) % 4]));
    let longest = lengths.iter().copied().fold(0.0, f64::max);
    let shortest = lengths.iter().copied().fold(f64::INFINITY, f64::min);
    let differ =
        |k: usize| (sides[k] + sides[k + 2]).norm() < LEAST_PARALLEL * lengths[k].max(lengths[k + 2]);
    let sine = |k: usize| turns[k].abs() > LEAST_SINE * lengths[k] * lengths[(k + 1) % 4];
    let one_way = turns.iter().all(|turn| *turn > 0.0) || turns.iter().all(|turn| *turn < 0.0);
    one_way
        && shortest > SHORTEST * LEAST_PX
        && longest > LEAST_PX
        && longest < LONGEST * shortest
        && area(quad).abs() > LEAST_PX * LEAST_PX
        && differ(0)
        && differ(1)
        && (0..4).all(sine)
}

impl Outline {
    /// Its two panels.
    pub fn panels(&self) -> [Quad; 2] {
        PANELS.map(|panel| panel.map(|corner| self.0[corner]))
    }

    /// The two ends of a side.
    pub fn side(&self, side: usize) -> (Place, Place) {
        let (from, to) = SIDES[side];
        (self.0[from], self.0[to])
    }

    /// Side of a square with the mean area of its panels, px.
    pub fn size_px(&self) -> f64 {
        (self.panels().iter().map(|panel| area(panel).abs()).sum::<f64>() / 2.0).sqrt()
    }

    /// The greatest distance between the corners of two folds, px, under the order that matches best.
    pub fn distance_px(&self, other: &Self) -> f64 {
        let furthest = |naming: [usize; 6]| {
            let far = |(k, corner): (usize, usize)| (self.0[corner] - other.0[k]).norm();
            naming.into_iter().enumerate().map(far).fold(0.0, f64::max)
        };
        NAMINGS.into_iter().map(furthest).fold(f64::INFINITY, f64::min)
    }

    /// Whether both panels may be rectangles, one on either side of the crease.
    pub fn may_be_fold(&self) -> bool {
        let [a, b] = self.panels();
        may_be_rectangle(&a) && may_be_rectangle(&b) && area(&a) * area(&b) < 0.0
    }

    /// The same fold in the user's order: with an upright crease end 0 at the bottom and panel 0 on the left;
    /// with a level crease panel 0 the lower one.
    pub fn named(&self) -> Self {
        let renamed = |naming: [usize; 6]| Self(naming.map(|corner| self.0[corner]));
        let is_usual = |outline: &Self| {
            let crease = outline.0[1] - outline.0[0];
            crease.x + crease.y < 0.0 && cross(crease, outline.0[3] - outline.0[0]) < 0.0
        };
        NAMINGS.into_iter().map(renamed).find(is_usual).unwrap_or(*self)
    }

    /// The same in a picture `scale` times as large.
    pub fn scaled(&self, scale: f64) -> Self {
        Self(self.0.map(|corner| corner * scale))
    }

    /// Whether two places are on the two panels, in either order.
    pub fn has_panels_at(&self, places: [Point; 2]) -> bool {
        let [a, b] = places.map(|p| Place::new(p.x, p.y));
        let [first, second] = self.panels();
        (is_inside(&first, a) && is_inside(&second, b)) || (is_inside(&first, b) && is_inside(&second, a))
    }

    /// The corners of each panel as points.
    pub fn points(&self) -> [[Point; 4]; 2] {
        self.panels().map(|panel| panel.map(|corner| Point::new(corner.x, corner.y)))
    }
}

/// The most probable of the scored `folds`, at most `most`, omitting those less than `apart_px` from a more
/// probable one.
pub(super) fn distinct(mut folds: Vec<(f64, Outline)>, apart_px: f64, most: usize) -> Vec<(f64, Outline)> {
    folds.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut kept: Vec<(f64, Outline)> = Vec::new();
    for (score, fold) in folds {
        if kept.len() == most {
            break;
        }
        if kept.iter().all(|(_, other)| fold.distance_px(other) >= apart_px) {
            kept.push((score, fold));
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::super::synthetic::outline;
    use super::*;

    #[test]
    fn a_fold_has_one_name_however_it_was_found() {
        for naming in NAMINGS {
            let other = Outline(naming.map(|corner| outline().0[corner]));
            assert_eq!(other.named(), outline());
            assert!(other.distance_px(&outline()) < 1e-12);
        }
        let lower = Outline(outline().0.map(|p| Place::new(p.y, p.x))).named();
        assert!(lower.0[0].x > lower.0[1].x && lower.0[3].y > lower.0[0].y, "{lower:?}");
    }

    #[test]
    fn panels_lie_on_either_side_of_the_crease() {
        assert!(outline().may_be_fold());
        let mut folded = outline();
        (folded.0[4], folded.0[5]) = (folded.0[2], folded.0[3]);
        assert!(!folded.may_be_fold());
        let [a, _] = outline().panels();
        assert!(may_be_rectangle(&a) && !may_be_rectangle(&[a[0], a[2], a[1], a[3]]));
        assert!((outline().size_px() - 125.0).abs() < 10.0);
    }

    #[test]
    fn of_folds_that_are_alike_the_likelier_one_stays() {
        let moved = |px: f64| Outline(outline().0.map(|corner| corner + Place::new(px, 0.0)));
        let kept = distinct(vec![(1.0, moved(0.0)), (3.0, moved(1.0)), (2.0, moved(9.0))], 2.0, 5);
        assert_eq!(kept, [(3.0, moved(1.0)), (2.0, moved(9.0))]);
        assert_eq!(distinct(kept, 2.0, 1).len(), 1);
    }
}
