//! Things that take long to compute and that successive scenes usually share.

use std::sync::{Mutex, PoisonError};

use vfold::Result;

/// The value computed last, with what it was computed for.
pub struct Latest<K, V>(Mutex<Option<(K, V)>>);

impl<K, V> Default for Latest<K, V> {
    fn default() -> Self {
        Self(Mutex::default())
    }
}

impl<K: PartialEq, V: Clone> Latest<K, V> {
    /// The value for this key, computed unless it is the latest.
    pub fn get(&self, key: K, compute: impl FnOnce(&K) -> Result<V>) -> Result<V> {
        let mut latest = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((of_latest, value)) = &*latest
            && *of_latest == key
        {
            return Ok(value.clone());
        }
        let value = compute(&key)?;
        *latest = Some((key, value.clone()));
        Ok(value)
    }
}
