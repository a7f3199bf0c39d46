//! Straight chains of pixels that are locally brightest, or steepest, across the line.

use rayon::prelude::*;

use super::outline::Place;
use super::plane::Plane;

/// A straight piece of an edge or ridge.
#[derive(Debug, Clone, Copy)]
pub(super) struct Segment {
    pub from: Place,
    pub to: Place,
    /// Mean strength of its pixels.
    pub strength: f64,
    /// Fraction of its length covered by pixels, from 0 to 1.
    pub cover: f64,
}

impl Segment {
    pub fn length(&self) -> f64 {
        (self.to - self.from).norm()
    }
}

/// Strength of an edge at every pixel, and the unit vector across it.
pub(super) struct EdgeMap {
    width: usize,
    height: usize,
    strength: Vec<f32>,
    across: Vec<[f32; 2]>,
}

/// Largest difference in direction between neighbours in a chain: the cosine of 22.5 degrees.
const ALIKE: f32 = 0.924;
/// Largest distance of a chain's pixel from its line, px,
const OFF_PX: f64 = 1.5;
/// once at least this many pixels determine the line.
const ENOUGH: usize = 8;
/// Largest gap between pixels of a chain in x and y, px.
const NEXT_PX: usize = 2;
/// Largest distance of the strength's maximum from its pixel's centre, px.
const MOST_SUBPIXEL: f32 = 0.6;

impl EdgeMap {
    /// Steps, from the structure tensor.
    pub fn steps([xx, yy, xy]: &[Plane; 3]) -> Self {
        Self::new([xx, yy, xy], |mean, half, normal| ((mean + half).max(0.0).sqrt(), normal))
    }

    /// Bright ridges, from second derivatives.
    pub fn ridges([xx, yy, xy]: &[Plane; 3]) -> Self {
        Self::new([xx, yy, xy], |mean, half, [x, y]| ((half - mean).max(0.0), [-y, x]))
    }

    /// `of_eigen` computes strength and direction across from the mean of the eigenvalues, half their
    /// difference, and the eigenvector of the larger.
    fn new(
        [xx, yy, xy]: [&Plane; 3],
        of_eigen: impl Fn(f32, f32, [f32; 2]) -> (f32, [f32; 2]) + Sync,
    ) -> Self {
        let width = xx.width;
        let pixel = |k: usize| {
            let (xx, yy, xy) = (xx.values[k], yy.values[k], xy.values[k]);
            let (mean, difference) = ((xx + yy) / 2.0, (xx - yy) / 2.0);
            let half = (difference * difference + xy * xy).sqrt();
            let cos = if half > 0.0 { difference / half } else { 1.0 };
            let normal =
                [((1.0 + cos) / 2.0).max(0.0).sqrt(), ((1.0 - cos) / 2.0).max(0.0).sqrt().copysign(xy)];
            of_eigen(mean, half, normal)
        };
        let (strength, across): (Vec<_>, Vec<_>) = (0..xx.values.len()).into_par_iter().map(pixel).unzip();
        Self { width, height: strength.len() / width, strength, across }
    }

    /// Straight chains of at least `least_pixels` pixels with at least `least_strength`.
    pub fn chains(&self, least_strength: f32, least_pixels: usize) -> Vec<Segment> {
        let mut order: Vec<usize> =
            (0..self.strength.len()).into_par_iter().filter(|k| self.is_crest(*k, least_strength)).collect();
        let mut free = vec![false; self.strength.len()];
        order.iter().for_each(|k| free[*k] = true);
        order.sort_unstable_by(|a, b| self.strength[*b].total_cmp(&self.strength[*a]).then(a.cmp(b)));
        let grow = |k: &usize| if free[*k] { self.grow(*k, &mut free, least_pixels) } else { None };
        order.iter().filter_map(grow).collect()
    }

    /// Strengths one pixel away to either side of the edge; none at the picture's edge.
    fn neighbours(&self, k: usize) -> Option<[f32; 2]> {
        let (x, y) = ((k % self.width) as f32, (k / self.width) as f32);
        let [nx, ny] = self.across[k];
        let at = |x: f32, y: f32| {
            if !(x >= 0.0 && y >= 0.0) {
                return None;
            }
            let (i, j) = (x as usize, y as usize);
            if i + 1 >= self.width || j + 1 >= self.height {
                return None;
            }
            let (right, down) = (x - i as f32, y - j as f32);
            let row = |j: usize| {
                let k = j * self.width + i;
                self.strength[k] * (1.0 - right) + self.strength[k + 1] * right
            };
            Some(row(j) * (1.0 - down) + row(j + 1) * down)
        };
        Some([at(x - nx, y - ny)?, at(x + nx, y + ny)?])
    }

    /// Whether a pixel is stronger than its neighbours on both sides.
    fn is_crest(&self, k: usize, least: f32) -> bool {
        let strength = self.strength[k];
        strength >= least && self.neighbours(k).is_some_and(|[a, b]| a <= strength && b < strength)
    }

    /// Sub-pixel position at which the edge crosses a pixel.
    fn crossing(&self, k: usize) -> Place {
        let centre = Place::new((k % self.width) as f64 + 0.5, (k / self.width) as f64 + 0.5);
        let Some([a, b]) = self.neighbours(k) else { return centre };
        let bend = a - 2.0 * self.strength[k] + b;
        let offset =
            if bend < 0.0 { (0.5 * (a - b) / bend).clamp(-MOST_SUBPIXEL, MOST_SUBPIXEL) } else { 0.0 };
        centre + Place::from(self.across[k].map(|n| f64::from(n * offset)))
    }

    /// The chain that grows from a pixel.
    fn grow(&self, first: usize, free: &mut [bool], least_pixels: usize) -> Option<Segment> {
        free[first] = false;
        let (mut waiting, mut places, mut line) = (vec![first], Vec::new(), Moments::default());
        let mut next = 0;
        while let Some(&k) = waiting.get(next) {
            next += 1;
            let place = self.crossing(k);
            if places.len() >= ENOUGH && line.distance(place) > OFF_PX {
                free[k] = true;
                continue;
            }
            places.push(place);
            line.add(place, f64::from(self.strength[k]), self.across[k]);
            let across = line.across(places.len() >= ENOUGH);
            let (x, y) = (k % self.width, k / self.width);
            for j in y.saturating_sub(NEXT_PX)..(y + NEXT_PX + 1).min(self.height) {
                for i in x.saturating_sub(NEXT_PX)..(x + NEXT_PX + 1).min(self.width) {
                    let k = j * self.width + i;
                    let [nx, ny] = self.across[k];
                    if free[k] && (nx * across[0] + ny * across[1]).abs() > ALIKE {
                        free[k] = false;
                        waiting.push(k);
                    }
                }
            }
        }
        if places.len() < least_pixels {
            return None;
        }
        let (middle, along) = (line.middle(), line.along());
        let along_line = places.iter().map(|place| (place - middle).dot(&along));
        let (low, high) = along_line.fold((f64::MAX, f64::MIN), |(low, high), t| (low.min(t), high.max(t)));
        let strength = line.weight / places.len() as f64;
        (high - low >= least_pixels as f64 - 1.0).then(|| Segment {
            from: middle + along * low,
            to: middle + along * high,
            strength,
            cover: 1.0,
        })
    }
}

/// Sums over the places of a chain, weighted by their strength.
#[derive(Default)]
struct Moments {
    weight: f64,
    sum: Place,
    squares: [f64; 3],
    /// Cosines and sines of twice the angle of the directions across.
    doubled: [f32; 2],
}

impl Moments {
    fn add(&mut self, place: Place, weight: f64, [nx, ny]: [f32; 2]) {
        self.weight += weight;
        self.sum += place * weight;
        let squares = [place.x * place.x, place.y * place.y, place.x * place.y];
        self.squares.iter_mut().zip(squares).for_each(|(sum, square)| *sum += weight * square);
        self.doubled[0] += nx * nx - ny * ny;
        self.doubled[1] += 2.0 * nx * ny;
    }

    fn middle(&self) -> Place {
        self.sum / self.weight
    }

    fn along(&self) -> Place {
        let middle = self.middle();
        let [xx, yy, xy] = self.squares.map(|sum| sum / self.weight);
        let (xx, yy, xy) = (xx - middle.x * middle.x, yy - middle.y * middle.y, xy - middle.x * middle.y);
        let angle = 0.5 * (2.0 * xy).atan2(xx - yy);
        Place::new(angle.cos(), angle.sin())
    }

    fn across(&self, from_places: bool) -> [f32; 2] {
        if from_places {
            let along = self.along();
            return [-along.y as f32, along.x as f32];
        }
        let angle = 0.5 * self.doubled[1].atan2(self.doubled[0]);
        [angle.cos(), angle.sin()]
    }

    fn distance(&self, place: Place) -> f64 {
        (place - self.middle()).perp(&self.along()).abs()
    }
}
