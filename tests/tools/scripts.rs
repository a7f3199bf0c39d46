//! Shell scripts that no test runs whole can be read by their shells all the same.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const FOLDERS: [&str; 5] = [".ci", "benches", "examples", "share", "tests"];

/// Files below a folder.
fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries.flat_map(|path| if path.is_dir() { files(&path) } else { vec![path] }).collect()
}

/// The shell that a file's first line names.
fn shell(path: &Path) -> Option<&'static str> {
    let bytes = fs::read(path).unwrap();
    let first = bytes.split(|byte| *byte == b'\n').next()?;
    match std::str::from_utf8(first).ok()? {
        "#!/bin/sh" => Some("sh"),
        "#!/usr/bin/env bash" => Some("bash"),
        _ => None,
    }
}

#[test]
fn every_script_can_be_read() {
    let project = Path::new(env!("CARGO_MANIFEST_DIR"));
    let all = FOLDERS.iter().flat_map(|folder| files(&project.join(folder)));
    let scripts: Vec<_> = all.filter_map(|path| Some((shell(&path)?, path))).collect();
    assert!(scripts.len() > 20, "{scripts:?}");
    for (shell, path) in scripts {
        let read = Command::new(shell).arg("-n").arg(&path).output().unwrap();
        assert!(read.status.success(), "{}", String::from_utf8_lossy(&read.stderr));
    }
}
