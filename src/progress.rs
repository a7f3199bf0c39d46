//! A line on standard error that counts samples while a long run lasts.

use std::io::{IsTerminal, Write};
use std::path::Path;
use std::time::{Duration, Instant};

/// Runs shorter than this draw nothing, and redraws are this far apart.
const INTERVAL: Duration = Duration::from_millis(500);

/// When the line is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum When {
    /// On a terminal, by the tool at the end of a pipeline whose records go to a file: no two tools share the line.
    Auto,
    /// Whatever standard error is, and the total at the end.
    Always,
    /// Never.
    Never,
}

/// Counts samples, and shows the count now and then.
#[derive(Debug)]
pub struct Progress {
    tool: String,
    when: When,
    count: usize,
    next: Instant,
    drawn: bool,
}

impl Progress {
    /// The progress of `tool`; `to_file` says whether its records go to a file of their own.
    #[must_use]
    pub fn new(tool: &str, when: When, to_file: bool) -> Self {
        let to_file = to_file || Path::new("/dev/stdout").metadata().is_ok_and(|out| out.is_file());
        let alone = to_file && std::io::stderr().is_terminal();
        let when = if when == When::Auto && !alone { When::Never } else { when };
        Self { tool: tool.to_owned(), when, count: 0, next: Instant::now() + INTERVAL, drawn: false }
    }

    /// Counts one sample.
    pub fn tick(&mut self) {
        self.count += 1;
        if self.when != When::Never && Instant::now() >= self.next {
            self.draw("");
            self.next = Instant::now() + INTERVAL;
        }
    }

    /// Ends the line.
    pub fn finish(&mut self) {
        if self.drawn || self.when == When::Always {
            self.draw("\n");
        }
    }

    /// A closed standard error is no reason to stop.
    fn draw(&mut self, end: &str) {
        let _ = write!(std::io::stderr(), "\r{}: {} samples{end}", self.tool, self.count);
        self.drawn = true;
    }
}
