//! docs/tutorial.md runs as it stands: its blocks of shell, in their order, in an empty folder.

// a test stops at the first surprise
#![allow(clippy::unwrap_used)]

mod common;

use common::Workdir;

/// Lines of the fenced blocks of `sh`.
fn shell(page: &str) -> String {
    let blocks = page.split("\n```sh\n").skip(1);
    blocks.map(|block| block.split("\n```\n").next().unwrap()).collect::<Vec<_>>().join("\n")
}

#[test]
fn a_newcomer_gets_through() {
    let page = include_str!("../docs/tutorial.md");
    let run = Workdir::new().sh(&shell(page));
    assert_eq!(run.status, 0, "{run:?}");
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
