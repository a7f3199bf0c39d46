//! Reading records.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};

use super::{Fields, Sample, Scene};
use crate::error::{Error, Result};
use crate::room;

/// Longest line that is read: the scene of a 5° fold of 512 x 512 facets has 900 MB.
const LINE_MAX: u64 = 1 << 30;

/// What is not the beginning of a record after so many bytes is not read to its end.
const BEGINNING: u64 = 1 << 16;

const NO_ROOM: &str =
    "no room for a line this long; take fewer facets or wavelengths, or allow more memory (ulimit -v)";

/// One line of the stream.
#[derive(Clone, Debug, PartialEq)]
pub enum Record {
    /// What follows belongs to this scene.
    Scene(Scene),
    /// A sample of the scene above it.
    Sample(Sample),
    /// A record of a kind that the tools pass on untouched.
    Other(Fields),
}

/// Reads records from a file or from standard input.
pub struct Reader {
    source: Box<dyn BufRead + Send>,
    path: String,
    line: usize,
    line_bytes: usize,
    /// Comes before what is read.
    first: Option<Scene>,
    /// Whether no record at all is no fault.
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

    /// Reads from `source`, which errors call `path`; there may be nothing in it.
    pub(super) fn new(source: Box<dyn BufRead + Send>, path: &str) -> Self {
        Self { source, path: path.to_owned(), line: 0, line_bytes: 0, first: None, may_be_empty: true }
    }

    /// Nothing but a scene.
    #[must_use]
    pub fn of(scene: Scene) -> Self {
        Self::new(Box::new(io::empty()), "").after(scene)
    }

    /// The same records with a scene before them.
    #[must_use]
    pub fn after(self, scene: Scene) -> Self {
        Self { first: Some(scene), ..self }
    }

    /// The next record, none at the end.
    ///
    /// # Errors
    /// [`Error::Record`] for a line that is not a record, with file and line, and for a stream that ends before its first.
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
            return Err(
                self.wrong("no record: the stream is empty", "give it what the tool before it writes")
            );
        }
        if is_record(&bytes) && !bytes.ends_with(b"\n") {
            return Err(match bytes.len() as u64 {
                LINE_MAX => self.wrong("a line of more than 1 GiB", "take fewer facets or wavelengths"),
                _ => {
                    self.wrong("the last line has no end: the stream was cut", "run the tool before it again")
                }
            });
        }
        room::ask(
            bytes.len() as u64,
            &format!("{}:{}", self.path, self.line),
            "take fewer facets or wavelengths",
        )?;
        let fields = serde_json::from_slice(&bytes)
            .map_err(|e| self.wrong(&format!("not a JSON object ({e})"), "each line must be one record"))?;
        self.typed(fields).map(Some)
    }

    /// The next line, or as much of it as tells what is wrong with it; empty at the end.
    fn line(&mut self) -> io::Result<Vec<u8>> {
        let (mut bytes, mut source) = (Vec::new(), (&mut self.source).take(BEGINNING));
        source.read_until(b'\n', &mut bytes)?;
        if is_record(&bytes) && !bytes.ends_with(b"\n") {
            source.set_limit(LINE_MAX - bytes.len() as u64);
            read_line(&mut source, &mut bytes)?;
        }
        Ok(bytes)
    }

    /// Length of the line that was read last.
    pub(super) fn line_bytes(&self) -> usize {
        self.line_bytes
    }

    fn typed(&self, fields: Fields) -> Result<Record> {
        match fields.kind().as_str() {
            "scene" => Ok(Record::Scene(Scene::from_fields(fields).map_err(|e| self.at(e))?)),
            "sample" => Ok(Record::Sample(Sample { fields })),
            "" => {
                Err(self.wrong("a record without 'kind'", "each line must be a scene, a sample or a summary"))
            }
            _ => Ok(Record::Other(fields)),
        }
    }

    /// The same error with the file and line it belongs to; wrong usage belongs to the command line.
    #[must_use]
    pub fn at(&self, error: Error) -> Error {
        match error {
            Error::Usage { .. } => error,
            // A scene that came from flags has no line.
            error if self.line == 0 => error,
            other => Error::Located { path: self.path.clone(), line: self.line, source: Box::new(other) },
        }
    }

    /// A sample that stands before all scenes.
    pub(super) fn no_scene(&self) -> Error {
        self.wrong("a sample before any scene", "put its scene line first")
    }

    /// What is wrong with the line that was read last.
    pub(super) fn wrong(&self, problem: &str, remedy: &str) -> Error {
        Error::Record {
            path: self.path.clone(),
            line: self.line,
            problem: problem.to_owned(),
            remedy: remedy.to_owned(),
        }
    }
}

/// Adds the rest of a line, its end with it. `read_until` would end the program where there is no room for it.
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

/// Whether a line begins as a record does.
fn is_record(line: &[u8]) -> bool {
    line.trim_ascii_start().starts_with(b"{")
}
