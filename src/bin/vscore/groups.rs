//! `--by FIELD`: groups of samples with equal values of a field.

use std::collections::HashMap;

use vfold::score::{Group, Summary};
use vfold::stream::{Sample, Scene, Scenes};
use vfold::{Error, Result};

/// Name of the group of samples without the field.
const NONE: &str = "(none)";

/// All samples, and those with each value of a field.
pub struct Groups<'a> {
    field: Option<&'a str>,
    /// The value of the field in each scene.
    scenes: Scenes<Option<String>>,
    all: Summary,
    /// By value, in order of appearance.
    groups: Vec<Group>,
    places: HashMap<String, usize>,
    found: bool,
}

impl<'a> Groups<'a> {
    pub fn new(field: Option<&'a str>) -> Self {
        let (scenes, all) = (Scenes::default(), Summary::default());
        Self { field, scenes, all, groups: Vec::new(), places: HashMap::new(), found: false }
    }

    /// Adds the scene of the samples that follow.
    ///
    /// # Errors
    /// [`Error::Field`] if its field is not a single value.
    pub fn enter(&mut self, scene: &Scene) -> Result<()> {
        if let Some(field) = self.field {
            self.scenes.enter(scene, scene.fields.text_at(field)?);
        }
        Ok(())
    }

    /// Counts a sample and its scores.
    pub fn add(&mut self, sample: &Sample) -> Result<()> {
        let scores = sample.scores()?;
        self.all.add(scores.as_deref());
        let Some(field) = self.field else { return Ok(()) };
        let scene = self.scenes.of(sample).ok().flatten();
        let value = match sample.fields.text_at(field)? {
            Some(value) => Some(value),
            None => scene.cloned().flatten(),
        };
        self.found |= value.is_some();
        let value = value.unwrap_or_else(|| NONE.to_owned());
        let place = *self.places.entry(value.clone()).or_insert(self.groups.len());
        if place == self.groups.len() {
            self.groups.push(Group { value, summary: Summary::default() });
        }
        self.groups[place].summary.add(scores.as_deref());
        Ok(())
    }

    /// All samples.
    pub fn all(&self) -> &Summary {
        &self.all
    }

    /// The field and its groups, if samples are grouped.
    ///
    /// # Errors
    /// [`Error::Field`] if neither a sample nor its scene has the field.
    pub fn found(&self) -> Result<Option<(&str, &[Group])>> {
        match self.field {
            Some(field) if !self.found => {
                Err(Error::field(field, "no sample or scene has it; --by needs a field of one of them"))
            }
            field => Ok(field.map(|field| (field, self.groups.as_slice()))),
        }
    }
}
