//! Numbers of a scene that are fitted along with the spectrum: tilt, sky, its colour, the angle of the fold.
//!
//! Facets are sums over sources (even sun, odd sun, sky) whose amounts depend on these numbers alone, so that a source is a
//! product of one function of each. What is not linear (the angle of the fold, the colour of the sky) is interpolated
//! between three sources.

use nalgebra::{DMatrix, DVector};

use crate::forward::FacetModel;

/// What an unknown is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Value of a perfect white diffuser facing the sun. The model is proportional to it, so that the best one is a quotient
    /// for every spectrum tried; it is none of [`SceneModel::unknowns`].
    Exposure,
    /// Angle of the sun off the bisecting plane, degrees.
    TiltDeg,
    /// Irradiance of the sky on a plane facing the sun, the sun's being 1.
    Sky,
    /// Colour of the sky as a correlated colour temperature, K; the unknown is its reciprocal, in 1e-6/K.
    SkyCctK,
    /// Angle between the panels, degrees.
    AngleDeg,
}

impl Quantity {
    /// What it is called, unit included.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Exposure => "exposure",
            Self::TiltDeg => "tilt_deg",
            Self::Sky => "sky",
            Self::SkyCctK => "sky_cct_k",
            Self::AngleDeg => "angle_deg",
        }
    }
}

/// A number of the scene, and what is known of it before a picture is taken: it is normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unknown {
    /// What it is.
    pub quantity: Quantity,
    /// Mean.
    pub mean: f64,
    /// Standard deviation; zero for a number that is known after all.
    pub sd: f64,
}

/// What a source's amount is of one unknown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Factor {
    /// The same whatever it is.
    One,
    /// Cosine of an angle in degrees.
    Cosine,
    /// Sine of an angle in degrees.
    Sine,
    /// The number itself.
    Amount,
    /// The quadratic polynomial that is 1 at `nodes[at]` and 0 at the others.
    Node {
        /// Where sources are known.
        nodes: [f64; 3],
        /// Which of them.
        at: usize,
    },
}

/// A value with its first and second derivative.
type Jet = [f64; 3];

impl Unknown {
    /// Value at `w`, a standard normal number, and its derivative by it, in the unit of the quantity.
    #[must_use]
    pub fn at(self, w: f64) -> (f64, f64) {
        let value = self.mean + self.sd * w;
        match self.quantity {
            Quantity::SkyCctK => (1e6 / value, -1e6 * self.sd / (value * value)),
            _ => (value, self.sd),
        }
    }

    /// The number that is normal where the quantity is `value`.
    fn normal_of(self, value: f64) -> f64 {
        if self.quantity == Quantity::SkyCctK { 1e6 / value } else { value }
    }

    /// Least value that it can have.
    #[must_use]
    pub fn least(self) -> f64 {
        if self.quantity == Quantity::Sky { 0.0 } else { f64::NEG_INFINITY }
    }
}

impl Factor {
    fn at(self, x: f64) -> Jet {
        let by_degree = std::f64::consts::PI / 180.0;
        let (sin, cos) = x.to_radians().sin_cos();
        match self {
            Self::One => [1.0, 0.0, 0.0],
            Self::Cosine => [cos, -by_degree * sin, -by_degree * by_degree * cos],
            Self::Sine => [sin, by_degree * cos, -by_degree * by_degree * sin],
            Self::Amount => [x, 1.0, 0.0],
            Self::Node { nodes, at } => {
                let [own, a, b] = [0, 1, 2].map(|n| nodes[(at + n) % 3]);
                let scale = ((own - a) * (own - b)).recip();
                [scale * (x - a) * (x - b), scale * (2.0 * x - a - b), 2.0 * scale]
            }
        }
    }
}

/// A facet model whose sources come in amounts that depend on unknowns.
#[derive(Clone, Debug)]
pub struct SceneModel {
    facets: FacetModel,
    unknowns: Vec<Unknown>,
    /// Source by unknown.
    factors: Vec<Vec<Factor>>,
}

impl SceneModel {
    /// A scene in which all but the spectrum is known.
    #[must_use]
    pub fn known(facets: FacetModel) -> Self {
        let factors = vec![Vec::new(); facets.sources().len()];
        Self { facets, unknowns: Vec::new(), factors }
    }

    /// A scene with unknowns: `factors` has a row for each source of `facets`, with one factor an unknown.
    #[must_use]
    pub fn new(facets: FacetModel, unknowns: Vec<Unknown>, factors: Vec<Vec<Factor>>) -> Self {
        Self { facets, unknowns, factors }
    }

    /// The model, each source in the amount 1.
    #[must_use]
    pub fn facets(&self) -> &FacetModel {
        &self.facets
    }

    /// The unknowns.
    #[must_use]
    pub fn unknowns(&self) -> &[Unknown] {
        &self.unknowns
    }

    /// The same scene with one unknown known to have this value.
    #[must_use]
    pub fn with_known(mut self, unknown: usize, value: f64) -> Self {
        self.unknowns[unknown].mean = value;
        self.unknowns[unknown].sd = 0.0;
        self
    }

    /// The model with its unknowns, in their order and units, known to have these values.
    #[must_use]
    pub fn with_values(&self, values: &[f64]) -> FacetModel {
        let amount = |factors: &Vec<Factor>| {
            let unknowns = self.unknowns.iter().zip(values);
            factors
                .iter()
                .zip(unknowns)
                .map(|(factor, (unknown, value))| factor.at(unknown.normal_of(*value))[0])
                .product()
        };
        self.facets.in_amounts(&self.factors.iter().map(amount).collect::<Vec<f64>>())
    }

    /// Amounts of the sources at `w`, a standard normal number an unknown.
    #[must_use]
    pub fn amounts(&self, w: &[f64]) -> Amounts {
        let jet = |factor: &Factor, unknown: &Unknown, w: f64| {
            let [value, slope, curvature] = factor.at(unknown.mean + unknown.sd * w);
            [value, unknown.sd * slope, unknown.sd * unknown.sd * curvature]
        };
        let jets = |factors: &Vec<Factor>| {
            factors
                .iter()
                .zip(&self.unknowns)
                .zip(w)
                .map(|((factor, unknown), w)| jet(factor, unknown, *w))
                .collect()
        };
        Amounts { jets: self.factors.iter().map(jets).collect(), unknowns: self.unknowns.len() }
    }
}

/// Amounts of the sources about a point, as factors with their derivatives: source by unknown.
pub struct Amounts {
    jets: Vec<Vec<Jet>>,
    unknowns: usize,
}

impl Amounts {
    /// Amount of every source.
    #[must_use]
    pub fn values(&self) -> DVector<f64> {
        self.derivative(&[])
    }

    /// Derivatives of the amounts: source by unknown.
    #[must_use]
    pub fn slopes(&self) -> DMatrix<f64> {
        let columns: Vec<_> = (0..self.unknowns).map(|p| self.derivative(&[p])).collect();
        if columns.is_empty() { DMatrix::zeros(self.jets.len(), 0) } else { DMatrix::from_columns(&columns) }
    }

    /// Second derivatives of `Σ weightᵢ amountᵢ`: unknown by unknown.
    #[must_use]
    pub fn curvature(&self, weights: &DVector<f64>) -> DMatrix<f64> {
        DMatrix::from_fn(self.unknowns, self.unknowns, |p, q| self.derivative(&[p, q]).dot(weights))
    }

    /// The amounts derived by each unknown of `by` in turn.
    fn derivative(&self, by: &[usize]) -> DVector<f64> {
        let order = |p: usize| by.iter().filter(|q| **q == p).count();
        let product = |jets: &Vec<Jet>| jets.iter().enumerate().map(|(p, jet)| jet[order(p)]).product();
        DVector::from_iterator(self.jets.len(), self.jets.iter().map(product))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_have_their_derivatives() {
        let node = Factor::Node { nodes: [43.0, 45.0, 47.0], at: 1 };
        for factor in [Factor::One, Factor::Cosine, Factor::Sine, Factor::Amount, node] {
            for x in [-3.0, 0.4, 44.1] {
                let [[below, slope_below, _], at, [above, slope_above, _]] =
                    [x - 1e-4, x, x + 1e-4].map(|x| factor.at(x));
                let scale = 1.0 + at[0].abs() + at[1].abs();
                assert!((at[1] - (above - below) / 2e-4).abs() < 1e-6 * scale, "{factor:?} {x}");
                assert!((at[2] - (slope_above - slope_below) / 2e-4).abs() < 1e-6 * scale, "{factor:?} {x}");
            }
        }
    }

    /// Three nodes hold any quadratic polynomial.
    #[test]
    fn nodes_interpolate() {
        let nodes = [50.0, 100.0, 160.0];
        let of = |x: f64| 3.0 - 0.2 * x + 0.01 * x * x;
        let parts = [0, 1, 2].map(|at| of(nodes[at]) * Factor::Node { nodes, at }.at(120.0)[0]);
        assert!((parts.iter().sum::<f64>() - of(120.0)).abs() < 1e-9);
    }

    #[test]
    fn a_temperature_is_the_reciprocal_of_its_unknown() {
        let colour = Unknown { quantity: Quantity::SkyCctK, mean: 100.0, sd: 30.0 };
        let (cct_k, slope) = colour.at(1.0);
        assert!((cct_k - 1e6 / 130.0).abs() < 1e-9);
        assert!((slope - (colour.at(1.0 + 1e-5).0 - colour.at(1.0 - 1e-5).0) / 2e-5).abs() < 1e-3);
    }
}
