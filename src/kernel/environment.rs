//! Light of non-uniform surroundings on a fold: sky, ground, and the glow around the sun.
//!
//! Radiances are summed over directions, with those hidden by the opposite panel left out, and the resulting
//! light bounces between the panels as in [`super::bent`].

use std::ops::Range;

use nalgebra::{DMatrix, Vector2, Vector3};
use ndarray::Array2;
use pulp::{Arch, Simd, WithSimd};

use crate::error::Result;
use crate::geometry::{Fold, StandardSky};

use super::bent::{BentExchange, Seen, Symmetry};

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
    /// Unit vectors towards the light, coordinate by coordinate. Single precision is far finer than sums over
    /// directions are exact.
    rays: [Vec<f32>; 3],
    /// For each part the range of its rays, those above or those below, and each ray's irradiance on a plane
    /// facing it.
    irradiances: [(Range<usize>, Vec<f32>); PARTS],
}

/// Numbers processed at once: the vectors of every processor hold a power of two up to this.
const LANES: usize = 16;
const _: () = assert!(DIRECTIONS.is_multiple_of(LANES));

impl<const PARTS: usize> Environment<PARTS> {
    /// The light of `parts`, where the unit vector `up` points to the zenith, in the coordinates of
    /// [`Fold::panels`].
    #[must_use]
    pub fn new(parts: [Surroundings; PARTS], up: Vector3<f64>) -> Self {
        let mut rays: [Vec<f32>; 3] = Default::default();
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
                coordinates.extend(all.iter().map(|(_, towards)| towards[axis] as f32));
            }
            for (part, irradiance) in parts.iter().zip(&mut irradiances).filter(|(part, _)| is_of(part)) {
                let radiance = |(height, towards): &(f64, Vector3<f64>)| part.radiance(towards, *height);
                let horizontal: f64 = all.iter().map(|ray| ray.0 * radiance(ray)).sum();
                let by_ray = all.iter().map(|ray| (radiance(ray) / horizontal) as f32);
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
        self.on_line(Vector2::zeros(), normal, &[0.0], &[])[0]
    }

    /// Irradiance at points of a line along the crease, given by its coordinates across the crease and out of
    /// the fold and by theirs along it, with light hidden by `screens`.
    fn on_line(
        &self,
        line: Vector2<f64>,
        normal: Vector3<f64>,
        along: &[f64],
        screens: &[Screen],
    ) -> Vec<[f64; PARTS]> {
        Arch::new().dispatch(Gathered { light: self, line, normal, along, screens })
    }
}

/// Irradiance at points of a line, computed with the widest vectors of the processor.
struct Gathered<'a, const PARTS: usize> {
    light: &'a Environment<PARTS>,
    line: Vector2<f64>,
    normal: Vector3<f64>,
    along: &'a [f64],
    screens: &'a [Screen],
}

impl<const PARTS: usize> WithSimd for Gathered<'_, PARTS> {
    type Output = Vec<[f64; PARTS]>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Vec<[f64; PARTS]> {
        let Self { light, line, normal, along, screens } = self;
        let rays = light.rays.each_ref().map(|coordinates| S::as_simd_f32s(coordinates).0);
        let zero = simd.splat_f32s(0.0);
        let mut open = vec![zero; rays[0].len()];
        let normal = splat(simd, normal);
        for (n, cosine) in open.iter_mut().enumerate() {
            *cosine = simd.max_f32s(projected(simd, normal, rays, n), zero);
        }
        // Of each screen in front of the line: its half width, the height of the line above it, and for each
        // ray that meets its plane within its depth the cosine of approach, by which lengths are multiplied
        // to avoid a division.
        let mut met = Vec::with_capacity(screens.len());
        for Screen { facing, out, depth, half_width } in screens {
            let place = Vector3::new(line.x, 0.0, line.y);
            let height = facing.dot(&place);
            if height <= ON_PANEL {
                continue;
            }
            let (towards, outwards) = (splat(simd, -facing), splat(simd, height * out));
            let [from_crease, depth] = [out.dot(&place), *depth].map(|value| simd.splat_f32s(value as f32));
            let mut approaches = vec![zero; rays[0].len()];
            for (n, met) in approaches.iter_mut().enumerate() {
                let approach = projected(simd, towards, rays, n);
                let met_out = simd.mul_add_f32s(from_crease, approach, projected(simd, outwards, rays, n));
                let within_depth =
                    simd.min_f32s(met_out, simd.sub_f32s(simd.mul_f32s(depth, approach), met_out));
                let within = simd.min_f32s(approach, within_depth);
                *met = simd.select_f32s(simd.greater_than_f32s(within, zero), approach, zero);
            }
            met.push(([*half_width, height].map(|value| simd.splat_f32s(value as f32)), approaches));
        }
        let lanes = DIRECTIONS / S::as_simd_f32s(&light.rays[0][..DIRECTIONS]).0.len();
        let mut cosines = vec![zero; open.len()];
        let mut all = Vec::with_capacity(along.len());
        // no closure: it would not be compiled for wide vectors
        for place in along {
            let place = simd.splat_f32s(*place as f32);
            for (n, (cosine, open)) in cosines.iter_mut().zip(&open).enumerate() {
                *cosine = *open;
                for ([half_width, height], approaches) in &met {
                    let (approach, height) = (approaches[n], simd.mul_f32s(*height, rays[1][n]));
                    let met_along = simd.abs_f32s(simd.mul_add_f32s(place, approach, height));
                    let is_hidden = simd.less_than_f32s(met_along, simd.mul_f32s(*half_width, approach));
                    *cosine = simd.select_f32s(is_hidden, zero, *cosine);
                }
            }
            let mut sums = [0.0; PARTS];
            for (sum, (rays, irradiances)) in sums.iter_mut().zip(&light.irradiances) {
                let of_part = &cosines[rays.start / lanes..rays.end / lanes];
                let mut products = zero;
                for (cosine, irradiance) in of_part.iter().zip(S::as_simd_f32s(irradiances).0) {
                    products = simd.mul_add_f32s(*cosine, *irradiance, products);
                }
                *sum = f64::from(simd.reduce_sum_f32s(products));
            }
            all.push(sums);
        }
        all
    }
}

/// One vector, repeated for many rays.
#[inline(always)]
fn splat<S: Simd>(simd: S, vector: Vector3<f64>) -> [S::f32s; 3] {
    [vector.x, vector.y, vector.z].map(|value| simd.splat_f32s(value as f32))
}

/// Dot products of rays with a vector.
#[inline(always)]
fn projected<S: Simd>(simd: S, [a, b, c]: [S::f32s; 3], [x, y, z]: [&[S::f32s]; 3], n: usize) -> S::f32s {
    simd.mul_add_f32s(a, x[n], simd.mul_add_f32s(b, y[n], simd.mul_f32s(c, z[n])))
}

/// Radiance of the facets of a bent sheet in each of these lights, for each part, all bounces included; a
/// perfect diffuser with irradiance 1 has radiance 1.
///
/// # Returns
/// For each light and part: facet by albedo, as [`BentFold::facet_radiance`](super::bent::BentFold).
///
/// # Errors
/// [`crate::Error::Numeric`] if light does not leave the fold.
pub fn facet_radiances<const PARTS: usize>(
    lights: &[Environment<PARTS>],
    sheet: &BentExchange,
    albedos: &[f64],
) -> Result<Vec<[Array2<f64>; PARTS]>> {
    let fold = sheet.fold();
    let (rows, cols) = (fold.facets().rows, fold.facets().cols);
    let half = cols.div_ceil(2);
    let screens = &[0, 1].map(|panel| Screen::of(sheet.angle_deg(), fold, panel));
    let middles: Vec<f64> =
        (0..cols).map(|col| ((col as f64 + 0.5) / cols as f64 - 0.5) * fold.width()).collect();
    let direct = |light: &Environment<PARTS>| {
        let mut radiances: [Array2<f64>; PARTS] =
            std::array::from_fn(|_| Array2::zeros((2 * rows * cols, albedos.len())));
        for (row, seen) in sheet.rows().iter().enumerate() {
            for Seen { share, place, normal } in seen {
                let normal = Vector3::new(normal.x, 0.0, normal.y);
                let direct = light.on_line(*place, normal, &middles, screens);
                for (facet, direct) in (row * cols..).zip(direct) {
                    for (radiance, direct) in radiances.iter_mut().zip(direct) {
                        for (node, albedo) in albedos.iter().enumerate() {
                            radiance[(facet, node)] += share * albedo * direct;
                        }
                    }
                }
            }
        }
        radiances
    };
    let mut radiances: Vec<[Array2<f64>; PARTS]> = lights.iter().map(direct).collect();
    // of each patch: on itself and on its mirror image, by light and part
    let columns = sheet.columns();
    let along: Vec<f64> = columns.iter().copied().chain(columns.iter().map(|y| -y)).collect();
    let mut on_patches = [0, 1].map(|_| DMatrix::zeros(sheet.patches(), lights.len() * PARTS));
    for (line, [middle, normal]) in sheet.middles().enumerate() {
        let normal = Vector3::new(normal.x, 0.0, normal.y);
        for (n, light) in lights.iter().enumerate() {
            let lit = light.on_line(middle, normal, &along, screens);
            for (place, parts) in lit.into_iter().enumerate() {
                let patch = line * columns.len() + place % columns.len();
                for (part, lit) in parts.into_iter().enumerate() {
                    on_patches[place / columns.len()][(patch, n * PARTS + part)] = lit;
                }
            }
        }
    }
    let [own, mirrored] = on_patches;
    for symmetry in Symmetry::BOTH {
        let irradiances = 0.5 * (&own + symmetry.sign() * &mirrored);
        for (node, albedo) in albedos.iter().enumerate() {
            let bounced = sheet.bounced(symmetry, &irradiances, *albedo)?;
            for (radiance, bounced) in radiances.iter_mut().flatten().zip(bounced.column_iter()) {
                for (n, row) in (0..2 * rows).flat_map(|row| (0..cols).map(move |col| (col, row))) {
                    let mirror = cols - 1 - n;
                    let sign = if n <= mirror { 1.0 } else { symmetry.sign() };
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
    fn of(angle_deg: f64, fold: &Fold, panel: usize) -> Self {
        let (sin, cos) = (0.5 * angle_deg.to_radians()).sin_cos();
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
    use crate::kernel::bent::BentFold;

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
            let seen = BentExchange::new(&bent, &fold, Vector3::z());
            let [[sky, ground]] = &facet_radiances(slice::from_ref(&even), &seen, &[0.9999]).unwrap()[..]
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
