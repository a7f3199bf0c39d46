//! Many photographs at once.

use std::path::PathBuf;

use vfold::Result;
use vfold::image::Photograph;
use vfold::parallel::{Item, in_order};
use vfold::stream::{Kept, Sample};

use super::pictures::name;
use super::sample::Setup;

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
        let is_its = |sample: &Sample| sample.id() == name(path);
        match kept.sample(is_its).transpose() {
            Some(sample) => Item::Known(sample),
            None => Item::ToDo((path, opened)),
        }
    });
    let measure = |(path, opened): (&PathBuf, Option<_>)| {
        setup.sample_or_error(path, opened.unwrap_or_else(|| setup.reading.open(path)))
    };
    in_order(steps, rayon::current_num_threads(), measure, |sample| done(sample?))
}
