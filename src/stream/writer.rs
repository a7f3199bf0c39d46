//! Writing records: whole files or none.

use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use super::{Fields, Sample, Saves, Scene};
use crate::error::{Error, Result};
use crate::files::Saved;
use crate::progress::Progress;

/// Where a tool's records go: standard output, or a file that appears when it is whole.
pub struct Output {
    sink: Sink,
    /// Fields that are also written as arrays.
    pub saves: Saves,
    progress: Option<Progress>,
    failed: usize,
}

enum Sink {
    Stdout(BufWriter<io::Stdout>),
    File(BufWriter<Saved>),
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
        Ok(Self { sink, saves: Saves::new(saves), progress: None, failed: 0 })
    }

    /// Shows how many samples have been written.
    pub fn show(&mut self, progress: Progress) {
        self.progress = Some(progress);
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
        self.failed += usize::from(sample.error()?.is_some());
        if let Some(progress) = &mut self.progress {
            progress.tick();
        }
        self.fields(&sample.fields)
    }

    /// Writes any record.
    ///
    /// # Errors
    /// [`Error::Output`] or [`Error::File`] if it cannot be written.
    pub fn fields(&mut self, fields: &Fields) -> Result<()> {
        self.saves.record(fields)?;
        let mut line = serde_json::to_vec(&fields.0).map_err(|e| Error::field(fields.kind(), e))?;
        line.push(b'\n');
        self.bytes(&line)
    }

    /// Writes a line of plain text, for tables.
    ///
    /// # Errors
    /// As [`Output::fields`].
    pub fn text(&mut self, line: &str) -> Result<()> {
        self.bytes(format!("{line}\n").as_bytes())
    }

    /// Writes a line of plain text about a sample that failed.
    ///
    /// # Errors
    /// As [`Output::fields`].
    pub fn failed_text(&mut self, line: &str) -> Result<()> {
        self.failed += 1;
        self.text(line)
    }

    fn bytes(&mut self, bytes: &[u8]) -> Result<()> {
        match &mut self.sink {
            Sink::Stdout(out) => out.write_all(bytes).map_err(Error::Output),
            Sink::File(out) => {
                out.write_all(bytes).map_err(|e| Error::file(out.get_ref().path().display(), e))
            }
        }
    }

    /// Makes all that was written last: flushes, and gives a file its name.
    ///
    /// # Errors
    /// [`Error::Output`] or [`Error::File`] if the rest cannot be written.
    pub fn finish(mut self) -> Result<usize> {
        if let Some(progress) = &mut self.progress {
            progress.finish();
        }
        self.saves.finish()?;
        match self.sink {
            Sink::Stdout(mut out) => out.flush().map_err(Error::Output)?,
            Sink::File(out) => {
                let path = out.get_ref().path().display().to_string();
                out.into_inner().map_err(|e| Error::file(path, e.into_error()))?.keep()?;
            }
        }
        Ok(self.failed)
    }
}
