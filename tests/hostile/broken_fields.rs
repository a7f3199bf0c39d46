//! Samples of which one field, at any depth, is not what it should be: they pass, with an error where the
//! field is needed, and no tool stops for them.

use std::fmt::Write;
use std::fs;

use serde_json::{Map, Value, json};
use tempfile::NamedTempFile;

use crate::common::Workdir;

/// A scored sample with all that tools write.
const STREAM: &str = "vkernel --angle-deg 50 --facets 2x2 | vforward --reflectance cc24:red --noise-sd 1e-3 |
    vestimate | vscore --colour -o scored.ndjson";

/// Tools with what they draw and write besides records.
const RUNS: [&str; 10] = [
    "vestimate -q",
    "vestimate -q --plot drawn.svg",
    "vestimate -q --save reflectance=array.npy",
    "vforward --reflectance 0.5",
    "vscore",
    "vscore --colour --by camera.name",
    "vscore --plot drawn.svg",
    "vscore --report page.html",
    "vscore --spectra spectra.csv",
    "vscore --plot - 2>/dev/null",
];

/// What a field may hold instead.
fn instead() -> [Value; 9] {
    [
        json!(null),
        json!(true),
        json!(-1),
        json!(3),
        json!("x"),
        json!([]),
        json!([1]),
        json!([[["x"]]]),
        json!({"rmse": "x"}),
    ]
}

/// The object once for each of its fields, and theirs, with each of [`instead`] in its place.
fn broken(fields: &Map<String, Value>) -> Vec<Map<String, Value>> {
    let with = |name: &str, value: Value| {
        let mut copy = fields.clone();
        copy.insert(name.to_owned(), value);
        copy
    };
    let mut all = Vec::new();
    for (name, value) in fields {
        all.extend(instead().map(|value| with(name, value)));
        if let Value::Object(inner) = value {
            all.extend(broken(inner).into_iter().map(|inner| with(name, inner.into())));
        }
    }
    all
}

#[test]
fn no_sample_stops_a_batch() {
    let folder = Workdir::new();
    let made = folder.sh(&format!("{STREAM}; cat scored.ndjson"));
    assert_eq!((made.status, made.stderr.as_str()), (0, ""));
    let mut lines = made.stdout.lines();
    let (scene, sample) = (lines.next().unwrap(), lines.next().unwrap());
    let mut fields: Map<String, Value> = serde_json::from_str(sample).unwrap();
    // Without it a line is no sample.
    let kind = fields.remove("kind").unwrap();
    let mut stream = format!("{scene}\n");
    let samples = broken(&fields);
    for mut sample in samples.iter().cloned() {
        sample.insert("kind".to_owned(), kind.clone());
        writeln!(stream, "{}", Value::from(sample)).unwrap();
    }
    let broken = NamedTempFile::new().unwrap();
    fs::write(&broken, stream).unwrap();
    for run in RUNS {
        let ended = folder.sh(&format!(
            "{run} < '{}' > out || [ $? = 3 ]; grep -c '\"kind\":\"sample\"' out",
            broken.path().display()
        ));
        let passed: usize = ended.stdout.trim().parse().unwrap();
        assert!(
            ended.said_otherwise().is_empty() && passed >= samples.len(),
            "{run}: {passed} of {}, {ended:?}",
            samples.len()
        );
    }
}
