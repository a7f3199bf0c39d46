//! The contents of a record as a list for readers, including unknown fields.

use serde_json::Value;

use super::Fields;

/// Longest list whose items are listed individually.
const LISTED: usize = 6;

impl Fields {
    /// All single values under the object at a dotted `path` (empty: the whole record), with their dotted
    /// names; for long lists the number of items.
    ///
    /// # Example
    /// ```
    /// let mut fields = vfold::stream::Sample::new("fold", "sheet")?.fields;
    /// fields.set("wavelengths_nm", vec![400.0; 61])?;
    /// fields.set("panel", [1.0, 2.0])?;
    /// let leaves = fields.leaves("");
    /// let shown: Vec<_> = leaves.iter().map(|(name, value)| (name.as_str(), value.as_str())).collect();
    /// assert_eq!(shown[2..], [("id", "sheet"), ("wavelengths_nm", "61 values"), ("panel", "1.0, 2.0")]);
    /// # Ok::<(), vfold::Error>(())
    /// ```
    #[must_use]
    pub fn leaves(&self, path: &str) -> Vec<(String, String)> {
        let mut leaves = Vec::new();
        if path.is_empty() {
            let values = self.names().filter_map(|name| Some((name, self.get::<Value>(name).ok()??)));
            values.for_each(|(name, value)| walk(name.to_owned(), &value, &mut leaves));
        } else if let Some(Value::Object(fields)) = self.at(path) {
            fields.iter().for_each(|(name, value)| walk(name.clone(), value, &mut leaves));
        }
        leaves
    }
}

fn walk(name: String, value: &Value, leaves: &mut Vec<(String, String)>) {
    match value {
        Value::Null => {}
        Value::Object(fields) => {
            fields.iter().for_each(|(part, value)| walk(format!("{name}.{part}"), value, leaves));
        }
        Value::Array(items) if items.len() > LISTED => {
            leaves.push((name, format!("{} values", items.len())));
        }
        Value::Array(items) if items.iter().any(|item| item.is_object() || item.is_array()) => {
            let items = items.iter().enumerate();
            items.for_each(|(n, item)| walk(format!("{name}.{n}"), item, leaves));
        }
        Value::Array(items) => {
            leaves.push((name, items.iter().map(text).collect::<Vec<_>>().join(", ")));
        }
        value => leaves.push((name, text(value))),
    }
}

fn text(value: &Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), str::to_owned)
}
