//! Room in memory, asked for before it is needed.
//!
//! Where memory is limited (`ulimit -v`), a program that takes more than there is ends on the spot, without a
//! word of its own. Who is about to take a great deal asks here first.

use std::hint::black_box;

use crate::error::{Error, Result};

/// Whether there is room for so many bytes now.
///
/// # Errors
/// [`Error::Memory`] with `what` wants them and what to do instead, if there is not.
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
    // Room that nobody looks at is not asked for in optimised builds.
    black_box(&room);
    if there_is {
        return Ok(());
    }
    Err(Error::Memory { what: what.to_owned(), megabytes: bytes.div_ceil(1 << 20), remedy })
}
