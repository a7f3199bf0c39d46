//! Flags that cannot be combined with others.

use crate::error::{Error, Result};

/// Refuses the first of `flags` that is present, each paired with whether it is, with a problem and a remedy.
///
/// # Errors
/// [`Error::Usage`] if one is present.
///
/// # Example
/// ```
/// use vfold::cli::refuse;
/// let flags = [("--seed", false), ("--samples", true)];
/// let refused = refuse(flags, "there is nothing to sample", "add --method monte-carlo").unwrap_err();
/// assert!(refused.to_string().contains("--samples"));
/// ```
pub fn refuse(
    flags: impl IntoIterator<Item = (&'static str, bool)>,
    problem: &str,
    remedy: &str,
) -> Result<()> {
    match flags.into_iter().find(|(_, is_present)| *is_present) {
        Some((flag, _)) => Err(Error::usage(flag, problem, remedy)),
        None => Ok(()),
    }
}
