//! Passing records through a tool that takes some samples together.

use std::collections::HashMap;
use std::sync::Arc;

use rayon::prelude::*;

use super::pipe::{Made, Transform, transformed};
use super::{Reader, Record, Sample};
use crate::error::Result;

/// A sample with what it needs of the scene above it.
pub struct Member<C> {
    /// Of the scene.
    pub context: Arc<C>,
    /// The sample.
    pub sample: Sample,
}

/// A tool that can take samples together.
pub trait Together: Transform {
    /// Takes two samples or more that belong together, and adds to each; what is made beside them, one for each.
    ///
    /// # Errors
    /// Any: all of them go out with it in their `error` field, and the run goes on.
    fn samples(&self, members: &mut [Member<Self::Context>]) -> Result<Vec<Self::Aside>>;
}

/// Where a record stands once it is read.
enum Place {
    Record(Record),
    /// Which group, and which of its members.
    Member(usize, usize),
}

/// Passes all records of `reader` through `transform`, samples of one `group` together, wherever they stand in the stream: all are read
/// before the first is written. A sample of no group, and one that is alone in its own, passes as through [`super::pipe`].
///
/// # Errors
/// From the stream itself, from a scene or from `group`; samples carry their own.
pub fn pipe_together<T: Together + Sync>(
    reader: &mut Reader,
    transform: &T,
    group: impl Fn(&Sample) -> Result<Option<String>>,
    mut done: impl FnMut(Record, Option<T::Aside>) -> Result<()>,
) -> Result<()> {
    let (mut places, mut groups, mut known) =
        (Vec::new(), Vec::<Vec<Member<T::Context>>>::new(), HashMap::new());
    let mut context = None;
    while let Some(record) = reader.read()? {
        match record {
            Record::Scene(mut scene) => {
                context = Some(Arc::new(transform.scene(&mut scene).map_err(|e| reader.at(e))?));
                places.push(Place::Record(Record::Scene(scene)));
            }
            Record::Sample(sample) => {
                let Some(context) = &context else { return Err(reader.no_scene()) };
                let name = group(&sample).map_err(|e| reader.at(e))?;
                let is_whole = matches!(sample.error(), Ok(None));
                let at = match name.filter(|_| is_whole) {
                    Some(name) => *known.entry(name).or_insert(groups.len()),
                    None => groups.len(),
                };
                if at == groups.len() {
                    groups.push(Vec::new());
                }
                places.push(Place::Member(at, groups[at].len()));
                groups[at].push(Member { context: Arc::clone(context), sample });
            }
            other => places.push(Place::Record(other)),
        }
    }
    let made: Result<Vec<Vec<Made<T::Aside>>>> =
        groups.into_par_iter().map(|members| of_group(transform, members)).collect();
    let mut made: Vec<Vec<Option<Made<T::Aside>>>> =
        made?.into_iter().map(|group| group.into_iter().map(Some).collect()).collect();
    for place in places {
        match place {
            Place::Record(record) => done(record, None)?,
            Place::Member(group, member) => {
                if let Some((record, aside)) = made[group][member].take() {
                    done(record, aside)?;
                }
            }
        }
    }
    Ok(())
}

fn of_group<T: Together>(transform: &T, mut members: Vec<Member<T::Context>>) -> Result<Vec<Made<T::Aside>>> {
    if members.len() == 1 {
        let alone = members.into_iter().map(|one| transformed(transform, &*one.context, one.sample));
        return alone.collect();
    }
    match transform.samples(&mut members) {
        Ok(asides) => {
            let made = members.into_iter().zip(asides);
            Ok(made.map(|(one, aside)| (Record::Sample(one.sample), Some(aside))).collect())
        }
        Err(error) => {
            let failed = |mut one: Member<T::Context>| {
                one.sample.set_error(&error)?;
                Ok((Record::Sample(one.sample), None))
            };
            members.into_iter().map(failed).collect()
        }
    }
}
