//! Dependence of a source's amount on one unknown.

/// Dependence of a source's amount on one unknown, on its scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Factor {
    /// Independent of it.
    One,
    /// Cosine of an angle in degrees.
    Cosine,
    /// Sine of an angle in degrees.
    Sine,
    /// The number itself.
    Amount,
    /// The quadratic polynomial that is 1 at `nodes[at]` and 0 at the others.
    Node {
        /// Values at which sources are known.
        nodes: [f64; 3],
        /// Index of this node.
        at: usize,
    },
}

/// A value with its first and second derivative.
pub(super) type Jet = [f64; 3];

impl Factor {
    /// Value and derivatives at `x`.
    pub(super) fn at(self, x: f64) -> Jet {
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

    /// Three nodes represent any quadratic polynomial.
    #[test]
    fn nodes_interpolate() {
        let nodes = [50.0, 100.0, 160.0];
        let of = |x: f64| 3.0 - 0.2 * x + 0.01 * x * x;
        let parts = [0, 1, 2].map(|at| of(nodes[at]) * Factor::Node { nodes, at }.at(120.0)[0]);
        assert!((parts.iter().sum::<f64>() - of(120.0)).abs() < 1e-9);
    }
}
