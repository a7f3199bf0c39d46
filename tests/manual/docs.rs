//! The documentation is true as far as it can be run: blocks of `sh` of every page, in their order, in a clone, with no file that no page
//! makes; links lead to files; tables between marks are those of benches/results. What needs pictures or machines of the reader's stands in blocks
//! of `console`.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::common::{Ended, Workdir};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// By how many lines of text a curve in a plot that a page shows may be off from what is printed now: a change of the prior moves it a little.
const LINES_OFF: usize = 1;

/// A clone, as far as pages need it: nothing that they do not make themselves.
const SETUP: &str = r#"
export LC_ALL=C.UTF-8
for part in tests share examples; do ln -s "$ROOT/$part" $part; done
"#;

/// The fenced blocks of a kind.
fn blocks<'a>(page: &'a str, kind: &str) -> Vec<&'a str> {
    let starts = page.split(&format!("\n```{kind}\n")).skip(1).collect::<Vec<_>>();
    starts.into_iter().map(|block| block.split("\n```\n").next().unwrap()).collect()
}

/// Runs a page from its first block to its last.
fn read_along(page: &str) -> Ended {
    Workdir::new().sh(&format!("ROOT='{ROOT}'{SETUP}{}", blocks(page, "sh").join("\n")))
}

/// README.md and all pages of docs.
fn pages() -> Vec<(PathBuf, String)> {
    let docs = fs::read_dir(Path::new(ROOT).join("docs")).unwrap().map(|entry| entry.unwrap().path());
    let pages = docs.filter(|path| path.extension().is_some_and(|ending| ending == "md"));
    let others = ["README.md", "CONTRIBUTING.md", "docs/paper/README.md", "examples/cluster/README.md"]
        .map(|name| Path::new(ROOT).join(name));
    pages.chain(others).map(|path| (path.clone(), fs::read_to_string(path).unwrap())).collect()
}

#[test]
fn every_page_runs() {
    for (path, page) in pages() {
        // tests/tools/cluster.rs runs the scripts of that page
        if path.ends_with("examples/cluster/README.md") {
            continue;
        }
        let run = read_along(&page);
        assert_eq!(run.status, 0, "{}: {run:?}", path.display());
    }
}

#[test]
fn the_readme_shows_what_is_printed() {
    let page = fs::read_to_string(Path::new(ROOT).join("README.md")).unwrap();
    let shown = blocks(&page, "text");
    let run = read_along(&page);
    assert!(!shown.is_empty() && shown.iter().all(|text| is_printed(text, &run.stderr)), "{}", run.stderr);
}

/// Whether a plot is printed as a page shows it: frame, axes and letters exactly, the curve in each column within [`LINES_OFF`], bars
/// anyhow.
fn is_printed(shown: &str, printed: &str) -> bool {
    let shown: Vec<&str> = shown.lines().collect();
    let printed: Vec<&str> = printed.lines().collect();
    printed.windows(shown.len()).any(|lines| {
        let frames = shown.iter().zip(lines).all(|(shown, line)| frame(shown) == frame(line));
        frames && curve_is_near(&shown, lines) && curve_is_near(lines, &shown)
    })
}

/// Of a line of a plot all but what is drawn in it.
fn frame(line: &str) -> &str {
    match line.find(['┤', '│']) {
        Some(axis) => &line[..axis],
        None => line,
    }
}

/// Dots of a curve, by line and column.
fn dots(plot: &[&str]) -> Vec<(usize, usize)> {
    let in_line = |(row, line): (usize, &&str)| {
        let is_dot = |letter: char| ('\u{2801}'..='\u{28ff}').contains(&letter);
        let columns = line[frame(line).len()..].chars().enumerate();
        columns.filter(|(_, letter)| is_dot(*letter)).map(|(column, _)| (row, column)).collect::<Vec<_>>()
    };
    plot.iter().enumerate().flat_map(in_line).collect()
}

/// Whether each dot of a plot has one of another's in its column, or beside it, at most so many lines away.
fn curve_is_near(plot: &[&str], other: &[&str]) -> bool {
    let there = dots(other);
    dots(plot).into_iter().all(|(row, column)| {
        there.iter().any(|at| at.0.abs_diff(row) <= LINES_OFF && at.1.abs_diff(column) <= 1)
    })
}

#[test]
fn tables_between_marks_are_those_of_the_results() {
    let check = Command::new("python3")
        .args(["-B", "benches/figures.py", "--check"])
        .current_dir(ROOT)
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&check.stdout) + String::from_utf8_lossy(&check.stderr);
    assert!(check.status.success(), "benches/all figures writes them anew: {said}");
}

#[test]
fn a_newcomer_gets_through() {
    let run = read_along(include_str!("../../docs/tutorial.md"));
    assert!(
        run.stderr.contains(r#"--panel0 "358.28,441.60 346.13,100.03 155.42,55.00 166.27,426.90""#),
        "{run:?}"
    );
    let scores: Vec<Vec<&str>> = run
        .stdout
        .lines()
        .filter(|line| line.starts_with("mean "))
        .map(|line| line.split_whitespace().skip(1).collect())
        .collect();
    assert_eq!(scores.len(), 3, "{}", run.stdout);
    for score in scores {
        let [rmse, delta_e] = [0, 1].map(|n| score[n].parse::<f64>().unwrap());
        assert!(rmse < 0.03 && delta_e < 0.6, "{score:?}");
    }
}

#[test]
fn links_lead_somewhere() {
    let mut missing = Vec::new();
    for (path, page) in pages() {
        for link in page.split("](").skip(1).map(|rest| rest.split([')', '#']).next().unwrap()) {
            let inside = !link.is_empty() && !link.contains("://");
            if inside && !path.with_file_name(link).exists() {
                missing.push(format!("{}: {link}", path.display()));
            }
        }
    }
    assert!(missing.is_empty(), "{missing:#?}");
}
