//! What Cargo knows of the crates in `Cargo.lock`, `raw` among its features, for the machine of the Debian
//! package.

use std::collections::BTreeSet;
use std::process::Command;

use serde_json::Value;

/// `cargo metadata`; it needs no network, since whoever runs this has built it.
pub fn metadata() -> Value {
    let run = Command::new(env!("CARGO"))
        .args(["metadata", "--format-version", "1", "--locked", "--offline", "--features", "raw"])
        .args(["--filter-platform", "x86_64-unknown-linux-gnu"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    serde_json::from_slice(&run.stdout).unwrap()
}

/// Every crate but vfold, those for tests included.
pub fn others(metadata: &Value) -> Vec<&Value> {
    list(&metadata["packages"]).iter().filter(|package| package["name"] != "vfold").collect()
}

/// Crates whose code is in the programs: those that only run while others are compiled are left out.
pub fn linked(metadata: &Value) -> Vec<&Value> {
    let mut found = BTreeSet::new();
    let mut ahead = vec![metadata["resolve"]["root"].as_str().unwrap()];
    while let Some(id) = ahead.pop() {
        if found.insert(id) {
            let deps = list(&by_id(&metadata["resolve"]["nodes"], id)["deps"]).iter();
            let normal = deps.filter(|dep| list(&dep["dep_kinds"]).iter().any(|kind| kind["kind"].is_null()));
            ahead.extend(normal.map(|dep| dep["pkg"].as_str().unwrap()).filter(|id| !is_macro(metadata, id)));
        }
    }
    others(metadata).into_iter().filter(|package| found.contains(package["id"].as_str().unwrap())).collect()
}

/// Whether a crate is a procedural macro.
fn is_macro(metadata: &Value, id: &str) -> bool {
    let targets = list(&by_id(&metadata["packages"], id)["targets"]);
    targets.iter().any(|target| list(&target["kind"]).contains(&Value::from("proc-macro")))
}

pub fn list(value: &Value) -> &[Value] {
    value.as_array().unwrap()
}

fn by_id<'a>(all: &'a Value, id: &str) -> &'a Value {
    list(all).iter().find(|one| one["id"] == id).unwrap()
}
