//! Files that appear when they are whole: a reader never meets half of one, and a failed run leaves none.

use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use crate::error::{Error, Result};

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
        // Temporary files are private by default; a result is for whom the umask allows.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        // The error names the temporary file, which nobody asked for: its kind says what is wrong.
        let file = builder.tempfile_in(folder).map_err(|e| Error::file(path.display(), e.kind().into()))?;
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

    /// Writes a whole file at once.
    ///
    /// # Errors
    /// [`Error::File`] if it cannot be written.
    pub fn write(path: &Path, bytes: &[u8]) -> Result<()> {
        let mut saved = Self::new(path)?;
        saved.write_all(bytes).map_err(|e| Error::file(path.display(), e))?;
        saved.keep()
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
