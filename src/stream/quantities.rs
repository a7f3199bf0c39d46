//! The fitted unknowns by name.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{DeserializeOwned, Error};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::{Map, Value};

use crate::estimate::unknowns::{self, TABLE, Unknown};

/// One value for each fitted unknown of a scene, in the order of [`TABLE`]; the others are absent.
#[derive(Clone, Debug)]
pub(super) struct Quantities<T>(Vec<(&'static Unknown, T)>);

impl<T> Quantities<T> {
    /// From a list; none if it is empty.
    pub(super) fn of(list: impl IntoIterator<Item = (&'static Unknown, T)>) -> Option<Self> {
        let mut all: Vec<_> = list.into_iter().collect();
        all.sort_by_key(|(unknown, _)| TABLE.iter().position(|one| one == unknown));
        if all.is_empty() { None } else { Some(Self(all)) }
    }

    /// The values present.
    pub(super) fn iter(&self) -> impl Iterator<Item = (&'static Unknown, &T)> {
        self.0.iter().map(|(unknown, one)| (*unknown, one))
    }
}

impl<T: Serialize> Serialize for Quantities<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.iter().map(|(unknown, one)| (unknown.name, one)))
    }
}

/// Unknown names are skipped.
impl<'de, T: DeserializeOwned> Deserialize<'de> for Quantities<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let mut all = Vec::new();
        for (name, value) in Map::deserialize(deserializer)? {
            let Some(unknown) = unknowns::named(&name) else { continue };
            let one = Option::<T>::deserialize(value);
            let one = one.map_err(|error| D::Error::custom(format!("{name}: {error}")))?;
            all.extend(one.map(|one| (unknown, one)));
        }
        Ok(Self(all))
    }
}

impl<T: JsonSchema> JsonSchema for Quantities<T> {
    fn schema_name() -> Cow<'static, str> {
        "Quantities".into()
    }

    fn schema_id() -> Cow<'static, str> {
        format!("Quantities<{}>", T::schema_id()).into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let property = |unknown: &&Unknown| {
            let mut schema = generator.subschema_for::<Option<T>>();
            schema.insert("description".to_owned(), description(unknown).into());
            (unknown.name.to_owned(), schema.to_value())
        };
        let properties: Map<String, Value> = TABLE.iter().map(property).collect();
        json_schema!({
            "type": "object",
            "properties": properties,
            "description": "A value for each quantity of the scene that was fitted; others are absent.",
        })
    }
}

/// The description of an unknown, with its unit.
fn description(unknown: &Unknown) -> String {
    let unit = unknown.unit.map(|unit| format!(", {unit}")).unwrap_or_default();
    format!("{}{unit}.", unknown.description)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // a test stops at the first surprise

    use super::*;
    use crate::estimate::unknowns::{EXPOSURE, SKY, TILT};

    #[test]
    fn fits_are_written_in_the_order_of_the_table() {
        let fit: Quantities<f64> = Quantities::of([(&SKY, 0.2), (&EXPOSURE, 1.5), (&TILT, 4.5)]).unwrap();
        assert_eq!(serde_json::to_string(&fit).unwrap(), r#"{"exposure":1.5,"tilt_deg":4.5,"sky":0.2}"#);
        assert!(Quantities::<f64>::of([]).is_none());
    }

    #[test]
    fn what_is_not_known_is_passed_over() {
        let fit: Quantities<f64> = serde_json::from_str(r#"{"fog":{},"sky":0.2,"angle_deg":null}"#).unwrap();
        assert_eq!(fit.iter().collect::<Vec<_>>(), [(&SKY, &0.2)]);
    }
}
