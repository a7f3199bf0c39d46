//! Passing records through a tool: samples on all threads, their order kept.

use std::iter;
use std::sync::Arc;

use super::scenes::PLACE_BYTES;
use super::{Kept, Reader, Record, Sample, Scene, Scenes};
use crate::error::Result;
use crate::parallel::{Item, in_order};

/// Samples a thread that are read ahead: enough to keep it busy while one takes long, few enough to keep
/// memory flat.
pub(super) const AHEAD: usize = 16;

/// What a tool does to the records that pass through it.
pub trait Transform {
    /// What samples need of their scene.
    type Context: Send + Sync;
    /// What is made of a sample beside its record.
    type Aside: Send;

    /// Takes a scene, adds to it, and prepares its samples.
    ///
    /// # Errors
    /// Any: a scene that cannot be used ends the run.
    fn scene(&self, scene: &mut Scene) -> Result<Self::Context>;

    /// Takes a sample and adds to it; what is made beside it goes to `done` of [`pipe`].
    ///
    /// # Errors
    /// Any: the sample goes out with an `error` field and the run goes on.
    fn sample(&self, context: &Self::Context, sample: &mut Sample) -> Result<Self::Aside>;

    /// Whether `kept` is what an interrupted run made of `sample`: it need not be made again.
    fn is_made(&self, _sample: &Sample, _kept: &Sample) -> bool {
        false
    }
}

/// A record as it goes out, with what was made beside it.
pub(super) type Made<A> = (Record, Option<A>);

/// A record that is as it should be, or a sample with the context of its scene.
type Step<T> = Item<(Arc<<T as Transform>::Context>, Sample), Result<Made<<T as Transform>::Aside>>>;

/// Passes all records of `reader` through `transform`, samples in parallel; `done` takes them in their order,
/// each as soon as it is made. Samples that `kept` has are not made again.
///
/// # Errors
/// From the stream itself or from a scene; samples carry their own.
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

/// Reads a record, and does to it all that is not done in parallel.
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

/// What a sample needs of its scene; none of one that has an `error`, as one gets whose scene is not there.
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

/// The sample as the tool leaves it.
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
