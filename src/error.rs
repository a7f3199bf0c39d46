//! Errors of the five tools: where, what is wrong, and what to do.

use std::borrow::Cow;
use std::fmt::Display;
use std::io;

/// Everything that can go wrong, each in one line a user can act on.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    // ---- command line (exit status 2) ----
    /// A flag's value is outside the tool's range.
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
        /// The operating system's error.
        source: io::Error,
    },
    /// Standard output cannot be written.
    #[error("standard output: {}", in_words(.0))]
    Output(#[source] io::Error),

    // ---- the stream ----
    /// Standard input is an empty pipe: the preceding command failed and has reported why. The tools end with
    /// status 1 and without a message.
    #[error("nothing came from the command before this one")]
    EmptyPipe,
    /// A line of the stream is not a record, or a line of another JSON file is invalid.
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
    /// An error in a record of a stream.
    #[error("{path}:{line}: {source}")]
    Located {
        /// The stream's file, `-` for standard input.
        path: String,
        /// Line number, from 1.
        line: usize,
        /// What is wrong, and what to do.
        source: Box<Self>,
    },
    /// A record lacks a field, or the field has an invalid value.
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
    /// Wavelengths do not form a grid.
    #[error("wavelength grid: {problem}; {remedy}")]
    Grid {
        /// What is wrong.
        problem: String,
        /// What to do.
        remedy: &'static str,
    },
    /// A spectrum is unsuitable for its use.
    #[error("spectrum '{name}': {problem}; {remedy}")]
    Spectrum {
        /// The spectrum's name.
        name: String,
        /// What is wrong, with the offending value.
        problem: String,
        /// What to do.
        remedy: String,
    },
    /// A line in a table of spectra cannot be read.
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
        /// The name asked for.
        name: String,
        /// The nearest names, and how to list all of them.
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
    /// Four corners do not bound a panel of the picture.
    #[error("{problem}; {remedy}")]
    Corners {
        /// Which corner, and what is wrong with it.
        problem: String,
        /// What to give instead.
        remedy: String,
    },
    /// A region file cannot be used.
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

    /// The patches of a surface exchange light among more pairs than can be stored.
    #[error("{name}: the exchange between {patches} patches fills more than a gigabyte; use a coarser mesh")]
    FullExchange {
        /// Its file, or just `shape`.
        name: String,
        /// Number of patches.
        patches: usize,
    },

    // ---- numbers ----
    /// A check found a physical law violated.
    #[error("the kernel fails these checks: {0}")]
    BrokenLaw(String),
    /// A computation has no meaningful result.
    #[error("{0}")]
    Numeric(String),

    /// No sample has what a drawing shows; the records are complete.
    #[error("--plot: {0}; check the samples' errors")]
    NothingToDraw(&'static str),
    /// There is not enough memory for a computation.
    #[error("{what}: not enough memory for {megabytes} MB; {remedy}, or allow more memory (ulimit -v)")]
    Memory {
        /// Its purpose.
        what: String,
        /// Size.
        megabytes: u64,
        /// What to do without more memory.
        remedy: &'static str,
    },

    // ---- ours ----
    /// The tool reached a state that it was not written for.
    #[error("a fault of this program: {0}; please report it with the command and its input")]
    Fault(String),
}

impl Error {
    /// The exit status for this error: 2 for wrong usage, 1 for bad data or I/O.
    #[must_use]
    pub fn exit_status(&self) -> u8 {
        match self {
            Self::Usage { .. } => 2,
            Self::Located { source, .. } => source.exit_status(),
            _ => 1,
        }
    }

    /// True for the finding of a check, and for records that lack what a drawing needs: the output is
    /// complete. It is kept if it states why: the report of the check, or records that carry an error.
    #[must_use]
    pub fn is_finding(&self) -> bool {
        matches!(self, Self::BrokenLaw(_) | Self::NothingToDraw(_))
    }

    /// True if the reader of our output has gone, which is not a failure of ours.
    #[must_use]
    pub fn is_broken_pipe(&self) -> bool {
        matches!(self, Self::Output(e) if e.kind() == io::ErrorKind::BrokenPipe)
    }

    /// True if the process (`ulimit -n`) or the machine can open no more files: another file would fare no
    /// better.
    #[must_use]
    pub fn is_out_of_files(&self) -> bool {
        const ENFILE: i32 = 23;
        const EMFILE: i32 = 24;
        matches!(self, Self::File { source, .. } if matches!(source.raw_os_error(), Some(ENFILE | EMFILE)))
    }

    /// An I/O error with its file.
    pub fn file(path: impl Display, source: io::Error) -> Self {
        Self::File { path: path.to_string(), source }
    }

    /// An unusable picture file, with the problem and the remedy.
    pub fn picture(path: &std::path::Path, problem: impl Display, remedy: impl Into<String>) -> Self {
        Self::Picture {
            path: path.display().to_string(),
            problem: problem.to_string(),
            remedy: remedy.into(),
        }
    }

    /// An unusable region file, with the problem and the remedy.
    pub fn regions(path: &str, problem: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self::Regions { path: path.to_owned(), problem: problem.into(), remedy: remedy.into() }
    }

    /// An unusable surface, with the problem and the remedy.
    pub fn shape(problem: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self::Shape { name: "shape".to_owned(), problem: problem.into(), remedy: remedy.into() }
    }

    /// The same error with a surface named by its file.
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

    /// The same error about a spectrum, or about its use, with the flag that named it.
    #[must_use]
    pub fn of_flag(self, flag: &'static str) -> Self {
        match self {
            Self::Spectrum { name, problem, remedy } => {
                Self::usage(flag, format!("spectrum '{name}': {problem}"), remedy)
            }
            other => other,
        }
    }

    /// An invalid field of a record. A long problem is shortened, as it may quote a whole array.
    pub fn field(field: impl Into<String>, problem: impl Display) -> Self {
        const LETTERS: usize = 400;
        Self::Field { field: field.into(), problem: cut(&problem.to_string(), LETTERS).into_owned() }
    }

    /// An invalid spectrum, with the problem and the remedy.
    pub fn spectrum(name: impl Into<String>, problem: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self::Spectrum { name: name.into(), problem: problem.into(), remedy: remedy.into() }
    }

    /// An invalid value of a flag, with the problem and the remedy.
    pub fn usage(flag: &'static str, problem: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self::Usage { flag, problem: problem.into(), remedy: remedy.into() }
    }
}

/// The operating system's message without its number, and without the name of a temporary file after it,
/// which means nothing to the user.
fn in_words(error: &io::Error) -> String {
    let text = error.to_string();
    text.split(" (os error ").next().unwrap_or(&text).to_owned()
}

/// A result with the tools' own error.
pub type Result<T> = std::result::Result<T, Error>;

/// A number with what it counts: `1 facet`, `3 facets`, `2 patches`, `2 spectra`.
///
/// # Arguments
/// - `count`: a number, or text that shows one.
/// - `one`: the noun in the singular.
///
/// # Example
/// ```
/// use vfold::error::counted;
/// assert_eq!([counted(1, "facet"), counted(0, "facet")], ["1 facet", "0 facets"]);
/// assert_eq!([counted(2, "patch"), counted(3, "spectrum")], ["2 patches", "3 spectra"]);
/// ```
#[must_use]
pub fn counted(count: impl Display, one: &str) -> String {
    let count = count.to_string();
    if count == "1" {
        return format!("1 {one}");
    }
    match one.strip_suffix("um") {
        Some(stem) => format!("{count} {stem}a"),
        None if one.ends_with("ch") || one.ends_with("ss") => format!("{count} {one}es"),
        None => format!("{count} {one}s"),
    }
}

/// A text of at most `letters` characters: the beginning and the end of a longer one.
#[must_use]
pub(crate) fn cut(text: &str, letters: usize) -> Cow<'_, str> {
    let count = text.chars().count();
    if count <= letters {
        return text.into();
    }
    let (start, end) = (text.chars().take(letters / 2), text.chars().skip(count - letters / 2));
    start.chain(['…']).chain(end).collect()
}
