//! The verdicts on the estimates, printed on a terminal once all records are written.

use std::io::{self, IsTerminal};

use vfold::cli;
use vfold::stream::{LevelRecord, VerdictRecord};

/// Most samples with a line each.
const LINES: usize = 24;

/// The verdicts of a stream.
#[derive(Default)]
pub struct Verdicts {
    /// A line for each of the first samples.
    lines: Vec<String>,
    good: usize,
    doubtful: usize,
    wrong: usize,
    /// The first that is not good.
    first: Option<String>,
}

impl Verdicts {
    /// None if nobody would read them, because standard error is not a terminal.
    pub fn on_terminal() -> Option<Self> {
        io::stderr().is_terminal().then(Self::default)
    }

    pub fn add(&mut self, id: &str, verdict: &VerdictRecord) {
        let line = format!("{id}: {verdict}");
        match verdict.level {
            LevelRecord::Good => self.good += 1,
            LevelRecord::Doubtful => self.doubtful += 1,
            LevelRecord::Wrong => self.wrong += 1,
        }
        if verdict.level != LevelRecord::Good && self.first.is_none() {
            self.first = Some(line.clone());
        }
        if self.lines.len() <= LINES {
            self.lines.push(line);
        }
    }

    /// Prints a line each, or their counts if the lines would fill the terminal.
    pub fn say(&self) {
        if self.lines.len() <= LINES {
            return self.lines.iter().for_each(|line| cli::say("vestimate", line));
        }
        let Self { good, doubtful, wrong, .. } = self;
        let first = self.first.as_ref().map(|line| format!("; first: {line}")).unwrap_or_default();
        cli::say("vestimate", &format!("{good} good, {doubtful} doubtful, {wrong} wrong{first}"));
    }
}
