//! A line on standard error that shows the progress of a long run.

use std::fmt;
use std::io::{self, IsTerminal, Write};
use std::path::Path;
use std::sync::OnceLock;
use std::time::{Duration, Instant};

use clap::ValueEnum;
use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};

use crate::error::counted;
use crate::message::one_line;

/// Runs shorter than this show nothing.
const DELAY: Duration = Duration::from_millis(500);
/// Interval at which the line is redrawn even if nothing happens.
const REDRAW: Duration = Duration::from_millis(500);
/// Interval between lines in a file.
const LOG_INTERVAL: Duration = Duration::from_secs(10);

/// The line being drawn; a process has only one.
static LINE: OnceLock<ProgressBar> = OnceLock::new();

/// When progress is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum When {
    /// On a terminal, when the records go to a file.
    // so that no two tools of a pipeline share the line
    Auto,
    /// Always.
    // redrawn on a terminal, else a line now and then and the total at the end
    Always,
    /// Never.
    Never,
}

/// Counts samples and shows their number, their rate and the remaining time.
#[derive(Debug)]
pub struct Progress {
    tool: String,
    bar: ProgressBar,
    /// When the next line is due, if there is no terminal.
    next: Option<Instant>,
}

impl Progress {
    /// The progress of `tool`; `to_file` is true if its records go to a file of their own.
    #[must_use]
    pub fn new(tool: &str, when: When, to_file: bool) -> Self {
        let to_file = to_file || Path::new("/dev/stdout").metadata().is_ok_and(|out| out.is_file());
        let terminal = io::stderr().is_terminal();
        let wanted = when == When::Always || (when == When::Auto && to_file);
        let bar = if wanted && terminal { drawn(tool) } else { ProgressBar::hidden() };
        let next = (when == When::Always && !terminal).then(|| Instant::now() + LOG_INTERVAL);
        Self { tool: tool.to_owned(), bar, next }
    }

    /// Sets the expected number of samples.
    pub fn expect(&mut self, samples: usize) {
        self.bar.set_length(samples as u64);
    }

    /// Counts one sample.
    pub fn tick(&mut self) {
        self.bar.inc(1);
        if self.next.is_some_and(|next| Instant::now() >= next) {
            self.say_count("");
            self.next = Some(Instant::now() + LOG_INTERVAL);
        }
    }

    /// Replaces the line by the total.
    pub fn finish(&mut self) {
        let (shown, elapsed) = (!self.bar.is_hidden(), self.bar.elapsed());
        self.bar.finish_and_clear();
        if shown && elapsed >= DELAY && self.bar.position() > 0 {
            self.say_count(&format!(" in {:#}", HumanDuration(elapsed)));
        } else if self.next.is_some() {
            self.say_count("");
        }
    }

    fn say_count(&self, end: &str) {
        say(&self.tool, &format!("{}{end}", Count { samples: self.bar.position(), of: self.bar.length() }));
    }
}

impl Drop for Progress {
    /// A run that ends with an error leaves no line before the message.
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

/// Writes a line to standard error, above that of the progress; unlike `eprintln!` it survives a closed
/// stream.
pub fn say(tool: &str, message: &str) {
    let write = || drop(writeln!(io::stderr(), "{tool}: {}", one_line(message)));
    LINE.get().map_or_else(write, |line| line.suspend(write));
}

/// A line on the terminal, empty at first.
fn drawn(tool: &str) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr_with_hz(5));
    // the only possible error is a template that cannot be parsed
    if let Ok(style) = ProgressStyle::with_template("{progress}") {
        let tool = tool.to_owned();
        bar.set_style(style.with_key("progress", move |state: &ProgressState, line: &mut dyn fmt::Write| {
            let _ = write_line(&tool, state, line);
        }));
    }
    bar.enable_steady_tick(REDRAW);
    LINE.get_or_init(|| bar).clone()
}

fn write_line(tool: &str, state: &ProgressState, line: &mut dyn fmt::Write) -> fmt::Result {
    if state.elapsed() < DELAY {
        return Ok(());
    }
    if state.pos() == 0 {
        return write!(line, "{tool}: running for {:#}", HumanDuration(state.elapsed()));
    }
    write!(line, "{tool}: {}, {:.1}/s", Count { samples: state.pos(), of: state.len() }, state.per_sec())?;
    match state.len() {
        Some(_) => write!(line, ", {:#} left", HumanDuration(state.eta())),
        None => Ok(()),
    }
}

/// The number of samples so far, and the total if it is known.
struct Count {
    samples: u64,
    of: Option<u64>,
}

impl fmt::Display for Count {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.of {
            Some(of) if of != self.samples => write!(f, "{} of {of} samples", self.samples),
            _ => f.write_str(&counted(self.samples, "sample")),
        }
    }
}
