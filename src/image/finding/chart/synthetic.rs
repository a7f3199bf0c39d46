//! Drawn charts whose corners are known, for tests.
#![allow(clippy::unwrap_used)] // a test stops at the first surprise

use super::colours::{COLUMNS, REFERENCE, ROWS};
use crate::image::photograph::Photograph;
use crate::image::placing::{Homography, Lens, Point};

pub(super) const WIDTH: usize = 480;
pub(super) const HEIGHT: usize = 360;
/// Width of a patch relative to the distance between patches.
const FILLED: f64 = 0.88;
/// Light between patches, and around the chart.
const FRAME: [f64; 3] = [0.03; 3];
const GROUND: [f64; 3] = [0.3, 0.2, 0.12];
/// Width of the frame beyond the block of patches at each side, relative to the block.
const BORDER: f64 = 0.06;
/// Points per pixel in each direction.
const POINTS: usize = 3;

/// The outer corners of a chart in the middle of the picture: turned, leaning back to the right and downwards
/// by these fractions, and before that as wide as this fraction of the picture.
pub(super) fn tilted(turn_deg: f64, lean: [f64; 2], width: f64) -> [Point; 4] {
    let (sin, cos) = turn_deg.to_radians().sin_cos();
    [(-0.5, -1.0 / 3.0), (0.5, -1.0 / 3.0), (0.5, 1.0 / 3.0), (-0.5, 1.0 / 3.0)].map(|(x, y)| {
        let depth = 1.0 + 0.5 * (lean[0] * x + lean[1] * y);
        let scale = 0.75 * width * WIDTH as f64 / depth;
        let (x, y) = (x * (1.0 - 0.4 * lean[0].abs()), y * (1.0 - 0.4 * lean[1].abs()));
        Point::new(
            WIDTH as f64 / 2.0 + scale * (x * cos - y * sin),
            HEIGHT as f64 / 2.0 + scale * (x * sin + y * cos),
        )
    })
}

/// A photograph of a chart in coloured light by another camera, with noise. `patch` may change the colour of
/// a patch.
pub(super) fn drawn(corners: [Point; 4], patch: impl Fn(usize, [f64; 3]) -> [f64; 3]) -> Photograph {
    drawn_through(Lens::STRAIGHT, corners, patch)
}

/// The same through a lens.
pub(super) fn drawn_through(
    lens: Lens,
    corners: [Point; 4],
    patch: impl Fn(usize, [f64; 3]) -> [f64; 3],
) -> Photograph {
    let chart = Homography::through(lens, corners).unwrap();
    let cells = [COLUMNS, ROWS].map(|count| count as f64 - 1.0 + FILLED);
    photograph(|x, y| {
        let (u, v) = chart.to_panel(Point::new(x, y));
        let border = |part: f64| (-BORDER..1.0 + BORDER).contains(&part);
        if !(border(u) && border(v)) {
            return GROUND;
        }
        let [x, y] = [u * cells[0], v * cells[1]];
        let is_patch = (0.0..cells[0]).contains(&x)
            && (0.0..cells[1]).contains(&y)
            && x.fract() < FILLED
            && y.fract() < FILLED;
        if !is_patch {
            return FRAME;
        }
        let k = y as usize * COLUMNS + x as usize;
        let [r, g, b] = patch(k, REFERENCE[k]);
        [0.5 * r + 0.02 * g, 0.03 * r + 0.7 * g + 0.05 * b, 0.03 * g + 0.4 * b]
    })
}

/// A photograph of this light at (x, y), px, with noise.
pub(super) fn photograph(light: impl Fn(f64, f64) -> [f64; 3]) -> Photograph {
    let mut noise = 1_u32;
    let pixel = |k: usize| {
        let mut sum = [0.0; 3];
        for n in 0..POINTS * POINTS {
            let part = |n: usize| (n as f64 + 0.5) / POINTS as f64;
            let light = light((k % WIDTH) as f64 + part(n % POINTS), (k / WIDTH) as f64 + part(n / POINTS));
            sum.iter_mut().zip(light).for_each(|(sum, light)| *sum += light / (POINTS * POINTS) as f64);
        }
        sum.map(|light| {
            noise = noise.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (light * (1.0 + 0.04 * (f64::from(noise >> 8) / f64::from(1 << 24) - 0.5))) as f32
        })
    };
    let light = (0..WIDTH * HEIGHT).flat_map(pixel).collect();
    Photograph::from_light(WIDTH, HEIGHT, light).unwrap()
}
