//! What machines do to programs: streams that close, disks that fill, signals, files that may not be read,
//! lines and streams without end. Whatever happens, a file under the wanted name is whole, and the exit
//! status says what became of it.

mod disks;
mod permissions;
mod signals;
mod sizes;
mod streams;

use crate::common::Ended;

/// The five tools at work, each on what [`SETUP`] leaves; more flags may follow.
const RUNS: [(&str, &str); 5] = [
    ("vkernel", "vkernel --facets 3x3"),
    ("vforward", "vforward scene.json --reflectance cc24 --noise-sd 1e-3"),
    ("vextract", "extract photo.exr"),
    ("vestimate", "vestimate samples.ndjson"),
    ("vscore", "vscore estimates.ndjson"),
];

/// The tools that read a stream, and streams of 24 samples for them.
const READERS: [(&str, &str); 3] = [
    ("vforward - --reflectance cc24", "scene.json"),
    ("vestimate", "samples.ndjson"),
    ("vscore", "estimates.ndjson"),
];

/// A failure with this status that says what it is in one line of the tool's.
fn assert_one_line(run: &Ended, tool: &str, status: i32, says: &str, script: &str) {
    let is_one = run.stderr.lines().count() == 1 && run.stderr.starts_with(&format!("{tool}: "));
    assert!(run.status == status && is_one && run.stderr.contains(says), "{script}: {run:?}");
}
