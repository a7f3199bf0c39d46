//! The methods for the form factors between facets, one per file.

use std::fmt;

use super::fold_kernel::FoldKernel;
use super::monte_carlo::MonteCarlo;
use super::{form_factors, midpoint};
use crate::geometry::Fold;
use crate::kernel::mesh::KernelSource;

/// Method for the form factors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Averaged over both facets, exact to rounding.
    Exact,
    /// Estimated from samples, as in the paper.
    MonteCarlo(MonteCarlo),
    /// Eq. (2) at the facets' centres, as printed.
    Midpoint,
}

impl Method {
    /// The form factors between the facets of `fold`, and the largest standard error of one if they are
    /// estimates.
    ///
    /// # Example
    /// ```
    /// use vfold::geometry::{FacetGrid, Fold};
    /// use vfold::paper::Method;
    /// let fold = Fold::new(45.0, 1.0, 1.0, FacetGrid { rows: 10, cols: 10 })?;
    /// let [exact, midpoint] = [Method::Exact, Method::Midpoint].map(|method| method.form_factors(&fold).0);
    /// assert!((exact.form_factor(0, 0, 0, 0) - 0.483).abs() < 1e-3);
    /// assert!((midpoint.form_factor(0, 0, 0, 0) - 1.855).abs() < 1e-3); // more light than the facet has
    /// # Ok::<(), vfold::Error>(())
    /// ```
    #[must_use]
    pub fn form_factors(self, fold: &Fold) -> (FoldKernel, Option<f64>) {
        match self {
            Self::Exact => (form_factors(fold), None),
            Self::MonteCarlo(estimate) => {
                let (kernel, entry_sd) = estimate.form_factors(fold);
                (kernel, Some(entry_sd))
            }
            Self::Midpoint => (midpoint::form_factors(fold), None),
        }
    }
}

impl Method {
    /// Its name for `vkernel --method`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::MonteCarlo(_) => "monte-carlo",
            Self::Midpoint => "midpoint",
        }
    }

    /// The description of a kernel from this method.
    pub(super) fn source(self, entry_sd: Option<f64>, kernel: &FoldKernel) -> KernelSource {
        let samples = match self {
            Self::MonteCarlo(estimate) => Some(estimate.samples()),
            Self::Exact | Self::Midpoint => None,
        };
        KernelSource { method: self.name(), samples, entry_sd, entries: kernel.entries() }
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.name())
    }
}
