//! The bounces between two undivided panels: eqs. (1) to (4) without facets.
//!
//! One flat patch a facet is 4 % off at the crease of a bright 45° fold, however exact its form factors. Here the
//! radiosity is a function on the panel instead, resolved where it varies and nowhere else:
//!
//! - away from the crease, a Nyström rule in `u = ln s`, in which the kernel keeps its shape at every distance and its
//!   singularities stay `θ` away from the real axis. The strip next to the crease is one constant, and the difference
//!   between the exact share of the light of an endlessly long fold and the share that the rule finds is added to the
//!   diagonal: what the rule misses beside its nodes comes from near them;
//! - along the crease, Galerkin with Legendre polynomials on strips graded towards the ends, since there the kernel is
//!   far narrower than the radiosity is smooth. Only the shift `z = x − y` matters, so each pair of strips becomes one
//!   integral over z of the kernel times the correlation of two polynomials.
//!
//! Both converge exponentially. Lengths are in units of the panel's depth.

use std::f64::consts::PI;

use nalgebra::DMatrix;
use rayon::prelude::*;

use super::panel::{PanelOperator, mirrored};
use super::quadrature::{Rule, legendre_series};
use crate::geometry::{FacetGrid, Fold};

/// Ratio of the ends of a Gauss panel that is graded towards the kernel's peak at z = 0.
const PEAK_GRADING: f64 = 3.0;

/// How finely the radiosity of a panel is resolved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    /// Depth of the strip next to the crease on which radiosity is one constant, relative to the panel.
    pub crease_strip: f64,
    /// Longest panel of the rule in ln s, and its points.
    pub row_panel: f64,
    /// Points of the rule on a panel.
    pub row_order: usize,
    /// Width of the strip at each end of the crease, relative to the panel.
    pub end_strip: f64,
    /// The most that the strips' ends move away from one to the next, as a ratio.
    pub strip_growth: f64,
    /// Polynomials on a strip.
    pub strip_order: usize,
}

impl Resolution {
    /// Unknowns that a fold's panel takes.
    #[must_use]
    pub fn unknowns(&self, fold: &Fold) -> usize {
        let crease = Crease::new(fold.width() / fold.depth(), self);
        Rows::new(fold, self).len() * crease.strips.len() * crease.order
    }
}

/// The radiosity operator of one panel of a fold, and how to read facet means from its functions.
pub struct Continuum {
    matrix: DMatrix<f64>,
    uniform: Vec<f64>,
    facets: FacetGrid,
    /// Facet row by row node: mean over the facet row.
    row_pool: DMatrix<f64>,
    /// Facet column (first half) by polynomial: mean over the facet's width.
    col_pool: DMatrix<f64>,
}

impl Continuum {
    /// Discretises the exchange between the panels of `fold`.
    ///
    /// # Source
    /// Deeb et al., eq. (2), as the kernel of the integral equation that eqs. (1) to (4) iterate.
    #[must_use]
    pub fn new(fold: &Fold, resolution: &Resolution) -> Self {
        let rows = Rows::new(fold, resolution);
        let crease = Crease::new(fold.width() / fold.depth(), resolution);
        let facets = fold.facets();
        Self {
            matrix: assemble(&rows, &crease),
            uniform: rows.uniform().flat_map(|row| crease.uniform().map(move |col| row * col)).collect(),
            facets,
            row_pool: rows.means(facets.rows),
            col_pool: crease.means(facets.cols),
        }
    }
}

impl PanelOperator for Continuum {
    fn uniform(&self) -> Vec<f64> {
        self.uniform.clone()
    }

    fn apply(&self, x: &[f64], out: &mut [f64]) {
        // The matrix is symmetric, so its contiguous columns serve as rows.
        let columns = self.matrix.as_slice().par_chunks_exact(x.len());
        columns.zip(out).with_min_len(100_000 / x.len()).for_each(|(column, out)| *out = dot(column, x));
    }

    fn facet_means(&self, x: &[f64]) -> Vec<f64> {
        let x = DMatrix::from_column_slice(self.col_pool.ncols(), self.row_pool.ncols(), x);
        let means = &self.col_pool * x * self.row_pool.transpose();
        mirrored(self.facets, |row, col| means[(col, row)])
    }
}

/// Nodes across a panel, from the crease outwards; the first stands for the strip next to the crease.
struct Rows {
    angle: Angle,
    /// Ends of the rule's panels in ln s, from the crease strip to the outer edge at 0.
    ends: Vec<f64>,
    rule: Rule,
    distance: Vec<f64>,
    weight: Vec<f64>,
}

/// Trigonometry of the opening angle, in forms that keep their digits.
#[derive(Clone, Copy)]
struct Angle {
    sin: f64,
    cos: f64,
    half_sin: f64,
}

impl Angle {
    /// Squared distance across the crease.
    fn q2(self, s: f64, t: f64) -> f64 {
        (s - t).powi(2) + 4.0 * s * t * self.half_sin * self.half_sin
    }

    /// The kernel of an endlessly long fold: eq. (2) over π, integrated along the crease.
    fn long_kernel(self, s: f64, t: f64) -> f64 {
        self.sin * self.sin * s * t / (2.0 * self.q2(s, t).powf(1.5))
    }

    /// `∫₀^end` of [`Angle::long_kernel`] over t.
    fn long_share(self, s: f64, end: f64) -> f64 {
        0.5 * (1.0 + (end * self.cos - s) / self.q2(s, end).sqrt())
    }

    /// Share that a strip along the crease of an endlessly long fold hands to its twin (Hottel's crossed strings).
    fn crease_share(self) -> f64 {
        1.0 - self.half_sin
    }
}

impl Rows {
    fn new(fold: &Fold, resolution: &Resolution) -> Self {
        let theta = fold.angle_rad();
        let angle = Angle { sin: theta.sin(), cos: theta.cos(), half_sin: (theta / 2.0).sin() };
        let start = (resolution.crease_strip * (fold.width() / fold.depth()).min(1.0)).ln();
        let ends = graded_ends(start, resolution.row_panel, theta);
        let rule = Rule::gauss_legendre(resolution.row_order);
        let strip = start.exp();
        let (mut distance, mut weight) = (vec![0.5 * strip], vec![strip]);
        for (u, w) in ends.windows(2).flat_map(|ends| rule.on(ends[0], ends[1])) {
            distance.push(u.exp());
            weight.push(w * u.exp());
        }
        Self { angle, ends, rule, distance, weight }
    }

    fn len(&self) -> usize {
        self.distance.len()
    }

    /// Coordinates of the function 1.
    fn uniform(&self) -> impl Iterator<Item = f64> + '_ {
        self.weight.iter().map(|w| w.sqrt())
    }

    /// Factor of the correlation integral for nodes `i` and `j`.
    fn factor(&self, i: usize, j: usize) -> f64 {
        let (s, t) = (self.distance[i], self.distance[j]);
        self.angle.sin * self.angle.sin * s * t / PI * (self.weight[i] * self.weight[j]).sqrt()
    }

    /// What the rule misses of an endlessly long fold's exchange: entries with the crease strip, and the diagonal.
    fn missed(&self) -> (Vec<f64>, Vec<f64>) {
        let strip = self.weight[0];
        let found =
            |i: usize, j: usize| self.angle.long_kernel(self.distance[i], self.distance[j]) * self.weight[j];
        let with_strip = |i: usize| self.angle.long_share(self.distance[i], strip);
        let strip_missed = (0..self.len())
            .map(|i| match i {
                0 => self.angle.crease_share() - found(0, 0),
                _ => (with_strip(i) - found(i, 0)) * (self.weight[i] / strip).sqrt(),
            })
            .collect();
        let diagonal = (0..self.len())
            .map(|i| match i {
                0 => 0.0,
                _ => {
                    let rest: f64 = (1..self.len()).map(|j| found(i, j)).sum();
                    self.angle.long_share(self.distance[i], 1.0) - with_strip(i) - rest
                }
            })
            .collect();
        (strip_missed, diagonal)
    }

    /// Means over `count` facet rows of the function through the nodes: facet row by node.
    fn means(&self, count: usize) -> DMatrix<f64> {
        let order = self.rule.nodes.len();
        let fine = Rule::gauss_legendre(order + 4);
        let lagrange = Lagrange::new(&self.rule.nodes);
        let mut pool = DMatrix::zeros(count, self.len());
        for row in 0..count {
            let (low, high) = (row as f64 / count as f64, (row + 1) as f64 / count as f64);
            let overlap = (high.min(self.weight[0]) - low).max(0.0);
            pool[(row, 0)] = overlap / self.weight[0].sqrt();
            for (panel, ends) in self.ends.windows(2).enumerate() {
                let (from, to) = (ends[0].max(low.ln()), ends[1].min(high.ln()));
                if from >= to {
                    continue;
                }
                for (u, w) in fine.on(from, to) {
                    let local = (2.0 * u - ends[0] - ends[1]) / (ends[1] - ends[0]);
                    for (k, value) in lagrange.at(local).into_iter().enumerate() {
                        let node = 1 + panel * order + k;
                        pool[(row, node)] += value * w * u.exp() / self.weight[node].sqrt();
                    }
                }
            }
        }
        pool * count as f64
    }
}

/// Ends of panels from `start` (a logarithm) to 0. Near the outer edge, where light leaves, radiosity varies over θ times
/// the depth: panels shrink to that towards it.
fn graded_ends(start: f64, longest: f64, theta: f64) -> Vec<f64> {
    let mut ends = vec![0.0];
    let mut length = longest.min(2.2 * theta);
    let mut end = 0.0;
    while end - length > start + 0.3 * length {
        end -= length;
        ends.push(end);
        length = longest.min(2.0 * length);
    }
    ends.push(start);
    ends.reverse();
    ends
}

/// Lagrange interpolation through fixed nodes.
struct Lagrange<'a> {
    nodes: &'a [f64],
    scale: Vec<f64>,
}

impl<'a> Lagrange<'a> {
    fn new(nodes: &'a [f64]) -> Self {
        let others = |k: usize| nodes.iter().enumerate().filter(move |(m, _)| *m != k);
        let scale =
            (0..nodes.len()).map(|k| others(k).map(|(_, x)| nodes[k] - x).product::<f64>().recip()).collect();
        Self { nodes, scale }
    }

    /// Values of the basis polynomials at `x`.
    fn at(&self, x: f64) -> Vec<f64> {
        let others = |k: usize| self.nodes.iter().enumerate().filter(move |(m, _)| *m != k);
        (0..self.nodes.len())
            .map(|k| others(k).map(|(_, node)| x - node).product::<f64>() * self.scale[k])
            .collect()
    }
}

/// The half of the crease from its end to its middle, in strips that carry Legendre polynomials.
struct Crease {
    width: f64,
    strips: Vec<[f64; 2]>,
    order: usize,
}

impl Crease {
    fn new(width: f64, resolution: &Resolution) -> Self {
        let half = 0.5 * width;
        let first = (resolution.end_strip * width.min(1.0)).min(half);
        let graded = ((half / first).ln() / resolution.strip_growth.ln()).ceil();
        let end = |k: usize| first * (half / first).powf(k as f64 / graded);
        let others = (0..graded as usize).map(|k| [end(k), end(k + 1)]);
        let strips = std::iter::once([0.0, first]).chain(others).collect();
        Self { width, strips, order: resolution.strip_order }
    }

    /// Coordinates of the function 1 in the normalised polynomials of all strips.
    fn uniform(&self) -> impl Iterator<Item = f64> + '_ {
        let one = |[low, high]: [f64; 2]| {
            (0..self.order).map(move |b| if b == 0 { (high - low).sqrt() } else { 0.0 })
        };
        self.strips.iter().copied().flat_map(one)
    }

    /// Means over the first half of `count` facet columns: column by polynomial.
    fn means(&self, count: usize) -> DMatrix<f64> {
        let mut pool = DMatrix::zeros(count.div_ceil(2), self.strips.len() * self.order);
        let rule = Rule::gauss_legendre(self.order);
        let facet = self.width / count as f64;
        let mut values = vec![0.0; self.order];
        for col in 0..count.div_ceil(2) {
            // A middle column ends at the middle: its other half is its mirror image.
            let (low, high) = (col as f64 * facet, ((col + 1) as f64 * facet).min(0.5 * self.width));
            for (n, strip) in self.strips.iter().enumerate() {
                let (from, to) = (strip[0].max(low), strip[1].min(high));
                if from >= to {
                    continue;
                }
                for (x, w) in rule.on(from, to) {
                    polynomials(*strip, x, &mut values);
                    for (b, value) in values.iter().enumerate() {
                        pool[(col, n * self.order + b)] += w * value / (high - low);
                    }
                }
            }
        }
        pool
    }

    /// Correlation of strip `e` with strip `f` and with the mirror image of `f`.
    fn correlation(&self, e: usize, f: usize, peak: f64) -> Correlation {
        let [low, high] = self.strips[f];
        let mut correlation = Correlation::new(self.order);
        correlation.add(self.strips[e], [low, high], false, peak);
        correlation.add(self.strips[e], [self.width - high, self.width - low], true, peak);
        correlation
    }
}

/// Dot product in four sums, so that it need not wait for each addition.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (mut sums, mut rest) = ([0.0; 4], 0.0);
    let (a, b) = (a.chunks_exact(4), b.chunks_exact(4));
    for (a, b) in a.remainder().iter().zip(b.remainder()) {
        rest += a * b;
    }
    for (a, b) in a.zip(b) {
        for k in 0..4 {
            sums[k] += a[k] * b[k];
        }
    }
    sums.iter().sum::<f64>() + rest
}

/// Normalised Legendre polynomials of a strip at `x`.
fn polynomials(strip: [f64; 2], x: f64, values: &mut [f64]) {
    let length = strip[1] - strip[0];
    legendre_series((2.0 * x - strip[0] - strip[1]) / length, values);
    for (b, value) in values.iter_mut().enumerate() {
        *value *= ((2 * b + 1) as f64 / length).sqrt();
    }
}

/// `∫∫ P_b(x) P_d(y) g(x − y) dx dy` as a rule over the shift: squared shifts and, for each, weights of all pairs (b, d).
struct Correlation {
    order: usize,
    shift2: Vec<f64>,
    weights: Vec<f64>,
}

impl Correlation {
    fn new(order: usize) -> Self {
        Self { order, shift2: Vec::new(), weights: Vec::new() }
    }

    /// Adds strips `e` and `f`; `mirror` reverses the polynomials of `f`. The kernel's peak at z = 0 has width `peak`.
    fn add(&mut self, e: [f64; 2], f: [f64; 2], mirror: bool, peak: f64) {
        let mut kinks = [e[0] - f[1], e[0] - f[0], e[1] - f[1], e[1] - f[0]];
        kinks.sort_by(f64::total_cmp);
        let rule = Rule::gauss_legendre(self.order + 6);
        for piece in kinks.windows(2) {
            for [low, high] in towards_peak(piece[0], piece[1], peak) {
                for (z, w) in rule.on(low, high) {
                    self.add_shift(e, f, mirror, z, w);
                }
            }
        }
    }

    fn add_shift(&mut self, e: [f64; 2], f: [f64; 2], mirror: bool, z: f64, weight: f64) {
        let order = self.order;
        let start = self.weights.len();
        self.shift2.push(z * z);
        self.weights.resize(start + order * order, 0.0);
        let (mut of_e, mut of_f) = (vec![0.0; order], vec![0.0; order]);
        for (x, w) in Rule::gauss_legendre(order).on(e[0].max(f[0] + z), e[1].min(f[1] + z)) {
            polynomials(e, x, &mut of_e);
            polynomials(f, x - z, &mut of_f);
            if mirror {
                of_f.iter_mut().skip(1).step_by(2).for_each(|value| *value = -*value);
            }
            for (b, p) in of_e.iter().enumerate() {
                for (d, r) in of_f.iter().enumerate() {
                    self.weights[start + b * order + d] += weight * w * p * r;
                }
            }
        }
    }

    /// The integrals with `g = 1/(q² + z²)²` into `out[b * order + d]`.
    fn integrate(&self, q2: f64, out: &mut [f64]) {
        out.fill(0.0);
        for (z2, weights) in self.shift2.iter().zip(self.weights.chunks_exact(self.order * self.order)) {
            let g = (q2 + z2).powi(2).recip();
            out.iter_mut().zip(weights).for_each(|(out, w)| *out += w * g);
        }
    }
}

/// Cuts `[low, high]` at 0 and, towards 0, in geometric steps down to the width of the peak.
fn towards_peak(low: f64, high: f64, peak: f64) -> Vec<[f64; 2]> {
    if low < 0.0 && high > 0.0 {
        return [towards_peak(low, 0.0, peak), towards_peak(0.0, high, peak)].concat();
    }
    if high <= 0.0 && low < 0.0 {
        return towards_peak(-high, -low, peak).into_iter().map(|[a, b]| [-b, -a]).collect();
    }
    let mut pieces = Vec::new();
    let mut end = high;
    while end > low {
        let start = if end <= peak { low } else { low.max(end / PEAK_GRADING) };
        pieces.push([start, end]);
        end = start;
    }
    pieces
}

/// The symmetric matrix of the operator: row node slow, strip, polynomial fast.
fn assemble(rows: &Rows, crease: &Crease) -> DMatrix<f64> {
    let (count, order) = (rows.len(), crease.order);
    let block = crease.strips.len() * order;
    let peak = rows.angle.half_sin * rows.distance[0];
    let pairs: Vec<_> =
        (0..crease.strips.len()).flat_map(|e| (e..crease.strips.len()).map(move |f| (e, f))).collect();
    let correlations: Vec<_> =
        pairs.into_par_iter().map(|(e, f)| (e, f, crease.correlation(e, f, peak))).collect();
    let mut matrix = DMatrix::zeros(count * block, count * block);
    // Column blocks of one row node each: the upper half first, mirrored below.
    matrix.as_mut_slice().par_chunks_exact_mut(block * count * block).enumerate().for_each(|(j, columns)| {
        let mut integrals = vec![0.0; order * order];
        for i in 0..=j {
            let (q2, factor) = (rows.angle.q2(rows.distance[i], rows.distance[j]), rows.factor(i, j));
            for (e, f, correlation) in &correlations {
                correlation.integrate(q2, &mut integrals);
                for (n, value) in integrals.iter().enumerate() {
                    let (at_e, at_f) = (e * order + n / order, f * order + n % order);
                    columns[at_f * count * block + i * block + at_e] = factor * value;
                    columns[at_e * count * block + i * block + at_f] = factor * value;
                }
            }
        }
    });
    add_missed(rows, block, &mut matrix);
    matrix.fill_lower_triangle_with_upper_triangle();
    matrix
}

fn add_missed(rows: &Rows, block: usize, matrix: &mut DMatrix<f64>) {
    let (strip, diagonal) = rows.missed();
    for (i, (strip, diagonal)) in strip.into_iter().zip(diagonal).enumerate() {
        for n in 0..block {
            let at = i * block + n;
            matrix[(at, at)] += diagonal;
            matrix[(n, at)] += strip;
        }
    }
}
