//! The form of the stream for people: every field of every record, from the schemas. What several fields have
//! in common is listed once.

use std::collections::HashMap;

use serde_json::Value;

use super::schema::records;

/// A kind of record.
#[derive(Clone, Debug)]
pub struct RecordOutline {
    /// Its name.
    pub kind: String,
    /// Its meaning.
    pub description: String,
    /// Tools that write it, if they are the same for all of its fields.
    pub writers: Option<String>,
    /// Its fields; those of a group follow it.
    pub fields: Vec<FieldOutline>,
}

/// A field of a record, or one of its possible forms.
#[derive(Clone, Debug)]
pub struct FieldOutline {
    /// Names from the outermost inwards: `estimate.fit.sky`; `[]` is each item of a list, `NAME` any name, or
    /// any of those just listed.
    pub path: String,
    /// Type and range: `[number from 0 to 1]`; `either` and `or` introduce its forms.
    pub holds: String,
    /// Meaning, unit and shape.
    pub description: String,
    /// Tools that write it, unless it is nested or they are those that write the record.
    pub writers: Option<String>,
}

/// The records of the stream with all their fields.
///
/// # Example
/// ```
/// let records = vfold::stream::outline();
/// let fit = records[1].fields.iter().find(|field| field.path == "estimate.fit.NAME.sd").unwrap();
/// assert_eq!((records[1].kind.as_str(), fit.holds.as_str()), ("sample", "number from 0"));
/// assert_eq!(fit.description, "Standard deviation.");
/// ```
#[must_use]
pub fn outline() -> Vec<RecordOutline> {
    let records = records();
    let mut names = HashMap::new();
    let outline = |(kind, schema): &(String, Value)| {
        let mut walk =
            Walk { root: schema, kind, fields: Vec::new(), listed: HashMap::new(), names: &mut names };
        walk.fields_of(schema, "");
        RecordOutline {
            kind: kind.clone(),
            description: text(schema, "description"),
            writers: schema["x-writer"].as_str().map(str::to_owned),
            fields: walk.fields,
        }
    };
    records.iter().map(outline).collect()
}

/// Text of a keyword on one line, without code marks; empty if it is absent.
fn text(schema: &Value, keyword: &str) -> String {
    schema[keyword]
        .as_str()
        .unwrap_or_default()
        .replace('`', "")
        .split_whitespace()
        .collect::<Vec<_>>()
        .join(" ")
}

/// State of the walk through a record's schema.
struct Walk<'a, 'n> {
    root: &'a Value,
    kind: &'a str,
    fields: Vec<FieldOutline>,
    /// Paths at which referenced objects were listed.
    listed: HashMap<&'a str, String>,
    /// Paths at which a group of names was listed with the same meanings, in any record.
    names: &'n mut HashMap<String, String>,
}

/// At least this many consecutive fields that hold the same objects, or recur in another record, are listed
/// once.
const MANY: usize = 3;

impl<'a> Walk<'a, '_> {
    /// The schema that is referenced, or the schema itself.
    fn resolved(&self, schema: &'a Value) -> &'a Value {
        let target = schema["$ref"].as_str().and_then(|target| target.strip_prefix('#'));
        target.and_then(|pointer| self.root.pointer(pointer)).unwrap_or(schema)
    }

    /// Adds the fields of an object, of the objects in a list, or of each possible form of a value.
    fn fields_of(&mut self, schema: &'a Value, path: &str) {
        let name = |name: &str| if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") };
        let is_needed =
            |field: &str| schema["required"].as_array().is_some_and(|all| all.iter().any(|one| one == field));
        let properties: Vec<_> = schema["properties"].as_object().into_iter().flatten().collect();
        if let Some(place) = self.listed_elsewhere(&properties, path) {
            let description = format!("Of the same names as {place}.");
            self.fields.push(FieldOutline {
                path: name("NAME"),
                holds: self.holds_if_there(properties[0].1),
                description,
                writers: None,
            });
            return;
        }
        let runs: Vec<_> = properties.chunk_by(|(_, a), (_, b)| self.are_alike(a, b)).collect();
        for alike in runs {
            for (field, value) in alike {
                self.field(name(field), value, is_needed(field));
                if let Some(last) = self.fields.last_mut().filter(|last| last.description.is_empty()) {
                    // a field that tells forms apart stands for its form
                    last.description = text(schema, "description");
                }
                if alike.len() < MANY {
                    self.fields_of(value, &name(field));
                }
            }
            if alike.len() >= MANY {
                self.fields_of(alike[0].1, &name("NAME"));
            }
        }
        if schema["additionalProperties"].is_object() {
            self.field(name("NAME"), &schema["additionalProperties"], false);
            if let Some(last) = self.fields.last_mut().filter(|last| last.description.is_empty()) {
                "Each of them.".clone_into(&mut last.description);
            }
            self.fields_of(&schema["additionalProperties"], &name("NAME"));
        }
        if schema["items"].is_object() {
            self.fields_of(&schema["items"], &format!("{path}[]"));
        }
        let forms = self.forms(schema);
        let are_distinct = forms.len() == 1 || schema["oneOf"].is_array();
        for (n, form) in forms.into_iter().enumerate() {
            if !are_distinct {
                self.form(path, n, form);
            }
            self.fields_of(form, path);
        }
        if let Some(target) = schema["$ref"].as_str() {
            let object = self.resolved(schema);
            match (self.listed.get(target), self.fields.last_mut()) {
                // within itself, an object is listed again: otherwise its form would be ambiguous
                (Some(first), Some(last)) if object["properties"].is_object() && !path.starts_with(first) => {
                    last.description += &format!(" Its fields are those of {first}.");
                }
                _ => {
                    self.listed.insert(target, path.to_owned());
                    self.fields_of(object, path);
                }
            }
        }
    }

    /// The path at which all these names were listed with the same meanings.
    fn listed_elsewhere(&mut self, properties: &[(&String, &'a Value)], path: &str) -> Option<String> {
        let all: Vec<_> = properties
            .iter()
            .map(|(name, value)| format!("{name}: {}", text(value, "description")))
            .collect();
        if all.len() < MANY || path.is_empty() {
            return None;
        }
        let place = format!("{path} of a {}", self.kind);
        let known = self.names.entry(all.join("\n")).or_insert_with(|| place.clone());
        (*known != place && !known.ends_with(&format!(" of a {}", self.kind))).then(|| known.clone())
    }

    /// Whether two fields hold the same objects, whatever their meaning.
    fn are_alike(&self, a: &'a Value, b: &'a Value) -> bool {
        let object = |schema| {
            let form = self.forms(schema).first().copied().unwrap_or(schema);
            Some(self.resolved(form)).filter(|form| form["properties"].is_object())
        };
        object(a).is_some_and(|a| object(b).is_some_and(|b| std::ptr::eq(a, b)))
    }

    fn field(&mut self, path: String, schema: &'a Value, is_needed: bool) {
        let holds = if is_needed { self.holds(schema) } else { self.holds_if_there(schema) };
        let description = match text(schema, "description") {
            none if none.is_empty() => text(self.resolved(schema), "description"),
            description => description,
        };
        let writers = schema["x-writer"].as_str().map(str::to_owned);
        self.fields.push(FieldOutline { path, holds, description, writers });
    }

    /// Adds the `n`th form of a value whose forms no field distinguishes.
    fn form(&mut self, path: &str, n: usize, schema: &Value) {
        let holds = if n == 0 { "either" } else { "or" }.to_owned();
        let description = text(schema, "description");
        self.fields.push(FieldOutline { path: path.to_owned(), holds, description, writers: None });
    }

    /// The possible forms of a value, except null.
    fn forms(&self, schema: &'a Value) -> Vec<&'a Value> {
        let forms = schema["anyOf"].as_array().or(schema["oneOf"].as_array());
        forms.into_iter().flatten().filter(|form| form["type"] != "null").collect()
    }

    /// Type and range of a field that may be absent.
    fn holds_if_there(&self, schema: &'a Value) -> String {
        self.holds(schema).trim_end_matches(" or null").to_owned() + ", or absent"
    }

    /// Type and range.
    fn holds(&self, schema: &'a Value) -> String {
        let schema = self.resolved(schema);
        if !schema["const"].is_null() {
            return schema["const"].to_string();
        }
        if let Some(values) = schema["enum"].as_array() {
            return values.iter().map(Value::to_string).collect::<Vec<_>>().join(" or ");
        }
        let forms = self.forms(schema);
        if !forms.is_empty() {
            let mut types: Vec<_> = forms.into_iter().map(|form| self.holds(form)).collect();
            types.dedup();
            return types.join(" or ");
        }
        let types = match &schema["type"] {
            Value::Array(types) => types.iter().filter_map(Value::as_str).collect(),
            one => vec![one.as_str().unwrap_or("object")],
        };
        types.into_iter().map(|kind| self.holds_type(schema, kind)).collect::<Vec<_>>().join(" or ")
    }

    fn holds_type(&self, schema: &'a Value, kind: &str) -> String {
        match kind {
            "array" => {
                let item = self.holds(&schema["items"]);
                let count =
                    schema["minItems"].as_u64().filter(|count| schema["maxItems"].as_u64() == Some(*count));
                count.map_or(format!("[{item}]"), |count| format!("[{count} x {item}]"))
            }
            "number" | "integer" => format!("{kind}{}", range(schema)),
            _ => kind.to_owned(),
        }
    }
}

/// The range of a number in words; for a count, a minimum of 0 is implied.
fn range(schema: &Value) -> String {
    let words = [
        ("exclusiveMinimum", "above"),
        ("minimum", "from"),
        ("exclusiveMaximum", "below"),
        ("maximum", "to"),
    ];
    let is_count = schema["minimum"] == 0 && schema["maximum"].is_null() && schema["format"] != "double";
    let stated = words.iter().filter(|(keyword, _)| schema[*keyword].is_number());
    stated
        .filter(|(keyword, _)| !(is_count && *keyword == "minimum"))
        .map(|(keyword, word)| format!(" {word} {}", schema[*keyword]))
        .collect()
}
