//! The selection shown of a stream of any length: the worst samples, and failures.

use std::sync::Arc;

use super::View;
use crate::error::Result;
use crate::plot::batch::Batch;
use crate::plot::sheet::Sheet;
use crate::scene::sheet;
use crate::score::{Score, Summary, Worst};
use crate::stream::{EstimateRecord, Sample, Scene, Scenes};

/// Most failures that are listed.
const FAILURES_MAX: usize = 24;
/// Most samples that are listed as the worst.
const WORST_MAX: usize = 10;

/// A sample with its scene.
#[derive(Clone, Debug)]
pub struct Shown {
    /// The scene.
    pub scene: Arc<Scene>,
    /// The sample.
    pub sample: Sample,
}

/// Samples to show: all if they are few, otherwise the worst by the first score. Only those shown are kept in
/// memory.
pub struct Gallery {
    samples: Worst<Shown>,
    scenes: Scenes<Arc<Scene>>,
    failures: Vec<(String, String)>,
    failed: usize,
}

impl Gallery {
    /// An empty gallery for up to `most` samples.
    #[must_use]
    pub fn new(most: usize) -> Self {
        Self { samples: Worst::new(most), scenes: Scenes::default(), failures: Vec::new(), failed: 0 }
    }

    /// Adds the scene of the samples that follow.
    pub fn enter(&mut self, scene: &Scene) {
        self.scenes.enter(scene, Arc::new(scene.clone()));
    }

    /// Adds a sample.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if its scores are invalid.
    pub fn add(&mut self, sample: &Sample) -> Result<()> {
        let scene = self.scenes.of(sample);
        if let Some(error) = sample.error()? {
            self.failed += 1;
            if self.failures.len() < FAILURES_MAX {
                self.failures.push((sample.id(), error));
            }
            return Ok(());
        }
        let Ok(Some(scene)) = scene else { return Ok(()) };
        let badness = first_score(sample)?.map_or(f64::NEG_INFINITY, |score| score.badness());
        self.samples.add(badness, || Shown { scene: Arc::clone(scene), sample: sample.clone() });
        Ok(())
    }

    /// Number of samples without errors.
    #[must_use]
    pub fn seen(&self) -> usize {
        self.samples.seen()
    }

    /// The samples shown, in their original order.
    pub fn in_order(&self) -> impl Iterator<Item = &Shown> {
        self.samples.in_order()
    }

    /// Names and errors of the first failures, and the number of all.
    pub(super) fn failures(&self) -> (&[(String, String)], usize) {
        (&self.failures, self.failed)
    }

    /// The drawings of the samples shown.
    ///
    /// # Errors
    /// As [`crate::scene::sheet`].
    pub fn sheets(&self, view: &View) -> Result<Vec<Sheet>> {
        let sheet = |shown: &Shown| {
            let estimate = shown.sample.estimate()?;
            estimate.map(|estimate| shown.sheet(&estimate, view)).transpose()
        };
        self.in_order().filter_map(|shown| sheet(shown).transpose()).collect()
    }

    /// The scores of all samples, and the worst ten by the first score.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if scores are invalid.
    pub fn batch(&self, summary: &Summary) -> Result<Batch> {
        let scores = summary.statistics().into_iter().zip(summary.values());
        let mut worst = Vec::new();
        for shown in self.samples.ranked().take(WORST_MAX) {
            worst.extend(first_score(&shown.sample)?.map(|score| (shown.sample.id(), score.value)));
        }
        Ok(Batch {
            samples: summary.samples(),
            scored: summary.scored(),
            scores: scores.map(|(score, values)| (score.name, score.mean, values.to_vec())).collect(),
            worst,
        })
    }
}

impl Shown {
    /// The drawing of its estimate.
    pub(super) fn sheet(&self, estimate: &EstimateRecord, view: &View) -> Result<Sheet> {
        sheet((&self.sample, estimate), &self.scene, view.illuminant, view.observer)
    }
}

/// The score by which samples are ranked.
fn first_score(sample: &Sample) -> Result<Option<Score>> {
    Ok(sample.scores()?.and_then(|scores| scores.into_iter().next()))
}
