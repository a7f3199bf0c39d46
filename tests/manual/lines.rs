//! Comments are no wider than the code, which rustfmt keeps within its `max_width`: all but their code, tables and
//! diagrams, which cannot be wrapped.

use std::fs;
use std::path::Path;

use crate::imports::{SOURCES, files};

const COLUMNS: usize = 110;

/// Numbers of the lines of prose in comments that are wider than that.
fn too_wide(source: &str) -> Vec<usize> {
    let mut is_code = false;
    let mut wide = Vec::new();
    for (n, line) in source.lines().enumerate() {
        let text = line.trim_start();
        let Some(comment) = text.strip_prefix("//") else { continue };
        let comment = comment.trim_start_matches(['/', '!']).trim_start();
        is_code ^= comment.starts_with("```");
        if !is_code && !comment.starts_with('|') && line.chars().count() > COLUMNS {
            wide.push(n + 1);
        }
    }
    wide
}

#[test]
fn comments_are_no_wider_than_code() {
    let config = fs::read_to_string(Path::new(SOURCES).join("../rustfmt.toml")).unwrap();
    assert!(config.contains(&format!("max_width = {COLUMNS}\n")), "{config}");
    let mut wide = Vec::new();
    for file in files(Path::new(SOURCES)) {
        let source = fs::read_to_string(&file).unwrap();
        wide.extend(too_wide(&source).into_iter().map(|line| format!("{}:{line}", file.display())));
    }
    assert!(wide.is_empty(), "wrap these comments: {wide:#?}");
}

#[test]
fn wide_prose_is_seen_and_wide_code_is_not() {
    let long = "word ".repeat(COLUMNS / 5);
    assert_eq!(too_wide(&format!("/// {long}\n/// ```\n/// {long}\n/// ```\n//! | {long}\n")), [1]);
}
