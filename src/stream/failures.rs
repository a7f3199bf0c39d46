//! Counts samples that carry an error as they are written.

use std::fmt;

use super::Sample;
use crate::error::Result;

/// Number of samples in a stream that carry an error, with the first message.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Failures {
    samples: usize,
    failed: usize,
    first: Option<String>,
}

impl Failures {
    /// Counts a sample.
    pub(super) fn count(&mut self, sample: &Sample) -> Result<()> {
        self.samples += 1;
        if let Some(error) = sample.error()? {
            self.failed += 1;
            self.first.get_or_insert_with(|| format!("{}: {error}", sample.id()));
        }
        Ok(())
    }

    /// Whether there are any.
    #[must_use]
    pub fn any(&self) -> bool {
        self.failed > 0
    }
}

impl fmt::Display for Failures {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { samples, failed, first } = self;
        write!(f, "{failed} of {samples} failed; first: {}", first.as_deref().unwrap_or_default())
    }
}
