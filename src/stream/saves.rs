//! `--save FIELD=FILE`: any numeric field of the records as an NPY array.

use std::path::{Path, PathBuf};

use ndarray::ArrayD;
use serde_json::Value;

use super::fields::VALUES_MAX;
use super::{ArrayStack, Fields};
use crate::error::Result;

/// Groups of a record that are searched for a field that the record itself lacks.
const GROUPS: [&str; 3] = ["estimate", "metrics", "response"];

/// Fields to be saved, and their files.
#[derive(Default)]
pub struct Saves(Vec<(String, PathBuf, Option<ArrayStack>)>);

impl Saves {
    /// Fields and files in the terms of the command line; a dot selects a member of a group
    /// (`estimate.reflectance`).
    #[must_use]
    pub fn new(requests: &[(String, PathBuf)]) -> Self {
        Self(requests.iter().map(|(field, path)| (field.clone(), path.clone(), None)).collect())
    }

    /// Removes a request for a field that a tool writes itself.
    pub fn take(&mut self, field: &str) -> Option<PathBuf> {
        let position = self.0.iter().position(|(name, ..)| name == field)?;
        Some(self.0.remove(position).1)
    }

    /// Adds the requested fields of a record.
    ///
    /// # Errors
    /// As [`ArrayStack::new`] and [`ArrayStack::push`].
    pub fn record(&mut self, fields: &Fields) -> Result<()> {
        for (field, path, stack) in &mut self.0 {
            if let Some(array) = find(fields, field).as_ref().and_then(numbers) {
                open(stack, path)?.push(array.view())?;
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

/// A number or nested lists of uniform shape, null as NaN; none for anything else.
fn numbers(value: &Value) -> Option<ArrayD<f64>> {
    let mut shape = Vec::new();
    measure(value, 0, &mut shape);
    let mut values = Vec::new();
    collect(value, &shape, &mut values)?;
    ArrayD::from_shape_vec(shape, values).ok()
}

/// Lengths by depth; a null represents a list of the same length as its neighbours.
fn measure(value: &Value, depth: usize, shape: &mut Vec<usize>) {
    if let Value::Array(items) = value {
        if shape.len() == depth {
            shape.push(items.len());
        }
        items.iter().for_each(|item| measure(item, depth + 1, shape));
    }
}

fn collect(value: &Value, shape: &[usize], values: &mut Vec<f64>) -> Option<()> {
    match (value, shape) {
        (Value::Null, _) => {
            // the text of nulls is short: a small record may ask for any amount of memory
            let count = shape.iter().try_fold(1, |count: usize, extent| count.checked_mul(*extent))?;
            let all = values.len().checked_add(count).filter(|all| *all <= VALUES_MAX)?;
            values.resize(all, f64::NAN);
            Some(())
        }
        (Value::Number(number), []) => {
            values.push(number.as_f64()?);
            Some(())
        }
        (Value::Array(items), [extent, rest @ ..]) if items.len() == *extent => {
            items.iter().try_for_each(|item| collect(item, rest, values))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use ndarray::{arr0, arr1};
    use serde_json::json;

    use super::*;

    #[test]
    fn nested_lists_have_a_shape_and_null_is_nan() {
        let array = numbers(&json!([[1, 2], null, [5, 6.5]])).unwrap();
        assert_eq!(array.shape(), [3, 2]);
        let rows: Vec<_> = array.outer_iter().collect();
        assert_eq!(rows[0], arr1(&[1.0, 2.0]).into_dyn());
        assert!(rows[1].iter().all(|value| value.is_nan()));
        assert_eq!(rows[2], arr1(&[5.0, 6.5]).into_dyn());
    }

    #[test]
    fn ragged_lists_and_text_are_no_arrays() {
        assert!(numbers(&json!([[1, 2], [3]])).is_none());
        assert!(numbers(&json!(["a"])).is_none());
        assert_eq!(numbers(&json!(4.0)).unwrap(), arr0(4.0).into_dyn());
    }

    /// A short text would otherwise take any amount of memory.
    #[test]
    fn nulls_stand_for_no_more_than_a_field_may_hold() {
        let (rows, nulls) = (VALUES_MAX / 1000, vec![json!(null); 2000]);
        let with_nulls = |nulls: &[Value]| json!([&[json!(vec![0; rows])], nulls].concat());
        assert_eq!(numbers(&with_nulls(&nulls[..10])).unwrap().shape(), [11, rows]);
        assert!(numbers(&with_nulls(&nulls)).is_none());
    }

    #[test]
    fn a_field_is_found_in_its_group() {
        let mut fields = Fields::default();
        fields.set("estimate", json!({ "reflectance": [0.5] })).unwrap();
        assert_eq!(find(&fields, "reflectance"), find(&fields, "estimate.reflectance"));
        assert!(find(&fields, "estimate.nothing").is_none());
    }
}
