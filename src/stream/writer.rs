//! Writes records: complete files or none.

use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use super::failures::Failures;
use super::resume::Resumed;
use super::{Fields, Kept, Record, Sample, Saves, Scene};
use crate::error::{Error, Result};
use crate::files::Saved;
use crate::progress::Progress;

/// Destination of a tool's records: standard output, a file that appears when it is complete, or one that
/// grows line by line.
pub struct Output {
    sink: Sink,
    /// Fields that are also written as arrays.
    pub saves: Saves,
    progress: Option<Progress>,
    failures: Failures,
}

enum Sink {
    Stdout(BufWriter<io::Stdout>),
    File(BufWriter<Saved>),
    Resumed(Resumed),
}

impl Output {
    /// Standard output for `-` or nothing, else the file; `saves` names fields to write as arrays.
    ///
    /// # Errors
    /// [`Error::File`] if its folder cannot be written.
    pub fn to(path: Option<&Path>, saves: &[(String, PathBuf)]) -> Result<Self> {
        let sink = match path {
            Some(path) if path != Path::new("-") => Sink::File(BufWriter::new(Saved::new(path)?)),
            _ => Sink::Stdout(BufWriter::new(io::stdout())),
        };
        Ok(Self::into(sink, saves))
    }

    /// The file of an interrupted run, or a new one: existing records are compared, others appended. If its
    /// scenes have no history, one existing sample is recomputed to detect another command's file.
    ///
    /// # Errors
    /// [`Error::Usage`] for standard output, [`Error::File`] for a folder or a file that another run is
    /// writing, [`Error::Record`] if it is not a stream.
    pub fn resume(path: &Path, saves: &[(String, PathBuf)], has_history: bool) -> Result<Self> {
        Ok(Self::into(Sink::Resumed(Resumed::open(path, has_history)?), saves))
    }

    fn into(sink: Sink, saves: &[(String, PathBuf)]) -> Self {
        Self { sink, saves: Saves::new(saves), progress: None, failures: Failures::default() }
    }

    /// The records of the interrupted run, if any.
    ///
    /// # Errors
    /// [`Error::File`] if they cannot be read.
    pub fn kept(&self) -> Result<Kept> {
        match &self.sink {
            Sink::Resumed(resumed) => resumed.kept(),
            _ => Ok(Kept::none()),
        }
    }

    /// Keeps at most the first records of the interrupted run; to be called before any is written.
    ///
    /// # Errors
    /// [`Error::File`] if they cannot be read.
    pub fn keep(&mut self, records: usize) -> Result<()> {
        match &mut self.sink {
            Sink::Resumed(resumed) => resumed.keep(records),
            _ => Ok(()),
        }
    }

    /// Shows the number of samples written.
    pub fn show(&mut self, progress: Progress) {
        self.progress = Some(progress);
    }

    /// Announces the number of samples to be written, if known.
    pub fn expect(&mut self, samples: usize) {
        if let Some(progress) = &mut self.progress {
            progress.expect(samples);
        }
    }

    /// Writes a scene.
    ///
    /// # Errors
    /// As [`Output::fields`].
    pub fn scene(&mut self, scene: &Scene) -> Result<()> {
        self.fields(&scene.fields)
    }

    /// Writes a sample, and counts it if it carries an error.
    ///
    /// # Errors
    /// As [`Output::fields`].
    pub fn sample(&mut self, sample: &Sample) -> Result<()> {
        self.failures.count(sample)?;
        if let Some(progress) = &mut self.progress {
            progress.tick();
        }
        self.fields(&sample.fields)
    }

    /// Writes the fields of a record, flushed at once because the next may take long.
    ///
    /// # Errors
    /// [`Error::Output`] or [`Error::File`] if it cannot be written, [`Error::Record`] if a resumed file has
    /// another record in its place.
    pub fn fields(&mut self, fields: &Fields) -> Result<()> {
        self.saves.record(fields)?;
        let mut line = serde_json::to_vec(fields).map_err(|e| Error::field(fields.kind(), e))?;
        line.push(b'\n');
        self.bytes(&line)?;
        match &mut self.sink {
            Sink::Stdout(out) => out.flush().map_err(Error::Output),
            Sink::File(_) | Sink::Resumed(_) => Ok(()),
        }
    }

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

    /// Writes a line of plain text, for tables.
    ///
    /// # Errors
    /// As [`Output::fields`].
    pub fn text(&mut self, line: &str) -> Result<()> {
        self.bytes(format!("{line}\n").as_bytes())
    }

    /// Writes a line of plain text for a sample, which counts as the sample does.
    ///
    /// # Errors
    /// As [`Output::fields`].
    pub fn row(&mut self, sample: &Sample, line: &str) -> Result<()> {
        self.failures.count(sample)?;
        self.text(line)
    }

    fn bytes(&mut self, bytes: &[u8]) -> Result<()> {
        match &mut self.sink {
            Sink::Stdout(out) => out.write_all(bytes).map_err(Error::Output),
            Sink::File(out) => {
                out.write_all(bytes).map_err(|e| Error::file(out.get_ref().path().display(), e))
            }
            Sink::Resumed(out) => out.write(bytes),
        }
    }

    /// Completes all output and returns the failed samples: flushes, and renames files. To be called only
    /// once every record is written, so that a full disk does not leave arrays of records that were not
    /// written.
    ///
    /// # Errors
    /// [`Error::Output`] or [`Error::File`] if the rest cannot be written.
    pub fn finish(mut self) -> Result<Failures> {
        if let Some(progress) = &mut self.progress {
            progress.finish();
        }
        match self.sink {
            Sink::Stdout(mut out) => out.flush().map_err(Error::Output).and_then(|()| self.saves.finish())?,
            Sink::File(out) => {
                let path = out.get_ref().path().display().to_string();
                let file = out.into_inner().map_err(|e| Error::file(path, e.into_error()))?;
                self.saves.finish()?;
                file.keep()?;
            }
            Sink::Resumed(out) => out.finish().and_then(|()| self.saves.finish())?,
        }
        Ok(self.failures)
    }
}
