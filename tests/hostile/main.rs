//! Bad input gets one clear line and the right exit status: no panic, no file, no half line; nor do machines
//! that fail leave any.

// a test stops at the first surprise
#![allow(clippy::unwrap_used, clippy::panic)]

mod broken_fields;
mod calibration;
mod cameras;
#[path = "../common/mod.rs"]
mod common;
mod faults;
mod flags;
mod formats;
mod kernels;
mod lights;
mod methods;
mod outputs;
mod photographs;
#[path = "../common/ready.rs"]
mod ready;
mod resume;
mod shapes;
mod spectra;
mod streams;
mod table;

use common::Workdir;

const TOOLS: [&str; 5] = ["vkernel", "vforward", "vextract", "vestimate", "vscore"];

/// A shell line that must fail.
#[derive(Clone, Copy)]
struct Case {
    script: &'static str,
    status: i32,
    /// What the error must say.
    says: &'static [&'static str],
}

const fn case(script: &'static str, status: i32, says: &'static [&'static str]) -> Case {
    Case { script, status, says }
}

/// The script in a memory that a clean run needs, and no more; each thread beyond two would need its own.
fn limited(script: &str) -> String {
    format!("unset RUST_BACKTRACE\nexport RAYON_NUM_THREADS=2\nulimit -v 1500000\n{script}")
}

/// Runs each case in one folder that `setup` has filled.
fn assert_refused(setup: &str, cases: &[Case]) {
    let folder = Workdir::new();
    let ready = folder.sh(setup);
    assert_eq!((ready.status, ready.stderr.as_str()), (0, ""), "{setup}");
    let files = folder.sh("ls -A").stdout;
    let failures: Vec<_> = cases.iter().filter_map(|case| refusal_fault(&folder, case, &files)).collect();
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}

/// What is wrong with the way in which a case is refused, if anything.
fn refusal_fault(folder: &Workdir, case: &Case, files: &str) -> Option<String> {
    let run = folder.sh(&limited(case.script));
    let fault =
        |what: &str| Some(format!("{}\n    {what}: status {}: {}", case.script, run.status, run.stderr));
    let by_tool = TOOLS.iter().any(|tool| run.stderr.starts_with(&format!("{tool}: ")));
    if run.status != case.status {
        return fault(&format!("exit status is not {}", case.status));
    }
    let line = run.stderr.strip_suffix('\n').unwrap_or_default();
    if !by_tool || line.is_empty() || line.contains(char::is_control) {
        return fault("not one line that starts with the tool's name");
    }
    if let Some(word) = case.says.iter().find(|word| !run.stderr.contains(**word)) {
        return fault(&format!("does not say '{word}'"));
    }
    if !run.stdout.is_empty() && !run.stdout.ends_with('\n') {
        return fault("half a line on standard output");
    }
    (folder.sh("ls -A").stdout != *files).then(|| fault("leaves or takes a file")).flatten()
}
