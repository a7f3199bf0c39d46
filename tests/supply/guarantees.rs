//! `docs/guarantees.md`: every promise names tests, and every test it names is there and is run.

use std::fs;

use super::{path, sources, text};

/// What stands in backticks.
fn quoted(line: &str) -> impl Iterator<Item = &str> {
    line.split('`').skip(1).step_by(2)
}

/// Names of tests, `file::name`, and golden cases, `tests/golden/*.sh`, of a promise.
fn named(line: &str) -> Vec<&str> {
    quoted(line).filter(|word| word.contains(".rs::") || word.starts_with("tests/golden/")).collect()
}

/// Whether `file::name` is a test of that file, or a golden case is there; ignored tests hold nothing.
fn is_run(test: &str) -> bool {
    let Some((file, name)) = test.split_once("::") else { return path(test).is_file() };
    let source = fs::read_to_string(path(file)).unwrap_or_default();
    let Some((before, _)) = source.split_once(&format!("fn {name}(")) else { return false };
    let attributes = before.rsplit("\n\n").next().unwrap_or_default();
    attributes.contains("#[test]") && !attributes.contains("#[ignore")
}

#[test]
fn every_promise_names_tests_that_are_run() {
    let guarantees = text("docs/guarantees.md");
    let rows: Vec<&str> = guarantees.lines().filter(|line| line.starts_with("| **")).collect();
    assert!(rows.len() >= 15, "{} promises", rows.len());
    for row in rows {
        assert!(!named(row).is_empty(), "no test holds: {row}");
    }
    for test in guarantees.lines().flat_map(named) {
        assert!(is_run(test), "docs/guarantees.md names {test}, which is no test");
    }
}

#[test]
fn a_test_that_is_not_there_is_missed() {
    assert!(is_run("tests/tools/cli.rs::threads_change_no_byte"));
    assert!(is_run("tests/numbers/laws.rs::exchange_is_mutual"));
    assert!(is_run("tests/golden/01-howell.sh"));
    let missing = [
        "tests/tools/cli.rs::threads_change_a_byte",
        "tests/none.rs::none",
        "tests/tools/cli.rs::after_setup",
    ];
    assert!(missing.into_iter().chain(["tests/golden/none.sh"]).all(|test| !is_run(test)));
}

/// A file that no `mod` names is compiled nowhere, and nobody says so.
#[test]
fn every_file_of_tests_is_part_of_a_test() {
    for file in sources(&path("tests")) {
        let (folder, name) = (file.parent().unwrap(), file.file_stem().unwrap().to_str().unwrap());
        let is_root = name == "main" || folder == path("tests");
        let (at, name) = if name == "mod" {
            (folder.parent().unwrap(), folder.file_name().unwrap().to_str().unwrap())
        } else {
            (folder, name)
        };
        let declared = |root: &str| {
            let source = fs::read_to_string(at.join(root)).unwrap_or_default();
            source.lines().any(|line| line == format!("mod {name};") || line == format!("pub mod {name};"))
        };
        let shared = folder == path("tests/common");
        assert!(
            is_root || shared || declared("main.rs") || declared("mod.rs"),
            "{}: no `mod` names it",
            file.display()
        );
    }
}

/// Cargo is told not to look for any, which saves building every tool twice.
#[test]
fn tools_have_no_unit_tests() {
    for file in sources(&path("src/bin")) {
        let source = fs::read_to_string(&file).unwrap();
        assert!(!source.contains("#[test]"), "{}: tests of tools go to tests/tools", file.display());
    }
}
