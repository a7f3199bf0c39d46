//! The panels of a surface.

use std::collections::BTreeMap;
use std::ops::Range;

use super::Shape;
use crate::geometry::{Panel, Vec3};

impl Shape {
    /// The groups of facets that form panels, by their numbers.
    #[must_use]
    pub fn panels(&self) -> BTreeMap<usize, Panel> {
        let panel = |facets: &Range<usize>| {
            let quads = facets.clone().map(|facet| <[Vec3; 4]>::try_from(self.facet(facet).corners()).ok());
            Panel::of_facets(&quads.collect::<Option<Vec<_>>>()?, facets.start)
        };
        let groups = self.groups().iter().enumerate();
        groups.filter_map(|(number, group)| Some((number, panel(&group.facets)?))).collect()
    }
}
