//! The light of a panel: smooth, of one colour, and monotonic towards the crease.

use nalgebra::{Matrix3, SMatrix, SVector, Vector3};
use rayon::prelude::*;

use super::outline::{Place, Quad};
use super::plane::Plane;
use super::reduced::Reduced;
use crate::image::placing::{Point, square_to_quadrilateral};

/// Sampled places across a panel, in each direction.
const ACROSS: usize = 12;
const PLACES: usize = ACROSS * ACROSS;
/// Terms of smooth light: a cubic polynomial across the crease, a quadratic one along it.
const TERMS: usize = 7;
/// Light is clamped to at least this: below, its logarithm is noise.
const LEAST: f32 = 1e-3;
/// Blur before light is sampled, px.
const BLUR_PX: f32 = 1.0;
/// Fewest places of a panel in the picture.
const FEWEST: usize = 50;
/// Limit of a departure from smooth light.
const MOST_UNEVEN: f64 = 0.5;

/// The logarithm of a picture's light in each channel.
pub(super) struct LogLight {
    width: usize,
    height: usize,
    values: Vec<[f32; 3]>,
}

/// Properties of a panel's light, all in logarithms.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct PanelLight {
    /// How much brighter it is at the crease than at the outer side.
    pub rise: f64,
    /// Departure from smooth light, rms.
    pub unevenness: f64,
    /// Red and blue over green.
    pub colour: [f64; 2],
    /// Change of that between the outer third and the third at the crease, the larger of the two.
    pub colour_change: f64,
    /// Rise of light from the crease outwards, as a fraction of all changes.
    pub wrong_way: f64,
    pub level: f64,
    /// Mean light near the crease.
    pub at_crease: f64,
    /// Fraction of the panel in the picture.
    pub seen: f64,
}

/// Distance from the crease and position along it of a sampled place, each from 0 to 1.
fn place(k: usize) -> (f64, f64) {
    let part = |n: usize| (n as f64 + 0.5) / ACROSS as f64;
    (part(k / ACROSS), part(k % ACROSS))
}

fn terms(k: usize) -> SVector<f64, TERMS> {
    let (v, u) = place(k);
    let u = u - 0.5;
    SVector::from([1.0, v, v * v, v * v * v, u, u * u, u * v])
}

impl LogLight {
    pub fn of(reduced: &Reduced) -> Self {
        let [r, g, b] = reduced.planes(|light| light).map(|plane: Plane| plane.blurred(BLUR_PX).values);
        let logarithms = |k: usize| [r[k], g[k], b[k]].map(|light| light.max(LEAST).ln());
        let values = (0..r.len()).into_par_iter().map(logarithms).collect();
        Self { width: reduced.width, height: reduced.height, values }
    }

    /// The light of the pixel at a place.
    pub fn at(&self, place: Place) -> Option<Vector3<f64>> {
        let inside = place.x >= 0.0 && place.y >= 0.0;
        let (x, y) = (place.x as usize, place.y as usize);
        (inside && x < self.width && y < self.height)
            .then(|| Vector3::from(self.values[y * self.width + x].map(f64::from)))
    }

    /// The light at those places of a panel that are in the picture, with their numbers. The panel's first
    /// side is the crease.
    fn samples(&self, quad: &Quad) -> Vec<(usize, Vector3<f64>)> {
        let to_image: Matrix3<f64> =
            square_to_quadrilateral(&quad.map(|corner| Point::new(corner.x, corner.y)));
        let sample = |k: usize| {
            let (v, u) = place(k);
            let seen = to_image * Vector3::new(u, v, 1.0);
            Some((k, self.at(Place::new(seen.x / seen.z, seen.y / seen.z))?))
        };
        (0..PLACES).filter_map(sample).collect()
    }

    /// Mean absolute departure of a quadrilateral's light from smooth light, over places and channels.
    pub fn unevenness(&self, quad: &Quad) -> f64 {
        let samples = self.samples(quad);
        if samples.len() < FEWEST {
            return MOST_UNEVEN;
        }
        let (mut normal, mut right) =
            (SMatrix::<f64, TERMS, TERMS>::zeros(), SMatrix::<f64, TERMS, 3>::zeros());
        for (k, light) in &samples {
            let terms = terms(*k);
            normal += terms * terms.transpose();
            right += terms * light.transpose();
        }
        let Some(fit) = normal.cholesky().map(|normal| normal.solve(&right)) else { return MOST_UNEVEN };
        let off = |(k, light): &(usize, Vector3<f64>)| {
            let smooth = fit.transpose() * terms(*k);
            (light - smooth).iter().map(|off| off.abs().min(MOST_UNEVEN)).sum::<f64>() / 3.0
        };
        samples.iter().map(off).sum::<f64>() / samples.len() as f64
    }

    /// The light of a panel, whose first side is the crease.
    pub fn panel(&self, quad: &Quad) -> PanelLight {
        let samples = self.samples(quad);
        let seen = samples.len() as f64 / PLACES as f64;
        let nothing = PanelLight { unevenness: MOST_UNEVEN, seen, ..PanelLight::default() };
        if samples.len() < FEWEST {
            return nothing;
        }
        let mean: Vec<(usize, f64)> = samples.iter().map(|(k, light)| (*k, light.mean())).collect();
        let Some(smooth) = robust_fit(&mean) else { return nothing };
        let off =
            mean.iter().map(|(k, light)| (light - smooth.dot(&terms(*k))).abs().min(MOST_UNEVEN).powi(2));
        let across =
            |v: f64| smooth[0] + smooth[1] * v + smooth[2] * v * v + smooth[3] * v * v * v + smooth[5] / 12.0;
        let profile: Vec<f64> = (0..9).map(|n| across(0.06 + 0.11 * f64::from(n))).collect();
        let changes = profile.windows(2).map(|pair| pair[1] - pair[0]);
        let total: f64 = changes.clone().map(f64::abs).sum();
        let colour = |keep: fn(f64) -> bool, k: usize| {
            let chosen = samples.iter().filter(|(n, _)| keep(place(*n).0));
            median(chosen.map(|(_, light)| light[k] - light[1]).collect())
        };
        let change = |k: usize| (colour(|v| v < 0.35, k) - colour(|v| v > 0.65, k)).abs();
        PanelLight {
            rise: across(0.06) - across(0.92),
            unevenness: (off.sum::<f64>() / mean.len() as f64).sqrt(),
            colour: [colour(|_| true, 0), colour(|_| true, 2)],
            colour_change: change(0).max(change(2)),
            wrong_way: changes.map(|change| change.max(0.0)).sum::<f64>() / (total + 1e-3),
            level: median(mean.iter().map(|(_, light)| *light).collect()),
            at_crease: across(0.06),
            seen,
        }
    }
}

/// Smooth light, insensitive to a few places that show something else.
fn robust_fit(samples: &[(usize, f64)]) -> Option<SVector<f64, TERMS>> {
    let mut weights = vec![1.0; samples.len()];
    let mut fit = SVector::zeros();
    for _ in 0..4 {
        let mut normal = SMatrix::<f64, TERMS, TERMS>::from_diagonal_element(1e-6 * samples.len() as f64);
        let mut right = SVector::<f64, TERMS>::zeros();
        for ((k, light), weight) in samples.iter().zip(&weights) {
            let terms = terms(*k);
            normal += terms * terms.transpose() * *weight;
            right += terms * (light * weight);
        }
        fit = normal.cholesky()?.solve(&right);
        let off: Vec<f64> = samples.iter().map(|(k, light)| (light - fit.dot(&terms(*k))).abs()).collect();
        let spread = 1.4826 * median(off.clone()) + 1e-4;
        weights = off.iter().map(|off| 1.0 / (1.0 + (off / (2.5 * spread)).powi(2))).collect();
    }
    Some(fit)
}

/// The median; 0 if there are no numbers.
pub(super) fn median(mut numbers: Vec<f64>) -> f64 {
    if numbers.is_empty() {
        return 0.0;
    }
    let middle = numbers.len() / 2;
    *numbers.select_nth_unstable_by(middle, f64::total_cmp).1
}

#[cfg(test)]
mod tests {
    use super::super::synthetic::{SHEET, lit, off, outline, views};

    #[test]
    fn both_panels_are_smooth_of_one_colour_and_brighter_at_the_crease() {
        let (_, _, light) = views();
        let [a, b] = outline().panels().map(|panel| light.panel(&panel));
        for panel in [&a, &b] {
            let rise =
                SHEET.map(|channel| (lit(channel, 0.06) / lit(channel, 0.92)).ln()).iter().sum::<f64>() / 3.0;
            assert!((panel.rise - rise).abs() < 0.02, "{rise}: {panel:?}");
            assert!(panel.unevenness < 0.01 && panel.wrong_way < 0.05 && panel.seen > 0.999, "{panel:?}");
        }
        assert!((a.colour[0] - b.colour[0]).abs() < 0.01 && (a.at_crease - b.at_crease).abs() < 0.02);
    }

    #[test]
    fn light_across_an_edge_is_uneven() {
        let (_, _, light) = views();
        let [panel, _] = outline().panels();
        let [over, _] = off(30.0).panels();
        assert!(light.unevenness(&panel) < 0.01 && light.unevenness(&over) > 0.05);
    }
}
