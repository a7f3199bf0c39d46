//! The panels of a scene: what photographs are measured by.

use std::collections::BTreeMap;

use super::Scene;
use crate::error::Result;
use crate::geometry::Panel;

impl Scene {
    /// The scene's panels by their numbers.
    ///
    /// # Errors
    /// [`Error::Field`](crate::Error::Field) if the geometry is missing or none that this version knows.
    pub fn panels(&self) -> Result<BTreeMap<usize, Panel>> {
        Ok(self.fold()?.panels().into_iter().enumerate().collect())
    }

    /// How many facets the scene has, those in no panel included.
    ///
    /// # Errors
    /// As [`Scene::panels`].
    pub fn facet_count(&self) -> Result<usize> {
        Ok(2 * self.fold()?.facets().len())
    }
}
