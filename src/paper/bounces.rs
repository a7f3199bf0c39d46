//! The number of bounces of light that count: the first ones are eqs. (5) to (7), in matrix form eqs. (11) to
//! (13), and their sum is eq. (14).

use nalgebra::DMatrix;

use crate::forward::{BispectralSheet, FacetModel, Fluorescing};

/// The light included in a facet RGB, by its number of reflections between the panels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bounces {
    /// All light.
    All,
    /// Light of at most this many bounces; 0 is direct light only.
    First(u32),
    /// The least number of bounces that omits at most this fraction, in (0, 1), of any facet's RGB.
    Within(f64),
}

/// The effect of omitting bounces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Truncation {
    /// Bounces that are included.
    pub count: u32,
    /// Largest fraction of a facet's RGB that the others would add, in [0, 1].
    pub missing: f64,
}

impl Bounces {
    /// RGB of every facet at exposure 1, facet by channel, and what is omitted, if bounces are limited.
    ///
    /// # Source
    /// Deeb et al., eq. (14).
    ///
    /// # Example
    /// ```
    /// use vfold::camera::CameraResponse;
    /// use vfold::paper::{Method, bounces::Bounces, respond};
    /// use vfold::forward::{FacetModel, Lighting};
    /// use vfold::geometry::{FacetGrid, Fold, Light};
    /// use vfold::kernel::mesh::Mesh;
    /// // Two white squares at a right angle hand on a fifth of their light, whose sixth power is the first
    /// // below 1e-4.
    /// let fold = Fold::new(90.0, 1.0, 1.0, FacetGrid { rows: 1, cols: 1 })?;
    /// let (response, _) = respond(Method::Exact, &fold, Mesh::Facets, 1e-9)?;
    /// let eye = CameraResponse::from_weights(vec![vec![1.0]]);
    /// let lighting = Lighting { light: Light::new(&fold, 0.0, 0.0, 0.0)?, sun: eye.clone(), sky: eye };
    /// let model = FacetModel::one_sheet(&response, &lighting);
    /// let (_, truncation) = Bounces::Within(1e-4).facet_rgb(&model, &[1.0]);
    /// assert_eq!(truncation.map(|left_out| left_out.count), Some(5));
    /// # Ok::<(), vfold::Error>(())
    /// ```
    #[must_use]
    pub fn facet_rgb(self, model: &FacetModel, reflectance: &[f64]) -> (DMatrix<f64>, Option<Truncation>) {
        self.counted(model.facet_rgb(reflectance), |count| model.facet_rgb_after(count, reflectance))
    }

    /// The same for a fluorescent sheet.
    #[must_use]
    pub fn fluorescing_rgb(self, sheet: &Fluorescing) -> (DMatrix<f64>, Option<Truncation>) {
        self.counted(sheet.facet_rgb(), |count| sheet.facet_rgb_after(count))
    }

    /// The same for a sheet excited by all light that falls on it.
    #[must_use]
    pub fn bispectral_rgb(self, sheet: &BispectralSheet) -> (DMatrix<f64>, Option<Truncation>) {
        self.counted(sheet.facet_rgb(), |count| sheet.facet_rgb_after(count))
    }

    /// The part of `all` light that counts; `after(n)` is the light of more than n bounces.
    fn counted(
        self,
        all: DMatrix<f64>,
        after: impl Fn(u32) -> DMatrix<f64>,
    ) -> (DMatrix<f64>, Option<Truncation>) {
        let count = match self {
            Self::All => return (all, None),
            Self::First(count) => count,
            Self::Within(tolerance) => least(|count| largest_share(&after(count), &all) <= tolerance),
        };
        let rest = after(count);
        let missing = largest_share(&rest, &all);
        (all - rest, Some(Truncation { count, missing }))
    }
}

/// The least sufficient number, by doubling and bisection: every larger number is sufficient, too.
fn least(enough: impl Fn(u32) -> bool) -> u32 {
    let mut high = 1_u32;
    while !enough(high) && high < u32::MAX {
        high = high.saturating_mul(2);
    }
    let mut low = 0;
    while low < high {
        let middle = low + (high - low) / 2;
        if enough(middle) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    high
}

/// A facet without light counts as complete.
fn largest_share(part: &DMatrix<f64>, all: &DMatrix<f64>) -> f64 {
    let shares = part.iter().zip(all).filter(|(_, all)| **all > 0.0).map(|(part, all)| part / all);
    shares.fold(0.0, f64::max)
}
