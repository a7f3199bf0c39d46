//! Probability that all corners of a fold are right.
//!
//! Boosted trees (J. Friedman, *Greedy function approximation: a gradient boosting machine*, 2001) over the
//! results of search and refinement; `benches/find_fit.py` fits them, and the other weights, to photographs
//! and composites with known corners.

use super::tree::CLUES;
use super::weights::{BASE, OFFSET, SLOPE, TREES};

/// The probability that all six corners are within 3 % of a panel's side of their true positions.
pub(super) fn confidence(clues: &[f64; CLUES]) -> f64 {
    let sum: f64 = TREES.iter().map(|tree| tree.answer(clues)).sum();
    1.0 / (1.0 + (-SLOPE * (BASE + sum) - OFFSET).exp())
}
