//! Light reflected three times or more, computed between flat patches.
//!
//! `L(i → k)`, the light that patch i of one panel sends to patch k of the other, obeys
//! `L(i → k) = f(sun, i → k) E + Σⱼ f(j → i → k) π F(i, j) L(j → i)` with the form factors F. Patches repeat
//! along the crease: the angles between two directions depend only on the rows and the differences of
//! columns.

use std::f64::consts::PI;
use std::sync::LazyLock;

use nalgebra::Vector3;
use ndarray::Array2;
use pulp::{Arch, Simd, WithSimd};

use super::frame::Frame;
use super::pooling::Pooling;
use crate::geometry::Fold;
use crate::kernel::quadrature::{Lagrange, Rule};
use crate::kernel::wedge::Wedge;
use crate::sheet::{AngleList, Angles, Shape};

/// Boundaries of the rows of patches, as fractions of the panel's depth.
const EDGES: [f64; 5] = [0.0, 0.1, 0.3, 0.6, 1.0];
const ROWS: usize = EDGES.len() - 1;
/// Patches along the crease, the direction in which light near the crease varies most in angle.
const COLS: usize = 8;
const COUNT: usize = ROWS * COLS;
/// Number of column differences.
const SHIFTS: usize = 2 * COLS - 1;
/// Directions from a row of patches to the patches of the other panel, repeated along the crease.
const DIRECTIONS: usize = ROWS * SHIFTS;
/// Points per patch, in each dimension, over which directions are averaged.
const PLACES: usize = 4;
/// Maximum number of reflections followed one by one.
const REFLECTIONS: usize = 40;
/// Neglected light, relative to what the sun sends.
const NEGLIGIBLE: f64 = 1e-4;
/// Albedo nodes. Light of all reflections grows like 1 / (1 − a·r) towards the albedo at which none is lost,
/// where `r` is the share of its light that a panel exchanges with the other; the rest is smooth.
const NODES: usize = 6;
/// Iterations for that share, which need not be exact.
const ITERATIONS: usize = 8;

/// The patches of both panels, with all directions between them.
pub struct Patches {
    panels: [Panel; 2],
    /// Angles of the distinct [`PAIRS`] of directions, by row of patches.
    between: AngleList,
    /// The same for panel 1 if its shape differs.
    between_1: Option<AngleList>,
    /// True if both panels send the same: the sun is on the bisecting plane of a symmetric fold.
    alike: bool,
    /// Share of its light that either panel sends to the other, of what is reflected often.
    exchanged: f64,
    pooling: Pooling,
}

/// The patches of one panel.
struct Panel {
    /// Irradiance from the sun.
    lit: f64,
    /// π times the form factors from each patch to those of the other panel.
    factors: Vec<f32>,
    /// From the sun towards each patch of the other panel, by row and direction.
    from_sun: AngleList,
    /// From each patch of the other panel towards the eye, by patch.
    to_eye: AngleList,
}

/// Body and surface reflection of a shape at a list of angles.
struct Parts {
    body: Vec<f32>,
    surface: Vec<f32>,
}

impl Patches {
    /// The patches of `fold`, with sun and eye taken from the frames.
    pub(super) fn new(fold: &Fold, frames: &[Frame; 2]) -> Self {
        let middles: Vec<f64> = EDGES.windows(2).map(|ends| 0.5 * (ends[0] + ends[1])).collect();
        let columns: Vec<f64> = (0..COLS).map(|col| (col as f64 + 0.5) / COLS as f64).collect();
        let wedge = Wedge::new(fold);
        let to = directions(&frames[0]);
        let to_1 = (!fold.is_symmetric()).then(|| directions(&frames[1]));
        let seen = [&to, to_1.as_ref().unwrap_or(&to)];
        let panels = [0, 1].map(|p| Panel::new(&frames[p], &wedge, &middles, seen[p]));
        Self {
            exchanged: exchanged(&panels),
            panels,
            between: pairs(&to),
            between_1: to_1.as_ref().map(|to| pairs(to)),
            alike: fold.is_symmetric() && frames[0].sun == frames[1].sun,
            pooling: Pooling::straight(fold, &middles, &columns),
        }
    }

    /// Radiance towards the eye of light reflected three times or more: patches of both panels by albedo
    /// nodes, between which [`Self::shares`] interpolates.
    #[must_use]
    pub fn radiances(&self, shape: &Shape) -> Array2<f64> {
        self.radiances_at(shape, &nodes(NODES))
    }

    fn radiances_at(&self, shape: &Shape, albedos: &[f64]) -> Array2<f64> {
        // Uses the widest vectors of the processor. Every lane is summed separately, so the results do not
        // depend on the width.
        Arch::new().dispatch(Radiances { patches: self, shape, albedos })
    }

    /// Weights of the nodes at these albedos: node by albedo.
    #[must_use]
    pub fn shares(&self, albedos: &[f64]) -> Array2<f64> {
        self.shares_of(&nodes(NODES), albedos)
    }

    fn shares_of(&self, nodes: &[f64], albedos: &[f64]) -> Array2<f64> {
        let left = |albedo: f64| 1.0 - albedo * self.exchanged;
        let lagrange = Lagrange::new(nodes);
        let mut shares = Array2::zeros((albedos.len(), nodes.len()));
        for (albedo, mut row) in albedos.iter().zip(shares.rows_mut()) {
            lagrange.at(*albedo, row.as_slice_mut().unwrap_or_default());
            row.iter_mut().zip(nodes).for_each(|(share, node)| *share *= left(*node) / left(*albedo));
        }
        shares.reversed_axes()
    }

    /// Facet means.
    #[must_use]
    pub fn pooled(&self, radiances: &Array2<f64>) -> Array2<f64> {
        self.pooling.pool(radiances)
    }

    /// Light sent by each patch of either panel to each of the other after two or more reflections.
    #[inline(always)]
    fn sent(&self, direct: Vec<Vec<f32>>, matrices: [&Vec<f32>; 2]) -> Vec<Vec<f32>> {
        let first = total(&direct);
        let (mut before, mut ratio, mut change) = (first, 0.0, f64::INFINITY);
        let mut sent = vec![vec![0.0; COUNT * COUNT]; direct.len()];
        let mut light = direct;
        for _ in 1..REFLECTIONS {
            let mut next = Vec::with_capacity(light.len());
            for ((panel, matrix), light) in self.panels.iter().zip(matrices).zip(light.iter().rev()) {
                next.push(panel.reflected(light, matrix));
            }
            light = next;
            let now = total(&light);
            add(&mut sent, &light, 1.0);
            let last = std::mem::replace(&mut ratio, now / before.max(f64::MIN_POSITIVE));
            let last_change = std::mem::replace(&mut change, (ratio - last).abs());
            before = now;
            let tail = ratio.min(0.999) / (1.0 - ratio.min(0.999));
            // from here on the light decays geometrically; one ratio like the last may be chance
            if now * tail < NEGLIGIBLE * first
                || change.max(last_change) * now * tail * tail < NEGLIGIBLE * first
            {
                break;
            }
        }
        let ratio = ratio.min(0.999);
        add(&mut sent, &light, (ratio / (1.0 - ratio)) as f32);
        sent
    }
}

/// The computation of [`Patches::radiances`].
struct Radiances<'a> {
    patches: &'a Patches,
    shape: &'a Shape,
    albedos: &'a [f64],
}

impl WithSimd for Radiances<'_> {
    type Output = Array2<f64>;

    // Inlined functions are compiled for those vectors; called ones are not.
    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Array2<f64> {
        let Self { patches, shape, albedos } = self;
        let panels = &patches.panels;
        // the sending panels: only one if both send the same
        let sending = &panels[..if patches.alike { 1 } else { 2 }];
        let sun: Vec<Parts> = sending.iter().map(|panel| Parts::of(shape, &panel.from_sun)).collect();
        let eye = panels.each_ref().map(|panel| Parts::of(shape, &panel.to_eye));
        let all = |between: &AngleList| Parts::of(shape, between).of_pairs();
        let between = [Some(&patches.between), patches.between_1.as_ref()].map(|between| between.map(all));
        let buffer = |parts: &Parts| vec![0.0; parts.body.len()];
        let mut matrices: Vec<Vec<f32>> = between.iter().flatten().map(buffer).collect();
        let (mut from_sun, mut to_eye) = (buffer(&sun[0]), buffer(&eye[0]));
        let mut radiances = Array2::zeros((2 * COUNT, albedos.len()));
        for (n, albedo) in albedos.iter().enumerate() {
            let weights = shape.weights(*albedo).map(|weight| weight as f32);
            for (between, matrix) in between.iter().flatten().zip(&mut matrices) {
                between.mix(weights, matrix);
            }
            let mut direct = Vec::with_capacity(2);
            for (panel, sun) in sending.iter().zip(&sun) {
                sun.mix(weights, &mut from_sun);
                direct.push(panel.direct(&from_sun));
            }
            let sent = patches.sent(direct, [&matrices[0], &matrices[matrices.len() - 1]]);
            for p in 0..2 {
                let (panel, sent) = (&panels[p], &sent[(1 - p).min(sent.len() - 1)]);
                eye[p].mix(weights, &mut to_eye);
                for i in 0..COUNT {
                    let mut sum = 0.0;
                    for j in 0..COUNT {
                        let arriving = panel.factors[i * COUNT + j] * sent[j * COUNT + i];
                        sum += f64::from(arriving * to_eye[i * COUNT + j]);
                    }
                    radiances[[p * COUNT + i, n]] = sum;
                }
            }
        }
        radiances
    }
}

/// Sum of the absolute values of all light.
#[inline(always)]
fn total(light: &[Vec<f32>]) -> f64 {
    let mut sums = [0.0; COUNT];
    for values in light.iter().flat_map(|panel| panel.as_chunks::<COUNT>().0) {
        sums.iter_mut().zip(values).for_each(|(sum, value)| *sum += value.abs());
    }
    sums.iter().copied().map(f64::from).sum()
}

impl Parts {
    fn of(shape: &Shape, angles: &AngleList) -> Self {
        let [body, surface] =
            shape.at_each(angles).map(|values| values.into_iter().map(|value| value as f32).collect());
        Self { body, surface }
    }

    /// Expands the distinct pairs to all pairs of directions, for each row of patches.
    fn of_pairs(&self) -> Self {
        let all = |distinct: &[f32]| {
            let mut all = Vec::with_capacity(ROWS * PAIRS.places.len());
            for row in distinct.chunks_exact(PAIRS.distinct.len()) {
                all.extend(PAIRS.places.iter().map(|place| row[*place]));
            }
            all
        };
        Self { body: all(&self.body), surface: all(&self.surface) }
    }

    /// Body and surface under the [weights](Shape::weights) of an albedo.
    #[inline(always)]
    fn mix(&self, [of_body, level]: [f32; 2], mixed: &mut [f32]) {
        for ((mixed, body), surface) in mixed.iter_mut().zip(&self.body).zip(&self.surface) {
            *mixed = of_body * body + (surface + level);
        }
    }
}

/// Albedo nodes.
fn nodes(count: usize) -> Vec<f64> {
    Rule::gauss_legendre(count).on(0.0, 1.0).map(|(albedo, _)| albedo).collect()
}

/// Geometric mean of the shares of its light that either panel sends to the other, by the power method.
fn exchanged(panels: &[Panel; 2]) -> f64 {
    let (mut light, mut shares) = (vec![1.0_f32; COUNT], [0.0; 2]);
    for n in 0..2 * ITERATIONS {
        let rows = panels[n % 2].factors.as_chunks::<COUNT>().0.iter();
        light = rows.map(|row| row.iter().zip(&light).map(|(factor, sent)| factor * sent).sum()).collect();
        let most = light.iter().copied().fold(f32::MIN_POSITIVE, f32::max);
        light.iter_mut().for_each(|value| *value /= most);
        shares[n % 2] = f64::from(most) / PI;
    }
    (shares[0] * shares[1]).sqrt()
}

#[inline(always)]
fn add(sums: &mut [Vec<f32>], light: &[Vec<f32>], weight: f32) {
    for (sum, value) in sums.iter_mut().flatten().zip(light.iter().flatten()) {
        *sum += weight * value;
    }
}

impl Panel {
    fn new(frame: &Frame, wedge: &Wedge, middles: &[f64], to: &[Vec<Vector3<f64>>]) -> Self {
        // the kernel expects lengths in widths of a patch
        let unit = frame.width / COLS as f64;
        let row = |depth: f64, n: usize| EDGES[n] * depth / unit..EDGES[n + 1] * depth / unit;
        let (mut factors, mut shifts) = (vec![0.0_f32; COUNT * COUNT], [0.0; COLS]);
        let mut to_eye = AngleList::default();
        for (i, to) in to.iter().enumerate() {
            let here = row(frame.depth, i);
            for j in 0..ROWS {
                wedge.exchange(&here, &row(frame.other_depth, j), &mut shifts);
                for (col, other) in (0..COLS).flat_map(|col| (0..COLS).map(move |other| (col, other))) {
                    factors[(i * COLS + col) * COUNT + j * COLS + other] =
                        (PI * shifts[col.abs_diff(other)] / (here.end - here.start)) as f32;
                }
            }
            for col in 0..COLS {
                let along = ((col as f64 + 0.5) / COLS as f64 - 0.5) * frame.width;
                let eye = frame.to_eye([middles[i] * frame.depth, along]);
                to_eye.extend((0..COUNT).map(|k| Angles::new(&to[direction(col, k)], &eye)));
            }
        }
        let from_sun = to.iter().flatten().map(|to| Angles::new(&frame.sun, to)).collect();
        Self { lit: frame.lit(), factors, from_sun, to_eye }
    }

    /// Sunlight sent by each patch to each of the other panel, given the reflection along each direction.
    #[inline(always)]
    fn direct(&self, from_sun: &[f32]) -> Vec<f32> {
        let lit = (PI * self.lit) as f32;
        let mut direct = Vec::with_capacity(COUNT * COUNT);
        for i in 0..COUNT {
            // towards the other panel's patches, row by row
            let (first, of_row) = (COLS - 1 - i % COLS, &from_sun[i / COLS * DIRECTIONS..][..DIRECTIONS]);
            for row in of_row.chunks_exact(SHIFTS) {
                direct.extend(row[first..first + COLS].iter().map(|reflection| lit * reflection));
            }
        }
        direct
    }

    /// Light that this panel's patches reflect of what the other's sent.
    #[inline(always)]
    fn reflected(&self, light: &[f32], matrix: &[f32]) -> Vec<f32> {
        let mut reflected = Vec::with_capacity(COUNT * COUNT);
        // by incoming direction, then by row of the outgoing one
        let (towards, _) = matrix.as_chunks::<SHIFTS>().0.as_chunks::<ROWS>();
        for (i, factors) in self.factors.as_chunks::<COUNT>().0.iter().enumerate() {
            let mut arriving = [0.0; COUNT];
            for ((arriving, factor), sent) in
                arriving.iter_mut().zip(factors).zip(light.as_chunks::<COUNT>().0)
            {
                *arriving = factor * sent[i];
            }
            let first = COLS - 1 - i % COLS;
            let of_row = &towards[i / COLS * DIRECTIONS..][..DIRECTIONS];
            let mut sums = [[0.0; COLS]; ROWS];
            for (arriving, from) in arriving.as_chunks::<COLS>().0.iter().zip(of_row.as_chunks::<SHIFTS>().0)
            {
                for (arriving, towards) in arriving.iter().zip(&from[first..first + COLS]) {
                    // arrays of known length stay in registers
                    for (sums, row) in sums.iter_mut().zip(towards) {
                        let Some(row) = row[first..].first_chunk::<COLS>() else { continue };
                        sums.iter_mut().zip(row).for_each(|(sum, f)| *sum += arriving * f);
                    }
                }
            }
            reflected.extend_from_slice(sums.as_flattened());
        }
        reflected
    }
}

/// Index of the direction from patch `i` to patch `k` of the other panel, within its row.
fn direction(i: usize, k: usize) -> usize {
    k / COLS * SHIFTS + (k % COLS + COLS - 1 - i % COLS)
}

/// Directions from the patches of each row to those of the other panel: means over the exchanged light, which
/// differ from the direction between the middles of nearby patches.
fn directions(frame: &Frame) -> Vec<Vec<Vector3<f64>>> {
    let (gauss, hat) = (Rule::gauss_legendre(PLACES), Rule::gauss_hat(PLACES));
    let unit = frame.width / COLS as f64;
    let span = |depth: f64, n: usize| gauss.on(EDGES[n] * depth, EDGES[n + 1] * depth);
    let mean = |row: usize, other: usize, shift: f64| {
        let mut sum = Vector3::zeros();
        for (out, weight) in span(frame.depth, row) {
            for (far, weight_far) in span(frame.other_depth, other) {
                for (z, weight_along) in hat.nodes.iter().zip(&hat.weights) {
                    let along = (shift + z) * unit;
                    let way = Vector3::new(far * frame.cos - out, along, far * frame.sin);
                    let square = way.norm_squared();
                    sum += way
                        * (weight * weight_far * weight_along * out * far
                            / (square * square * square.sqrt()));
                }
            }
        }
        sum.normalize()
    };
    let ends = (0..ROWS).flat_map(|other| (0..SHIFTS).map(move |n| (other, n as f64 + 1.0 - COLS as f64)));
    (0..ROWS).map(|row| ends.clone().map(|(other, shift)| mean(row, other, shift)).collect()).collect()
}

/// Angles of the distinct pairs of directions, by row of patches.
fn pairs(to: &[Vec<Vector3<f64>>]) -> AngleList {
    to.iter().flat_map(|to| PAIRS.distinct.iter().map(|&(a, b)| Angles::new(&to[a], &to[b]))).collect()
}

/// Pairs of directions at a row of patches with distinct reflection: reflection is reciprocal, and unchanged
/// if both directions are mirrored along the crease.
struct Pairs {
    distinct: Vec<(usize, usize)>,
    /// Index of the distinct pair for each incoming and outgoing direction.
    places: Vec<usize>,
}

static PAIRS: LazyLock<Pairs> = LazyLock::new(|| {
    let mirrored = |direction: usize| direction / SHIFTS * SHIFTS + SHIFTS - 1 - direction % SHIFTS;
    let first_alike = |(a, b): (usize, usize)| {
        let (c, d) = (mirrored(a), mirrored(b));
        (a, b).min((b, a)).min((c, d)).min((d, c))
    };
    let all: Vec<_> =
        (0..DIRECTIONS).flat_map(|a| (0..DIRECTIONS).map(move |b| first_alike((a, b)))).collect();
    let mut distinct = all.clone();
    distinct.sort_unstable();
    distinct.dedup();
    let places = all.iter().map(|pair| distinct.partition_point(|other| other < pair)).collect();
    Pairs { distinct, places }
});

#[cfg(test)]
mod tests {
    use nalgebra::Point3;

    use super::*;
    use crate::geometry::FacetGrid;
    use crate::sheet::{Family, measured};

    /// Whatever the sheet, a few albedos tell what many do.
    #[test]
    fn few_albedos_tell_all_others() {
        let albedos: Vec<f64> = (0..20).map(|n| f64::from(n) * 0.05).collect();
        let glossy = [(1.0, 0.28), (0.4, 0.65)].map(|(specular_weight, roughness)| Family {
            specular_weight,
            roughness,
            ..Family::default()
        });
        let others = [
            Family { body_roughness_deg: 25.0, ..Family::default() },
            Family { sheen: 1.0, ..Family::default() },
        ];
        let formulas = glossy.into_iter().chain(others).map(Shape::from);
        let shapes: Vec<Shape> = formulas.chain(measured().unwrap().iter().cloned()).collect();
        for (angle_deg, sun) in [(48.0, [0.0, 0.0, 1.0]), (80.0, [0.2, 0.1, 1.0])] {
            let fold = Fold::new(angle_deg, 1.0, 1.0, FacetGrid { rows: 4, cols: 4 }).unwrap();
            let eye = Point3::new(1.0, 1.1, 8.4);
            let frames = [0, 1].map(|panel| Frame::new(&fold, panel, &Vector3::from(sun), &eye));
            let with_pole = Patches::new(&fold, &frames);
            let without = Patches { exchanged: 0.0, ..Patches::new(&fold, &frames) };
            let mut squares = [0.0; 2];
            for shape in &shapes {
                let at = |patches: &Patches, count: usize| {
                    let nodes = nodes(count);
                    patches.radiances_at(shape, &nodes).dot(&patches.shares_of(&nodes, &albedos))
                };
                let many = at(&with_pole, 12);
                for (sum, patches) in squares.iter_mut().zip([&with_pole, &without]) {
                    let square = (at(patches, NODES) - &many).pow2().mean().unwrap();
                    assert!(square.sqrt() < 7e-4, "{angle_deg}°: {square:.1e}");
                    *sum += square;
                }
            }
            // wide folds exchange so little that it makes no difference
            assert!(angle_deg > 60.0 || squares[0] < 0.6 * squares[1], "{angle_deg}°: {squares:?}");
        }
    }

    /// Just off the bisecting plane the sun needs both panels followed; exactly on it, one suffices.
    #[test]
    fn panels_that_send_the_same_are_followed_once() {
        let fold = Fold::new(48.0, 1.0, 1.0, FacetGrid { rows: 4, cols: 4 }).unwrap();
        let glossy = Shape::from(Family { specular_weight: 0.5, roughness: 0.4, ..Family::default() });
        let eye = Point3::new(1.0, 1.1, 8.4);
        let [(one, once), (two, twice)] = [0.0, 1e-7].map(|x| {
            let frames = [0, 1].map(|panel| Frame::new(&fold, panel, &Vector3::new(x, 0.1, 1.0), &eye));
            let patches = Patches::new(&fold, &frames);
            (patches.alike, patches.radiances(&glossy))
        });
        assert!(one && !two);
        assert!(once.iter().zip(&twice).all(|(a, b)| (a - b).abs() < 1e-5 * (0.01 + b.abs())));
    }
}
