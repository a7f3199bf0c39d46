//! Lines are no wider than rustfmt's `max_width`. It wraps neither strings nor comments, and leaves
//! what stands around a string that is too wide as it is.

use std::fs;
use std::path::Path;

use crate::imports::files;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

const COLUMNS: usize = 110;

/// Numbers of the lines that are wider than that, but for tables in comments, which cannot be wrapped.
fn too_wide(source: &str) -> Vec<usize> {
    let is_table = |line: &str| ["//! |", "/// |"].iter().any(|start| line.trim_start().starts_with(start));
    let is_wide = |line: &str| line.chars().count() > COLUMNS && !is_table(line);
    (1..).zip(source.lines()).filter(|(_, line)| is_wide(line)).map(|(n, _)| n).collect()
}

#[test]
fn lines_are_no_wider_than_rustfmt_makes_them() {
    let config = fs::read_to_string(Path::new(ROOT).join("rustfmt.toml")).unwrap();
    assert!(config.contains(&format!("max_width = {COLUMNS}\n")), "{config}");
    let folders = ["benches", "examples", "share", "src", "tests"];
    let all = folders.map(|folder| files(&Path::new(ROOT).join(folder))).concat();
    let mut wide = Vec::new();
    for file in all.iter().filter(|file| file.extension().is_some_and(|ending| ending == "rs")) {
        let source = fs::read_to_string(file).unwrap();
        wide.extend(too_wide(&source).into_iter().map(|line| format!("{}:{line}", file.display())));
    }
    assert!(wide.is_empty(), "wrap these lines, strings with a \\ at the end: {wide:#?}");
}

#[test]
fn wide_lines_are_seen_and_wide_tables_are_not() {
    let long = "word ".repeat(COLUMNS / 5);
    let fits = format!("{}é", &long[1..]);
    assert_eq!(too_wide(&format!("/// {long}\n//! | {long}\n{fits}\n    \"{long}\"\n")), [1, 4]);
}
