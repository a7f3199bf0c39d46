//! Flags that do not go with others.

use crate::error::{Error, Result};

/// Refuses the first of `flags` that was given, each with whether it was: what is wrong with it, and what to
/// do.
///
/// # Errors
/// [`Error::Usage`] if one was given.
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
