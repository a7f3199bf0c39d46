//! The V-shaped fold: two equal rectangular panels that share a crease.

use crate::error::{Error, Result};

/// Most facets on one panel: the distinct kernel entries of 512 x 512 facets fill half a gigabyte.
const MAX_FACETS: usize = 512 * 512;

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

    /// Whether the grid has no facet, which [`Fold::new`] refuses.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// A fold: two panels of equal size, opened by an angle, each divided into a grid of facets.
///
/// Only the ratio of the panel's sides matters: interreflection is free of scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fold {
    angle_deg: f64,
    width: f64,
    depth: f64,
    facets: FacetGrid,
}

impl Fold {
    /// A fold opened by `angle_deg` in (0, 180], panels `width` along the crease by `depth` away from it, any unit.
    ///
    /// # Errors
    /// Angle outside the range, sides not positive or further apart than 1 : 1000, no facet, or more than 262144 a panel.
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
        if !(width > 0.0 && depth > 0.0 && (width / depth).ln().abs() <= 1000_f64.ln() + 1e-9) {
            return Err(Error::usage(
                "--panel",
                format!("{width}x{depth} is not a panel"),
                "give width along the crease x depth, both positive, at most 1000 times each other",
            ));
        }
        let Some(count) = facets.rows.checked_mul(facets.cols).filter(|count| *count <= MAX_FACETS) else {
            let entries = 0.5 * (facets.rows as f64) * (facets.rows as f64 + 1.0) * facets.cols as f64;
            return Err(Error::usage(
                "--facets",
                format!(
                    "the kernel of {}x{} facets would take {:.3e} GB",
                    facets.rows,
                    facets.cols,
                    8e-9 * entries
                ),
                format!("give rows x columns, at most {MAX_FACETS} facets a panel"),
            ));
        };
        if count == 0 {
            return Err(Error::usage(
                "--facets",
                format!("{}x{} is no facet", facets.rows, facets.cols),
                "give rows x columns, at least 1x1",
            ));
        }
        Ok(Self { angle_deg, width, depth, facets })
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

    /// Length of the crease, in the unit the fold was given in.
    #[must_use]
    pub fn width(&self) -> f64 {
        self.width
    }

    /// Distance from the crease to the outer edge, in the same unit.
    #[must_use]
    pub fn depth(&self) -> f64 {
        self.depth
    }

    /// Facet grid of each panel.
    #[must_use]
    pub fn facets(&self) -> FacetGrid {
        self.facets
    }

    /// The same fold with other facets.
    ///
    /// # Errors
    /// As [`Fold::new`].
    pub fn with_facets(&self, facets: FacetGrid) -> Result<Self> {
        Self::new(self.angle_deg, self.width, self.depth, facets)
    }
}
