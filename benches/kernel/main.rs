//! Kernels and bounces by every method: time and error side by side.
//!
//! `benches/kernel.sh` runs it, pyviewfactor first, and leaves tables and drawings in `benches/results`.

#![allow(clippy::unwrap_used, reason = "a measurement stops at the first surprise")]
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a measurement for the reader of a terminal")]

#[path = "../common/mod.rs"]
mod common;
mod drawings;
#[path = "../common/marks.rs"]
mod marks;
mod measure;
mod pyviewfactor;
#[allow(dead_code, reason = "another benchmark uses the rest")]
mod reference;
#[path = "../common/solutions.rs"]
mod solutions;
mod steps;
mod table;

const ANGLES_DEG: [f64; 5] = [1.0, 30.0, 45.0, 60.0, 90.0];
const FACETS: [usize; 4] = [10, 16, 64, 256];

fn main() {
    common::on_one_thread();
    let mut rows = Vec::new();
    for angle_deg in ANGLES_DEG {
        for n in FACETS {
            eprintln!("{angle_deg}°, {n}x{n} facets");
            rows.extend(measure::fold(angle_deg, n));
        }
    }
    let theirs = pyviewfactor::rows();
    pyviewfactor::compare(&rows, &theirs);
    rows.extend(theirs);
    table::write("kernel.csv", table::HEAD, rows.iter().map(ToString::to_string));
    let steps: Vec<_> = ANGLES_DEG.into_iter().flat_map(steps::of_fold).collect();
    table::write("response.csv", steps::HEAD, steps.iter().map(ToString::to_string));
    drawings::draw(&rows, &steps);
}
