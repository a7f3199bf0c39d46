//! Notes on what was read, each of which is shown once.

use std::collections::HashSet;
use std::sync::{Arc, Mutex};

/// Those that were shown.
#[derive(Clone, Debug, Default)]
pub(super) struct Notes(Arc<Mutex<HashSet<String>>>);

impl Notes {
    /// Whether this one was not shown yet; it counts as shown from now on.
    pub(super) fn is_new(&self, note: &str) -> bool {
        self.0.lock().is_ok_and(|mut shown| shown.insert(note.to_owned()))
    }
}
