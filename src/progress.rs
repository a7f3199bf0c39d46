//! A line on standard error that says how far a long run is.

use std::fmt;
use std::io::{self, IsTerminal, Write};
use std::path::Path;
use std::sync::OnceLock;
use std::time::{Duration, Instant};

use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};

use crate::message::one_line;

/// Runs shorter than this show nothing.
const DELAY: Duration = Duration::from_millis(500);
/// How often the line is drawn though nothing happens.
const REDRAW: Duration = Duration::from_millis(500);
/// How far lines in a file are apart.
const LOG_INTERVAL: Duration = Duration::from_secs(10);

/// The line that is being drawn, of which a process has one.
static LINE: OnceLock<ProgressBar> = OnceLock::new();

/// When progress is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum When {
    /// On a terminal, by the tool at the end of a pipeline whose records go to a file: no two tools share the
    /// line.
    Auto,
    /// Whatever standard error is: redrawn on a terminal, else a line now and then, and the total at the end.
    Always,
    /// Never.
    Never,
}

/// Counts samples, and shows how many there are, how fast they pass and how long it takes.
#[derive(Debug)]
pub struct Progress {
    tool: String,
    bar: ProgressBar,
    /// When the next line is due, where there is no terminal.
    next: Option<Instant>,
}

impl Progress {
    /// The progress of `tool`; `to_file` says whether its records go to a file of their own.
    #[must_use]
    pub fn new(tool: &str, when: When, to_file: bool) -> Self {
        let to_file = to_file || Path::new("/dev/stdout").metadata().is_ok_and(|out| out.is_file());
        let terminal = io::stderr().is_terminal();
        let wanted = when == When::Always || (when == When::Auto && to_file);
        let bar = if wanted && terminal { drawn(tool) } else { ProgressBar::hidden() };
        let next = (when == When::Always && !terminal).then(|| Instant::now() + LOG_INTERVAL);
        Self { tool: tool.to_owned(), bar, next }
    }

    /// Says how many samples there will be.
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

    /// Leaves the total in place of the line.
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
    /// A run that ends with an error leaves no line before it.
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

/// Writes a line to standard error, above that of the progress; unlike `eprintln!` it survives a closed one.
pub fn say(tool: &str, message: &str) {
    let write = || drop(writeln!(io::stderr(), "{tool}: {}", one_line(message)));
    LINE.get().map_or_else(write, |line| line.suspend(write));
}

/// A line on the terminal, of nothing at first.
fn drawn(tool: &str) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr_with_hz(5));
    // the one error is that of a template which cannot be read
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
        return write!(line, "{tool}: at work for {:#}", HumanDuration(state.elapsed()));
    }
    write!(line, "{tool}: {}, {:.1}/s", Count { samples: state.pos(), of: state.len() }, state.per_sec())?;
    match state.len() {
        Some(_) => write!(line, ", {:#} left", HumanDuration(state.eta())),
        None => Ok(()),
    }
}

/// Samples that have passed, and of how many if that is known.
struct Count {
    samples: u64,
    of: Option<u64>,
}

impl fmt::Display for Count {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.of {
            Some(of) if of != self.samples => write!(f, "{} of {of} samples", self.samples),
            _ => write!(f, "{} samples", self.samples),
        }
    }
}
