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

/// Prior of an unknown of a photograph.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expectation {
    /// Unit of the value on its [`Scale`].
    pub unit: f64,
    /// Its prior there.
    pub normal: Normal,
}

impl From<Normal> for Expectation {
    /// In the unit of the unknown itself.
    fn from(normal: Normal) -> Self {
        Self { unit: 1.0, normal }
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
