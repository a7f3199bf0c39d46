//! Light of non-uniform surroundings on a fold: sky, ground, and the glow around the sun.
//!
//! Radiances are summed over directions, with those hidden by the opposite panel left out, and the resulting
//! light bounces between the panels as in [`super::bent`].

use std::ops::Range;

use nalgebra::{DMatrix, Vector3};
use ndarray::Array2;
use pulp::{Arch, Simd, WithSimd};

use crate::error::Result;
use crate::geometry::{Fold, StandardSky};

use super::bent::{BentExchange, BentFold, Seen};

/// Directions in each half, spread evenly by a spiral, so that no edge that hides light runs along many of
/// them (R. Swinbank, R. J. Purser, *Quarterly Journal of the Royal Meteorological Society* 132 (2006),
/// p. 1769).
const DIRECTIONS: usize = 800;
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;

/// One part of the surroundings, which the direction `up` divides into an upper and a lower half.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Surroundings {
    /// Uniform above the horizon: irradiance 1 on a horizontal plane facing up.
    Sky,
    /// Uniform below the horizon: irradiance 1 on a horizontal plane facing down.
    Ground,
    /// A standard sky with the sun in the direction of this unit vector, above the horizon: irradiance 1 on a
    /// horizontal plane facing up.
    Standard(StandardSky, Vector3<f64>),
    /// An overcast sky, irradiance 1 on a horizontal plane facing up: three times as bright at the zenith as
    /// at the horizon (P. Moon, D. E. Spencer, *Illuminating Engineering* 37 (1942), p. 707; CIE standard
    /// overcast sky).
    OvercastSky,
}

impl Surroundings {
    /// Relative radiance from a direction; `height` is its cosine with the zenith (with the nadir for the
    /// ground).
    fn radiance(self, towards: &Vector3<f64>, height: f64) -> f64 {
        match self {
            Self::Sky | Self::Ground => 1.0,
            Self::OvercastSky => 1.0 + 2.0 * height,
            Self::Standard(sky, sun) => sky.radiance(height, towards.dot(&sun)),
        }
    }
}

/// Parts of the surroundings, represented by directions with shares of their light.
pub struct Environment<const PARTS: usize> {
    /// Unit vectors towards the light, coordinate by coordinate.
    rays: [Vec<f64>; 3],
    /// For each part the range of its rays, those above or those below, and each ray's irradiance on a plane
    /// facing it.
    irradiances: [(Range<usize>, Vec<f64>); PARTS],
}

/// Numbers processed at once: the vectors of every processor hold a power of two up to this.
const LANES: usize = 8;
const _: () = assert!(DIRECTIONS.is_multiple_of(LANES));

impl<const PARTS: usize> Environment<PARTS> {
    /// The light of `parts`, where the unit vector `up` points to the zenith, in the coordinates of
    /// [`Fold::panels`].
    #[must_use]
    pub fn new(parts: [Surroundings; PARTS], up: Vector3<f64>) -> Self {
        let mut rays: [Vec<f64>; 3] = Default::default();
        let mut irradiances = std::array::from_fn(|_| (0..0, Vec::new()));
        for (pole, is_below) in [(up, false), (-up, true)] {
            let is_of = |part: &Surroundings| (*part == Surroundings::Ground) == is_below;
            if !parts.iter().any(is_of) {
                continue;
            }
            let east = pole.cross(&if pole.x.abs() < 0.7 { Vector3::x() } else { Vector3::y() }).normalize();
            let north = pole.cross(&east);
            let ray = |n: usize| {
                let height = (n as f64 + 0.5) / DIRECTIONS as f64;
                let (sin, cos) = (GOLDEN_ANGLE * n as f64).sin_cos();
                let spread = (1.0 - height * height).sqrt();
                (height, height * pole + spread * (cos * east + sin * north))
            };
            let all: Vec<(f64, Vector3<f64>)> = (0..DIRECTIONS).map(ray).collect();
            let first = rays[0].len();
            for (axis, coordinates) in rays.iter_mut().enumerate() {
                coordinates.extend(all.iter().map(|(_, towards)| towards[axis]));
            }
            for (part, irradiance) in parts.iter().zip(&mut irradiances).filter(|(part, _)| is_of(part)) {
                let radiance = |(height, towards): &(f64, Vector3<f64>)| part.radiance(towards, *height);
                let horizontal: f64 = all.iter().map(|ray| ray.0 * radiance(ray)).sum();
                let by_ray = all.iter().map(|ray| radiance(ray) / horizontal);
                *irradiance = (first..first + DIRECTIONS, by_ray.collect());
            }
        }
        Self { rays, irradiances }
    }

    /// Irradiance of an unobstructed plane with this unit normal, by each part.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use vfold::kernel::environment::{Environment, Surroundings};
    /// let [sky] = Environment::new([Surroundings::Sky], Vector3::z()).on_plane(Vector3::x());
    /// assert!((sky - 0.5).abs() < 0.01); // an upright plane sees half of it
    /// ```
    #[must_use]
    pub fn on_plane(&self, normal: Vector3<f64>) -> [f64; PARTS] {
        Arch::new().dispatch(Gathered { light: self, place: Vector3::zeros(), normal, screens: &[] })
    }

    /// Irradiance at a point of the fold, with light hidden by its panels, which are taken as flat.
    fn on_sheet(&self, place: Vector3<f64>, normal: Vector3<f64>, panels: &[Screen; 2]) -> [f64; PARTS] {
        Arch::new().dispatch(Gathered { light: self, place, normal, screens: panels })
    }
}

/// Irradiance at a point, computed with the widest vectors of the processor.
struct Gathered<'a, const PARTS: usize> {
    light: &'a Environment<PARTS>,
    place: Vector3<f64>,
    normal: Vector3<f64>,
    screens: &'a [Screen],
}

impl<const PARTS: usize> WithSimd for Gathered<'_, PARTS> {
    type Output = [f64; PARTS];

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> [f64; PARTS] {
        let Self { light, place, normal, screens } = self;
        let rays = light.rays.each_ref().map(|coordinates| S::as_simd_f64s(coordinates).0);
        let zero = simd.splat_f64s(0.0);
        let mut cosines = vec![zero; rays[0].len()];
        let normal = splat(simd, normal);
        for (n, cosine) in cosines.iter_mut().enumerate() {
            *cosine = simd.max_f64s(along(simd, normal, rays, n), zero);
        }
        for Screen { facing, out, depth, half_width } in screens {
            let height = facing.dot(&place);
            if height <= ON_PANEL {
                continue;
            }
            let (towards, outwards) = (splat(simd, -facing), splat(simd, height * out));
            let [from_crease, from_middle, height] =
                [out.dot(&place), place.y, height].map(|value| simd.splat_f64s(value));
            let [depth, half_width] = [*depth, *half_width].map(|value| simd.splat_f64s(value));
            for (n, cosine) in cosines.iter_mut().enumerate() {
                // Intersection with the panel's plane, multiplied by the cosine of approach to avoid a
                // division.
                let approach = along(simd, towards, rays, n);
                let met_out = simd.mul_add_f64s(from_crease, approach, along(simd, outwards, rays, n));
                let met_along = simd.mul_add_f64s(from_middle, approach, simd.mul_f64s(height, rays[1][n]));
                let within_depth =
                    simd.min_f64s(met_out, simd.sub_f64s(simd.mul_f64s(depth, approach), met_out));
                let within_width =
                    simd.sub_f64s(simd.mul_f64s(half_width, approach), simd.abs_f64s(met_along));
                let within = simd.min_f64s(approach, simd.min_f64s(within_depth, within_width));
                *cosine = simd.select_f64s(simd.greater_than_f64s(within, zero), zero, *cosine);
            }
        }
        let lanes = DIRECTIONS / S::as_simd_f64s(&light.rays[0][..DIRECTIONS]).0.len();
        let mut sums = [0.0; PARTS];
        for (sum, (rays, irradiances)) in sums.iter_mut().zip(&light.irradiances) {
            let of_part = &cosines[rays.start / lanes..rays.end / lanes];
            let mut products = zero;
            for (cosine, irradiance) in of_part.iter().zip(S::as_simd_f64s(irradiances).0) {
                products = simd.mul_add_f64s(*cosine, *irradiance, products);
            }
            *sum = simd.reduce_sum_f64s(products);
        }
        sums
    }
}

/// One vector, repeated for many rays.
#[inline(always)]
fn splat<S: Simd>(simd: S, vector: Vector3<f64>) -> [S::f64s; 3] {
    [simd.splat_f64s(vector.x), simd.splat_f64s(vector.y), simd.splat_f64s(vector.z)]
}

/// Dot products of rays with a vector.
#[inline(always)]
fn along<S: Simd>(simd: S, [a, b, c]: [S::f64s; 3], [x, y, z]: [&[S::f64s]; 3], n: usize) -> S::f64s {
    simd.mul_add_f64s(a, x[n], simd.mul_add_f64s(b, y[n], simd.mul_f64s(c, z[n])))
}

/// Radiance of the facets of a sheet bent like this in each of these lights, for each part, all bounces
/// included; a perfect diffuser with irradiance 1 has radiance 1. Facets are those of `fold`, seen from far
/// away in the direction `eye`.
///
/// # Returns
/// For each light and part: facet by albedo, as [`BentFold::facet_radiance`].
///
/// # Errors
/// [`crate::Error::Numeric`] if light does not leave the fold.
pub fn facet_radiances<const PARTS: usize>(
    lights: &[Environment<PARTS>],
    (bent, fold, eye): (&BentFold, &Fold, Vector3<f64>),
    albedos: &[f64],
) -> Result<Vec<[Array2<f64>; PARTS]>> {
    let (rows, cols) = (fold.facets().rows, fold.facets().cols);
    let half = cols.div_ceil(2);
    let panels = &[0, 1].map(|panel| Screen::of(bent, fold, panel));
    let exchanges = [1.0, -1.0].map(|image| (image, BentExchange::of_light(bent, fold, eye, image)));
    let direct = |light: &Environment<PARTS>| {
        let mut radiances: [Array2<f64>; PARTS] =
            std::array::from_fn(|_| Array2::zeros((2 * rows * cols, albedos.len())));
        for (row, seen) in exchanges[0].1.rows().iter().enumerate() {
            for col in 0..cols {
                let y = ((col as f64 + 0.5) / cols as f64 - 0.5) * fold.width();
                for Seen { share, place, normal } in seen {
                    let (place, normal) =
                        (Vector3::new(place.x, y, place.y), Vector3::new(normal.x, 0.0, normal.y));
                    let direct = light.on_sheet(place, normal, panels);
                    for (radiance, direct) in radiances.iter_mut().zip(direct) {
                        for (node, albedo) in albedos.iter().enumerate() {
                            radiance[(row * cols + col, node)] += share * albedo * direct;
                        }
                    }
                }
            }
        }
        radiances
    };
    let mut radiances: Vec<[Array2<f64>; PARTS]> = lights.iter().map(direct).collect();
    // both exchanges have the same patches
    let on_patch = |[place, normal]: [Vector3<f64>; 2]| {
        let mirrored = Vector3::new(place.x, -place.y, place.z);
        lights.iter().flat_map(move |light| {
            let [own, other] = [place, mirrored].map(|place| light.on_sheet(place, normal, panels));
            (0..PARTS).map(move |part| [own[part], other[part]])
        })
    };
    let on_patches: Vec<[f64; 2]> = exchanges[0].1.places(fold.width()).flat_map(on_patch).collect();
    for (image, exchange) in &exchanges {
        let halves = on_patches.iter().map(|[own, other]| 0.5 * (own + image * other));
        let patches = DMatrix::from_row_iterator(exchange.patches(), lights.len() * PARTS, halves);
        for (node, albedo) in albedos.iter().enumerate() {
            let bounced = exchange.bounced(&patches, *albedo)?;
            for (radiance, bounced) in radiances.iter_mut().flatten().zip(bounced.column_iter()) {
                for (n, row) in (0..2 * rows).flat_map(|row| (0..cols).map(move |col| (col, row))) {
                    let mirror = cols - 1 - n;
                    let sign = if n <= mirror { 1.0 } else { *image };
                    radiance[(row * cols + n, node)] += albedo * sign * bounced[row * half + n.min(mirror)];
                }
            }
        }
    }
    Ok(radiances)
}

/// A panel as an obstacle that hides light from the rest of the sheet.
struct Screen {
    out: Vector3<f64>,
    facing: Vector3<f64>,
    depth: f64,
    half_width: f64,
}

/// Points up to this height above a panel, in the fold's unit, count as on it.
const ON_PANEL: f64 = 1e-9;

impl Screen {
    fn of(bent: &BentFold, fold: &Fold, panel: usize) -> Self {
        let (sin, cos) = (0.5 * bent.angle_deg.to_radians()).sin_cos();
        let side = if panel == 0 { -1.0 } else { 1.0 };
        Self {
            out: Vector3::new(side * sin, 0.0, cos),
            facing: Vector3::new(-side * cos, 0.0, sin),
            depth: fold.depths()[panel],
            half_width: 0.5 * fold.width(),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::slice;

    use super::*;
    use crate::geometry::FacetGrid;

    /// A white sheet in uniform surroundings is as bright as they are, however it is bent.
    #[test]
    fn a_white_sheet_vanishes_in_even_light() {
        let fold = Fold::new(48.0, 1.0, 1.0, FacetGrid { rows: 10, cols: 10 }).unwrap();
        let ideal = BentFold::ideal(48.0);
        let even = Environment::new([Surroundings::Sky, Surroundings::Ground], Vector3::z());
        for bent in [
            ideal,
            BentFold { crease_radius: 0.012, ..ideal },
            BentFold { crease_radius: 0.03, ..ideal },
            BentFold { bow_deg: [3.0; 2], ..ideal },
            BentFold { bow_deg: [-3.0; 2], ..ideal },
        ] {
            let seen = (&bent, &fold, Vector3::z());
            let [[sky, ground]] = &facet_radiances(slice::from_ref(&even), seen, &[0.9999]).unwrap()[..]
            else {
                panic!("one light has one radiance of each part")
            };
            for ((facet, _), radiance) in (sky + ground).indexed_iter() {
                let most = if facet / 10 % 10 < 2 { 0.06 } else { 0.025 };
                assert!((radiance - 1.0).abs() < most, "{bent:?}, facet {facet}: {radiance}");
            }
        }
    }
}
