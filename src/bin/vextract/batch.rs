//! Many photographs at once.

use std::path::PathBuf;

use rayon::prelude::*;
use vfold::Result;
use vfold::image::Photograph;
use vfold::stream::Sample;

use super::sample::Setup;

/// Measures photographs, of which the first is open already, and hands on their samples in order. No more of them are in memory
/// than there are threads.
pub fn measure(
    setup: &Setup,
    images: &[PathBuf],
    first: Result<Photograph>,
    mut done: impl FnMut(Sample) -> Result<()>,
) -> Result<()> {
    let mut first = Some(first);
    for images in images.chunks(rayon::current_num_threads()) {
        let opened: Vec<_> = images.iter().map(|path| (path, first.take())).collect();
        let measure = |(path, opened): (&PathBuf, Option<Result<Photograph>>)| {
            setup.sample_or_error(path, opened.unwrap_or_else(|| Photograph::open(path, &setup.options)))
        };
        let samples: Vec<Result<Sample>> = opened.into_par_iter().map(measure).collect();
        samples.into_iter().try_for_each(|sample| done(sample?))?;
    }
    Ok(())
}
