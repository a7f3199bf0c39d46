//! Sides of marked panels along which no edge of the sheet lies.
//!
//! A panel that is entirely marked ends at its outer sides, beyond which brightness or colour differs. If
//! nothing changes across a side, the sheet continues beyond the corners or does not reach them.

use crate::image::photograph::{Photograph, Pixel};
use crate::image::placing::Grid;

/// Range of the strips on either side of a side, and along it, relative to the panel and clear of the edge's
/// blur; number of pieces that are compared.
const STRIP: [f64; 2] = [0.03, 0.09];
const ALONG: [f64; 2] = [0.05, 0.95];
const PIECES: usize = 6;
/// Sampled points of a piece, along and across.
const POINTS: [usize; 2] = [12, 4];
/// Fewest visible pieces of a side for a judgement, and the fraction of them without a change across an open
/// one.
const SEEN_LEAST: usize = 4;
const OPEN_SHARE: f64 = 0.75;
/// Least change of brightness (natural logarithm) in some channel where the sheet ends; on the sheet, except
/// at the crease, it changes by less over a tenth of a panel.
const STEP_LEAST: f64 = 0.07;

/// A panel's sides other than the crease.
const SIDES: [&str; 3] = ["the outer side", "the side at crease end 0", "the side at crease end 1"];

/// Names of the open sides of marked panels, such as `the outer side of panel 0`.
///
/// # Arguments
/// - `panels`: their positions; the first side of each is its crease.
#[must_use]
pub fn open_sides(photograph: &Photograph, panels: &[Grid]) -> Vec<String> {
    let numbered = panels.iter().filter_map(|panel| Some((panel, panel.panel?)));
    let open = numbered.flat_map(|(panel, number)| {
        let is_open = move |side: &usize| is_open(photograph, panel, *side);
        (0..SIDES.len()).filter(is_open).map(move |side| format!("{} of panel {number}", SIDES[side]))
    });
    open.collect()
}

fn is_open(photograph: &Photograph, panel: &Grid, side: usize) -> bool {
    let [near, far] = STRIP;
    let (inner, outer) = match side {
        0 | 2 => ([1.0 - far, 1.0 - near], [1.0 + near, 1.0 + far]),
        _ => ([near, far], [-far, -near]),
    };
    let [inside, outside] = [inner, outer].map(|across| pieces(photograph, panel, side, across));
    let pairs = inside.iter().zip(&outside);
    let steps: Vec<f64> = pairs.filter_map(|(a, b)| step(a.as_ref()?, b.as_ref()?)).collect();
    let alike = steps.iter().filter(|step| **step < STEP_LEAST).count();
    steps.len() >= SEEN_LEAST && alike as f64 >= OPEN_SHARE * steps.len() as f64
}

/// Means of the pieces of a strip along a side, `across` being its range of distances from the crease, or of
/// positions along it; none for a piece of which half is outside the picture or clipped.
fn pieces(photograph: &Photograph, panel: &Grid, side: usize, across: [f64; 2]) -> Vec<Option<[f64; 3]>> {
    let place =
        |[from, to]: [f64; 2], n: usize, count: usize| from + (to - from) * (n as f64 + 0.5) / count as f64;
    let light = |along: usize, across_it: usize| {
        let along = place(ALONG, along, PIECES * POINTS[0]);
        let across = place(across, across_it, POINTS[1]);
        let (u, v) = if side == 0 { (along, across) } else { (across, along) };
        let point = panel.outline.to_image(u, v);
        let is_seen = (0.0..photograph.width() as f64).contains(&point.x)
            && (0.0..photograph.height() as f64).contains(&point.y);
        match is_seen.then(|| photograph.pixel(point.x as usize, point.y as usize)) {
            Some(Pixel::Light(light)) => Some(light),
            Some(Pixel::Clipped | Pixel::NotFinite) | None => None,
        }
    };
    let piece = |piece: usize| {
        let along = piece * POINTS[0]..(piece + 1) * POINTS[0];
        let points = along.flat_map(|along| (0..POINTS[1]).map(move |across| (along, across)));
        let seen: Vec<[f64; 3]> = points.filter_map(|(along, across)| light(along, across)).collect();
        let mean = |k: usize| seen.iter().map(|one| one[k]).sum::<f64>() / seen.len() as f64;
        (2 * seen.len() > POINTS[0] * POINTS[1]).then(|| [0, 1, 2].map(mean))
    };
    (0..PIECES).map(piece).collect()
}

/// The greatest change of a channel, in logarithms.
fn step(inside: &[f64; 3], outside: &[f64; 3]) -> Option<f64> {
    let change = |(a, b): (&f64, &f64)| if *a > 0.0 && *b > 0.0 { (a / b).ln().abs() } else { f64::INFINITY };
    inside.iter().zip(outside).map(change).reduce(f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::placing::{Homography, Point};

    /// A sheet of 160 x 120 px on a dark table, its panel marked to `right` and `bottom`.
    fn open(right: f64, bottom: f64) -> Vec<String> {
        let is_sheet = |n: usize| (40..200).contains(&(n % 320)) && (40..160).contains(&(n / 320));
        let light: Vec<f32> = (0..320 * 240).flat_map(|n| [if is_sheet(n) { 0.5 } else { 0.1 }; 3]).collect();
        let photograph = Photograph::from_light(320, 240, light).unwrap();
        let corners =
            [(40., 40.), (right, 40.), (right, bottom), (40., bottom)].map(|(x, y)| Point::new(x, y));
        let outline = Homography::from_unit_square(corners).unwrap();
        open_sides(&photograph, &[Grid::of_panel(0, outline, &[0.0, 1.0], &[0.0, 1.0])])
    }

    #[test]
    fn a_panel_ends_where_it_is_marked() {
        assert!(open(200.0, 160.0).is_empty());
        assert_eq!(open(200.0, 120.0), ["the outer side of panel 0"]);
        assert_eq!(open(140.0, 160.0), ["the side at crease end 1 of panel 0"]);
        assert_eq!(open(264.0, 160.0), ["the side at crease end 1 of panel 0"]);
    }
}
