//! The V-shaped fold: two rectangular panels that share a crease.

use std::ops::RangeInclusive;

use crate::error::{Error, Result};

/// Maximum number of facets on one panel.
const FACETS_MAX: usize = 512 * 512;
/// Maximum number of distinct kernel entries: those of 512 x 512 facets fill half a gigabyte.
const ENTRIES_MAX: f64 = 0.5 * 512.0 * 513.0 * 512.0;

/// How one panel is divided into facets, where colour is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FacetGrid {
    /// Facets from the crease to the outer edge.
    pub rows: usize,
    /// Facets along the crease.
    pub cols: usize,
}

impl FacetGrid {
    /// Number of facets on one panel.
    #[must_use]
    pub fn len(&self) -> usize {
        self.rows * self.cols
    }

    /// Row and column of a facet. Facets are numbered row by row from the crease.
    #[must_use]
    pub fn place(&self, facet: usize) -> [usize; 2] {
        [facet / self.cols, facet % self.cols]
    }

    /// True if the grid has no facets, which [`Fold::new`] refuses.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// How the facet rows of a panel are spaced.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Spacing {
    /// Rows of equal depth.
    #[default]
    Uniform,
    /// Row n ends at (n/rows)² of the depth: rows are narrow at the crease, where interreflection varies
    /// most.
    Graded,
}

impl Spacing {
    /// Row boundaries from 0 (the crease) to 1 (the outer edge): `rows + 1` numbers.
    ///
    /// # Example
    /// ```
    /// use vfold::geometry::Spacing;
    /// assert_eq!(Spacing::Graded.edges(2), [0.0, 0.25, 1.0]);
    /// ```
    #[must_use]
    pub fn edges(self, rows: usize) -> Vec<f64> {
        let even = (0..=rows).map(|n| n as f64 / rows as f64);
        match self {
            Self::Uniform => even.collect(),
            Self::Graded => even.map(|edge| edge * edge).collect(),
        }
    }
}

/// Two rectangular panels that share a crease, opened by an angle, each divided into a grid of facets.
///
/// Only the ratios of the sides matter: interreflection does not depend on scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fold {
    angle_deg: f64,
    width: f64,
    depths: [f64; 2],
    facets: FacetGrid,
    spacing: Spacing,
}

impl Fold {
    /// A fold opened by `angle_deg` in (0, 180]. Both panels measure `width` along the crease by `depth` away
    /// from it, in any unit, and have facets of equal size.
    ///
    /// # Errors
    /// An angle outside the range; sides that are not positive, outside 1e±100 or more than 1 : 1000 apart;
    /// no facets, more than 262144 per panel, or a kernel of more than 0.54 GB.
    ///
    /// # Example
    /// ```
    /// use vfold::geometry::{FacetGrid, Fold};
    /// let fold = Fold::new(45.0, 1.0, 1.0, FacetGrid { rows: 10, cols: 10 })?;
    /// assert_eq!(fold.facets().len(), 100);
    /// assert!(Fold::new(0.0, 1.0, 1.0, FacetGrid { rows: 10, cols: 10 }).is_err());
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn new(angle_deg: f64, width: f64, depth: f64, facets: FacetGrid) -> Result<Self> {
        if !(angle_deg > 0.0 && angle_deg <= 180.0) {
            return Err(Error::usage(
                "--angle-deg",
                format!("{angle_deg} is not an angle between two panels"),
                "give degrees above 0 and up to 180 (flat)",
            ));
        }
        if !possible(width, depth) {
            return Err(Error::usage(
                "--panel",
                format!("{width:?}x{depth:?} is not a panel"),
                "give WIDTHxDEPTH, both above 0, neither more than 1000 times the other",
            ));
        }
        check_facets(facets)?;
        Ok(Self { angle_deg, width, depths: [depth; 2], facets, spacing: Spacing::Uniform })
    }

    /// The same fold with another depth of panel 1, in the unit of the other sides.
    ///
    /// # Errors
    /// A depth that is not positive, or more than 1 : 1000 from the width or the other panel's depth.
    pub fn with_panel1_depth(self, depth: f64) -> Result<Self> {
        if !(possible(self.width, depth) && possible(self.depths[0], depth)) {
            return Err(Error::usage(
                "--panel1-depth",
                format!("{depth} is not the depth of a panel"),
                "give a depth of 0.001 to 1000 times each side of panel 0",
            ));
        }
        Ok(Self { depths: [self.depths[0], depth], ..self })
    }

    /// The same fold opened by another angle.
    ///
    /// # Errors
    /// An angle outside (0, 180].
    pub fn with_angle_deg(self, angle_deg: f64) -> Result<Self> {
        let fold = Self::new(angle_deg, self.width, self.depths[0], self.facets)?;
        Ok(Self { depths: self.depths, spacing: self.spacing, ..fold })
    }

    /// The same fold with different spacing of the facet rows.
    #[must_use]
    pub fn with_spacing(self, spacing: Spacing) -> Self {
        Self { spacing, ..self }
    }

    /// The same fold with another facet grid.
    ///
    /// # Errors
    /// No facets, more than 262144 per panel, or a kernel of more than 0.54 GB.
    pub fn with_facets(self, facets: FacetGrid) -> Result<Self> {
        check_facets(facets)?;
        Ok(Self { facets, ..self })
    }

    /// Opening angle between the panels, degrees, in (0, 180].
    #[must_use]
    pub fn angle_deg(&self) -> f64 {
        self.angle_deg
    }

    /// Opening angle, radians.
    #[must_use]
    pub fn angle_rad(&self) -> f64 {
        self.angle_deg.to_radians()
    }

    /// True if the fold is open to 180°, so that its panels do not see each other.
    #[must_use]
    pub fn is_flat(&self) -> bool {
        (180.0 - self.angle_deg).abs() < 1e-13
    }

    /// Length of the crease, in the unit of [`Fold::new`].
    #[must_use]
    pub fn width(&self) -> f64 {
        self.width
    }

    /// Distance from the crease to the outer edge of each panel, in the same unit.
    #[must_use]
    pub fn depths(&self) -> [f64; 2] {
        self.depths
    }

    /// True if the panels are mirror images of each other.
    #[must_use]
    pub fn is_symmetric(&self) -> bool {
        self.depths[0].total_cmp(&self.depths[1]).is_eq()
    }

    /// Facet grid of each panel.
    #[must_use]
    pub fn facets(&self) -> FacetGrid {
        self.facets
    }

    /// How the facet rows are spaced.
    #[must_use]
    pub fn spacing(&self) -> Spacing {
        self.spacing
    }

    /// Distances from the crease to the boundaries of the facet rows of each panel: `rows + 1` numbers,
    /// starting at 0.
    #[must_use]
    pub fn row_edges(&self) -> [Vec<f64>; 2] {
        let edges = self.spacing.edges(self.facets.rows);
        self.depths.map(|depth| edges.iter().map(|edge| depth * edge).collect())
    }
}

/// Allowed sides of panels, in any unit: their areas neither overflow nor underflow.
const SIDES: RangeInclusive<f64> = 1e-100..=1e100;

fn possible(a: f64, b: f64) -> bool {
    SIDES.contains(&a) && SIDES.contains(&b) && (a / b).ln().abs() <= 1000_f64.ln() + 1e-9
}

fn check_facets(FacetGrid { rows, cols }: FacetGrid) -> Result<()> {
    let entries = 0.5 * (rows as f64) * (rows as f64 + 1.0) * cols as f64;
    let count = rows.checked_mul(cols).filter(|count| *count <= FACETS_MAX && entries <= ENTRIES_MAX);
    let Some(count) = count else {
        return Err(Error::usage(
            "--facets",
            format!("the kernel of {rows}x{cols} facets would take {:.3e} GB", 8e-9 * entries),
            format!("give ROWSxCOLS, at most {FACETS_MAX} facets per panel and 0.538 GB, such as 512x512"),
        ));
    };
    if count == 0 {
        return Err(Error::usage(
            "--facets",
            format!("{rows}x{cols} leaves no facet"),
            "give ROWSxCOLS, at least 1x1",
        ));
    }
    Ok(())
}
