//! The form of the stream as JSON Schema, derived from the types that write and read it.

use schemars::generate::SchemaSettings;
use schemars::transform::RecursiveTransform;
use schemars::{JsonSchema, Schema};
use serde_json::{Map, Value, json};

use super::plan::PlanRecord;
use super::sample_record::SampleRecord;
use super::scene_record::SceneRecord;
use super::scores::SummaryRecord;
use super::trace::IterationRecord;

const DRAFT: &str = "https://json-schema.org/draft/2020-12/schema";
/// Identifiers of the schemas: of the stream and, with the kind appended, of its records.
const NAME: &str = "urn:vfold:1";

/// Schema of one line of the stream, indented: `$defs` contains those of all kinds of record, which are also
/// complete by themselves. Other kinds of record are allowed, because the tools pass them on.
///
/// # Example
/// ```
/// let schema: serde_json::Value = serde_json::from_str(&vfold::stream::schema())?;
/// let angle = &schema["$defs"]["scene"]["$defs"]["FoldRecord"]["properties"]["angle_deg"];
/// assert_eq!(angle["description"], "Angle between the panels, degrees; 180 is a flat sheet.");
/// # Ok::<(), serde_json::Error>(())
/// ```
#[must_use]
pub fn schema() -> String {
    let records = records();
    let rule = |(kind, _): &(String, Value)| {
        let is_it = json!({ "properties": { "kind": { "const": kind } } });
        json!({ "if": is_it, "then": { "$ref": format!("{NAME}:{kind}") } })
    };
    let schema = json!({
        "$schema": DRAFT,
        "$id": NAME,
        "title": "vfold/1",
        "description": "A line of the stream.",
        "type": "object",
        "properties": { "kind": { "type": "string" } },
        "required": ["kind"],
        "allOf": records.iter().map(rule).collect::<Vec<_>>(),
        "$defs": records.into_iter().collect::<Map<_, _>>(),
    });
    format!("{schema:#}")
}

/// The schema of every kind of record, in the order of the stream.
pub(super) fn records() -> Vec<(String, Value)> {
    vec![
        of::<SceneRecord>(),
        of::<SampleRecord>(),
        of::<SummaryRecord>(),
        of::<PlanRecord>(),
        of::<IterationRecord>(),
    ]
}

/// The schema of a kind of record, as written by the tools. Its first field, added by serde, is its kind.
fn of<T: JsonSchema>() -> (String, Value) {
    let settings =
        SchemaSettings::draft2020_12().for_serialize().with_transform(RecursiveTransform(no_default));
    let mut schema = settings.into_generator().into_root_schema_for::<T>();
    let kind = schema.get("title").and_then(Value::as_str).unwrap_or_default().to_owned();
    let record = schema.ensure_object();
    record.shift_insert(0, "$id".to_owned(), format!("{NAME}:{kind}").into());
    if let Some(Value::Object(fields)) = record.get_mut("properties") {
        let named = json!({ "description": "Kind of the record.", "const": kind });
        fields.shift_insert(0, "kind".to_owned(), named);
    }
    if let Some(Value::Array(required)) = record.get_mut("required") {
        required.insert(0, "kind".into());
    }
    (kind, schema.to_value())
}

/// Fields that are written but not read have no default.
fn no_default(schema: &mut Schema) {
    if schema.get("readOnly").is_some() {
        schema.remove("default");
    }
}
