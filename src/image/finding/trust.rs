//! How likely it is that all corners of a fold are right.
//!
//! Boosted trees (J. Friedman, *Greedy function approximation: a gradient boosting machine*, 2001) over what the search and the
//! refinement say; `benches/find_fit.py` makes them and the weights beside them, of photographs and composites whose corners are known.

use super::candidates::CLUES;
use super::weights::{BASE, OFFSET, SLOPE, TREES};

/// Three questions in turn, which lead to one of eight answers.
pub(super) struct Tree {
    /// Which clue is compared, and with what: the first question, the two after it, and the four after those.
    pub questions: [(u8, f64); 7],
    pub answers: [f64; 8],
}

impl Tree {
    fn answer(&self, clues: &[f64; CLUES]) -> f64 {
        let next = |at: usize, _: usize| {
            let (clue, bound) = self.questions[at];
            2 * at + if clues[usize::from(clue)] <= bound { 1 } else { 2 }
        };
        self.answers[(0..3).fold(0, next) - self.questions.len()]
    }
}

/// The probability that all six corners are within 3 % of a panel's side of where they should be.
pub(super) fn confidence(clues: &[f64; CLUES]) -> f64 {
    let sum: f64 = TREES.iter().map(|tree| tree.answer(clues)).sum();
    1.0 / (1.0 + (-SLOPE * (BASE + sum) - OFFSET).exp())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn questions_lead_to_their_answer() {
        let tree = Tree {
            questions: [(0, 0.5), (1, 0.5), (1, 0.5), (2, 0.5), (2, 0.5), (2, 0.5), (2, 0.5)],
            answers: [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0],
        };
        for number in 0..8_u8 {
            let mut clues = [0.0; CLUES];
            (0..3).for_each(|bit| clues[bit] = f64::from(number >> (2 - bit) & 1));
            assert!((tree.answer(&clues) - f64::from(number)).abs() < 1e-12, "{number}");
        }
    }
}
