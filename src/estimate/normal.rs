//! Prior knowledge of a number: normal on a scale.

/// Mean and standard deviation of a number on the [`Scale`] of its unknown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Normal {
    /// Mean.
    pub mean: f64,
    /// Standard deviation; zero for a number that is known.
    pub sd: f64,
}

impl Normal {
    /// Combines this with independent knowledge of the same number.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        let [own, others] = [self, other].map(|one| one.sd.powi(-2));
        let information = own + others;
        Self { mean: (own * self.mean + others * other.mean) / information, sd: information.sqrt().recip() }
    }
}

/// Nodes and weights of five points for a standard normal number.
///
/// # Source
/// M. Abramowitz, I. Stegun, *Handbook of Mathematical Functions* (1964), table 25.10.
const GAUSS_HERMITE: [(f64, f64); 5] = [
    (-2.856_970_013_872_806, 0.011_257_411_327_720_69),
    (-1.355_626_179_974_266, 0.222_075_922_005_612_65),
    (0.0, 0.533_333_333_333_333_3),
    (1.355_626_179_974_266, 0.222_075_922_005_612_65),
    (2.856_970_013_872_806, 0.011_257_411_327_720_69),
];

/// Prior of an unknown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expectation {
    /// Unit of the value on its [`Scale`].
    pub unit: f64,
    /// Its prior there.
    pub normal: Normal,
    /// Heaviness of its tails, t: they are those of sinh(tw) / t, which is w near 0; 0 for a normal number.
    ///
    /// # Source
    /// M. C. Jones, A. Pewsey, "Sinh-arcsinh distributions", *Biometrika* 96 (2009), p. 761.
    pub tail: f64,
}

impl Expectation {
    /// The same with tails of this heaviness.
    #[must_use]
    pub fn with_tail(self, tail: f64) -> Self {
        Self { tail, ..self }
    }

    /// The number on the scale at the standard normal number `w`, with its first and second derivative.
    ///
    /// # Example
    /// ```
    /// use vfold::estimate::unknowns::{Expectation, Normal};
    /// let angle = Expectation::from(Normal { mean: 45.0, sd: 1.2 }).with_tail(0.5);
    /// assert!((angle.number(1.0)[0] - 46.25).abs() < 0.01);
    /// assert!(angle.number(3.0)[0] > 50.0);
    /// ```
    #[must_use]
    pub fn number(&self, w: f64) -> [f64; 3] {
        let (Normal { mean, sd }, t) = (self.normal, self.tail);
        if t > 0.0 {
            let (sinh, cosh) = ((t * w).sinh(), (t * w).cosh());
            [mean + sd * sinh / t, sd * cosh, sd * t * sinh]
        } else {
            [mean + sd * w, sd, 0.0]
        }
    }

    /// Value at `w`, a standard normal number, and its derivative.
    #[must_use]
    pub fn value(&self, scale: Scale, w: f64) -> (f64, f64) {
        let [number, by_w, _] = self.number(w);
        let (value, slope) = scale.value(number);
        (self.unit * value, self.unit * slope * by_w)
    }

    /// Root mean square deviation from the value at `w` if `w` is uncertain by `sd`.
    ///
    /// # Example
    /// ```
    /// use vfold::estimate::unknowns::{Expectation, Normal, Scale};
    /// let one = Expectation::from(Normal { mean: 0.0, sd: 2.0 });
    /// assert!((one.spread(Scale::Linear, 0.3, 0.5) - 1.0).abs() < 1e-12);
    /// let (_, slope) = one.value(Scale::Positive, 0.0);
    /// assert!(one.spread(Scale::Positive, 0.0, 1.0) > 1.1 * slope); // it is bent
    /// ```
    #[must_use]
    pub fn spread(&self, scale: Scale, w: f64, sd: f64) -> f64 {
        let value = |node: f64| self.value(scale, w + sd * node).0;
        let square = |(node, weight): (f64, f64)| weight * (value(node) - value(0.0)).powi(2);
        GAUSS_HERMITE.into_iter().map(square).sum::<f64>().sqrt()
    }

    /// The standard normal number for a value.
    #[must_use]
    pub fn normal_of(&self, scale: Scale, value: f64) -> f64 {
        let x = (scale.normal(value / self.unit) - self.normal.mean) / self.normal.sd;
        if self.tail > 0.0 { (self.tail * x).asinh() / self.tail } else { x }
    }
}

impl From<Normal> for Expectation {
    /// In the unit of the unknown itself.
    fn from(normal: Normal) -> Self {
        Self { unit: 1.0, normal, tail: 0.0 }
    }
}

/// A monotone map between the value of an unknown and a normally distributed number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scale {
    /// The value itself.
    Linear,
    /// A million over the value: the eye sees differences in colour temperature (K) as differences in their
    /// reciprocals (1e-6/K).
    Reciprocal,
    /// The logarithm, for factors.
    Logarithm,
    /// The value is `ln(1 + eˣ)`: never negative, almost 0 for negative x and proportional to positive x.
    Positive,
}

impl Scale {
    /// The value at the normal number `x`, and its derivative.
    #[must_use]
    pub fn value(self, x: f64) -> (f64, f64) {
        match self {
            Self::Linear => (x, 1.0),
            Self::Reciprocal => (1e6 / x, -1e6 / (x * x)),
            Self::Logarithm => (x.exp(), x.exp()),
            Self::Positive => {
                let value = if x > 30.0 { x } else { x.exp().ln_1p() };
                (value, (1.0 + (-x).exp()).recip())
            }
        }
    }

    /// The normal number at `value`.
    #[must_use]
    pub fn normal(self, value: f64) -> f64 {
        match self {
            Self::Linear => value,
            Self::Reciprocal => 1e6 / value,
            Self::Logarithm => value.ln(),
            Self::Positive => value.exp_m1().ln(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_and_their_inverses_agree() {
        for scale in [Scale::Linear, Scale::Reciprocal, Scale::Logarithm, Scale::Positive] {
            for x in [3.0, 5.0, 7.0] {
                let (value, slope) = scale.value(x);
                assert!((scale.normal(value) - x).abs() < 1e-12 * x);
                let rise = scale.value(x + 1e-4).0 - scale.value(x - 1e-4).0;
                assert!((slope - rise / 2e-4).abs() < 1e-6 * slope.abs());
            }
        }
    }
}
