//! Detects whether another command writes the tool's input.

use std::io;

use rustix::fs::{FileType, fstat};

/// Whether standard input is a pipe, not a terminal, file or device.
pub(super) fn stdin_is_pipe() -> bool {
    fstat(io::stdin()).is_ok_and(|stat| FileType::from_raw_mode(stat.st_mode) == FileType::Fifo)
}
