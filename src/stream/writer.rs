//! Writing records: whole files or none.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use super::{Fields, Sample, Scene};
use crate::error::{Error, Result};

/// Where a tool's records go: standard output, or a file that appears when it is whole.
pub struct Output {
    sink: Sink,
    failed: usize,
}

enum Sink {
    Stdout(BufWriter<io::Stdout>),
    File(BufWriter<Saved>),
}

impl Output {
    /// Standard output for `-` or nothing, else the file.
    ///
    /// # Errors
    /// [`Error::File`] if its folder cannot be written.
    pub fn to(path: Option<&Path>) -> Result<Self> {
        let sink = match path {
            Some(path) if path != Path::new("-") => Sink::File(BufWriter::new(Saved::new(path)?)),
            _ => Sink::Stdout(BufWriter::new(io::stdout())),
        };
        Ok(Self { sink, failed: 0 })
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
        self.failed += usize::from(sample.has_error()?);
        self.fields(&sample.fields)
    }

    /// Writes any record.
    ///
    /// # Errors
    /// [`Error::Output`] or [`Error::File`] if it cannot be written.
    pub fn fields(&mut self, fields: &Fields) -> Result<()> {
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

    fn bytes(&mut self, bytes: &[u8]) -> Result<()> {
        match &mut self.sink {
            Sink::Stdout(out) => out.write_all(bytes).map_err(Error::Output),
            Sink::File(out) => out.write_all(bytes).map_err(|e| Error::file(out.get_ref().path.display(), e)),
        }
    }

    /// Makes all that was written last: flushes, and gives a file its name.
    ///
    /// # Errors
    /// [`Error::Output`] or [`Error::File`] if the rest cannot be written.
    pub fn finish(self) -> Result<usize> {
        match self.sink {
            Sink::Stdout(mut out) => out.flush().map_err(Error::Output)?,
            Sink::File(out) => {
                out.into_inner().map_err(io::IntoInnerError::into_error).map_err(Error::Output)?.keep()?;
            }
        }
        Ok(self.failed)
    }
}

/// A file under a temporary name in its own folder, which takes its name when it is whole.
pub struct Saved {
    file: NamedTempFile,
    path: PathBuf,
}

impl Saved {
    /// Opens the temporary file.
    ///
    /// # Errors
    /// [`Error::File`] if the folder cannot be written.
    pub fn new(path: &Path) -> Result<Self> {
        let folder = match path.parent() {
            Some(folder) if folder != Path::new("") => folder,
            _ => Path::new("."),
        };
        let mut builder = tempfile::Builder::new();
        builder.prefix(".vfold-");
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o644));
        let file = builder.tempfile_in(folder).map_err(|e| Error::file(path.display(), e))?;
        Ok(Self { file, path: path.to_owned() })
    }

    /// The open file.
    pub fn file_mut(&mut self) -> &mut File {
        self.file.as_file_mut()
    }

    /// The name it will have.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Gives the file its name.
    ///
    /// # Errors
    /// [`Error::File`] if it cannot be renamed.
    pub fn keep(self) -> Result<()> {
        let path = self.path;
        // Devices such as /dev/null take bytes, not a new name.
        self.file.persist(&path).map(drop).map_err(|e| Error::file(path.display(), e.error))
    }
}

impl Write for Saved {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}
