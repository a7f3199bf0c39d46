//! Reads records.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};

use super::fields::problem;
use super::piped::stdin_is_pipe;
use super::{Fields, Sample, Scene};
use crate::error::{Error, Result};
use crate::files::forms::{other_form, without_mark};
use crate::room;

/// Longest line: the scene of a 5° fold of 512 x 512 facets has 900 MB.
const LINE_MAX: u64 = 1 << 30;

/// A line that is not the beginning of a record after this many bytes is not read to its end.
const BEGINNING: u64 = 1 << 16;

const ONE_RECORD: &str = "each line must be one record";

/// Fields that only scenes have, at their beginning, middle and end.
const OF_SCENES: [&str; 3] = ["\"geometry\"", "\"residues\"", "\"sensitivities\""];

const NO_ROOM: &str =
    "not enough memory for so long a line; use fewer facets or wavelengths, or allow more memory (ulimit -v)";

/// One line of the stream.
#[derive(Clone, Debug, PartialEq)]
pub enum Record {
    /// The scene of what follows.
    Scene(Scene),
    /// A sample of the scene above it.
    Sample(Sample),
    /// A record of a kind that the tools pass on untouched.
    Other(Fields),
}

impl Record {
    /// Its fields.
    #[must_use]
    pub fn fields(&self) -> &Fields {
        match self {
            Self::Scene(scene) => &scene.fields,
            Self::Sample(sample) => &sample.fields,
            Self::Other(fields) => fields,
        }
    }
}

/// Reads records from a file or from standard input.
pub struct Reader {
    source: Box<dyn BufRead + Send>,
    path: String,
    line: usize,
    line_bytes: usize,
    /// Returned before the records of the source.
    first: Option<Scene>,
    /// The name of the current scene.
    scene: String,
    /// The line of the current scene, if it could not be read.
    lost_scene: Option<usize>,
    /// Whether an empty stream is allowed.
    may_be_empty: bool,
}

impl Reader {
    /// Opens a file, or standard input for `-`.
    ///
    /// # Errors
    /// [`Error::File`] if it cannot be opened.
    pub fn open(path: &str) -> Result<Self> {
        let source: Box<dyn BufRead + Send> = match path {
            "-" => Box::new(BufReader::new(io::stdin())),
            _ => Box::new(BufReader::new(File::open(path).map_err(|e| Error::file(path, e))?)),
        };
        Ok(Self { may_be_empty: false, ..Self::new(source, path) })
    }

    /// Reads from `source`, named `path` in errors; it may be empty.
    pub(super) fn new(source: Box<dyn BufRead + Send>, path: &str) -> Self {
        Self {
            source,
            path: path.to_owned(),
            line: 0,
            line_bytes: 0,
            first: None,
            scene: String::new(),
            lost_scene: None,
            may_be_empty: true,
        }
    }

    /// A reader of a scene only.
    #[must_use]
    pub fn of(scene: Scene) -> Self {
        Self::new(Box::new(io::empty()), "").after(scene)
    }

    /// The same records, preceded by a scene.
    #[must_use]
    pub fn after(self, scene: Scene) -> Self {
        Self { first: Some(scene), ..self }
    }

    /// The next record, none at the end. A line without a record, unless it is the first or the last and cut,
    /// becomes a sample that carries an error, as does every sample of an unreadable scene.
    ///
    /// # Errors
    /// [`Error::Record`] with file and line for a stream that does not begin with a record, ends before its
    /// first or within one, or has a line that is too long; [`Error::EmptyPipe`] for an empty pipe;
    /// [`Error::Located`] for a scene of another version.
    pub fn read(&mut self) -> Result<Option<Record>> {
        if let Some(scene) = self.first.take() {
            return Ok(Some(Record::Scene(scene)));
        }
        let bytes = self.line().map_err(|e| Error::file(&self.path, e))?;
        if bytes.is_empty() && (self.line > 0 || self.may_be_empty) {
            return Ok(None);
        }
        self.line += 1;
        self.line_bytes = bytes.len();
        if bytes.is_empty() {
            if self.path == "-" && stdin_is_pipe() {
                return Err(Error::EmptyPipe);
            }
            return Err(
                self.wrong("no record: the stream is empty", "pipe the output of the preceding tool into it")
            );
        }
        let is_whole = bytes.ends_with(b"\n");
        if is_record(&bytes) && !is_whole {
            return Err(match bytes.len() as u64 {
                LINE_MAX => self.wrong("a line of more than 1 GiB", "use fewer facets or wavelengths"),
                _ => self.wrong("the stream was cut in its last line", "run the preceding tool again"),
            });
        }
        room::ask(
            bytes.len() as u64,
            &format!("{}:{}", self.path, self.line),
            "use fewer facets or wavelengths",
        )?;
        match self.fields(&bytes) {
            Ok(fields) => self.typed(fields).map(Some),
            Err(error) if self.line == 1 || !is_whole => Err(error),
            Err(error) => self.lost(&bytes, &error).map(Some),
        }
    }

    /// The fields of a line.
    fn fields(&self, line: &[u8]) -> Result<Fields> {
        let fields: Fields = serde_json::from_slice(without_mark(line)).map_err(|error| {
            if let Some(form) = other_form(line).filter(|_| self.line == 1) {
                let problem = format!("{}, not lines of JSON in UTF-8", form.name);
                return self.wrong(&problem, form.way_out().as_deref().unwrap_or(ONE_RECORD));
            }
            let problem = format!("{}, column {}", problem(&error), error.column());
            self.wrong(&format!("not a JSON object ({problem})"), ONE_RECORD)
        })?;
        match fields.kind().as_str() {
            "" => {
                Err(self.wrong("a record without 'kind'", "each line must be a scene, a sample or a summary"))
            }
            _ => Ok(fields),
        }
    }

    /// A replacement for a line without a record: its contents are unknown, but it counts as a failed sample.
    fn lost(&mut self, line: &[u8], error: &Error) -> Result<Record> {
        if is_scene(line) {
            self.lost_scene = Some(self.line);
        }
        let mut sample = Sample::new(&self.scene, &format!("line {}", self.line))?;
        sample.set_error(error)?;
        Ok(Record::Sample(sample))
    }

    /// The next line, or as much of it as shows what is wrong with it; empty at the end.
    fn line(&mut self) -> io::Result<Vec<u8>> {
        let (mut bytes, mut source) = (Vec::new(), (&mut self.source).take(BEGINNING));
        source.read_until(b'\n', &mut bytes)?;
        if bytes.ends_with(b"\n") {
            return Ok(bytes);
        }
        source.set_limit(LINE_MAX - bytes.len() as u64);
        if is_record(&bytes) {
            read_line(&mut source, &mut bytes)?;
        } else if self.line > 0 && bytes.len() as u64 == BEGINNING {
            // a line that is no record takes no memory
            source.skip_until(b'\n')?;
            bytes.extend((source.limit() > 0).then_some(b'\n'));
        }
        Ok(bytes)
    }

    /// Length of the last line.
    pub(super) fn line_bytes(&self) -> usize {
        self.line_bytes
    }

    fn typed(&mut self, fields: Fields) -> Result<Record> {
        match fields.kind().as_str() {
            "scene" => {
                let scene = Scene::from_fields(fields).map_err(|e| self.at(e))?;
                self.scene = scene.fields.text_at("id").ok().flatten().unwrap_or_default();
                self.lost_scene = None;
                Ok(Record::Scene(scene))
            }
            "sample" => {
                let mut sample = Sample { fields };
                if let Some(line) = self.lost_scene
                    && !matches!(sample.error(), Ok(Some(_)))
                {
                    let problem = format!("the scene above it, line {line}, cannot be read; repair it");
                    sample.set_error(&Error::field("scene", problem))?;
                }
                Ok(Record::Sample(sample))
            }
            _ => Ok(Record::Other(fields)),
        }
    }

    /// The same error with its file and line; a usage error belongs to the command line.
    #[must_use]
    pub fn at(&self, error: Error) -> Error {
        match error {
            Error::Usage { .. } => error,
            // a scene from flags has no line
            error if self.line == 0 => error,
            other => Error::Located { path: self.path.clone(), line: self.line, source: Box::new(other) },
        }
    }

    /// The error for a sample before all scenes.
    pub(super) fn no_scene(&self) -> Error {
        self.wrong("a sample before any scene", "put its scene line first")
    }

    /// An error in the last line.
    pub(super) fn wrong(&self, problem: &str, remedy: &str) -> Error {
        Error::Record {
            path: self.path.clone(),
            line: self.line,
            problem: problem.to_owned(),
            remedy: remedy.to_owned(),
        }
    }
}

/// Appends the rest of a line, including its end. `read_until` would abort the program if memory ran out.
fn read_line(source: &mut impl BufRead, line: &mut Vec<u8>) -> io::Result<()> {
    while !line.ends_with(b"\n") {
        let piece = source.fill_buf()?;
        let length = piece.iter().position(|byte| *byte == b'\n').map_or(piece.len(), |end| end + 1);
        if length == 0 {
            break;
        }
        let no_room = |_| io::Error::new(io::ErrorKind::OutOfMemory, NO_ROOM);
        line.try_reserve(length).map_err(no_room)?;
        line.extend_from_slice(&piece[..length]);
        source.consume(length);
    }
    Ok(())
}

/// Whether a line has the beginning of a record.
fn is_record(line: &[u8]) -> bool {
    without_mark(line).trim_ascii_start().starts_with(b"{")
}

/// Whether an unreadable line declares itself a scene or, without its beginning, contains fields that only
/// scenes have.
fn is_scene(line: &[u8]) -> bool {
    let line = String::from_utf8_lossy(line);
    if OF_SCENES.iter().any(|name| line.contains(name)) {
        return true;
    }
    let kind = |rest: &str| {
        rest.trim_start().strip_prefix(':').map(|kind| kind.trim_start().starts_with("\"scene\""))
    };
    line.split("\"kind\"").skip(1).any(|rest| kind(rest) == Some(true))
}
