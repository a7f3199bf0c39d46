//! What is known of a number before a picture is looked at: normal on a scale.

/// Mean and standard deviation of a number on the [`Scale`] of its unknown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Normal {
    /// Mean.
    pub mean: f64,
    /// Standard deviation; zero for a number that is known after all.
    pub sd: f64,
}

impl Normal {
    /// The same number, of which something else, independent of what is known so far, says this.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        let [own, others] = [self, other].map(|one| one.sd.powi(-2));
        let information = own + others;
        Self { mean: (own * self.mean + others * other.mean) / information, sd: information.sqrt().recip() }
    }
}

/// What is known of an unknown of a photograph before that is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expectation {
    /// The unit in which the value is on its [`Scale`].
    pub unit: f64,
    /// What is known of it there.
    pub normal: Normal,
}

impl From<Normal> for Expectation {
    /// In the unit of the unknown itself.
    fn from(normal: Normal) -> Self {
        Self { unit: 1.0, normal }
    }
}

/// A monotone map between the value of an unknown and the number that is normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scale {
    /// The value itself.
    Linear,
    /// A million over the value: colour temperatures in K differ to the eye as their reciprocals in 1e-6/K
    /// do.
    Reciprocal,
    /// The logarithm: what is known of the value is a factor.
    Logarithm,
    /// `ln(1 + eˣ)` is the value: it is never negative, near to nothing below and proportional to x above.
    Positive,
}

impl Scale {
    /// The value where the normal number is `x`, and its derivative by it.
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

    /// The normal number where the value is `value`.
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
