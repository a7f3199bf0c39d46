//! A record as a bag of named fields, in the order they came.

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

use crate::error::{Error, Result};

/// Largest number that is read of colours, spectra and exposures: sums, products and squares of such numbers stay finite.
pub(super) const LARGEST: f64 = 1e30;

/// What to do where a part of a scene is missing.
pub(super) const BY_VKERNEL: &str = "make the scene with vkernel";

/// The fields of one record.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fields(pub(super) Map<String, Value>);

impl Fields {
    /// The fields of a record; the caller has made sure with [`finite`] that its numbers are numbers.
    ///
    /// # Errors
    /// [`Error::Field`] if it has no form in JSON.
    pub(super) fn of(record: &impl Serialize) -> Result<Self> {
        match serde_json::to_value(record).map_err(|e| Error::field("kind", e))? {
            Value::Object(fields) => Ok(Self(fields)),
            _ => Err(Error::field("kind", "not that of a record")),
        }
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

    /// What a dotted path leads to, through objects by name and lists by number; none if it leads nowhere.
    pub(super) fn at(&self, path: &str) -> Option<&Value> {
        let mut parts = path.split('.');
        let first = self.0.get(parts.next()?)?;
        parts.try_fold(first, |value, part| match value {
            Value::Array(items) => items.get(part.parse::<usize>().ok()?),
            other => other.get(part),
        })
    }

    /// The number, text or truth value at a dotted path, as text; none if there is none.
    ///
    /// # Errors
    /// [`Error::Field`] if a list or an object is there.
    ///
    /// # Example
    /// ```
    /// let mut fields = vfold::stream::Fields::default();
    /// fields.set("geometry", std::collections::HashMap::from([("angle_deg", 45.0)]))?;
    /// assert_eq!(fields.text_at("geometry.angle_deg")?.as_deref(), Some("45.0"));
    /// assert_eq!(fields.text_at("geometry.shape")?, None);
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn text_at(&self, path: &str) -> Result<Option<String>> {
        match self.at(path) {
            None | Some(Value::Null) => Ok(None),
            Some(Value::String(text)) => Ok(Some(text.clone())),
            Some(Value::Array(_) | Value::Object(_)) => {
                Err(Error::field(path, "not one value; name a field within it"))
            }
            Some(value) => Ok(Some(value.to_string())),
        }
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

    /// Adds an entry to a field that is a list, or makes it; entries that it has stay as they are.
    ///
    /// # Errors
    /// As [`Fields::set`]; [`Error::Field`] if it is not a list.
    pub(super) fn push(&mut self, name: &str, entry: impl Serialize) -> Result<()> {
        let mut list: Vec<Value> = self.get(name)?.unwrap_or_default();
        list.push(serde_json::to_value(entry).map_err(|e| Error::field(name, e))?);
        self.set(name, list)
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
