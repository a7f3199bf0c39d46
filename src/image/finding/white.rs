//! Locates even bright areas of a photograph that may be white: paper, a card, the table.
//!
//! White reflects as much as anything in the picture, in all channels at once. Whether an area is paper, a
//! card or a painted wall, the picture does not show: a person decides.

use super::outline::{Place, Quad, centre, is_inside};
use super::reduced::Reduced;
use crate::image::photograph::{Photograph, Pixel};
use crate::image::placing::Point;

/// Side of a cell, px of the reduced picture.
const CELL_PX: usize = 6;
/// Largest standard deviation of the light within a cell, and largest difference of an area's cells from its
/// brightest one, relative to the light.
const UNEVEN: f32 = 0.04;
const UNLIKE: f32 = 0.08;
/// Least light of an area in its darkest channel, relative to that of the brightest area.
const LEAST_OF_BRIGHTEST: f32 = 0.6;
/// Least light of an area in its brightest channel, relative to the picture's white level: unless pictures
/// are far underexposed, what is darker is a table. Set with photographs of `../shared/real` in view.
const LEAST_OF_FULL_SCALE: f32 = 0.25;
/// Least side of an area, cells.
const LEAST_CELLS: usize = 4;
/// Most areas returned.
const MOST: usize = 3;
/// Panels and a chart are enlarged by this factor, so that their margins do not count as areas.
const MARGIN: f64 = 1.15;

/// Mean light of the cells of a picture, row by row; `None` where light is uneven.
struct Cells {
    width: usize,
    light: Vec<Option<[f32; 3]>>,
}

/// Corners of the areas, px of the photograph, the whitest first: squares inside them, clear of `panels` and
/// `chart`.
pub(super) fn white_areas(
    photograph: &Photograph,
    reduced: &Reduced,
    (panels, chart): (Option<&[[Point; 4]; 2]>, Option<&[Point; 4]>),
) -> Vec<[Point; 4]> {
    let scale = reduced.scale as f64;
    let quad = |corners: &[Point; 4]| corners.map(|corner| Place::new(corner.x, corner.y) / scale);
    let panels: Vec<Quad> = panels.into_iter().flatten().map(quad).collect();
    let taken: Vec<Quad> = panels.iter().copied().chain(chart.map(quad)).map(enlarged).collect();
    let mut cells = Cells::of(reduced, &taken);
    let least = least_light(reduced, &panels);
    let seeds = cells.whitest_first(least);
    let Some(brightest) = seeds.first().and_then(|seed| cells.light[*seed]).map(darkest_channel) else {
        return Vec::new();
    };
    let mut areas = Vec::new();
    for seed in seeds {
        let Some(light) = cells.light[seed] else { continue }; // of an area that is taken
        if areas.len() == MOST || darkest_channel(light) < LEAST_OF_BRIGHTEST * brightest {
            break;
        }
        let of_full_scale = light.iter().zip(reduced.one).map(|(light, one)| light * one).fold(0.0, f32::max);
        let square = cells.take_area(seed, light).filter(|_| of_full_scale >= LEAST_OF_FULL_SCALE);
        let square = square.map(|square| square.map(|place| scale * place));
        areas.extend(square.filter(|square| !is_clipped(photograph, square)));
    }
    areas.into_iter().map(|square: Quad| square.map(|place| Point::new(place.x, place.y))).collect()
}

fn darkest_channel(light: [f32; 3]) -> f32 {
    light.into_iter().fold(f32::INFINITY, f32::min)
}

fn enlarged(quad: Quad) -> Quad {
    let middle = centre(&quad);
    quad.map(|corner| middle + (corner - middle) * MARGIN)
}

/// Least light of white, channel by channel: the median of the panels, at one pixel per cell. Panels face the
/// sun obliquely, and no sheet is whiter than white.
fn least_light(reduced: &Reduced, panels: &[Quad]) -> [f32; 3] {
    let mut of_panels: [Vec<f32>; 3] = Default::default();
    for y in (0..reduced.height).step_by(CELL_PX) {
        for x in (0..reduced.width).step_by(CELL_PX) {
            let place = Place::new(x as f64 + 0.5, y as f64 + 0.5);
            if panels.iter().any(|panel| is_inside(panel, place)) {
                let light = reduced.light[y * reduced.width + x];
                of_panels.iter_mut().zip(light).for_each(|(all, light)| all.push(light));
            }
        }
    }
    of_panels.map(|mut all| {
        let middle = all.len() / 2;
        if all.is_empty() { 0.0 } else { *all.select_nth_unstable_by(middle, f32::total_cmp).1 }
    })
}

/// Whether a corner or the middle of an area, px of the photograph, is overexposed.
fn is_clipped(photograph: &Photograph, square: &Quad) -> bool {
    let is_clipped =
        |place: &Place| matches!(photograph.pixel(place.x as usize, place.y as usize), Pixel::Clipped);
    square.iter().chain([&centre(square)]).any(is_clipped)
}

impl Cells {
    fn of(reduced: &Reduced, taken: &[Quad]) -> Self {
        let [width, height] = [reduced.width, reduced.height].map(|side| side / CELL_PX);
        let cell = |k: usize| {
            let (x, y) = (k % width * CELL_PX, k / width * CELL_PX);
            let middle = Place::new(x as f64, y as f64) + Place::repeat(0.5 * CELL_PX as f64);
            if taken.iter().any(|quad| is_inside(quad, middle)) {
                return None;
            }
            let (mut sums, mut squares) = ([0.0_f32; 3], [0.0_f32; 3]);
            for y in y..y + CELL_PX {
                for light in &reduced.light[y * reduced.width + x..][..CELL_PX] {
                    for channel in 0..3 {
                        sums[channel] += light[channel];
                        squares[channel] += light[channel] * light[channel];
                    }
                }
            }
            let count = (CELL_PX * CELL_PX) as f32;
            let means = sums.map(|sum| sum / count);
            let is_even = (0..3).all(|channel| {
                let variance = squares[channel] / count - means[channel] * means[channel];
                variance <= (UNEVEN * means[channel]).powi(2)
            });
            is_even.then_some(means)
        };
        Self { width, light: (0..width * height).map(cell).collect() }
    }

    /// The even cells with at least this light, those with the most in their darkest channel first.
    fn whitest_first(&self, least: [f32; 3]) -> Vec<usize> {
        let is_bright = |light: &[f32; 3]| light.iter().zip(least).all(|(light, least)| *light > least);
        let bright =
            self.light.iter().enumerate().filter_map(|(k, light)| Some((k, light.filter(is_bright)?)));
        let mut bright: Vec<_> = bright.map(|(k, light)| (k, darkest_channel(light))).collect();
        bright.sort_by(|a, b| b.1.total_cmp(&a.1));
        bright.into_iter().map(|(k, _)| k).collect()
    }

    /// Takes the area around a cell out of the others; returns the largest square within it, half a cell
    /// inside, if it is large enough.
    fn take_area(&mut self, seed: usize, light: [f32; 3]) -> Option<Quad> {
        let is_alike = |other: &[f32; 3]| {
            other.iter().zip(light).all(|(other, light)| (other - light).abs() < UNLIKE * light)
        };
        let (mut area, mut next) = (Vec::new(), vec![seed]);
        while let Some(k) = next.pop() {
            if !self.light.get(k).is_some_and(|light| light.as_ref().is_some_and(is_alike)) {
                continue;
            }
            self.light[k] = None;
            area.push(k);
            let x = k % self.width;
            next.extend((x > 0).then(|| k - 1));
            next.extend((x + 1 < self.width).then_some(k + 1));
            next.extend(k.checked_sub(self.width));
            next.push(k + self.width);
        }
        if area.len() < LEAST_CELLS * LEAST_CELLS {
            return None;
        }
        area.sort_unstable();
        // side of the largest square that ends at each cell
        let mut sides = vec![0_usize; self.light.len()];
        for k in area {
            let before = |back: usize| k.checked_sub(back).map_or(0, |k| sides[k]);
            let at_edge = k % self.width == 0;
            let shortest = before(1).min(before(self.width)).min(before(self.width + 1));
            sides[k] = if at_edge { 1 } else { shortest + 1 };
        }
        let (end, side) = sides.into_iter().enumerate().max_by_key(|(_, side)| *side)?;
        (side >= LEAST_CELLS).then(|| {
            let px = |cells: f64| cells * CELL_PX as f64;
            let [right, bottom] = [end % self.width, end / self.width].map(|cell| px(cell as f64 + 0.5));
            let [left, top] = [right, bottom].map(|end| end - px(side as f64 - 1.0));
            [(left, top), (right, top), (right, bottom), (left, bottom)].map(|(x, y)| Place::new(x, y))
        })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // a test stops at the first surprise

    use super::*;

    const WIDTH: usize = 300;
    const HEIGHT: usize = 200;

    /// A picture of rectangles, x, y, width and height each, of these colours on a dark table.
    fn areas(rectangles: &[([usize; 4], [f32; 3])]) -> Vec<[Point; 4]> {
        let mut noise = 1_u32;
        let mut light = Vec::new();
        for k in 0..WIDTH * HEIGHT {
            let (x, y) = (k % WIDTH, k / WIDTH);
            let on = |([left, top, width, height], _): &&([usize; 4], [f32; 3])| {
                (*left..left + width).contains(&x) && (*top..top + height).contains(&y)
            };
            for value in rectangles.iter().find(on).map_or([0.1, 0.12, 0.1], |(_, colour)| *colour) {
                noise = noise.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                light.push(value * (1.0 + 0.02 * ((noise >> 8) as f32 / (1 << 24) as f32 - 0.5)));
            }
        }
        let photograph = Photograph::from_light(WIDTH, HEIGHT, light).unwrap();
        white_areas(&photograph, &Reduced::of(&photograph), (None, None))
    }

    const WHITE: [f32; 3] = [0.5, 0.8, 0.6];

    #[test]
    fn a_white_card_is_found_and_a_coloured_one_is_not() {
        let yellow = ([180, 60, 70, 70], [0.52, 0.75, 0.1]);
        let found = areas(&[([40, 50, 90, 70], WHITE), yellow]);
        let [[a, _, c, _]] = found[..] else { panic!("{found:?}") };
        assert!(a.x >= 40.0 && a.y >= 50.0 && c.x <= 130.0 && c.y <= 120.0 && c.x - a.x > 50.0, "{found:?}");
    }

    #[test]
    fn the_whitest_comes_first_and_small_ones_are_left() {
        let grey = WHITE.map(|light| 0.8 * light);
        let found =
            areas(&[([40, 50, 60, 60], grey), ([150, 50, 60, 60], WHITE), ([250, 20, 15, 15], WHITE)]);
        assert!(found.len() == 2 && found[0][0].x >= 150.0 && found[1][0].x < 100.0, "{found:?}");
        assert!(areas(&[]).is_empty());
    }
}
