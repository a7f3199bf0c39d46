//! A record as a set of named fields, in their original order.
//!
//! A field remains text until it is read: fields passed through take no more memory than their line, and are
//! written unchanged.

use std::collections::BTreeMap;
use std::fmt;

use serde::de::{DeserializeOwned, Error as _, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::Value;
use serde_json::value::{RawValue, to_raw_value};

use crate::error::{Error, Result};

/// Largest number accepted in colours, spectra and exposures: sums, products and squares of such numbers
/// remain finite.
pub(super) const LARGEST: f64 = 1e30;

/// Remedy for a missing part of a scene.
pub(super) const BY_VKERNEL: &str = "make the scene with vkernel";

/// Most fields of a record; those of the tools are two dozen.
const FIELDS_MAX: usize = 1000;

/// Most values read from one field: numbers at full precision reach the longest line first. Short ones,
/// `1,1,1`, take many times the memory of their text.
pub(super) const VALUES_MAX: usize = 1 << 26;

/// The fields of one record.
#[derive(Clone, Debug, Default)]
pub struct Fields(Vec<(String, Box<RawValue>)>);

impl Fields {
    /// The fields of a record; the caller has checked with [`finite`] that its numbers are finite.
    ///
    /// # Errors
    /// [`Error::Field`] if it cannot be written as JSON.
    pub(super) fn of(record: &impl Serialize) -> Result<Self> {
        let text = to_raw_value(record).map_err(|e| Error::field("kind", e))?;
        serde_json::from_str(text.get()).map_err(|e| Error::field("kind", problem(&e)))
    }

    /// The record's kind, empty if it has none.
    #[must_use]
    pub fn kind(&self) -> String {
        self.raw("kind").and_then(|kind| serde_json::from_str(kind.get()).ok()).unwrap_or_default()
    }

    /// The names of its fields.
    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(|(name, _)| name.as_str())
    }

    /// A field's text in the line; none if it is absent.
    pub(super) fn text(&self, name: &str) -> Option<&str> {
        self.raw(name).map(RawValue::get)
    }

    /// Whether a field is present and not null.
    #[must_use]
    pub fn has(&self, name: &str) -> bool {
        self.text(name).is_some_and(|text| text != NULL)
    }

    fn raw(&self, name: &str) -> Option<&RawValue> {
        self.0.iter().find(|(other, _)| other == name).map(|(_, value)| &**value)
    }

    /// A field as a number, text, array or type of the tools; none if it is absent or null.
    ///
    /// # Errors
    /// [`Error::Field`] if it holds something else.
    pub fn get<T: DeserializeOwned>(&self, name: &str) -> Result<Option<T>> {
        match self.raw(name).filter(|value| value.get() != NULL) {
            None => Ok(None),
            Some(value) => read(value).map(Some).map_err(|problem| Error::field(name, problem)),
        }
    }

    /// A field that the tool requires; `remedy` names the tool or flag that adds it.
    ///
    /// # Errors
    /// [`Error::Field`] if it is absent, null or holds something else.
    pub fn require<T: DeserializeOwned>(&self, name: &str, remedy: &str) -> Result<T> {
        self.get(name)?.ok_or_else(|| Error::field(name, format!("missing; {remedy}")))
    }

    /// The value at a dotted path, through objects by name and lists by index; none if it does not exist, is
    /// nested too deeply or is too large.
    pub(super) fn at(&self, path: &str) -> Option<Value> {
        let mut parts = path.split('.');
        let first = self.raw(parts.next()?)?;
        read(parts.try_fold(first, inner)?).ok()
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
            Some(Value::String(text)) => Ok(Some(text)),
            Some(Value::Array(_) | Value::Object(_)) => {
                Err(Error::field(path, "not one value; name a field within it"))
            }
            Some(value) => Ok(Some(value.to_string())),
        }
    }

    /// Sets a field; the caller has checked with [`finite`] that its numbers are finite.
    ///
    /// # Errors
    /// [`Error::Field`] if the value cannot be written as JSON.
    pub fn set(&mut self, name: &str, value: impl Serialize) -> Result<()> {
        let value = to_raw_value(&value).map_err(|e| Error::field(name, e))?;
        self.insert(name.to_owned(), value);
        Ok(())
    }

    /// Removes a field, if present.
    pub fn remove(&mut self, name: &str) {
        self.0.retain(|(other, _)| other != name);
    }

    fn insert(&mut self, name: String, value: Box<RawValue>) {
        match self.0.iter_mut().find(|(other, _)| *other == name) {
            Some((_, old)) => *old = value,
            None => self.0.push((name, value)),
        }
    }

    /// Appends an entry to a list field, created if absent; existing entries remain unchanged.
    ///
    /// # Errors
    /// As [`Fields::set`]; [`Error::Field`] if it is not a list.
    pub(super) fn push(&mut self, name: &str, entry: impl Serialize) -> Result<()> {
        let entry = to_raw_value(&entry).map_err(|e| Error::field(name, e))?;
        let list = self.text(name).filter(|text| *text != NULL).unwrap_or("[]");
        let entries = list.strip_prefix('[').and_then(|list| list.strip_suffix(']'));
        let entries = entries.ok_or_else(|| Error::field(name, "not a list"))?;
        let comma = if entries.trim().is_empty() { "" } else { "," };
        let list = RawValue::from_string(format!("[{entries}{comma}{entry}]"));
        self.insert(name.to_owned(), list.map_err(|e| Error::field(name, problem(&e)))?);
        Ok(())
    }
}

/// Records are equal if their texts are equal.
impl PartialEq for Fields {
    fn eq(&self, other: &Self) -> bool {
        self.names().eq(other.names()) && self.names().all(|name| self.text(name) == other.text(name))
    }
}

impl Serialize for Fields {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name, value)))
    }
}

impl<'de> Deserialize<'de> for Fields {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> std::result::Result<Self, D::Error> {
        deserializer.deserialize_map(ReadFields)
    }
}

struct ReadFields;

impl<'de> Visitor<'de> for ReadFields {
    type Value = Fields;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("an object")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> std::result::Result<Fields, A::Error> {
        let mut fields = Fields::default();
        while let Some((name, value)) = map.next_entry()? {
            if fields.0.len() == FIELDS_MAX {
                return Err(A::Error::custom(format!("more than {FIELDS_MAX} fields")));
            }
            fields.insert(name, value);
        }
        Ok(fields)
    }
}

const NULL: &str = "null";

/// The value of a field, or what is wrong with it.
fn read<T: DeserializeOwned>(value: &RawValue) -> std::result::Result<T, String> {
    if !is_readable(value) {
        return Err(format!("more than {VALUES_MAX} values; use fewer facets or wavelengths"));
    }
    serde_json::from_str(value.get()).map_err(|error| problem(&error))
}

fn is_readable(value: &RawValue) -> bool {
    let text = value.get().as_bytes();
    text.len() <= VALUES_MAX || text.iter().filter(|byte| b",[{".contains(byte)).count() <= VALUES_MAX
}

/// The value of this name in an object, or at this index in a list.
fn inner<'a>(value: &'a RawValue, part: &str) -> Option<&'a RawValue> {
    let text = is_readable(value).then(|| value.get())?;
    if text.starts_with('[') {
        let items: Vec<&RawValue> = serde_json::from_str(text).ok()?;
        return items.get(part.parse::<usize>().ok()?).copied();
    }
    let mut fields: BTreeMap<String, &RawValue> = serde_json::from_str(text).ok()?;
    fields.remove(part)
}

/// What is wrong with JSON, without the position, which is of no use within a field.
pub(super) fn problem(error: &serde_json::Error) -> String {
    let place = format!(" at line {} column {}", error.line(), error.column());
    let text = error.to_string();
    text.strip_suffix(&place).unwrap_or(&text).to_owned()
}

/// Checks that all numbers of a field are finite: JSON has no NaN or infinity, and a null in their place
/// would hide them.
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
