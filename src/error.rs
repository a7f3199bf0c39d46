//! Every error of the five tools: where it is, what is wrong, what to do.

use std::borrow::Cow;
use std::io;

/// What can go wrong, in one line a user can act on.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    // ---- command line (exit status 2) ----
    /// A flag's value is outside what the tool can do.
    #[error("{flag}: {problem}; {remedy}")]
    Usage {
        /// The flag, with its dashes.
        flag: &'static str,
        /// What is wrong with the value.
        problem: String,
        /// What to write instead.
        remedy: String,
    },

    // ---- files ----
    /// A file cannot be opened, read or written.
    #[error("{path}: {}", in_words(source))]
    File {
        /// The file, `-` for standard input or output.
        path: String,
        /// What the operating system said.
        source: io::Error,
    },
    /// Standard output cannot be written.
    #[error("standard output: {}", in_words(.0))]
    Output(#[source] io::Error),

    // ---- the stream ----
    /// The pipe that standard input is had nothing in it: the command before it failed, and has said why. The
    /// tools end with status 1 and say no more.
    #[error("nothing came from the command before this one")]
    EmptyPipe,
    /// A line of the stream is not a record, or one of another JSON file is not what it should be.
    #[error("{path}:{line}: {problem}; {remedy}")]
    Record {
        /// The file, `-` for standard input.
        path: String,
        /// Line number, from 1.
        line: usize,
        /// What is wrong.
        problem: String,
        /// What to do.
        remedy: String,
    },
    /// What is wrong with a record of a stream.
    #[error("{path}:{line}: {source}")]
    Located {
        /// The stream's file, `-` for standard input.
        path: String,
        /// Line number, from 1.
        line: usize,
        /// What is wrong, and what to do.
        source: Box<Self>,
    },
    /// A record lacks a field, or the field does not hold what it should.
    #[error("field '{field}': {problem}")]
    Field {
        /// The field's path in the record.
        field: String,
        /// What is wrong, and what to do.
        problem: String,
    },
    /// An NPY array cannot be used.
    #[error("{path}: {problem}")]
    Array {
        /// The NPY file.
        path: String,
        /// What is wrong, and what to do.
        problem: String,
    },

    // ---- spectra ----
    /// Wavelengths do not make a grid.
    #[error("wavelength grid: {problem}; {remedy}")]
    Grid {
        /// What is wrong.
        problem: String,
        /// What to do.
        remedy: &'static str,
    },
    /// A spectrum cannot be what it is used as.
    #[error("spectrum '{name}': {problem}; {remedy}")]
    Spectrum {
        /// The spectrum's name.
        name: String,
        /// What is wrong, with the offending value.
        problem: String,
        /// What to do.
        remedy: String,
    },
    /// A line of a table of spectra cannot be read.
    #[error("{path}:{line}: {problem}; {remedy}")]
    Table {
        /// The table's file.
        path: String,
        /// Line number, from 1.
        line: usize,
        /// What is wrong, with the column.
        problem: String,
        /// What to do.
        remedy: String,
    },
    /// A name is neither built in nor a file.
    #[error("no {kind} is called '{name}'; {hint}")]
    UnknownName {
        /// Illuminant, reflectance or camera.
        kind: &'static str,
        /// What was asked for.
        name: String,
        /// The nearest names, and how to see all of them.
        hint: String,
    },

    // ---- photographs ----
    /// A picture file cannot be used.
    #[error("{path}: {problem}; {remedy}")]
    Picture {
        /// The picture file.
        path: String,
        /// What is wrong with it.
        problem: String,
        /// What to do.
        remedy: String,
    },
    /// Four corners do not bound a panel in the picture.
    #[error("{problem}; {remedy}")]
    Corners {
        /// Which corner, and what is wrong with it.
        problem: String,
        /// What to give instead.
        remedy: String,
    },
    /// A file of regions cannot be used.
    #[error("{path}: {problem}; {remedy}")]
    Regions {
        /// The file.
        path: String,
        /// What is wrong, with the field.
        problem: String,
        /// What to do.
        remedy: String,
    },

    // ---- shapes ----
    /// A surface cannot be used.
    #[error("{name}: {problem}; {remedy}")]
    Shape {
        /// Its file, or just `shape`.
        name: String,
        /// What is wrong with it.
        problem: String,
        /// What to do.
        remedy: String,
    },

    /// The patches of a surface exchange more light than is kept.
    #[error("{name}: the exchange between {patches} patches fills more than a gigabyte; take a coarser mesh")]
    FullExchange {
        /// Its file, or just `shape`.
        name: String,
        /// How many there are.
        patches: usize,
    },

    // ---- numbers ----
    /// A check ran and found a law broken.
    #[error("the kernel breaks a law: {0}")]
    BrokenLaw(String),
    /// A computation cannot give a meaningful number.
    #[error("{0}")]
    Numeric(String),

    /// No sample has what a drawing shows; the records are whole.
    #[error("--plot: {0}; check the samples' errors")]
    NothingToDraw(&'static str),
    /// There is no room for what a computation takes.
    #[error("{what}: no room for {megabytes} MB; {remedy}, or allow more memory (ulimit -v)")]
    Memory {
        /// What it is for.
        what: String,
        /// How much it takes.
        megabytes: u64,
        /// What to do without more memory.
        remedy: &'static str,
    },

    // ---- ours ----
    /// The tool came upon something that it was not written for.
    #[error("a fault of this program: {0}; report it with what it was given")]
    Fault(String),
}

impl Error {
    /// The exit status that belongs to this error: 2 for wrong usage, 1 for bad data or I/O.
    #[must_use]
    pub fn exit_status(&self) -> u8 {
        match self {
            Self::Usage { .. } => 2,
            Self::Located { source, .. } => source.exit_status(),
            _ => 1,
        }
    }

    /// Whether this is what a check found, or what records lack for a drawing: what was written is whole, and
    /// kept.
    #[must_use]
    pub fn is_finding(&self) -> bool {
        matches!(self, Self::BrokenLaw(_) | Self::NothingToDraw(_))
    }

    /// Whether the reader of our output has gone, which is no failure of ours.
    #[must_use]
    pub fn is_broken_pipe(&self) -> bool {
        matches!(self, Self::Output(e) if e.kind() == io::ErrorKind::BrokenPipe)
    }

    /// Whether the process may open no more files (`ulimit -n`), or the machine: another file would fare no
    /// better.
    #[must_use]
    pub fn is_out_of_files(&self) -> bool {
        const ENFILE: i32 = 23;
        const EMFILE: i32 = 24;
        matches!(self, Self::File { source, .. } if matches!(source.raw_os_error(), Some(ENFILE | EMFILE)))
    }

    /// An I/O error with the file it happened to.
    pub fn file(path: impl std::fmt::Display, source: io::Error) -> Self {
        Self::File { path: path.to_string(), source }
    }

    /// A picture file with what is wrong with it and what to do.
    pub fn picture(
        path: &std::path::Path,
        problem: impl std::fmt::Display,
        remedy: impl Into<String>,
    ) -> Self {
        Self::Picture {
            path: path.display().to_string(),
            problem: problem.to_string(),
            remedy: remedy.into(),
        }
    }

    /// A file of regions with what is wrong with it and what to do.
    pub fn regions(path: &str, problem: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self::Regions { path: path.to_owned(), problem: problem.into(), remedy: remedy.into() }
    }

    /// A surface with what is wrong with it.
    pub fn shape(problem: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self::Shape { name: "shape".to_owned(), problem: problem.into(), remedy: remedy.into() }
    }

    /// The same error with a surface called by its file.
    #[must_use]
    pub fn of_file(self, path: &std::path::Path) -> Self {
        match self {
            Self::Shape { problem, remedy, .. } => {
                Self::Shape { name: path.display().to_string(), problem, remedy }
            }
            Self::FullExchange { patches, .. } => {
                Self::FullExchange { name: path.display().to_string(), patches }
            }
            other => other,
        }
    }

    /// A record's field with what is wrong with it. What it quotes of the field is cut: it may be a whole
    /// array.
    pub fn field(field: impl Into<String>, problem: impl std::fmt::Display) -> Self {
        const LETTERS: usize = 400;
        Self::Field { field: field.into(), problem: cut(&problem.to_string(), LETTERS).into_owned() }
    }

    /// A flag with what is wrong with its value and what to write instead.
    pub fn usage(flag: &'static str, problem: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self::Usage { flag, problem: problem.into(), remedy: remedy.into() }
    }
}

/// What the operating system says, without its number, and without the temporary file that stands behind
/// that, which nobody asked for.
fn in_words(error: &io::Error) -> String {
    let text = error.to_string();
    text.split(" (os error ").next().unwrap_or(&text).to_owned()
}

/// A result whose error is the tools' own.
pub type Result<T> = std::result::Result<T, Error>;

/// A text of at most so many letters, of a longer one its beginning and its end.
#[must_use]
pub(crate) fn cut(text: &str, letters: usize) -> Cow<'_, str> {
    let count = text.chars().count();
    if count <= letters {
        return text.into();
    }
    let (start, end) = (text.chars().take(letters / 2), text.chars().skip(count - letters / 2));
    start.chain(['…']).chain(end).collect()
}
