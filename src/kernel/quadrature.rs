//! Gauss–Legendre rules and interpolation through their nodes.

use std::borrow::Cow;
use std::f64::consts::PI;
use std::sync::OnceLock;

use nalgebra::DMatrix;
use smallvec::{SmallVec, smallvec};

use crate::solve::Eigen;

/// A quadrature rule: `∫ f ≈ Σ weights[i] f(nodes[i])`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rule {
    /// Abscissae, increasing.
    pub nodes: Vec<f64>,
    /// Weights, positive.
    pub weights: Vec<f64>,
}

/// Rules with fewer points than this are cached.
const KEPT: usize = 64;

impl Rule {
    /// The `order`-point Gauss–Legendre rule on [-1, 1], exact for polynomials of degree `2·order − 1`.
    ///
    /// Newton's method on the Legendre polynomial, starting from Tricomi's asymptotic roots (Press et
    /// al., *Numerical Recipes*, 3rd ed., section 4.6).
    ///
    /// # Example
    /// ```
    /// use vfold::kernel::quadrature::Rule;
    /// let rule = Rule::gauss_legendre(2);
    /// assert!((rule.nodes[1] - 1.0 / 3.0_f64.sqrt()).abs() < 1e-15);
    /// ```
    #[must_use]
    pub fn gauss_legendre(order: usize) -> Self {
        let (nodes, weights) = (0..order).rev().map(|i| legendre_root(order, i)).unzip();
        Self { nodes, weights }
    }

    /// [`Rule::gauss_legendre`], cached if it has fewer than 64 points.
    ///
    /// # Example
    /// ```
    /// use vfold::kernel::quadrature::Rule;
    /// assert_eq!(*Rule::kept_legendre(3), Rule::gauss_legendre(3));
    /// ```
    #[must_use]
    pub fn kept_legendre(order: usize) -> Cow<'static, Self> {
        static RULES: [OnceLock<Rule>; KEPT] = [const { OnceLock::new() }; KEPT];
        let make = || Self::gauss_legendre(order);
        RULES.get(order).map_or_else(|| Cow::Owned(make()), |kept| Cow::Borrowed(kept.get_or_init(make)))
    }

    /// The `order`-point Gauss rule for the weight `1 − |x|` on [-1, 1].
    ///
    /// Stieltjes' procedure on an exact discretisation of the weight, then the eigenvalues of the Jacobi
    /// matrix (Gautschi, *Orthogonal Polynomials*, sections 2.2.3 and 3.1.1).
    ///
    /// # Example
    /// ```
    /// use vfold::kernel::quadrature::Rule;
    /// let rule = Rule::gauss_hat(2); // nodes ±1/√6, weights 1/2
    /// assert!((rule.nodes[1] - 6.0_f64.sqrt().recip()).abs() < 1e-15);
    /// ```
    #[must_use]
    pub fn gauss_hat(order: usize) -> Self {
        let legendre = Self::gauss_legendre(order + 1);
        let halves = [(-1.0, 0.0), (0.0, 1.0)].into_iter().flat_map(|(low, high)| legendre.on(low, high));
        let measure: Vec<(f64, f64)> = halves.map(|(x, w)| (x, w * (1.0 - x.abs()))).collect();
        // Orthonormal polynomials at the nodes; as the weight is even, their recurrence has no diagonal.
        let (mut before, mut now) = (vec![0.0; measure.len()], vec![1.0; measure.len()]);
        let mut off_diagonal = Vec::new();
        for _ in 1..order {
            let last = off_diagonal.last().copied().unwrap_or(0.0);
            let next = measure.iter().zip(now.iter().zip(&before)).map(|((x, _), (p, q))| x * p - last * q);
            let next: Vec<f64> = next.collect();
            let norm = measure.iter().zip(&next).map(|((_, w), p)| w * p * p).sum::<f64>().sqrt();
            before = std::mem::replace(&mut now, next.iter().map(|p| p / norm).collect());
            off_diagonal.push(norm);
        }
        // First components of the eigenvectors.
        let Eigen { values, vectors } =
            Eigen::seen(DMatrix::identity(1, order), &vec![0.0; order], &off_diagonal);
        let mut rule: Vec<(f64, f64)> = (0..order).map(|k| (values[k], vectors[(0, k)].powi(2))).collect();
        rule.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (nodes, weights) = rule.into_iter().unzip();
        Self { nodes, weights }
    }

    /// Nodes and weights of this rule, mapped from [-1, 1] to `[low, high]`.
    pub fn on(&self, low: f64, high: f64) -> impl Iterator<Item = (f64, f64)> + '_ {
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        self.nodes.iter().zip(&self.weights).map(move |(x, w)| (middle + half * x, half * w))
    }
}

/// ρ of the largest ellipse with foci at the ends of `[low, high]` that excludes the point `re ± i·im` of the
/// complex plane: the error of an n-point Gauss rule for a function that is singular there is about `ρ^(−2n)`
/// (Trefethen, *Approximation Theory and Approximation Practice*, chapter 19).
///
/// # Example
/// ```
/// use vfold::kernel::quadrature::bernstein_rho;
/// assert!((bernstein_rho([-1.0, 1.0], [1.25, 0.0]) - 2.0).abs() < 1e-15); // 2 + 1/2 is twice 1.25
/// ```
#[must_use]
pub fn bernstein_rho([low, high]: [f64; 2], [re, im]: [f64; 2]) -> f64 {
    let axis = (((low - re).hypot(im) + (high - re).hypot(im)) / (high - low)).max(1.0);
    axis + (axis * axis - 1.0).sqrt()
}

/// The `i`-th root of the Legendre polynomial of degree `n`, counted from the largest, and its Gauss weight.
fn legendre_root(n: usize, i: usize) -> (f64, f64) {
    let mut x = (PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
    let mut slope = 1.0;
    for _ in 0..100 {
        let (value, derivative) = legendre(n, x);
        slope = derivative;
        let step = value / derivative;
        x -= step;
        if step.abs() <= 1e-16 {
            break;
        }
    }
    (x, 2.0 / ((1.0 - x * x) * slope * slope))
}

/// The Legendre polynomial of degree `n` and its derivative at `x` inside (-1, 1).
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut previous, mut value) = (0.0, 1.0);
    for k in 0..n {
        let k = k as f64;
        (previous, value) = (value, ((2.0 * k + 1.0) * x * value - k * previous) / (k + 1.0));
    }
    (value, n as f64 * (x * value - previous) / (x * x - 1.0))
}

/// Values of the Legendre polynomials at `points` in [-1, 1], degree by degree from 0, as many as `values`
/// holds.
pub fn legendre_series(points: &[f64], values: &mut [f64]) {
    let mut degrees = values.chunks_exact_mut(points.len());
    let Some(mut before) = degrees.next() else { return };
    before.fill(1.0);
    let Some(mut now) = degrees.next() else { return };
    now.copy_from_slice(points);
    for (next, k) in degrees.zip(1_u32..) {
        let k = f64::from(k);
        let (of_now, of_before) = ((2.0 * k + 1.0) / (k + 1.0), k / (k + 1.0));
        for (((next, x), now), before) in next.iter_mut().zip(points).zip(&*now).zip(&*before) {
            *next = of_now * x * now - of_before * before;
        }
        (before, now) = (now, next);
    }
}

/// Lagrange interpolation through fixed nodes.
#[derive(Clone, Debug)]
pub struct Lagrange {
    nodes: Vec<f64>,
    scale: Vec<f64>,
}

/// A distance that is practically zero but has a finite inverse.
const NEGLIGIBLE: f64 = 1e-200;

impl Lagrange {
    /// Interpolation through distinct `nodes`.
    #[must_use]
    pub fn new(nodes: &[f64]) -> Self {
        let others = |k: usize| nodes.iter().enumerate().filter(move |(m, _)| *m != k);
        let scale = |k: usize| others(k).map(|(_, x)| nodes[k] - x).product::<f64>().recip();
        Self { nodes: nodes.to_vec(), scale: (0..nodes.len()).map(scale).collect() }
    }

    /// Weights of the values at the nodes for interpolation at `x`, one per node.
    ///
    /// The barycentric formula (Trefethen, *Approximation Theory and Approximation Practice*, chapter 5).
    ///
    /// # Example
    /// ```
    /// use vfold::kernel::quadrature::Lagrange;
    /// let mut weights = [0.0; 3];
    /// Lagrange::new(&[0.0, 1.0, 2.0]).at(1.5, &mut weights); // of values 0, 1, 4 at the nodes
    /// assert!((weights[1] + 4.0 * weights[2] - 2.25).abs() < 1e-15);
    /// ```
    pub fn at(&self, x: f64, weights: &mut [f64]) {
        self.at_all(&[x], weights);
    }

    /// As [`Lagrange::at`] for many points: the weights of the first node at all of them, then those of the
    /// next.
    pub fn at_all(&self, points: &[f64], weights: &mut [f64]) {
        let mut sums: SmallVec<[f64; 4]> = smallvec![0.0; points.len()];
        let of_nodes = weights.chunks_exact_mut(points.len()).zip(&self.nodes).zip(&self.scale);
        for ((weights, node), scale) in of_nodes {
            for ((weight, x), sum) in weights.iter_mut().zip(points).zip(&mut sums) {
                let distance = x - node;
                // At a node, the weights of the others are negligible.
                *weight = scale / if distance.abs() < NEGLIGIBLE { NEGLIGIBLE } else { distance };
                *sum += *weight;
            }
        }
        sums.iter_mut().for_each(|sum| *sum = sum.recip());
        for weights in weights.chunks_exact_mut(points.len()) {
            weights.iter_mut().zip(&sums).for_each(|(weight, inverse)| *weight *= inverse);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn five_points_match_abramowitz_and_stegun_table_25_4() {
        let rule = Rule::gauss_legendre(5);
        let nodes = [-0.906179845938664, -0.538469310105683, 0.0, 0.538469310105683, 0.906179845938664];
        let weights =
            [0.236926885056189, 0.478628670499366, 0.568888888888889, 0.478628670499366, 0.236926885056189];
        for i in 0..5 {
            assert!((rule.nodes[i] - nodes[i]).abs() < 1e-15);
            assert!((rule.weights[i] - weights[i]).abs() < 1e-15);
        }
    }

    /// `∫ (1 − |x|) x^d dx = 2/((d + 1)(d + 2))` for even d.
    #[test]
    fn hat_rules_integrate_their_highest_power() {
        for order in 1..=14 {
            let rule = Rule::gauss_hat(order);
            let degree = 2 * order as i32 - 2;
            let sum: f64 = rule.nodes.iter().zip(&rule.weights).map(|(x, w)| w * x.powi(degree)).sum();
            let want = 2.0 / f64::from((degree + 1) * (degree + 2));
            assert!((sum / want - 1.0).abs() < 1e-13, "order {order}: {sum}");
        }
    }

    /// Poles at ±0.5i of 1/(x² + 0.25), and at −1.5 of 1/(x + 1.5): each additional point divides the error
    /// by ρ².
    #[test]
    fn an_ellipse_says_how_fast_rules_converge() {
        let tame = (4.0 * 2.0_f64.atan(), [0.0, 0.5], (|x| 1.0 / (x * x + 0.25)) as fn(f64) -> f64);
        let off_diagonal = (5.0_f64.ln(), [-1.5, 0.0], (|x| 1.0 / (x + 1.5)) as fn(f64) -> f64);
        for (integral, pole, f) in [tame, off_diagonal] {
            let error = |order| {
                let sum: f64 = Rule::kept_legendre(order).on(-1.0, 1.0).map(|(x, w)| w * f(x)).sum();
                (sum / integral - 1.0).abs()
            };
            let factor = (error(4) / error(12)).powf(1.0 / 16.0);
            let rho = bernstein_rho([-1.0, 1.0], pole);
            assert!((factor / rho - 1.0).abs() < 0.02, "{factor} for {rho}");
        }
    }

    #[test]
    fn kept_rules_are_those_that_are_made() {
        for order in [1, KEPT - 1, KEPT, 2 * KEPT] {
            assert_eq!(*Rule::kept_legendre(order), Rule::gauss_legendre(order));
        }
    }

    #[test]
    fn rules_integrate_their_highest_power() {
        for order in 1..=32 {
            let rule = Rule::gauss_legendre(order);
            let degree = 2 * order as i32 - 2;
            let sum: f64 = rule.on(0.0, 1.0).map(|(x, w)| w * x.powi(degree)).sum();
            assert!((sum * f64::from(degree + 1) - 1.0).abs() < 1e-13, "order {order}: {sum}");
        }
    }
}
