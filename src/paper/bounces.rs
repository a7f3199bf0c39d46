//! How many bounces of light count: the first ones are eqs. (5) to (7), in matrices eqs. (11) to (13), their
//! sum is eq. (14).

use nalgebra::DMatrix;

use crate::forward::{BispectralSheet, FacetModel, Fluorescing};

/// Which light a facet RGB is made of, by how often it has been reflected from panel to panel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bounces {
    /// All light.
    All,
    /// Light of at most this many bounces; 0 is direct light alone.
    First(u32),
    /// As few bounces as leave out at most this share, in (0, 1), of any facet's RGB.
    Within(f64),
}

/// What counting some bounces only leaves out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Truncation {
    /// Bounces that are counted.
    pub count: u32,
    /// Largest share of a facet's RGB that the others would add, in [0, 1].
    pub missing: f64,
}

impl Bounces {
    /// RGB of every facet at exposure 1, facet by channel, and what it leaves out, if anything is asked to
    /// be.
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

    /// The same of a sheet that fluoresces.
    #[must_use]
    pub fn fluorescing_rgb(self, sheet: &Fluorescing) -> (DMatrix<f64>, Option<Truncation>) {
        self.counted(sheet.facet_rgb(), |count| sheet.facet_rgb_after(count))
    }

    /// The same of a sheet that is excited by all light that falls on it.
    #[must_use]
    pub fn bispectral_rgb(self, sheet: &BispectralSheet) -> (DMatrix<f64>, Option<Truncation>) {
        self.counted(sheet.facet_rgb(), |count| sheet.facet_rgb_after(count))
    }

    /// What counts of `all` light, of which `after` has that of more bounces.
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

/// The least number that is enough, by doubling and halving: more is always enough, too.
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

/// A facet without light misses nothing.
fn largest_share(part: &DMatrix<f64>, all: &DMatrix<f64>) -> f64 {
    let shares = part.iter().zip(all).filter(|(_, all)| **all > 0.0).map(|(part, all)| part / all);
    shares.fold(0.0, f64::max)
}
