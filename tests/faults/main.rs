//! What machines do to programs: streams that close, disks that fill, signals, files that may not be read, lines and streams
//! without end. Whatever happens, a file under the wanted name is whole, and the exit status says what became of it.

// a test stops at the first surprise, and says what it leaves out
#![allow(clippy::unwrap_used, clippy::print_stdout)]

#[path = "../common/mod.rs"]
mod common;
mod disks;
mod permissions;
mod signals;
mod sizes;
mod streams;

use common::{Ended, Workdir};

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

/// Leaves a scene, samples, estimates, a photograph and a command that knows its corners, in a folder that all may enter.
const SETUP: &str = concat!(
    "chmod 755 .\ncp '",
    env!("CARGO_MANIFEST_DIR"),
    "/tests/data/photos/a_ideal_magenta_50.exr' photo.exr",
    r#"
vkernel --angle-deg 50 --facets 2x2 -o scene.json
vforward scene.json --reflectance cc24 --noise-sd 1e-3 -o samples.ndjson
vestimate samples.ndjson -o estimates.ndjson
cat > extract <<'END'
exec vextract "$@" --scene "${scene:-scene.json}" --camera canon-5d-mark-ii \
    --panel0 "332,462 345,77 122,12 104,442" --panel1 "332,462 345,77 485,17 472,446"
END
extract() { sh extract "$@"; }
"#
);

/// A folder after [`SETUP`].
fn ready() -> Workdir {
    let folder = Workdir::new();
    let run = folder.sh(SETUP);
    assert_eq!((run.status, run.stderr.as_str()), (0, ""));
    folder
}

/// Runs a script that knows `extract`.
fn sh(folder: &Workdir, script: &str) -> Ended {
    folder.sh(&format!("extract() {{ sh extract \"$@\"; }}\n{script}"))
}

/// A failure with this status that says what it is in one line of the tool's.
fn assert_one_line(run: &Ended, tool: &str, status: i32, says: &str, script: &str) {
    let is_one = run.stderr.lines().count() == 1 && run.stderr.starts_with(&format!("{tool}: "));
    assert!(run.status == status && is_one && run.stderr.contains(says), "{script}: {run:?}");
}

/// Whether a script runs at all; if not, a line says what is left out.
fn can(folder: &Workdir, script: &str, otherwise: &str) -> bool {
    let can = folder.sh(script).status == 0;
    if !can {
        println!("left out: {otherwise}");
    }
    can
}
