//! The odds of a picture's hypotheses against "no fold".

use super::features::FEATURES;
use super::weights::{NO_FOLD, RANK};

/// Log odds of a hypothesis against no fold.
pub(super) fn log_odds(features: &[f64; FEATURES]) -> f64 {
    features.iter().zip(&RANK).map(|(feature, weight)| feature * weight).sum::<f64>() - NO_FOLD
}

#[cfg(test)]
mod tests {
    use super::super::synthetic::{off, outline, views};
    use super::*;
    use crate::image::finding::features::features;
    use crate::image::finding::outline::Outline;

    #[test]
    fn the_fold_is_likelier_than_none_and_than_what_lies_beside_it() {
        let (_, evidence, light) = views();
        let odds = |fold: &Outline| log_odds(&features(fold, &evidence, &light));
        assert!(odds(&outline()) > 3.0, "{}", odds(&outline()));
        assert!(odds(&off(8.0)) < odds(&outline()) - 3.0, "{}", odds(&off(8.0)));
        assert!(odds(&off(25.0)) < 0.0, "{}", odds(&off(25.0)));
    }
}
