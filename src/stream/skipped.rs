//! Parts of a scene that need not be computed.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::Scene;
use crate::error::Result;
use crate::kernel::skipped::Skipped;

/// Work that was skipped because the result does not need it.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct SkippedRecord {
    /// What was skipped, a noun in the plural.
    pub what: String,
    /// How many were skipped.
    pub count: usize,
    /// Why the result does not need them.
    pub why: String,
}

impl From<&Skipped> for SkippedRecord {
    fn from(Skipped { what, count, why }: &Skipped) -> Self {
        Self { what: (*what).to_owned(), count: *count, why: (*why).to_owned() }
    }
}

impl Scene {
    /// The work that the scene did not need.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if `skipped` is not a list of it.
    pub fn skipped(&self) -> Result<Vec<SkippedRecord>> {
        Ok(self.fields.get("skipped")?.unwrap_or_default())
    }

    /// Records that `count` items of `what` need not be computed, and why, replacing an earlier entry on
    /// them.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if `skipped` is not a list.
    pub fn set_skipped(&mut self, what: &str, count: usize, why: &str) -> Result<()> {
        if let Some(mut skipped) = self.fields.get::<Vec<Value>>("skipped")? {
            skipped.retain(|entry| entry["what"] != what);
            self.fields.set("skipped", skipped)?;
        }
        if count == 0 {
            return Ok(());
        }
        self.fields.push("skipped", SkippedRecord { what: what.to_owned(), count, why: why.to_owned() })
    }
}
