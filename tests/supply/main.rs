//! What vfold is made of, and what it promises: its crates, their licences, the oldest Rust they build with;
//! and `docs/guarantees.md`, which names the tests that hold each promise.

// a test stops at the first surprise
#![allow(clippy::unwrap_used)]

#[path = "../common/mod.rs"]
mod common;

mod crates;
mod guarantees;
mod licences;
mod metadata;
mod runs;

use std::path::{Path, PathBuf};

/// A file or folder of the project.
fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

fn text(name: &str) -> String {
    std::fs::read_to_string(path(name)).unwrap()
}

/// All `.rs` files in a folder and its folders.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let (folders, files): (Vec<PathBuf>, Vec<PathBuf>) =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).partition(|path| path.is_dir());
    let here = files.into_iter().filter(|path| path.extension().is_some_and(|ending| ending == "rs"));
    here.chain(folders.iter().flat_map(|folder| sources(folder))).collect()
}
