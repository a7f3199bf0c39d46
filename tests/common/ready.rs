//! A folder in which each of the tools finds something to work on.

use std::ffi::OsString;
use std::fs;
use std::sync::LazyLock;

use crate::common::{Ended, Workdir};

/// Names and bytes of what `setup.sh` leaves: the tools run once for all tests.
static FILES: LazyLock<Vec<(OsString, Vec<u8>)>> = LazyLock::new(|| {
    let folder = Workdir::new();
    let run = folder.sh(include_str!("setup.sh"));
    assert_eq!((run.status, run.stderr.as_str()), (0, ""));
    let entries = fs::read_dir(folder.path()).unwrap().map(Result::unwrap);
    entries.map(|entry| (entry.file_name(), fs::read(entry.path()).unwrap())).collect()
});

/// A fresh folder with these files, which all may enter.
pub fn ready() -> Workdir {
    let folder = Workdir::new();
    for (name, bytes) in FILES.iter() {
        fs::write(folder.path().join(name), bytes).unwrap();
    }
    // records say when a picture was written: the same in all folders
    folder.sh("touch -d 2024-06-21T12:00Z *; chmod 755 .");
    folder
}

/// Runs a script that knows `extract`, which takes a photograph and further flags.
pub fn sh(folder: &Workdir, script: &str) -> Ended {
    folder.sh(&format!("extract() {{ sh extract \"$@\"; }}\n{script}"))
}
