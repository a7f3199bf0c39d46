//! How likely it is that all corners of a fold are right.
//!
//! Boosted trees (J. Friedman, *Greedy function approximation: a gradient boosting machine*, 2001) over what
//! the search and the refinement say; `benches/find_fit.py` makes them and the weights beside them, of
//! photographs and composites whose corners are known.

use super::tree::CLUES;
use super::weights::{BASE, OFFSET, SLOPE, TREES};

/// The probability that all six corners are within 3 % of a panel's side of where they should be.
pub(super) fn confidence(clues: &[f64; CLUES]) -> f64 {
    let sum: f64 = TREES.iter().map(|tree| tree.answer(clues)).sum();
    1.0 / (1.0 + (-SLOPE * (BASE + sum) - OFFSET).exp())
}
