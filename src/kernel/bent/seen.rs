//! The parts of a bent sheet visible in each facet.
//!
//! Facets divide the quadrilateral between an outer side and the line where the panels would meet without
//! rounding, at which their ends point in the picture. Seen from aside, a rounding reaches beyond that line,
//! and the facets of a panel show some of the other one.

use nalgebra::{Matrix2, Vector2};

use super::section::Strip;

/// Rows that begin closer to the crease than this fraction of the depth are divided at strip boundaries.
const DIVIDED: f64 = 0.2;
/// Most of the first row that is not read.
const UNREAD_MOST: f64 = 0.5;

/// A point representing part of a row of facets.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Its row.
    pub row: usize,
    /// Its weight in the row's value.
    pub weight: f64,
    /// Its strip, among those of panel 0 and then of panel 1.
    pub strip: usize,
    /// Position on the strip, from 0 to 1 outwards.
    pub share: f64,
}

/// A strip as it appears in the picture.
struct Apparent {
    strip: usize,
    /// Where it begins and ends on the way outwards, as fractions of the depth.
    ends: [f64; 2],
    /// Whether it belongs to the other panel and thus leads towards the crease.
    is_other: bool,
}

/// A row of facets between two fractions of the depth, of which the part next to the crease may be unread:
/// its value is that of a line through the light of the rest, at the middle of the whole.
struct Row {
    number: usize,
    read: [f64; 2],
    unread: f64,
}

/// Points of the rows between `edges` (fractions of the depth from 0 to 1) of one panel on the strips of
/// both, seen from far away in the direction `view` (x, z); `unread`: the fraction of the panel next to the
/// crease that is not read.
pub fn samples(
    panels: &[Vec<Strip>; 2],
    panel: usize,
    (edges, unread): (&[f64], f64),
    view: Vector2<f64>,
) -> Vec<Sample> {
    let shown = shown(panels, panel, view);
    let row = |(number, edge): (usize, &[f64])| {
        let unread = if number == 0 { unread.max(0.0).min(UNREAD_MOST * (edge[1] - edge[0])) } else { 0.0 };
        Row { number, read: [edge[0] + unread, edge[1]], unread }
    };
    edges.windows(2).enumerate().map(row).flat_map(|row| row.samples(&shown)).collect()
}

/// The strips that appear on a panel, in order outwards.
fn shown(panels: &[Vec<Strip>; 2], panel: usize, view: Vector2<f64>) -> Vec<Apparent> {
    let (own, other) = (&panels[panel], &panels[1 - panel]);
    let Some(last) = own.last() else { return Vec::new() };
    let across = Matrix2::from_columns(&[last.far, view]).try_inverse().unwrap_or_else(Matrix2::identity);
    let place = |point: Vector2<f64>| (across * point).x;
    let first = |panel: usize| if panel == 0 { 0 } else { panels[0].len() };
    let beyond = other.iter().take_while(|strip| place(strip.near) > 0.0).enumerate();
    let others: Vec<_> =
        beyond.map(|(n, strip)| (first(1 - panel) + n, [strip.far, strip.near], true)).collect();
    let own = own.iter().enumerate().map(|(n, strip)| (first(panel) + n, [strip.near, strip.far], false));
    // a strip never begins closer to the crease than those that hide it
    let mut reached = f64::NEG_INFINITY;
    let appear = |(strip, ends, is_other): (usize, [Vector2<f64>; 2], bool)| {
        let begin = place(ends[0]).max(reached);
        reached = place(ends[1]).clamp(begin, begin.max(1.0));
        Apparent { strip, ends: [begin, reached], is_other }
    };
    others.into_iter().rev().chain(own).map(appear).collect()
}

impl Row {
    /// The points that represent it.
    fn samples(&self, shown: &[Apparent]) -> Vec<Sample> {
        let [begin, end] = self.read;
        let boundaries = shown.iter().map(|strip| strip.ends[1]);
        let inside = boundaries.filter(|at| begin < DIVIDED && *at > begin && *at < end);
        let ends: Vec<f64> = std::iter::once(begin).chain(inside).chain([end]).collect();
        ends.windows(2).filter_map(|part| self.sample([part[0], part[1]], shown)).collect()
    }

    /// The middle of a part of it.
    fn sample(&self, part: [f64; 2], shown: &[Apparent]) -> Option<Sample> {
        let middle = 0.5 * (part[0] + part[1]);
        let Apparent { strip, ends: [begin, end], is_other } =
            shown.iter().find(|strip| strip.ends[1] > middle).or(shown.last())?;
        let along = ((middle - begin) / (end - begin)).clamp(0.0, 1.0);
        let share = if *is_other { 1.0 - along } else { along };
        Some(Sample { row: self.number, weight: self.weight(part, middle), strip: *strip, share })
    }

    /// Weight of a part with this middle in the value of the line.
    fn weight(&self, part: [f64; 2], middle: f64) -> f64 {
        let [begin, end] = self.read;
        let (length, off) = (end - begin, middle - 0.5 * (begin + end));
        (part[1] - part[0]) / length * (1.0 - 6.0 * self.unread * off / (length * length))
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // a test stops at the first surprise

    use proptest::prelude::*;

    use super::super::BentFold;
    use super::super::section::strips;
    use super::*;
    use crate::geometry::{FacetGrid, Fold};

    proptest! {
        /// A row's value of even light is that light, wherever the camera stands and whatever is not read.
        #[test]
        fn weights_add_up_to_one(radius in 0.0..0.05, view in -0.3..0.3, unread in 0.0..0.04) {
            let fold = Fold::new(48.0, 1.0, 1.0, FacetGrid { rows: 10, cols: 1 }).unwrap();
            let panels = strips(&BentFold { crease_radius: radius, ..BentFold::ideal(48.0) }, &fold);
            let edges: Vec<f64> = (0..=10).map(|n| f64::from(n) / 10.0).collect();
            for panel in [0, 1] {
                let all = samples(&panels, panel, (&edges, unread), Vector2::new(view, 1.0));
                for row in 0..10 {
                    let of_row = all.iter().filter(|sample| sample.row == row);
                    prop_assert!((of_row.map(|sample| sample.weight).sum::<f64>() - 1.0).abs() < 1e-12);
                }
            }
        }
    }

    /// From the side of panel 1 its rounding reaches into the facets of panel 0.
    #[test]
    fn a_rounding_seen_from_aside_appears_on_the_other_panel() {
        let fold = Fold::new(48.0, 1.0, 1.0, FacetGrid { rows: 10, cols: 1 }).unwrap();
        let panels = strips(&BentFold { crease_radius: 0.03, ..BentFold::ideal(48.0) }, &fold);
        let edges = [0.0, 0.1, 1.0];
        let others = |panel: usize| {
            let all = samples(&panels, panel, (&edges, 0.0), Vector2::new(0.2, 1.0));
            all.iter().filter(|sample| (sample.strip < panels[0].len()) == (panel == 1)).count()
        };
        assert!(others(0) > 0 && others(1) == 0, "{} {}", others(0), others(1));
    }
}
