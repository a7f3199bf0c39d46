//! Memory, requested before it is needed.
//!
//! Where memory is limited (`ulimit -v`), a program that exceeds the limit ends at once, without a message of
//! its own. Code that is about to allocate a great deal asks here first.

use std::hint::black_box;

use crate::error::{Error, Result};

/// Checks that `bytes` of memory are available now.
///
/// # Errors
/// [`Error::Memory`] if they are not, with the purpose (`what`) and the `remedy`.
///
/// # Example
/// ```
/// use vfold::room::ask;
/// assert!(ask(1 << 20, "a small picture", "crop it").is_ok());
/// let error = ask(u64::MAX, "a huge picture", "crop it").unwrap_err();
/// assert_eq!(error.exit_status(), 1);
/// ```
pub fn ask(bytes: u64, what: &str, remedy: &'static str) -> Result<()> {
    let mut room = Vec::<u8>::new();
    let there_is = usize::try_from(bytes).is_ok_and(|bytes| room.try_reserve_exact(bytes).is_ok());
    // An unused allocation would be removed from optimised builds.
    black_box(&room);
    if there_is {
        return Ok(());
    }
    Err(Error::Memory { what: what.to_owned(), megabytes: bytes.div_ceil(1 << 20), remedy })
}
