//! Many photographs at once.

use std::path::{Path, PathBuf};

use vfold::image::Photograph;
use vfold::parallel::in_order;
use vfold::stream::{Kept, Sample};
use vfold::{Error, Result};

use super::pictures::name;
use super::sample::Setup;

/// A photograph on its way.
enum Step<'a> {
    Measured(Sample),
    Opened(&'a Path, Result<Photograph>),
    ToOpen(&'a Path),
}

/// Measures photographs, of which the first is open already, and hands on their samples in order, each as soon as it is there.
/// Those that `kept` has are not measured again. No more of them are in memory than there are threads.
pub fn measure(
    setup: &Setup,
    images: &[PathBuf],
    first: Result<Photograph>,
    mut kept: Kept,
    mut done: impl FnMut(Sample) -> Result<()>,
) -> Result<()> {
    kept.pass()?;
    let mut first = Some(first);
    let steps = images.iter().map(|path| {
        let opened = first.take();
        let is_its = |sample: &Sample| sample.id().is_ok_and(|id| id == name(path));
        Ok(match (kept.sample(is_its)?, opened) {
            (Some(sample), _) => Step::Measured(sample),
            (None, Some(opened)) => Step::Opened(path, opened),
            (None, None) => Step::ToOpen(path),
        })
    });
    let measure = |step: Result<Step>| match step? {
        Step::Measured(sample) => Ok::<_, Error>(sample),
        Step::Opened(path, opened) => setup.sample_or_error(path, opened),
        Step::ToOpen(path) => setup.sample_or_error(path, Photograph::open(path, &setup.options)),
    };
    in_order(steps, rayon::current_num_threads(), measure, |sample| done(sample?))
}
