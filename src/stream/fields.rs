//! A record as a bag of named fields, in the order they came.

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

use crate::error::{Error, Result};

/// The fields of one record.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fields(pub(super) Map<String, Value>);

impl Fields {
    /// An empty record of the given kind.
    #[must_use]
    pub fn of_kind(kind: &str) -> Self {
        let mut map = Map::new();
        map.insert("kind".to_owned(), Value::from(kind));
        Self(map)
    }

    /// The record's kind, empty if it has none.
    #[must_use]
    pub fn kind(&self) -> &str {
        self.0.get("kind").and_then(Value::as_str).unwrap_or("")
    }

    /// A field as a number, text, array or type of the tools; none if it is absent or null.
    ///
    /// # Errors
    /// [`Error::Field`] if it holds something else.
    pub fn get<T: DeserializeOwned>(&self, name: &str) -> Result<Option<T>> {
        match self.0.get(name) {
            None | Some(Value::Null) => Ok(None),
            Some(value) => T::deserialize(value).map(Some).map_err(|e| Error::field(name, e)),
        }
    }

    /// A field that the tool cannot do without; `remedy` says which tool or flag adds it.
    ///
    /// # Errors
    /// [`Error::Field`] if it is absent, null or holds something else.
    pub fn require<T: DeserializeOwned>(&self, name: &str, remedy: &str) -> Result<T> {
        self.get(name)?.ok_or_else(|| Error::field(name, format!("missing; {remedy}")))
    }

    /// Sets a field; the caller has made sure with [`finite`] that its numbers are numbers.
    ///
    /// # Errors
    /// [`Error::Field`] if the value has no form in JSON.
    pub fn set(&mut self, name: &str, value: impl Serialize) -> Result<()> {
        let value = serde_json::to_value(value).map_err(|e| Error::field(name, e))?;
        self.0.insert(name.to_owned(), value);
        Ok(())
    }
}

/// Checks that all numbers of a field are finite: JSON has no NaN or infinity, and a null in their place would hide them.
///
/// # Errors
/// [`Error::Field`] if one is not.
pub fn finite<'a>(name: &str, values: impl IntoIterator<Item = &'a f64>) -> Result<()> {
    match values.into_iter().find(|value| !value.is_finite()) {
        Some(value) => {
            Err(Error::field(name, format!("computed as {value}; the scene or its numbers are out of range")))
        }
        None => Ok(()),
    }
}
