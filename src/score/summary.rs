//! Mean, median and worst of the scores of many samples.

use super::Worse;

/// A score of one sample.
#[derive(Clone, Debug, PartialEq)]
pub struct Score {
    /// Its name in records: `rmse`, `ciede2000`, ...
    pub name: String,
    /// Its value.
    pub value: f64,
}

impl Score {
    /// A score.
    #[must_use]
    pub fn new(name: impl Into<String>, value: f64) -> Self {
        Self { name: name.into(), value }
    }

    /// Its badness: the value, or its negative if smaller values are worse.
    #[must_use]
    pub fn badness(&self) -> f64 {
        match Worse::of_score(&self.name) {
            Worse::Larger => self.value,
            Worse::Smaller => -self.value,
        }
    }
}

/// Mean, median and worst of a score.
#[derive(Clone, Debug, PartialEq)]
pub struct Statistics {
    /// Name of the score.
    pub name: String,
    /// Mean.
    pub mean: f64,
    /// Median.
    pub median: f64,
    /// The largest, or the smallest if smaller values are worse.
    pub worst: f64,
}

/// The scores of a batch: 8 bytes per score, so that the median is exact.
///
/// # Example
/// ```
/// use vfold::score::{Score, Summary};
/// let mut summary = Summary::default();
/// [0.1, 0.2, 0.6].iter().for_each(|rmse| summary.add(Some(&[Score::new("rmse", *rmse)])));
/// summary.add(None);
/// let [rmse] = &summary.statistics()[..] else { panic!() };
/// assert_eq!((summary.samples(), summary.scored(), rmse.median, rmse.worst), (4, 3, 0.2, 0.6));
/// ```
#[derive(Clone, Debug, Default)]
pub struct Summary {
    samples: usize,
    scored: usize,
    scores: Vec<(String, Vec<f64>)>,
}

/// Samples that share the value of a field.
#[derive(Clone, Debug, Default)]
pub struct Group {
    /// The value.
    pub value: String,
    /// Their scores.
    pub summary: Summary,
}

impl Summary {
    /// Counts a sample, and adds its scores if any.
    pub fn add(&mut self, scores: Option<&[Score]>) {
        self.samples += 1;
        self.scored += usize::from(scores.is_some());
        for Score { name, value } in scores.unwrap_or_default() {
            match self.scores.iter_mut().find(|(known, _)| known == name) {
                Some((_, values)) => values.push(*value),
                None => self.scores.push((name.clone(), vec![*value])),
            }
        }
    }

    /// Samples counted.
    #[must_use]
    pub fn samples(&self) -> usize {
        self.samples
    }

    /// Samples with scores.
    #[must_use]
    pub fn scored(&self) -> usize {
        self.scored
    }

    /// All values of each score, in order of appearance.
    pub fn values(&self) -> impl Iterator<Item = &[f64]> {
        self.scores.iter().map(|(_, values)| values.as_slice())
    }

    /// Mean, median and worst of each score, in order of appearance.
    #[must_use]
    pub fn statistics(&self) -> Vec<Statistics> {
        self.scores.iter().map(|(name, values)| statistics(name, values)).collect()
    }
}

fn statistics(name: &str, values: &[f64]) -> Statistics {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let last = sorted.len() - 1;
    let worst = match Worse::of_score(name) {
        Worse::Larger => last,
        Worse::Smaller => 0,
    };
    Statistics {
        name: name.to_owned(),
        mean: sorted.iter().sum::<f64>() / sorted.len() as f64,
        median: 0.5 * (sorted[last / 2] + sorted[sorted.len() / 2]),
        worst: sorted[worst],
    }
}
