//! The files of a run appear together when it has ended well: one that fails replaces none of them.

use std::mem;
use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::error::Result;

/// A complete file without its final name.
pub(super) trait Complete: Send {
    /// Gives it a temporary name; what is returned gives it the final one.
    ///
    /// # Errors
    /// [`Error::File`](crate::Error::File) if that is refused.
    fn named(self: Box<Self>) -> Result<Rename>;
}

/// Gives a file its final name.
pub(super) type Rename = Box<dyn FnOnce() -> Result<()>>;

/// The complete files that wait for the end of the run; none if files need not wait.
static COMPLETE: Mutex<Waiting> = Mutex::new(None);

type Waiting = Option<Vec<Box<dyn Complete>>>;

/// While it exists, complete files wait for each other. Those that still wait when it is dropped vanish.
pub(crate) struct Together(());

impl Together {
    /// From now on files wait.
    pub fn begin() -> Self {
        *complete() = Some(Vec::new());
        Self(())
    }

    /// Renames all files that wait.
    ///
    /// # Errors
    /// As [`keep_complete`].
    pub fn keep(self) -> Result<()> {
        keep_complete()
    }
}

impl Drop for Together {
    fn drop(&mut self) {
        *complete() = None;
    }
}

/// Renames the files that are complete so far, for those that must be there before the run ends.
///
/// # Errors
/// [`Error::File`](crate::Error::File) if one cannot be renamed.
pub fn keep_complete() -> Result<()> {
    let files = complete().as_mut().map(mem::take).unwrap_or_default();
    // a temporary name may be refused: no file is replaced before all have one
    let named = files.into_iter().map(Complete::named).collect::<Result<Vec<_>>>()?;
    named.into_iter().try_for_each(|rename| rename())
}

/// Lets a complete file wait for the others of its run; returns it if it need not.
pub(super) fn wait(file: Box<dyn Complete>) -> Option<Box<dyn Complete>> {
    match &mut *complete() {
        Some(files) => {
            files.push(file);
            None
        }
        None => Some(file),
    }
}

fn complete() -> MutexGuard<'static, Waiting> {
    COMPLETE.lock().unwrap_or_else(PoisonError::into_inner)
}
