//! A fresh folder in which shell lines run with the five tools first on PATH: those of the tests, or those in
//! the folder `TOOLS`.

use std::fs::OpenOptions;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use tempfile::TempDir;

/// The folder; it goes when the test ends.
pub struct Workdir(TempDir);

/// What a shell line left.
#[derive(Debug)]
pub struct Ended {
    pub status: i32,
    pub stdout: String,
    pub stderr: String,
}

impl Workdir {
    pub fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    pub fn path(&self) -> &Path {
        self.0.path()
    }

    /// Runs a script with `sh -eu`.
    pub fn sh(&self, script: &str) -> Ended {
        let built = Path::new(env!("CARGO_BIN_EXE_vkernel")).parent().unwrap().to_owned();
        let tools = std::env::var_os("TOOLS").map_or(built, PathBuf::from);
        let others = std::env::var_os("PATH").unwrap_or_default();
        let path = std::iter::once(tools).chain(std::env::split_paths(&others));
        let run = Command::new("sh")
            .args(["-eu", "-c", script])
            .current_dir(self.path())
            .env("PATH", std::env::join_paths(path).unwrap())
            .output();
        Ended::from(run.unwrap())
    }

    /// Whether a line runs, as it does where a program is installed; if not, says what is left out.
    /// `tests/run` brings what it can.
    #[allow(dead_code)] // for the tests that need more than the tools
    pub fn can(&self, line: &str, otherwise: &str) -> bool {
        let can = self.sh(line).status == 0;
        if !can {
            left_out(&format!("{otherwise}: '{line}' fails"));
        }
        can
    }
}

/// Whether a file or folder beside the project is there; if not, says that what needs it is left out.
#[allow(dead_code)] // for the tests that need more than the project
pub fn is_there(path: &str) -> bool {
    let is_there = Path::new(path).exists();
    if !is_there {
        left_out(&format!("what needs {path}, which is not there"));
    }
    is_there
}

/// Says what is left out, in the file `LEFT_OUT`, which `tests/run` prints in the end, or on standard error.
#[allow(dead_code)] // for the tests that need more than the project
pub fn left_out(what: &str) {
    let line = format!("left out: {what}\n");
    let said = match std::env::var_os("LEFT_OUT") {
        Some(file) => OpenOptions::new()
            .append(true)
            .create(true)
            .open(file)
            .and_then(|mut file| file.write_all(line.as_bytes())),
        // not by `print`, which shows nothing of a test that passes
        None => io::stderr().write_all(line.as_bytes()),
    };
    said.unwrap();
}

impl Ended {
    /// Whether all records were written, and nothing was said but how many samples failed, and why the first
    /// did: a line from each tool.
    #[allow(dead_code)] // for the tests in which samples fail
    pub fn says_what_failed(&self) -> bool {
        let lines = self.stderr.lines().count();
        self.status == 3 && lines > 0 && self.said_otherwise().is_empty()
    }

    /// What was said beside how many samples failed.
    #[allow(dead_code)] // for the tests in which samples fail
    pub fn said_otherwise(&self) -> Vec<&str> {
        self.stderr.lines().filter(|line| !line.contains(" failed; first: ")).collect()
    }
}

impl From<Output> for Ended {
    fn from(run: Output) -> Self {
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
        // a shell reports a child killed by a signal as 128 + signal; its own death has no status
        Self { status: run.status.code().unwrap_or(-1), stdout: text(run.stdout), stderr: text(run.stderr) }
    }
}
