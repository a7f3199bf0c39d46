//! Files that appear when they are whole: a reader never meets half of one, and a failed run leaves none.

use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use crate::error::{Error, Result};

/// A file under a temporary name in its own folder, which takes its name when it is whole. A pipe or device keeps its name
/// and takes the bytes as they come.
pub struct Saved {
    target: Target,
    path: PathBuf,
}

enum Target {
    Regular(NamedTempFile),
    Special(File),
}

impl Saved {
    /// Opens the temporary file, or the pipe or device.
    ///
    /// # Errors
    /// [`Error::File`] if the folder cannot be written.
    pub fn new(path: &Path) -> Result<Self> {
        let failed = |e| Error::file(path.display(), e);
        let target = match path.metadata() {
            Ok(found) if !found.is_file() => {
                Target::Special(File::options().write(true).open(path).map_err(failed)?)
            }
            // A link to a file stays a link: its target is replaced.
            Ok(_) => return Self::beside(&path.canonicalize().map_err(failed)?, path),
            Err(_) => return Self::beside(path, path),
        };
        Ok(Self { target, path: path.to_owned() })
    }

    /// Opens a temporary file beside `path`; errors call it `name`.
    fn beside(path: &Path, name: &Path) -> Result<Self> {
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
        let file = builder.tempfile_in(folder).map_err(|e| Error::file(name.display(), e.kind().into()))?;
        Ok(Self { target: Target::Regular(file), path: path.to_owned() })
    }

    /// The open file.
    pub fn file_mut(&mut self) -> &mut File {
        match &mut self.target {
            Target::Regular(file) => file.as_file_mut(),
            Target::Special(file) => file,
        }
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
        match self.target {
            Target::Regular(file) => {
                file.persist(&self.path).map(drop).map_err(|e| Error::file(self.path.display(), e.error))
            }
            Target::Special(_) => Ok(()),
        }
    }
}

impl Write for Saved {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file_mut().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file_mut().flush()
    }
}

#[cfg(all(test, unix))]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn a_file_appears_whole_and_a_link_stays_a_link() {
        let folder = tempfile::tempdir().unwrap();
        let (file, link) = (folder.path().join("file"), folder.path().join("link"));
        fs::write(&file, "old").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        let mut saved = Saved::new(&link).unwrap();
        saved.write_all(b"new").unwrap();
        assert_eq!(fs::read_to_string(&file).unwrap(), "old");
        saved.keep().unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read_to_string(&file).unwrap(), "new");
    }

    #[test]
    fn what_is_not_kept_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let mut saved = Saved::new(&folder.path().join("file")).unwrap();
        saved.write_all(b"half").unwrap();
        drop(saved);
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }

    #[test]
    fn a_folder_is_no_file() {
        let folder = tempfile::tempdir().unwrap();
        assert!(Saved::new(folder.path()).is_err());
    }
}
