//! `--save FIELD=FILE`: any numeric field of the records as an NPY array.

use std::path::{Path, PathBuf};

use serde_json::Value;

use super::{ArrayStack, Fields};
use crate::error::Result;

/// Groups of a record in which a field is looked for when the record itself has none of that name.
const GROUPS: [&str; 3] = ["estimate", "metrics", "response"];

/// Fields to save, and where.
#[derive(Default)]
pub struct Saves(Vec<(String, PathBuf, Option<ArrayStack>)>);

impl Saves {
    /// Fields and files as the command line names them; a dot leads into a group (`estimate.reflectance`).
    #[must_use]
    pub fn new(requests: &[(String, PathBuf)]) -> Self {
        Self(requests.iter().map(|(field, path)| (field.clone(), path.clone(), None)).collect())
    }

    /// Takes a request out, for a field that a tool writes itself.
    pub fn take(&mut self, field: &str) -> Option<PathBuf> {
        let position = self.0.iter().position(|(name, ..)| name == field)?;
        Some(self.0.remove(position).1)
    }

    /// Adds what the record has of the fields.
    ///
    /// # Errors
    /// As [`ArrayStack::new`] and [`ArrayStack::push`].
    pub fn record(&mut self, fields: &Fields) -> Result<()> {
        for (field, path, stack) in &mut self.0 {
            if let Some((shape, values)) = find(fields, field).as_ref().and_then(numbers) {
                open(stack, path)?.push(&shape, &values)?;
            }
        }
        Ok(())
    }

    /// Writes all arrays.
    ///
    /// # Errors
    /// As [`ArrayStack::finish`].
    pub fn finish(self) -> Result<()> {
        for (_, path, mut stack) in self.0 {
            open(&mut stack, &path)?;
            stack.map_or(Ok(()), ArrayStack::finish)?;
        }
        Ok(())
    }
}

fn open<'a>(stack: &'a mut Option<ArrayStack>, path: &Path) -> Result<&'a mut ArrayStack> {
    match stack {
        Some(stack) => Ok(stack),
        None => Ok(stack.insert(ArrayStack::new(path)?)),
    }
}

fn find(fields: &Fields, name: &str) -> Option<Value> {
    fields.at(name).or_else(|| GROUPS.iter().find_map(|group| fields.at(&format!("{group}.{name}"))))
}

/// Shape and values of a number or of nested lists of one shape, null as NaN; none for anything else.
fn numbers(value: &Value) -> Option<(Vec<u64>, Vec<f64>)> {
    let mut shape = Vec::new();
    measure(value, 0, &mut shape);
    let mut values = Vec::new();
    collect(value, &shape, &mut values)?;
    Some((shape, values))
}

/// Extents by depth; a null stands for a list of whatever extent its neighbours have.
fn measure(value: &Value, depth: usize, shape: &mut Vec<u64>) {
    if let Value::Array(items) = value {
        if shape.len() == depth {
            shape.push(items.len() as u64);
        }
        items.iter().for_each(|item| measure(item, depth + 1, shape));
    }
}

fn collect(value: &Value, shape: &[u64], values: &mut Vec<f64>) -> Option<()> {
    match (value, shape) {
        (Value::Null, _) => {
            let count = usize::try_from(shape.iter().product::<u64>()).ok()?;
            values.resize(values.len() + count, f64::NAN);
            Some(())
        }
        (Value::Number(number), []) => {
            values.push(number.as_f64()?);
            Some(())
        }
        (Value::Array(items), [extent, rest @ ..]) if items.len() as u64 == *extent => {
            items.iter().try_for_each(|item| collect(item, rest, values))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn nested_lists_have_a_shape_and_null_is_nan() {
        let (shape, values) = numbers(&json!([[1, 2], null, [5, 6.5]])).unwrap();
        assert_eq!(shape, [3, 2]);
        assert_eq!(values[..2], [1.0, 2.0]);
        assert!(values[2].is_nan() && values[3].is_nan());
        assert_eq!(values[4..], [5.0, 6.5]);
    }

    #[test]
    fn ragged_lists_and_text_are_no_arrays() {
        assert!(numbers(&json!([[1, 2], [3]])).is_none());
        assert!(numbers(&json!(["a"])).is_none());
        assert_eq!(numbers(&json!(4.0)).unwrap(), (vec![], vec![4.0]));
    }

    #[test]
    fn a_field_is_found_in_its_group() {
        let mut fields = Fields::default();
        fields.set("estimate", json!({ "reflectance": [0.5] })).unwrap();
        assert_eq!(find(&fields, "reflectance"), find(&fields, "estimate.reflectance"));
        assert!(find(&fields, "estimate.nothing").is_none());
    }
}
