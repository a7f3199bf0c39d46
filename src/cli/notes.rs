//! Notes on inputs, each shown once.

use std::collections::HashSet;
use std::sync::{Arc, Mutex};

/// The notes already shown.
#[derive(Clone, Debug, Default)]
pub(super) struct Notes(Arc<Mutex<HashSet<String>>>);

impl Notes {
    /// Whether this note is new; it counts as shown from now on.
    pub(super) fn is_new(&self, note: &str) -> bool {
        self.0.lock().is_ok_and(|mut shown| shown.insert(note.to_owned()))
    }
}
