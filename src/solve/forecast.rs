//! Predicts the gain of a further search from the model linearised about a point, without searching.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::dense::{cholesky, dot_products};
use super::ln_sum;
use super::posterior::{GaussNewton, Model, Solution, cost};

/// At a mode, predicts how much more probable the data become if the model has one more degree of freedom.
///
/// # Source
/// The score test: C. R. Rao, *Mathematical Proceedings of the Cambridge Philosophical Society* 44 (1948), p.
/// 50.
pub struct ScoreTest<'a> {
    weight: f64,
    residuals: &'a DVector<f64>,
    jacobian: &'a DMatrix<f64>,
    information: Cholesky<f64, Dyn>,
}

impl<'a> ScoreTest<'a> {
    /// At a solution, with the noise scaled by `tempering`; `None` if the model is not finite.
    #[must_use]
    pub fn at<S>(solution: &'a Solution<S>, tempering: f64) -> Option<Self> {
        let (weight, at) = (tempering.powi(-2), &solution.at);
        let information = cholesky(at.gauss_newton(weight))?;
        Some(Self { weight, residuals: &at.residuals, jacobian: &at.jacobian, information })
    }

    /// Logarithm of the factor by which the mode becomes more probable if the model may also move along
    /// `change`, by at least `least` times it: the data may oppose that.
    #[must_use]
    pub fn ln_gain_by(&self, least: f64, change: &DVector<f64>) -> f64 {
        let (slope, bend) = (self.slope(change), self.bend(change));
        let times = if bend > 0.0 { (slope / bend).max(least) } else { least };
        times * (slope - 0.5 * times * bend)
    }

    /// Logarithm of the factor by which the data become more probable if the model makes one of these
    /// `changes`, given with their probabilities, and its unknowns adapt.
    #[must_use]
    pub fn ln_gain_among(&self, changes: &[(f64, DVector<f64>)]) -> f64 {
        let ln_weight = |(probability, change): &(f64, DVector<f64>)| {
            probability.ln() + self.slope(change) - 0.5 * self.bend(change)
        };
        ln_sum(&changes.iter().map(ln_weight).collect::<Vec<_>>())
    }

    fn slope(&self, change: &DVector<f64>) -> f64 {
        self.weight * change.dot(self.residuals)
    }

    fn bend(&self, change: &DVector<f64>) -> f64 {
        let by_unknowns = self.weight * dot_products(self.jacobian, change);
        self.weight * change.norm_squared() - by_unknowns.dot(&self.information.solve(&by_unknowns))
    }
}

/// Twice the minimum of the objective, predicted from the model linearised about `w`; `None` if the model is
/// not finite.
pub fn foreseen_cost(model: &impl Model, w: &DVector<f64>, tempering: f64) -> Option<f64> {
    let (at, weight) = (model.linearise(w), tempering.powi(-2));
    let step = GaussNewton::at(w, &at, weight)?;
    Some(cost(weight, w, &at.residuals) - step.decrement.powi(2))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::posterior::{Evaluated, Linearised, find_mode};

    /// A straight line through the origin.
    struct Line;

    impl Model for Line {
        type Second = ();
        type Ingredients = ();

        fn unknowns(&self) -> usize {
            1
        }

        fn evaluate(&self, w: &DVector<f64>) -> Evaluated<()> {
            let residuals = DVector::from_vec(vec![3.0 - 2.0 * w[0], 1.0 - w[0]]);
            Evaluated { residuals, ingredients: () }
        }

        fn derivatives(&self, _: &DVector<f64>, at: Evaluated<()>) -> Linearised<()> {
            let jacobian = DMatrix::from_column_slice(2, 1, &[2.0, 1.0]);
            Linearised::new(at.residuals, jacobian, ())
        }
    }

    #[test]
    fn what_one_more_unknown_would_bring_is_known_before_it_is_fitted() {
        let found = find_mode(&Line, DVector::zeros(1), (1.0, 1.0), 1e-9, 100);
        let change = DVector::from_vec(vec![1.0, 0.0]);
        let test = ScoreTest::at(&found, 1.0).unwrap();
        let gain = test.ln_gain_by(0.0, &change);
        // with the first datum free only the second is left: ½(1 − w)² + ½w² is least at w = ½
        let before = 0.5 * found.cost(1.0);
        assert!((gain - (before - 0.25)).abs() < 1e-12, "{gain}");
        assert!(test.ln_gain_by(0.0, &-&change).abs() < f64::MIN_POSITIVE);
        assert!((test.ln_gain_by(0.1, &change) - gain).abs() < 1e-12);
        assert!(test.ln_gain_by(1.0, &-&change) < 0.0);
        // with the change, (2 − 2w, 1 − w) is left: ½(5(1 − w)² + w²) is least at w = 5/6
        let by_change = before - 5.0 / 12.0;
        let among = test.ln_gain_among(&[(0.25, change.clone()), (0.75, 0.0 * &change)]);
        assert!((among - (0.25 * by_change.exp() + 0.75).ln()).abs() < 1e-12, "{among}");
        let foreseen = foreseen_cost(&Line, &DVector::from_element(1, -5.0), 1.0).unwrap();
        assert!((foreseen - found.cost(1.0)).abs() < 1e-9, "{foreseen}");
        let moved =
            find_mode(&Line, DVector::from_element(1, -5.0), (1.0, 1.0), 1e-9, 0).foreseen(1.0).unwrap();
        assert!((&moved.w - &found.w).amax() < 1e-12);
        assert!((&moved.at.residuals - &found.at.residuals).amax() < 1e-12);
    }
}
