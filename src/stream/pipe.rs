//! Passes records through a tool: samples in parallel, their order kept.

use std::iter;
use std::sync::Arc;

use super::scenes::PLACE_BYTES;
use super::{Kept, Reader, Record, Sample, Scene, Scenes};
use crate::error::Result;
use crate::parallel::{Item, in_order};

/// Samples per thread read ahead: enough to keep it busy while one takes long, few enough to limit memory.
pub(super) const AHEAD: usize = 16;

/// The effect of a tool on the records that pass through it.
pub trait Transform {
    /// Context that samples need from their scene.
    type Context: Send + Sync;
    /// Result for a sample in addition to its record.
    type Aside: Send;

    /// Receives a scene, adds to it, and prepares for its samples.
    ///
    /// # Errors
    /// Any: an unusable scene ends the run.
    fn scene(&self, scene: &mut Scene) -> Result<Self::Context>;

    /// Receives a sample and adds to it; the additional result goes to `done` of [`pipe`].
    ///
    /// # Errors
    /// Any: the sample is written with an `error` field and the run continues.
    fn sample(&self, context: &Self::Context, sample: &mut Sample) -> Result<Self::Aside>;

    /// Whether `kept` is an interrupted run's result for `sample`, so that it need not be recomputed.
    fn is_made(&self, _sample: &Sample, _kept: &Sample) -> bool {
        false
    }
}

/// A record to be written, with its additional result.
pub(super) type Made<A> = (Record, Option<A>);

/// A finished record, or a sample with the context of its scene.
type Step<T> = Item<(Arc<<T as Transform>::Context>, Sample), Result<Made<<T as Transform>::Aside>>>;

/// Passes all records of `reader` through `transform`, samples in parallel; `done` receives them in order,
/// each as soon as it is ready. Samples in `kept` are not recomputed.
///
/// # Errors
/// From the stream or from a scene; samples carry their own.
pub fn pipe<T: Transform + Sync>(
    reader: &mut Reader,
    transform: &T,
    mut kept: Kept,
    mut done: impl FnMut(Record, Option<T::Aside>) -> Result<()>,
) -> Result<()> {
    let mut contexts = Scenes::default();
    let steps = iter::from_fn(|| {
        let step = step(reader, transform, &mut kept, &mut contexts);
        let step = step.unwrap_or_else(|error| Some(Item::Known(Err(error))))?;
        let further = iter::repeat_with(|| Item::Place).take(reader.line_bytes() / PLACE_BYTES);
        Some(iter::once(step).chain(further))
    });
    let finish = |(context, sample): (Arc<_>, _)| transformed(transform, &*context, sample);
    in_order(steps.flatten(), AHEAD * rayon::current_num_threads(), finish, |made| {
        let (record, aside) = made?;
        done(record, aside)
    })
}

/// Reads a record, and does all work on it that is not parallel.
fn step<T: Transform>(
    reader: &mut Reader,
    transform: &T,
    kept: &mut Kept,
    contexts: &mut Scenes<Arc<T::Context>>,
) -> Result<Option<Step<T>>> {
    let Some(record) = reader.read()? else { return Ok(None) };
    if let Record::Sample(mut sample) = record {
        let context = context_of(reader, contexts, &mut sample)?;
        let kept = kept.sample(|kept| transform.is_made(&sample, kept))?;
        return Ok(Some(match (context, kept) {
            (None, _) => Item::Known(Ok((Record::Sample(sample), None))),
            (Some(_), Some(kept)) => Item::Known(Ok((Record::Sample(kept), None))),
            (Some(context), None) => Item::ToDo((context, sample)),
        }));
    }
    kept.pass()?;
    if let Record::Scene(mut scene) = record {
        let context = transform.scene(&mut scene).map_err(|e| reader.at(e))?;
        contexts.enter(&scene, Arc::new(context));
        return Ok(Some(Item::Known(Ok((Record::Scene(scene), None)))));
    }
    Ok(Some(Item::Known(Ok((record, None)))))
}

/// The context of a sample's scene; none for a sample with an `error`, which it also gets if its scene is
/// missing.
pub(super) fn context_of<C>(
    reader: &Reader,
    contexts: &mut Scenes<Arc<C>>,
    sample: &mut Sample,
) -> Result<Option<Arc<C>>> {
    let context = contexts.of(sample).map(|context| context.map(Arc::clone));
    let context = match sample.error() {
        Ok(Some(_)) => return Ok(None),
        Ok(None) => context,
        Err(error) => Err(error),
    };
    match context {
        Ok(Some(context)) => Ok(Some(context)),
        Ok(None) => Err(reader.no_scene()),
        Err(error) => sample.set_error(&error).map(|()| None),
    }
}

/// The sample after the tool.
pub(super) fn transformed<T: Transform>(
    transform: &T,
    context: &T::Context,
    mut sample: Sample,
) -> Result<Made<T::Aside>> {
    let aside = match transform.sample(context, &mut sample) {
        Ok(aside) => Some(aside),
        Err(error) => {
            sample.set_error(&error)?;
            None
        }
    };
    Ok((Record::Sample(sample), aside))
}
