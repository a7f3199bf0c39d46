//! Passes records through a tool that processes some samples jointly.

use std::collections::HashMap;
use std::sync::Arc;

use super::pipe::{AHEAD, Made, Transform, context_of, transformed};
use super::{Kept, Reader, Record, Sample, Scenes};
use crate::error::Result;
use crate::parallel::{Item, in_order};

/// A sample with the context of its scene.
pub struct Member<C> {
    /// From the scene.
    pub context: Arc<C>,
    /// The sample.
    pub sample: Sample,
}

/// A tool that can process samples jointly.
pub trait Together: Transform {
    /// Receives two or more samples that belong together, and adds to each; returns one additional result for
    /// each.
    ///
    /// # Errors
    /// Any: all of them are written with it in their `error` field, and the run continues.
    fn samples(&self, members: &mut [Member<Self::Context>]) -> Result<Vec<Self::Aside>>;

    /// Whether samples, each of which is [made](Transform::is_made), were processed jointly by an interrupted
    /// run, without any others.
    fn are_made(&self, together: &[Sample]) -> bool;
}

/// Samples that belong together, each with an interrupted run's result.
struct Group<C> {
    members: Vec<Member<C>>,
    kept: Vec<Option<Sample>>,
}

/// The position of a record in the stream.
enum Place {
    Record(Record),
    /// The next member of this group.
    Member(usize),
}

/// All records in order, and the groups in the order of their first members.
struct Stream<C> {
    places: Vec<Place>,
    groups: Vec<Group<C>>,
}

/// A group's results, or the input for them.
type Task<T> = Item<Vec<Member<<T as Transform>::Context>>, Result<Vec<Made<<T as Transform>::Aside>>>>;

/// Passes all records of `reader` through `transform`, samples of one `group` jointly, wherever they are in
/// the stream: all are read before the first is written, and each is written as soon as it and its
/// predecessors are ready. A sample without a group, or alone in one, passes as through [`super::pipe`].
/// Groups in `kept` are not recomputed.
///
/// # Errors
/// From the stream, from a scene or from `group`; samples carry their own.
pub fn pipe_together<T: Together + Sync>(
    reader: &mut Reader,
    transform: &T,
    kept: Kept,
    group: impl Fn(&Sample) -> Result<Option<String>>,
    mut done: impl FnMut(Record, Option<T::Aside>) -> Result<()>,
) -> Result<()> {
    let Stream { places, groups } = read(reader, transform, kept, group)?;
    let (mut places, mut made) = (places.into_iter().peekable(), Vec::new());
    let tasks = groups.into_iter().map(|group| task(transform, group));
    let mut advance = |made: &mut Vec<std::vec::IntoIter<Made<T::Aside>>>| {
        let there = made.len();
        let is_there = |place: &Place| !matches!(place, Place::Member(group) if *group >= there);
        while let Some(place) = places.next_if(is_there) {
            let (record, aside) = match place {
                Place::Record(record) => (record, None),
                Place::Member(group) => match made[group].next() {
                    Some(made) => made,
                    None => continue,
                },
            };
            done(record, aside)?;
        }
        Ok(())
    };
    in_order(
        tasks,
        AHEAD * rayon::current_num_threads(),
        |members| of_group(transform, members),
        |group| {
            made.push(group?.into_iter());
            advance(&mut made)
        },
    )?;
    advance(&mut made)
}

fn read<T: Together>(
    reader: &mut Reader,
    transform: &T,
    mut kept: Kept,
    group: impl Fn(&Sample) -> Result<Option<String>>,
) -> Result<Stream<T::Context>> {
    let (mut places, mut groups, mut known) = (Vec::new(), Vec::<Group<T::Context>>::new(), HashMap::new());
    let mut contexts = Scenes::default();
    while let Some(record) = reader.read()? {
        let mut sample = match record {
            Record::Sample(sample) => sample,
            Record::Scene(mut scene) => {
                kept.pass()?;
                let context = transform.scene(&mut scene).map_err(|e| reader.at(e))?;
                contexts.enter(&scene, Arc::new(context));
                places.push(Place::Record(Record::Scene(scene)));
                continue;
            }
            other => {
                kept.pass()?;
                places.push(Place::Record(other));
                continue;
            }
        };
        let context = context_of(reader, &mut contexts, &mut sample)?;
        let name = group(&sample).map_err(|e| reader.at(e));
        let kept = kept.sample(|kept| transform.is_made(&sample, kept))?;
        let Some(context) = context else {
            places.push(Place::Record(Record::Sample(sample)));
            continue;
        };
        let at = name?.map_or(groups.len(), |name| *known.entry(name).or_insert(groups.len()));
        if at == groups.len() {
            groups.push(Group { members: Vec::new(), kept: Vec::new() });
        }
        places.push(Place::Member(at));
        groups[at].kept.push(kept);
        groups[at].members.push(Member { context, sample });
    }
    Ok(Stream { places, groups })
}

fn task<T: Together>(transform: &T, Group { members, kept }: Group<T::Context>) -> Task<T> {
    match kept.into_iter().collect::<Option<Vec<Sample>>>() {
        Some(kept) if transform.are_made(&kept) => {
            Item::Known(Ok(kept.into_iter().map(|sample| (Record::Sample(sample), None)).collect()))
        }
        _ => Item::ToDo(members),
    }
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
