//! Licences of the crates whose code is in the programs: `share/LICENSES/THIRD-PARTY.md` lists them,
//! `deny.toml` allows them.

use std::collections::BTreeSet;
use std::fmt::Write;
use std::fs;
use std::path::Path;

use super::metadata::{linked, metadata, others};
use super::{path, text};
use serde_json::Value;

const HEADER: &str = "\
# What else is in the programs

Crates linked into vfold's programs (Linux, feature `raw`), their licences and whose they are; \
where a licence is a choice, the first
of MIT, Apache-2.0 and the others holds. Texts are beside this file. \
rawler, and what it alone brings, is only in programs that read RAW
files: they may be built anew with another rawler, as LGPL-2.1 has it, from vfold's own source.
`LICENSES=write cargo test --test supply` makes this table anew.

| crate | version | licence | copyright |
|---|---|---|---|
";

/// `LICENSES=write cargo test --test supply` rewrites the table.
#[test]
fn the_table_of_licences_is_up_to_date() {
    let file = path("share/LICENSES/THIRD-PARTY.md");
    let metadata = metadata();
    let mut rows: Vec<String> = linked(&metadata).into_iter().map(row).collect();
    rows.sort_unstable();
    let table = format!("{HEADER}{}", rows.concat());
    if std::env::var("LICENSES").is_ok_and(|what| what == "write") {
        fs::write(file, table).unwrap();
    } else {
        let kept = fs::read_to_string(file).unwrap();
        assert!(kept == table, "stale: LICENSES=write cargo test --test supply writes it anew");
    }
}

/// Rows of crates that are linked.
fn row(package: &Value) -> String {
    let [name, version, licence] = ["name", "version", "license"].map(|key| package[key].as_str().unwrap());
    let folder = Path::new(package["manifest_path"].as_str().unwrap()).parent().unwrap();
    let whose = copyrights(folder).into_iter().collect::<Vec<_>>().join("; ").replace('|', "/");
    let mut row = String::new();
    writeln!(row, "| {name} | {version} | {} | {whose} |", spdx(licence)).unwrap();
    row
}

/// Whose a crate is by the files beside its manifest; the text of a licence itself has such lines as well.
fn copyrights(folder: &Path) -> BTreeSet<String> {
    const FILES: [&str; 5] = ["licen", "copying", "copyright", "notice", "unlicense"];
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let named = files.filter(|file| {
        let name = file.file_name().unwrap().to_string_lossy().to_lowercase();
        file.is_file() && FILES.iter().any(|start| name.starts_with(start))
    });
    let texts = named.map(|file| String::from_utf8_lossy(&fs::read(file).unwrap()).into_owned());
    let lines = texts.flat_map(|text| text.lines().map(|line| line.trim().to_owned()).collect::<Vec<_>>());
    lines.filter_map(|line| holder(&line)).collect()
}

/// `2019 Nick Fitzgerald` of `Copyright (c) 2019 Nick Fitzgerald`.
fn holder(line: &str) -> Option<String> {
    let rest = line.strip_prefix("Copyright")?.trim_start();
    let marked = ["(c)", "(C)", "©"].iter().find_map(|mark| rest.strip_prefix(mark));
    let whose = marked.unwrap_or(rest).trim().trim_end_matches('.');
    let says = marked.is_some() || whose.starts_with(|first: char| first.is_ascii_digit());
    (says && !whose.is_empty()).then(|| whose.to_owned())
}

/// An expression in the present notation: `/` once stood for `OR`.
fn spdx(licence: &str) -> String {
    licence.replace('/', " OR ")
}

/// Licences that `deny.toml` allows for any crate.
fn allowed() -> Vec<String> {
    let deny = text("deny.toml");
    let list = deny.split("\nallow = [").nth(1).unwrap().split(']').next().unwrap();
    list.split('"').skip(1).step_by(2).map(str::to_owned).collect()
}

/// Of the crates that `deny.toml` makes exceptions for, name and licence.
fn exceptions() -> Vec<[String; 2]> {
    let deny = text("deny.toml");
    let each = deny.split("{ allow = [\"").skip(1);
    each.map(|rest| {
        [rest.split("crate = \"").nth(1).unwrap(), rest]
            .map(|rest| rest.split('"').next().unwrap().to_owned())
    })
    .collect()
}

/// Whether an expression can be met with the licences of the list: one of each group of choices.
fn is_met(expression: &str, allowed: &[String]) -> bool {
    let groups = expression.split(" AND ").map(|group| group.trim_matches(['(', ')']));
    groups
        .into_iter()
        .all(|group| group.split(" OR ").any(|one| allowed.iter().any(|licence| licence == one)))
}

#[test]
fn licences_are_those_that_deny_toml_allows() {
    let (allowed, exceptions, metadata) = (allowed(), exceptions(), metadata());
    assert_eq!(exceptions, [["rawler", "LGPL-2.1"]]);
    for package in others(&metadata) {
        let [name, licence] = ["name", "license"].map(|key| package[key].as_str().unwrap());
        let licence = spdx(licence);
        let is_exception = exceptions.contains(&[name.to_owned(), licence.clone()]);
        assert!(is_exception || is_met(&licence, &allowed), "{name}: {licence}");
    }
    for bad in ["GPL-3.0", "LGPL-3.0", "MIT AND GPL-3.0", "(GPL-2.0 OR AGPL-3.0) AND MIT", ""] {
        assert!(!is_met(bad, &allowed), "{bad}");
    }
}

#[test]
fn texts_of_licences_are_at_hand() {
    let files = fs::read_dir(path("share/LICENSES")).unwrap().map(|entry| entry.unwrap().file_name());
    let texts: Vec<String> =
        files.filter_map(|name| Some(name.to_str()?.strip_suffix(".txt")?.to_owned())).collect();
    let metadata = metadata();
    for package in linked(&metadata) {
        let licence = spdx(package["license"].as_str().unwrap());
        assert!(is_met(&licence, &texts), "{}: {licence}, share/LICENSES has {texts:?}", package["name"]);
    }
}
