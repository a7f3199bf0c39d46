//! Flags for a kernel made elsewhere.

use std::path::PathBuf;

use clap::Args;

use crate::error::Result;
use crate::scene::ExternalKernel;

/// A kernel as NPY files, in place of a scene.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Kernel made elsewhere")]
pub struct KernelArgs {
    /// Instead of a scene: form factors, facets x facets; row i, column j is the share of the light of facet
    /// i that reaches j
    #[arg(long, value_name = "K.npy")]
    pub kernel: Option<PathBuf>,
    /// Direct irradiance: one number per facet, or one row per source [default: 1 everywhere]
    #[arg(long, value_name = "E0.npy", requires = "kernel")]
    pub irradiance: Option<PathBuf>,
    /// Areas of the facets, in any unit [default: those that reciprocity implies]
    #[arg(long, value_name = "A.npy", requires = "kernel")]
    pub areas: Option<PathBuf>,
}

impl KernelArgs {
    /// The kernel, if stated.
    ///
    /// # Errors
    /// As [`ExternalKernel::read`].
    pub fn external(&self) -> Result<Option<ExternalKernel>> {
        let read = |kernel| ExternalKernel::read(kernel, self.irradiance.as_deref(), self.areas.as_deref());
        self.kernel.as_deref().map(read).transpose()
    }
}
