//! The form of the stream for people: every field of every record, one after the other, from the schemas.

use serde_json::Value;

use super::schema::records;

/// A kind of record.
#[derive(Clone, Debug)]
pub struct RecordOutline {
    /// Its kind.
    pub kind: String,
    /// What it is.
    pub about: String,
    /// Its fields, those of a group after it.
    pub fields: Vec<FieldOutline>,
}

/// A field of a record, or one form that it can have.
#[derive(Clone, Debug)]
pub struct FieldOutline {
    /// Names from the outermost on: `estimate.fit.sky`; `[]` is each of a list, `NAME` any name.
    pub path: String,
    /// Type and range: `[number from 0 to 1]`; `either` and `or` before its forms.
    pub holds: String,
    /// Meaning, unit and shape.
    pub about: String,
    /// Tools that write it, if it is not within another.
    pub writers: Option<String>,
}

/// The records of the stream with all their fields.
///
/// # Example
/// ```
/// let records = vfold::stream::outline();
/// let fit = records[1].fields.iter().find(|field| field.path == "estimate.fit.sky.sd").unwrap();
/// assert_eq!((records[1].kind.as_str(), fit.holds.as_str()), ("sample", "number from 0"));
/// assert_eq!(fit.about, "Standard deviation.");
/// ```
#[must_use]
pub fn outline() -> Vec<RecordOutline> {
    records().into_iter().map(|(kind, schema)| of_record(kind, &schema)).collect()
}

fn of_record(kind: String, schema: &Value) -> RecordOutline {
    let mut walk = Walk { root: schema, fields: Vec::new() };
    walk.fields_of(schema, "");
    RecordOutline { kind, about: text(schema, "description"), fields: walk.fields }
}

/// Text of a keyword on one line, code as it stands; empty if it is not there.
fn text(schema: &Value, keyword: &str) -> String {
    schema[keyword]
        .as_str()
        .unwrap_or_default()
        .replace('`', "")
        .split_whitespace()
        .collect::<Vec<_>>()
        .join(" ")
}

/// A record's schema on the way through it.
struct Walk<'a> {
    root: &'a Value,
    fields: Vec<FieldOutline>,
}

impl<'a> Walk<'a> {
    /// What a schema refers to, or itself.
    fn resolved(&self, schema: &'a Value) -> &'a Value {
        let target = schema["$ref"].as_str().and_then(|target| target.strip_prefix('#'));
        target.and_then(|pointer| self.root.pointer(pointer)).unwrap_or(schema)
    }

    /// Adds the fields of an object, of the objects in a list, or of each form that a value can have.
    fn fields_of(&mut self, schema: &'a Value, path: &str) {
        let name = |name: &str| if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") };
        let is_needed =
            |field: &str| schema["required"].as_array().is_some_and(|all| all.iter().any(|one| one == field));
        for (field, value) in schema["properties"].as_object().into_iter().flatten() {
            self.field(name(field), value, is_needed(field));
            if let Some(last) = self.fields.last_mut().filter(|last| last.about.is_empty()) {
                last.about = text(schema, "description"); // a field that tells forms apart stands for its form
            }
        }
        if schema["additionalProperties"].is_object() {
            self.field(name("NAME"), &schema["additionalProperties"], false);
        }
        if schema["items"].is_object() {
            self.fields_of(&schema["items"], &format!("{path}[]"));
        }
        let forms = self.forms(schema);
        let are_told_apart = forms.len() == 1 || schema["oneOf"].is_array();
        for (n, form) in forms.into_iter().enumerate() {
            if !are_told_apart {
                self.form(path, n, form);
            }
            self.fields_of(form, path);
        }
        if !schema["$ref"].is_null() {
            self.fields_of(self.resolved(schema), path);
        }
    }

    fn field(&mut self, path: String, schema: &'a Value, is_needed: bool) {
        let holds = self.holds(schema);
        let holds =
            if is_needed { holds } else { holds.trim_end_matches(" or null").to_owned() + ", or absent" };
        let about = match text(schema, "description") {
            none if none.is_empty() => text(self.resolved(schema), "description"),
            about => about,
        };
        let is_outermost = !path.contains(['.', '[']);
        let of_all = self.root["x-writer"].as_str().filter(|_| is_outermost);
        let writers = schema["x-writer"].as_str().or(of_all).map(str::to_owned);
        self.fields.push(FieldOutline { path: path.clone(), holds, about, writers });
        self.fields_of(schema, &path);
    }

    /// Adds the `n`th form of a value, where no field tells its forms apart.
    fn form(&mut self, path: &str, n: usize, schema: &Value) {
        let holds = if n == 0 { "either" } else { "or" }.to_owned();
        let about = text(schema, "description");
        self.fields.push(FieldOutline { path: path.to_owned(), holds, about, writers: None });
    }

    /// The forms of a value that can have several, null aside.
    fn forms(&self, schema: &'a Value) -> Vec<&'a Value> {
        let forms = schema["anyOf"].as_array().or(schema["oneOf"].as_array());
        forms.into_iter().flatten().filter(|form| form["type"] != "null").collect()
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
            let mut kinds: Vec<_> = forms.into_iter().map(|form| self.holds(form)).collect();
            kinds.dedup();
            return kinds.join(" or ");
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

/// The range of a number as words; that a count is not negative goes without saying.
fn range(schema: &Value) -> String {
    let words = [
        ("exclusiveMinimum", "above"),
        ("minimum", "from"),
        ("exclusiveMaximum", "below"),
        ("maximum", "to"),
    ];
    let is_count = schema["minimum"] == 0 && schema["maximum"].is_null() && schema["format"] != "double";
    let said = words.iter().filter(|(keyword, _)| schema[*keyword].is_number());
    said.filter(|(keyword, _)| !(is_count && *keyword == "minimum"))
        .map(|(keyword, word)| format!(" {word} {}", schema[*keyword]))
        .collect()
}
