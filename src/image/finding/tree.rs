//! A decision tree over the clues to whether the corners of a fold are right.

use super::features::FEATURES;

/// Number of clues to whether all corners of a candidate are right.
pub(super) const CLUES: usize = 12 + FEATURES;

/// Three successive questions lead to one of eight answers.
pub(super) struct Tree {
    /// The clue of each question and its threshold: the first question, the two after it, and the four after
    /// those.
    pub questions: [(u8, f64); 7],
    pub answers: [f64; 8],
}

impl Tree {
    pub(super) fn answer(&self, clues: &[f64; CLUES]) -> f64 {
        let next = |at: usize, _: usize| {
            let (clue, bound) = self.questions[at];
            2 * at + if clues[usize::from(clue)] <= bound { 1 } else { 2 }
        };
        self.answers[(0..3).fold(0, next) - self.questions.len()]
    }
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
