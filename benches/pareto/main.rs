//! Time against error of the kernel, the response and the estimate, at every setting of what steers them.
//!
//! `benches/pareto.sh` runs it, adds whole pipelines and what other libraries take, and has it draw
//! everything: `pareto kernel|response|estimate [SET.csv]` prints rows, `pareto draw STAGE` reads them and
//! leaves a table and a drawing in `benches/results`, `pareto growth` says how the kernel grows with the
//! facets.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a measurement stops at the first surprise")]
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a measurement for the reader of a terminal")]

#[path = "../common/mod.rs"]
mod common;
mod drawing;
mod estimate;
mod growth;
mod kernel;
#[path = "../common/marks.rs"]
mod marks;
mod point;
#[path = "../common/products.rs"]
mod products;
#[path = "../kernel/reference.rs"]
#[allow(dead_code, reason = "another benchmark uses the rest")]
mod reference;
mod response;
#[path = "../common/samples.rs"]
#[allow(dead_code, reason = "another benchmark uses the rest")]
mod samples;
#[path = "../common/solutions.rs"]
mod solutions;
#[path = "../common/tools.rs"]
mod tools;

fn main() {
    common::on_one_thread();
    // Cargo adds a flag of its own.
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match arguments.as_slice() {
        ["kernel"] => kernel::measure(),
        ["response"] => response::measure(),
        ["estimate", sets @ ..] => estimate::measure(sets),
        ["draw", stage] => drawing::draw(stage),
        ["growth"] => growth::measure(),
        _ => panic!("give kernel, response, estimate, growth or draw STAGE"),
    }
}
