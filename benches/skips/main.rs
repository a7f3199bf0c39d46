//! What is skipped, and what it saves: time with and without, in process, one thread.
//!
//! Each row does the work as it would be done by someone who did not know of the skip, here, and then as the
//! library does it; the results agree to rounding. Markdown goes to standard output and to
//! `benches/results/skips.md`.

#![allow(clippy::unwrap_used, reason = "a measurement stops at the first surprise")]
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a measurement for the reader of a terminal")]

mod bounces;
#[path = "../common/mod.rs"]
mod common;
#[path = "../common/products.rs"]
mod direct;
mod factors;
mod products;
#[path = "../common/solutions.rs"]
mod solutions;
mod wavebands;

use std::fmt::Write;
use std::fs;

use common::{machine, results, timed};

/// The fold of all rows: the default one.
const ANGLE_DEG: f64 = 45.0;

/// One thing that is skipped.
struct Skip {
    what: String,
    without: String,
    with: String,
}

impl Skip {
    fn new(what: impl Into<String>, without: impl Into<String>, with: impl Into<String>) -> Self {
        Self { what: what.into(), without: without.into(), with: with.into() }
    }

    /// The row of the table: both ways timed, and how far apart their results are, relative to the largest
    /// number.
    fn row(self, without: impl FnMut() -> Vec<f64>, with: impl FnMut() -> Vec<f64>) -> String {
        eprintln!("{}", self.what);
        let ((slow_ms, slow), (fast_ms, fast)) = (timed(without), timed(with));
        assert_eq!(slow.len(), fast.len(), "{}", self.what);
        let largest = slow.iter().copied().fold(0.0, f64::max);
        let differences = slow.iter().zip(&fast).map(|(a, b)| (a - b).abs());
        let difference = differences.fold(0.0, f64::max) / largest;
        let Self { what, without, with } = self;
        let ratio = slow_ms / fast_ms;
        format!(
            "| {what} | {without} | {with} | {slow_ms:.3} | {fast_ms:.3} | {ratio:.1} | {difference:.0e} |"
        )
    }
}

fn main() {
    common::on_one_thread();
    let rows = [factors::rows(), bounces::rows(), wavebands::rows(), products::rows()].concat();
    let mut page = format!("# What is skipped\n\n{}; 45°, milliseconds.\n\n", machine());
    page += "| skipped | without | with | without, ms | with, ms | ratio | difference |\n\
             |---|---|---|---|---|---|---|\n";
    rows.iter().for_each(|row| writeln!(page, "{row}").unwrap());
    write!(page, "\n{}", products::break_even()).unwrap();
    print!("{page}");
    fs::write(results("skips.md"), page).unwrap();
}
