//! Reading records, and passing them through a tool.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};

use rayon::prelude::*;

use super::{Fields, Output, Sample, Scene};
use crate::error::{Error, Result};

/// Longest line that is read: a scene of 512 x 512 facets with 50 poles has 300 MB.
const LINE_MAX: u64 = 1 << 30;
/// Samples that wait for each other in a batch: enough to keep the cores busy, few enough to keep memory flat.
const BATCH: usize = 64;

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
    source: Box<dyn BufRead>,
    path: String,
    line: usize,
    /// Comes before what is read.
    first: Option<Scene>,
}

impl Reader {
    /// Opens a file, or standard input for `-`.
    ///
    /// # Errors
    /// [`Error::File`] if it cannot be opened.
    pub fn open(path: &str) -> Result<Self> {
        let source: Box<dyn BufRead> = match path {
            "-" => Box::new(BufReader::new(io::stdin())),
            _ => Box::new(BufReader::new(File::open(path).map_err(|e| Error::file(path, e))?)),
        };
        Ok(Self { source, path: path.to_owned(), line: 0, first: None })
    }

    /// Nothing but a scene.
    #[must_use]
    pub fn of(scene: Scene) -> Self {
        Self { source: Box::new(io::empty()), path: String::new(), line: 0, first: Some(scene) }
    }

    /// The same records with a scene before them.
    #[must_use]
    pub fn after(self, scene: Scene) -> Self {
        Self { first: Some(scene), ..self }
    }

    /// The next record, none at the end.
    ///
    /// # Errors
    /// [`Error::Record`] for a line that is not a record, with file and line.
    pub fn read(&mut self) -> Result<Option<Record>> {
        if let Some(scene) = self.first.take() {
            return Ok(Some(Record::Scene(scene)));
        }
        let mut bytes = Vec::new();
        let mut limited = (&mut self.source).take(LINE_MAX);
        let read = limited.read_until(b'\n', &mut bytes).map_err(|e| Error::file(&self.path, e))?;
        if read == 0 {
            return Ok(None);
        }
        self.line += 1;
        if bytes.pop() != Some(b'\n') {
            return Err(
                self.wrong("the last line has no end: the stream was cut", "run the tool before it again")
            );
        }
        let fields = serde_json::from_slice(&bytes)
            .map(Fields)
            .map_err(|e| self.wrong(&format!("not a JSON object ({e})"), "each line must be one record"))?;
        self.typed(fields).map(Some)
    }

    fn typed(&self, fields: Fields) -> Result<Record> {
        match fields.kind() {
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

    fn wrong(&self, problem: &str, remedy: &str) -> Error {
        Error::Record {
            path: self.path.clone(),
            line: self.line,
            problem: problem.to_owned(),
            remedy: remedy.to_owned(),
        }
    }
}

/// What a tool does to the records that pass through it.
pub trait Transform {
    /// What samples need of the scene above them.
    type Context: Sync;

    /// Takes a scene, adds to it, and prepares its samples.
    ///
    /// # Errors
    /// Any: a scene that cannot be used ends the run.
    fn scene(&self, scene: &mut Scene) -> Result<Self::Context>;

    /// Takes a sample and adds to it.
    ///
    /// # Errors
    /// Any: the sample goes out with an `error` field and the run goes on.
    fn sample(&self, context: &Self::Context, sample: &mut Sample) -> Result<()>;
}

/// Passes all records of `reader` through `transform`, samples in parallel; `done` takes them in their order.
///
/// # Errors
/// From the stream itself or from a scene; samples carry their own.
pub fn pipe<T: Transform + Sync>(
    reader: &mut Reader,
    transform: &T,
    mut done: impl FnMut(Record) -> Result<()>,
) -> Result<()> {
    let mut context = None;
    let mut batch = Vec::new();
    loop {
        let record = reader.read()?;
        if let Some(Record::Sample(sample)) = record {
            batch.push((reader.line, sample));
            if batch.len() < BATCH {
                continue;
            }
            flush(reader, transform, context.as_ref(), &mut batch, &mut done)?;
            continue;
        }
        flush(reader, transform, context.as_ref(), &mut batch, &mut done)?;
        match record {
            Some(Record::Scene(mut scene)) => {
                context = Some(transform.scene(&mut scene).map_err(|e| reader.at(e))?);
                done(Record::Scene(scene))?;
            }
            Some(other) => done(other)?,
            None => return Ok(()),
        }
    }
}

/// Transforms the waiting samples and hands them on.
fn flush<T: Transform + Sync>(
    reader: &Reader,
    transform: &T,
    context: Option<&T::Context>,
    batch: &mut Vec<(usize, Sample)>,
    done: &mut impl FnMut(Record) -> Result<()>,
) -> Result<()> {
    let Some((line, _)) = batch.first() else { return Ok(()) };
    let Some(context) = context else {
        let (problem, remedy) =
            ("a sample before any scene".to_owned(), "put its scene line first".to_owned());
        return Err(Error::Record { path: reader.path.clone(), line: *line, problem, remedy });
    };
    let finished: Vec<Result<Sample>> = batch
        .par_drain(..)
        .map(|(_, mut sample)| {
            if sample.error()?.is_none()
                && let Err(error) = transform.sample(context, &mut sample)
            {
                sample.set_error(&error)?;
            }
            Ok(sample)
        })
        .collect();
    finished.into_iter().try_for_each(|sample| done(Record::Sample(sample?)))
}

impl Output {
    /// Writes any record.
    ///
    /// # Errors
    /// As [`Output::fields`].
    pub fn record(&mut self, record: &Record) -> Result<()> {
        match record {
            Record::Scene(scene) => self.scene(scene),
            Record::Sample(sample) => self.sample(sample),
            Record::Other(fields) => self.fields(fields),
        }
    }
}
