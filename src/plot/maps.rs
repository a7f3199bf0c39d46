//! One number per facet, with panels side by side as on the unfolded sheet.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::bitmap::Bitmap;
use super::figure::{Drawn, Figure};
use super::scale::{Scale, UNKNOWN};
use super::text::{GREY, SIZE, SMALL, elided, number, say, style};
use crate::geometry::Panel;

/// Space for maps, px, how many fit into a row, and their largest height.
const WIDTH: u32 = 700;
const PER_ROW: usize = 3;
const HIGHEST: u32 = 260;
const GAP: u32 = 20;
const MARGIN: i32 = 30;
const TITLE: i32 = 30;
/// Height of the text above and below a map.
const WORDS: i32 = 18;
/// Width and height of the colour bar.
const BAR: (u32, u32) = (300, 14);
const FOOT: i32 = 64;
/// Gap between panels, px.
const CREASE: u32 = 2;
/// Least width of a panel that is labelled with its number.
const NUMBERED: u32 = 14;
/// Largest ratio of the sides of a panel as drawn.
const ASPECT: f64 = 3.0;

/// Numbers of facets under one heading.
#[derive(Clone, Debug)]
pub struct FacetMap {
    /// What they mean.
    pub title: String,
    /// One per facet of the scene, none where unknown.
    pub values: Vec<Option<f64>>,
}

/// Panels side by side, those with even numbers with the crease on the right, the others on the left, so that
/// two halves of a crease are adjacent.
pub(super) struct Surface<'a> {
    panels: &'a [(usize, Panel)],
}

impl<'a> Surface<'a> {
    pub fn new(panels: &'a [(usize, Panel)]) -> Self {
        Self { panels }
    }

    /// Depths and width of the panels, in their unit, with limited ratios.
    fn extents(&self) -> (Vec<f64>, f64) {
        let depth = |panel: &Panel| (panel.corners[3] - panel.corners[0]).norm();
        let width = |panel: &Panel| (panel.corners[1] - panel.corners[0]).norm();
        let width = self.panels.iter().map(|(_, panel)| width(panel)).fold(0.0, f64::max);
        let within = |depth: f64| depth.clamp(width / ASPECT, width * ASPECT);
        (self.panels.iter().map(|(_, panel)| within(depth(panel))).collect(), width)
    }

    /// The largest size within `most` that preserves the panels' proportions.
    fn size(&self, most: (u32, u32)) -> (u32, u32) {
        let (depths, width) = self.extents();
        let depth: f64 = depths.iter().sum();
        let scale = (f64::from(most.0) / depth).min(f64::from(most.1) / width);
        ((scale * depth).round() as u32, ((scale * width).round() as u32).max(1))
    }

    /// Left edge and width of each panel if all together have this `width`.
    fn places(&self, width: u32) -> Vec<(i32, u32)> {
        let (depths, _) = self.extents();
        let total: f64 = depths.iter().sum();
        let mut before = 0.0;
        let place = |depth: &f64| {
            let edge = |at: f64| (f64::from(width) * at / total).round() as i32;
            let (left, right) = (edge(before), edge(before + depth));
            before += depth;
            (left, ((right - left) as u32).saturating_sub(CREASE).max(1))
        };
        depths.iter().map(place).collect()
    }

    /// The panels in a rectangle, with facets in the colours of their numbers.
    pub fn bitmaps<'b>(
        &self,
        corner: (i32, i32),
        (width, height): (u32, u32),
        colour: impl Fn(usize) -> RGBColor + Copy + 'b,
    ) -> Vec<Bitmap<'b>>
    where
        'a: 'b,
    {
        let panels = self.panels.iter().zip(self.places(width));
        let bitmap = |((number, panel), (left, wide)): (&'a (usize, Panel), (i32, u32))| {
            let mirrored = number.is_multiple_of(2);
            let facet = move |x: f64, y: f64| facet_at(panel, [y, if mirrored { 1.0 - x } else { x }]);
            Bitmap {
                corner: (corner.0 + left, corner.1),
                size: (wide, height),
                colour: Box::new(move |x, y| colour(facet(x, y))),
            }
        };
        panels.map(bitmap).collect()
    }
}

/// The facet at u along the crease and v away from it, each from 0 to 1.
fn facet_at(panel: &Panel, [u, v]: [f64; 2]) -> usize {
    let within = |edges: &[f64], at: f64| {
        edges.partition_point(|edge| *edge <= at).clamp(1, edges.len().saturating_sub(1).max(1)) - 1
    };
    let cols = panel.col_edges.len() - 1;
    panel.facets.start + within(&panel.row_edges, v) * cols + within(&panel.col_edges, u)
}

/// Maps on one scale, under a title and above the colour bar.
pub(super) struct Maps<'a> {
    pub title: String,
    pub panels: &'a [(usize, Panel)],
    pub maps: Vec<FacetMap>,
    pub scale: Scale,
    /// Label of the bar.
    pub unit: &'static str,
}

impl Maps<'_> {
    /// Width for one map: larger if there are few maps.
    fn space(&self) -> u32 {
        let across = self.maps.len().clamp(1, PER_ROW) as u32;
        (WIDTH - (across - 1) * GAP) / across
    }

    fn map_size(&self) -> (u32, u32) {
        Surface::new(self.panels).size((self.space(), HIGHEST))
    }

    fn corner(&self, map: usize) -> (i32, i32) {
        let (row, column) = ((map / PER_ROW) as i32, (map % PER_ROW) as u32);
        let down = self.map_size().1 as i32 + 2 * WORDS + 8;
        (MARGIN + (column * (self.space() + GAP)) as i32, TITLE + WORDS + row * down)
    }

    fn foot(&self) -> i32 {
        let rows = self.maps.len().div_ceil(PER_ROW).max(1) as i32;
        TITLE + rows * (self.map_size().1 as i32 + 2 * WORDS + 8)
    }

    fn is_known(&self) -> bool {
        self.panels
            .iter()
            .flat_map(|(_, panel)| panel.facets.clone())
            .all(|facet| self.maps.iter().all(|map| map.values.get(facet).is_some_and(Option::is_some)))
    }

    fn words<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>, map: usize) -> Drawn<B> {
        let ((x, y), (width, height)) = (self.corner(map), self.map_size());
        let words = style(SMALL, HPos::Left, BLACK);
        let title = elided(area, &self.maps[map].title, &words, self.space());
        say(area, &title, (x, y - WORDS / 2), &words)?;
        let places = Surface::new(self.panels).places(width);
        let below = y + height as i32 + WORDS / 2 + 1;
        for ((number, _), (left, wide)) in self.panels.iter().zip(places) {
            let text = if wide > 4 * NUMBERED { format!("panel {number}") } else { number.to_string() };
            if wide >= NUMBERED {
                let middle = (x + left + wide as i32 / 2, below);
                say(area, &text, middle, &style(SMALL, HPos::Center, GREY))?;
            }
        }
        Ok(())
    }

    /// The colour bar with its labels.
    fn key<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Drawn<B> {
        let (top, Scale { low, high, .. }) = (self.foot(), self.scale);
        let small = style(SMALL, HPos::Center, BLACK);
        // a single value has one tick, in the middle
        for tick in if self.scale.is_one() { 2..=2 } else { 0..=4 } {
            let (share, x) = (f64::from(tick) / 4.0, MARGIN + tick * BAR.0 as i32 / 4);
            area.draw(&PathElement::new(
                [(x, top + BAR.1 as i32), (x, top + BAR.1 as i32 + 4)],
                BLACK.stroke_width(1),
            ))?;
            say(area, &number(low + share * (high - low)), (x, top + BAR.1 as i32 + 14), &small)?;
        }
        let across = MARGIN + BAR.0 as i32 + 24;
        say(area, self.unit, (across, top + BAR.1 as i32 / 2), &style(SMALL, HPos::Left, BLACK))?;
        if !self.is_known() {
            let patch = [(across, top + 22), (across + 14, top + 36)];
            area.draw(&Rectangle::new(patch, UNKNOWN.filled()))?;
            say(area, "not measured", (across + 20, top + 29), &style(SMALL, HPos::Left, BLACK))?;
        }
        Ok(())
    }
}

impl Figure for Maps<'_> {
    fn size(&self) -> (u32, u32) {
        (2 * MARGIN as u32 + WIDTH, (self.foot() + FOOT) as u32)
    }

    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Drawn<B> {
        say(area, &self.title, (MARGIN, TITLE / 2), &style(SIZE, HPos::Left, BLACK))?;
        (0..self.maps.len()).try_for_each(|map| self.words(area, map))?;
        self.key(area)
    }

    fn bitmaps(&self) -> Vec<Bitmap<'_>> {
        let of_map = |(n, map)| {
            let FacetMap { values, .. }: &FacetMap = map;
            let colour = move |facet: usize| match values.get(facet) {
                Some(Some(value)) => self.scale.colour(*value),
                _ => UNKNOWN,
            };
            Surface::new(self.panels).bitmaps(self.corner(n), self.map_size(), colour)
        };
        let range = self.scale.high - self.scale.low;
        let bar = Bitmap {
            corner: (MARGIN, self.foot()),
            size: BAR,
            colour: Box::new(move |x, _| self.scale.colour(self.scale.low + x * range)),
        };
        self.maps.iter().enumerate().flat_map(of_map).chain([bar]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{FacetGrid, Fold};

    #[test]
    fn a_place_has_its_facet() {
        let fold = Fold::new(50.0, 2.0, 1.0, FacetGrid { rows: 2, cols: 4 }).unwrap();
        let [_, panel] = fold.panels();
        assert_eq!(facet_at(&panel, [0.0, 0.0]), 8);
        assert_eq!(facet_at(&panel, [0.99, 0.4]), 11);
        assert_eq!(facet_at(&panel, [1.0, 1.0]), 15);
    }

    /// Row 0, at the crease, is in the middle of the map.
    #[test]
    fn creases_lie_beside_each_other() {
        let fold = Fold::new(50.0, 1.0, 1.0, FacetGrid { rows: 2, cols: 1 }).unwrap();
        let panels: Vec<_> = fold.panels().into_iter().enumerate().collect();
        let surface = Surface::new(&panels);
        let bitmaps = surface.bitmaps((0, 0), (100, 50), |facet| RGBColor(facet as u8, 0, 0));
        let facets = bitmaps.iter().flat_map(|map| [0.2, 0.8].map(|x| (map.colour)(x, 0.5).0));
        assert_eq!(facets.collect::<Vec<_>>(), [1, 0, 2, 3]);
    }
}
