//! The scene's facets: a grid on each panel of a fold, or a list for any other surface.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Scene;
use super::fields::BY_VKERNEL;
use crate::error::{Error, Result};
use crate::geometry::{FacetGrid, Fold, Spacing};
use crate::surfaces::Group;

/// The parts of the surface on each of which one colour is measured.
#[derive(Serialize, JsonSchema)]
#[serde(untagged)]
pub(super) enum FacetsRecord {
    /// Of a fold: panel by panel, on each row by row from the crease.
    Grid(GridRecord),
    /// Of any other surface, in its file's order.
    List(ListRecord),
}

/// A grid of facets on each panel of a fold: panel by panel, row by row from the crease, column by column
/// along it.
#[derive(Serialize, Deserialize, JsonSchema)]
pub(super) struct GridRecord {
    /// Number of panels.
    #[schemars(extend("const" = 2))]
    panels: usize,
    /// Rows of a panel, counted from the crease.
    #[schemars(range(min = 1))]
    rows: usize,
    /// Columns of a panel, counted along the crease.
    #[schemars(range(min = 1))]
    cols: usize,
    /// Depths of the rows; uniform if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    spacing: Option<SpacingRecord>,
}

/// How the depths of the rows are chosen.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
enum SpacingRecord {
    Uniform,
    Graded,
}

/// Facets one after the other; those of the backs, if a surface reflects on both sides, after those of the
/// fronts.
#[derive(Serialize, Deserialize, JsonSchema)]
pub(super) struct ListRecord {
    /// Number of facets.
    #[schemars(range(min = 1))]
    pub count: usize,
    /// Facets that have a name, by which their reflectance can be stated.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub groups: Vec<GroupRecord>,
}

/// A group of facets, one after the other.
#[derive(Serialize, Deserialize, JsonSchema)]
pub(super) struct GroupRecord {
    /// Name; groups of the same name are one.
    name: String,
    /// The first facet, counted from 0.
    first: usize,
    /// Number of facets.
    count: usize,
}

impl From<&Fold> for GridRecord {
    fn from(fold: &Fold) -> Self {
        let FacetGrid { rows, cols } = fold.facets();
        let spacing = match fold.spacing() {
            Spacing::Uniform => None,
            Spacing::Graded => Some(SpacingRecord::Graded),
        };
        Self { panels: 2, rows, cols, spacing }
    }
}

impl GridRecord {
    pub(super) fn grid(&self) -> FacetGrid {
        FacetGrid { rows: self.rows, cols: self.cols }
    }

    pub(super) fn spacing(&self) -> Spacing {
        match self.spacing {
            None | Some(SpacingRecord::Uniform) => Spacing::Uniform,
            Some(SpacingRecord::Graded) => Spacing::Graded,
        }
    }
}

impl From<&Group> for GroupRecord {
    fn from(group: &Group) -> Self {
        Self { name: group.name.clone(), first: group.facets.start, count: group.facets.len() }
    }
}

impl From<GroupRecord> for Group {
    fn from(GroupRecord { name, first, count }: GroupRecord) -> Self {
        Self { name, facets: first..first.saturating_add(count) }
    }
}

impl Scene {
    /// Number of facets of any surface.
    ///
    /// # Errors
    /// [`Error::Field`] if the scene does not state it.
    pub fn facet_count(&self) -> Result<usize> {
        match self.fold_if_one()? {
            Some(fold) => Ok(2 * fold.facets().len()),
            None => Ok(self.facet_list()?.count),
        }
    }

    pub(super) fn facet_grid(&self) -> Result<GridRecord> {
        let grid: GridRecord = self.fields.require("facets", BY_VKERNEL)?;
        match grid.panels {
            2 => Ok(grid),
            panels => Err(Error::field("facets.panels", format!("{panels}, but a fold has 2"))),
        }
    }

    pub(super) fn facet_list(&self) -> Result<ListRecord> {
        self.fields.require("facets", BY_VKERNEL)
    }
}
