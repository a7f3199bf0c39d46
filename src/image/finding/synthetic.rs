//! A drawn fold whose corners are known, for tests.
#![allow(clippy::unwrap_used)] // a test stops at the first surprise

use super::evidence::{Evidence, curvatures, steps};
use super::light::LogLight;
use super::outline::{Outline, Place};
use super::plane::Plane;
use super::reduced::Reduced;
use crate::image::photograph::Photograph;
use crate::image::placing::Homography;

pub(super) const WIDTH: usize = 320;
pub(super) const HEIGHT: usize = 260;
/// The colour of the sheet, and of its background.
pub(super) const SHEET: [f64; 3] = [0.7, 0.4, 0.3];
const GROUND: [f64; 3] = [0.12, 0.14, 0.1];
/// Points per pixel in each direction.
const POINTS: usize = 4;

/// A fold with an upright crease, end 0 at the bottom, panel 0 on the left.
pub(super) fn outline() -> Outline {
    let corners = [(160., 210.), (157., 52.), (62., 42.), (70., 226.), (256., 46.), (248., 223.)];
    Outline(corners.map(|(x, y)| Place::new(x, y)))
}

/// A picture of a fold `scale` times as large, with noise; its light rises and gains saturation towards the
/// crease.
pub(super) fn picture(fold: &Outline, scale: usize) -> Photograph {
    let panels =
        fold.scaled(scale as f64).points().map(|corners| Homography::from_unit_square(corners).unwrap());
    let (width, height) = (WIDTH * scale, HEIGHT * scale);
    let mut noise = 1_u32;
    let mut light = Vec::new();
    for k in 0..width * height {
        let mut sum = [0.0; 3];
        for n in 0..POINTS * POINTS {
            let part = |n: usize| (n as f64 + 0.5) / POINTS as f64;
            let place =
                Place::new((k % width) as f64 + part(n % POINTS), (k / width) as f64 + part(n / POINTS));
            let lit = at(&panels, place);
            sum.iter_mut().zip(lit).for_each(|(sum, light)| *sum += light / (POINTS * POINTS) as f64);
        }
        for value in sum {
            noise = noise.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            light.push((value * (1.0 + 0.01 * (f64::from(noise >> 8) / f64::from(1 << 24) - 0.5))) as f32);
        }
    }
    Photograph::from_light(width, height, light).unwrap()
}

/// Light of a sheet of this reflectance at a distance from the crease, including light from the other panel.
pub(super) fn lit(reflectance: f64, v: f64) -> f64 {
    reflectance * (0.55 + 0.9 * reflectance * (-2.5 * v).exp())
}

fn at(panels: &[Homography; 2], place: Place) -> [f64; 3] {
    let inside = |panel: &Homography| {
        let (u, v) = panel.to_panel(crate::image::placing::Point::new(place.x, place.y));
        ((0.0..1.0).contains(&u) && (0.0..1.0).contains(&v)).then_some(v)
    };
    match panels.iter().find_map(inside) {
        Some(v) => SHEET.map(|reflectance| lit(reflectance, v)),
        None => GROUND,
    }
}

/// The drawn fold as the search sees it.
pub(super) fn views() -> (Reduced, Evidence, LogLight) {
    let reduced = Reduced::of(&picture(&outline(), 1));
    let channels = reduced.even();
    let sum = Plane::sum(&channels);
    let evidence = Evidence::new(&steps(&channels, 1.0), &curvatures(&sum, 2.0), &curvatures(&sum, 4.0));
    let light = LogLight::of(&reduced);
    (reduced, evidence, light)
}

/// The fold with every corner displaced by this distance, in varying directions.
pub(super) fn off(px: f64) -> Outline {
    let mut fold = outline();
    for (k, corner) in fold.0.iter_mut().enumerate() {
        *corner += Place::new((2.4 * k as f64).cos(), (2.4 * k as f64).sin()) * px;
    }
    fold
}
