//! Runs every `tests/golden/*.sh` in a fresh folder and compares what it prints with the `.out` beside it:
//! text exactly, numbers to 1e-10 of the larger (1e-12 near zero; outside JSON also by one unit of the last
//! decimal), or as the script's first line `# tolerance RELATIVE ABSOLUTE` says.
//! `GOLDEN=write cargo test --test golden` rewrites; read the diff. What a prior moves, scores of estimates
//! above all, is no case's digits: `tests/golden/below` says in their place whether they keep a bound.

// a test stops at the first surprise
#![allow(clippy::unwrap_used, clippy::panic)]

mod common;

use std::fs;
use std::path::{Path, PathBuf};

use common::Workdir;
use rayon::prelude::*;
use serde_json::Value;

/// Programs that the cases call, each with a line that runs only where it is there, and what to do where it
/// is not.
const NEEDED: [(&str, &str, &str); 2] = [
    ("oiiotool", "oiiotool --version", "apt-get install openimageio-tools"),
    (
        "NumPy",
        "python3 -c 'import numpy'",
        "run tests/run, which makes a Python with it, or pip install numpy",
    ),
];

/// How far apart two numbers may be: of the larger one, and near zero.
#[derive(Clone, Copy)]
struct Tolerance {
    relative: f64,
    absolute: f64,
}

impl Tolerance {
    /// That of a script, from its first line.
    fn of(script: &str) -> Self {
        let first = script.lines().next().unwrap_or_default();
        let Some(numbers) = first.strip_prefix("# tolerance ") else {
            return Self { relative: 1e-10, absolute: 1e-12 };
        };
        let (relative, absolute) = numbers.split_once(' ').unwrap();
        Self { relative: relative.parse().unwrap(), absolute: absolute.parse().unwrap() }
    }

    fn allows(self, a: f64, b: f64) -> bool {
        (a - b).abs() <= self.absolute.max(self.relative * a.abs().max(b.abs()))
    }
}

#[test]
fn every_case_prints_what_it_did() {
    for (what, line, remedy) in NEEDED {
        let found = Workdir::new().sh(line).status == 0;
        assert!(found, "the golden cases need {what}: {remedy}");
    }
    let differing: Vec<_> = cases().par_iter().filter_map(|case| difference(case)).collect();
    assert!(differing.is_empty(), "\n{}\nGOLDEN=write accepts what is printed now", differing.join("\n"));
}

fn cases() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden");
    let mut cases: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    cases.retain(|path| path.extension().is_some_and(|extension| extension == "sh"));
    cases.sort();
    cases
}

/// What is wrong with a case, if anything.
fn difference(case: &Path) -> Option<String> {
    let script = fs::read_to_string(case).unwrap();
    let run = Workdir::new().sh(&format!("PATH='{}':$PATH\n{script}", case.parent().unwrap().display()));
    // a shell knows only the last status of a pipeline, but no tool fails without a word
    if run.status != 0 || !run.stderr.is_empty() {
        return Some(format!("{}: exit status {}: {}", case.display(), run.status, run.stderr));
    }
    let expected = case.with_extension("out");
    if std::env::var("GOLDEN").is_ok_and(|what| what == "write") {
        fs::write(expected, run.stdout).unwrap();
        return None;
    }
    let expected = fs::read_to_string(&expected).unwrap_or_default();
    compare(&run.stdout, &expected, Tolerance::of(&script)).map(|what| format!("{}:{what}", case.display()))
}

/// The first line and place at which two texts differ.
fn compare(got: &str, want: &str, tolerance: Tolerance) -> Option<String> {
    let (got_lines, want_lines) = (got.lines().count(), want.lines().count());
    if got_lines != want_lines {
        return Some(format!("{}: {got_lines} lines, not {want_lines}", got_lines.min(want_lines) + 1));
    }
    let differs =
        |(n, (got, want))| Some(format!("{}: {}", n + 1, unlike(&parse(got), &parse(want), "", tolerance)?));
    got.lines().zip(want.lines()).enumerate().find_map(differs)
}

/// A line as a JSON record, or as a list of words, cells and elements.
fn parse(line: &str) -> Value {
    let words = || line.split_whitespace().flat_map(|word| word.split([',', '<', '>']));
    serde_json::from_str(line).unwrap_or_else(|_| words().collect())
}

/// Where two values differ: `path.to.field[i]: got, not want`.
fn unlike(got: &Value, want: &Value, path: &str, tolerance: Tolerance) -> Option<String> {
    match (got, want) {
        (Value::Object(a), Value::Object(b)) if a.keys().eq(b.keys()) => {
            a.iter().find_map(|(key, value)| unlike(value, &b[key], &format!("{path}.{key}"), tolerance))
        }
        (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
            let place = |n| format!("{path}[{n}]");
            a.iter().zip(b).enumerate().find_map(|(n, (a, b))| unlike(a, b, &place(n), tolerance))
        }
        (Value::Number(a), Value::Number(b)) if a.is_f64() || b.is_f64() => {
            let close = tolerance.allows(a.as_f64().unwrap(), b.as_f64().unwrap());
            (!close).then(|| format!("{path}: {a}, not {b}"))
        }
        (Value::String(a), Value::String(b)) if a.contains('.') && same_printed(a, b, tolerance) => None,
        _ => (got != want).then(|| format!("{path}: {got}, not {want}")),
    }
}

/// Whether two words are numbers close to each other, or one unit of their last decimal apart: a table
/// rounds.
fn same_printed(got: &str, want: &str, tolerance: Tolerance) -> bool {
    let (Ok(a), Ok(b)) = (got.parse::<f64>(), want.parse::<f64>()) else { return false };
    let decimals = want.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    tolerance.allows(a, b) || (a - b).abs() < 1.5 * 0.1_f64.powi(decimals as i32)
}

#[test]
fn a_difference_is_named_by_its_path() {
    let tolerance = Tolerance::of("vkernel");
    let compare = |got, want| compare(got, want, tolerance);
    assert_eq!(compare(r#"{"a":{"b":[1.0,2.0]}}"#, r#"{"a":{"b":[1.0,2.0000000001]}}"#), None);
    assert_eq!(
        compare(r#"{"a":{"b":[1.0,2.0]}}"#, r#"{"a":{"b":[1.0,2.1]}}"#).unwrap(),
        "1: .a.b[1]: 2.0, not 2.1"
    );
    assert_eq!(compare("x\nred 0.5 3", "x\nred 0.5 4").unwrap(), "2: [2]: \"3\", not \"4\"");
    assert_eq!(compare("red 0.018", "red 0.017"), None);
    assert_eq!(compare("400,0.018,0.2", "400,0.017,0.2"), None);
    assert_eq!(compare("red 0.019", "red 0.017").unwrap(), "1: [1]: \"0.019\", not \"0.017\"");
    assert_eq!(compare("x", "x\ny").unwrap(), "2: 1 lines, not 2");
    assert!(compare(r#"{"a":1}"#, r#"{"b":1}"#).is_some());
    assert_eq!(compare("[1e-13]", "[-1e-13]"), None);
}
