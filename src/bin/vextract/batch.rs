//! Measures many photographs.

use std::path::{Path, PathBuf};

use vfold::Result;
use vfold::files::composed;
use vfold::image::FileStamp;
use vfold::parallel::{Item, in_order};
use vfold::stream::{Kept, Output, Sample};

use super::pictures::name;
use super::reading::Opened;
use super::sample::Setup;

/// Discards the results of an interrupted run from the first replaced photograph on; returns that photograph.
///
/// # Errors
/// As [`Kept::sample`].
pub fn forget_replaced<'a>(images: &'a [PathBuf], out: &mut Output) -> Result<Option<&'a PathBuf>> {
    let mut kept = out.kept()?.all_known();
    kept.pass()?;
    for (n, path) in images.iter().enumerate() {
        let Some(measured) = kept.sample(is_of(path))?.map(|sample| sample.making()).transpose()? else {
            continue;
        };
        let there = path.metadata().ok().and_then(|metadata| FileStamp::of(&metadata));
        if measured.file.zip(there).is_some_and(|(measured, there)| measured != there) {
            out.keep(n + 1)?; // counting the scene
            return Ok(Some(path));
        }
    }
    Ok(None)
}

/// Whether a sample is named after a photograph.
fn is_of(path: &Path) -> impl Fn(&Sample) -> bool {
    let name = composed(&name(path));
    move |sample| composed(&sample.id()) == name
}

/// Measures photographs, the first of which is already open, and passes on their samples in order, each as
/// soon as it is ready. Those in `kept` are not measured again. At most one per thread is in memory.
pub fn measure(
    setup: &Setup,
    images: &[PathBuf],
    first: Result<Opened>,
    mut kept: Kept,
    mut done: impl FnMut(Sample) -> Result<()>,
) -> Result<()> {
    kept.pass()?;
    let mut first = Some(first);
    let steps = images.iter().map(|path| {
        let opened = first.take();
        match kept.sample(is_of(path)).transpose() {
            Some(sample) => Item::Known(sample),
            None => Item::ToDo((path, opened)),
        }
    });
    let measure = |(path, opened): (&PathBuf, Option<_>)| {
        setup.sample_or_error(path, opened.unwrap_or_else(|| setup.reading.open_to_measure(path)))
    };
    in_order(steps, rayon::current_num_threads(), measure, |sample| done(sample?))
}
