//! What the numbers of a photograph are worth.

use clap::Args;
use vfold::{Error, Result};

#[derive(Args)]
pub struct CalibrationArgs {
    /// Value of a perfect white diffuser facing the sun, in its strongest channel, if known
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    pub exposure: Option<f64>,
}

impl CalibrationArgs {
    /// # Errors
    /// [`Error::Usage`] if the exposure is no number above 0.
    pub fn check(&self) -> Result<()> {
        match self.exposure {
            Some(x) if !(x > 0.0 && x.is_finite()) => {
                Err(Error::usage("--exposure", format!("{x} gives no picture"), "give a number above 0"))
            }
            _ => Ok(()),
        }
    }
}
