//! Files that appear when they are complete: a reader never encounters a partial one, and a run that fails or
//! is killed leaves none.

mod checksum;
pub(crate) mod forms;
mod together;

use std::collections::BTreeSet;
use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

pub use checksum::sha256;
pub use forms::lines;
use tempfile::NamedTempFile;
pub(crate) use together::Together;
pub use together::keep_complete;
use together::{Complete, Rename};
use unicode_normalization::UnicodeNormalization;

use crate::error::{Error, Result};

/// A name in canonical form for comparison: systems write the same letters composed (é) or as a letter and
/// its accent.
///
/// # Example
/// ```
/// use vfold::files::composed;
/// assert_eq!(composed("cafe\u{301}.tif"), composed("caf\u{e9}.tif"));
/// ```
#[must_use]
pub fn composed(name: &str) -> String {
    name.nfc().collect()
}

/// A file in its own folder that gets its name when it is complete. A pipe or device keeps its name and
/// receives the bytes directly.
///
/// Until then it has no name at all, so nothing is left behind however the run ends, even by SIGKILL. File
/// systems without unnamed files (NFS, FAT) name it `.vfold-` and six letters, and it remains if a signal
/// ends the run.
pub struct Saved {
    target: Target,
    path: PathBuf,
    /// None for a pipe or device, to which several outputs may go.
    _claim: Option<Claim>,
}

enum Target {
    #[cfg(target_os = "linux")]
    Unnamed(File),
    Named(NamedTempFile),
    Special(File),
}

impl Saved {
    /// Opens the file without its name, or the pipe or device.
    ///
    /// # Errors
    /// [`Error::File`] if the folder cannot be written or the name is a dangling link, [`Error::Usage`] if
    /// another output of this run has the name.
    pub fn new(path: &Path) -> Result<Self> {
        let failed = |e| Error::file(path.display(), e);
        let path = match path.metadata() {
            Ok(found) if !found.is_file() => {
                let target = Target::Special(File::options().write(true).open(path).map_err(failed)?);
                return Ok(Self { target, path: path.to_owned(), _claim: None });
            }
            // a link to a file remains a link: its target is replaced
            Ok(_) => path.canonicalize().map_err(failed)?,
            // a link to itself or to nothing is a mistake
            Err(_) if path.is_symlink() => {
                return Err(failed(io::Error::other("a link to a missing file")));
            }
            Err(_) => path.to_owned(),
        };
        let target = target_beneath(&path).map_err(failed)?;
        Ok(Self { target, _claim: Some(Claim::new(&path)?), path })
    }

    /// The open file.
    pub fn file_mut(&mut self) -> &mut File {
        match &mut self.target {
            Target::Named(file) => file.as_file_mut(),
            #[cfg(target_os = "linux")]
            Target::Unnamed(file) => file,
            Target::Special(file) => file,
        }
    }

    /// Its final name.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes a complete file.
    ///
    /// # Errors
    /// [`Error::File`] if it cannot be written.
    pub fn write(path: &Path, bytes: &[u8]) -> Result<()> {
        let mut saved = Self::new(path)?;
        saved.write_all(bytes).map_err(|e| Error::file(path.display(), e))?;
        saved.keep()
    }

    /// Renames the file once it is on disk; in a tool, when all of its files are.
    ///
    /// # Errors
    /// [`Error::File`] if the rest of it cannot be written, or the file cannot be renamed.
    pub fn keep(mut self) -> Result<()> {
        if matches!(self.target, Target::Special(_)) {
            return Ok(());
        }
        self.file_mut().sync_data().map_err(|e| Error::file(self.path.display(), e))?;
        together::wait(Box::new(self)).map_or(Ok(()), |alone| alone.named()?())
    }
}

impl Complete for Saved {
    fn named(self: Box<Self>) -> Result<Rename> {
        let Self { target, path, _claim: claim } = *self;
        let temporary = match target {
            #[cfg(target_os = "linux")]
            Target::Unnamed(file) => unnamed::temporary_name(&file, &path).map(Some),
            Target::Named(file) => Ok(Some(file.into_temp_path())),
            Target::Special(_) => Ok(None),
        };
        let temporary = temporary.map_err(|e| Error::file(path.display(), e))?;
        Ok(Box::new(move || {
            let renamed = temporary.map_or(Ok(()), |temporary| temporary.persist(&path));
            drop(claim);
            renamed.map_err(|e| Error::file(path.display(), e.error))
        }))
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

/// Whether `{}` in a file name stands for another name.
#[must_use]
pub fn is_pattern(path: &Path) -> bool {
    path.to_str().is_some_and(|text| text.contains("{}"))
}

/// The file name from a pattern, with `name` in place of each `{}`.
///
/// # Example
/// ```
/// use std::path::Path;
/// assert_eq!(vfold::files::named(Path::new("overlay-{}.png"), "photo"), Path::new("overlay-photo.png"));
/// ```
#[must_use]
pub fn named(pattern: &Path, name: &str) -> PathBuf {
    pattern.to_str().map_or_else(|| pattern.to_owned(), |text| text.replace("{}", name).into())
}

/// A lock on a file's name while the file is written: of two outputs with the same name, one would be lost.
pub(crate) struct Claim(PathBuf);

static CLAIMED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

impl Claim {
    /// # Errors
    /// [`Error::Usage`] if another output has the name.
    pub fn new(path: &Path) -> Result<Self> {
        let name = folder(path).canonicalize().unwrap_or_default().join(path.file_name().unwrap_or_default());
        if claimed().insert(name.clone()) {
            return Ok(Self(name));
        }
        let problem = format!("two would be written to {}", path.display());
        Err(Error::usage("outputs", problem, "give each its own name"))
    }
}

impl Drop for Claim {
    fn drop(&mut self) {
        claimed().remove(&self.0);
    }
}

fn claimed() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    CLAIMED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A file in the folder of `path`: unnamed if possible, else under a temporary name.
fn target_beneath(path: &Path) -> io::Result<Target> {
    #[cfg(target_os = "linux")]
    if let Some(file) = unnamed::open(folder(path)) {
        return Ok(Target::Unnamed(file));
    }
    let mut builder = temporary();
    // temporary files are private by default; results have the permissions of the umask
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder(path)).map(Target::Named)
}

fn temporary() -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".vfold-");
    builder
}

fn folder(path: &Path) -> &Path {
    path.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."))
}

/// Unnamed files, which vanish with the process (open(2), `O_TMPFILE`).
#[cfg(target_os = "linux")]
mod unnamed {
    use std::os::fd::AsRawFd;

    use rustix::fs::{AtFlags, CWD, Mode, OFlags, linkat, openat};
    use tempfile::TempPath;

    use super::{File, Path, PathBuf, folder, io, temporary};

    /// None if the file system does not support them, or they could not be named later.
    pub(super) fn open(folder: &Path) -> Option<File> {
        let flags = OFlags::TMPFILE | OFlags::WRONLY | OFlags::CLOEXEC;
        let file = File::from(openat(CWD, folder, flags, Mode::from_raw_mode(0o666)).ok()?);
        descriptor(&file).exists().then_some(file)
    }

    /// Creates a link under a temporary name: a rename can replace another file, a link cannot.
    pub(super) fn temporary_name(file: &File, path: &Path) -> io::Result<TempPath> {
        let link = |name: &Path| Ok(linkat(CWD, descriptor(file), CWD, name, AtFlags::SYMLINK_FOLLOW)?);
        temporary().make_in(folder(path), link).map(tempfile::NamedTempFile::into_temp_path)
    }

    fn descriptor(file: &File) -> PathBuf {
        format!("/proc/self/fd/{}", file.as_raw_fd()).into()
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
    fn names_go_to_one_writer_at_a_time() {
        let folder = tempfile::tempdir().unwrap();
        let (file, link) = (folder.path().join("file"), folder.path().join("link"));
        fs::write(&file, "old").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        let saved = Saved::new(&file).unwrap();
        for same in [&file, &link, &folder.path().join(".").join("file")] {
            assert!(Saved::new(same).is_err_and(|error| error.exit_status() == 2), "{}", same.display());
        }
        drop(saved);
        assert!(Saved::new(&link).is_ok());
    }

    #[test]
    fn links_to_nothing_and_to_themselves_are_no_files() {
        let folder = tempfile::tempdir().unwrap();
        for (link, target) in [("loop", "loop"), ("dangling", "nowhere")] {
            let link = folder.path().join(link);
            std::os::unix::fs::symlink(target, &link).unwrap();
            assert!(Saved::new(&link).is_err_and(|error| error.to_string().contains("to a missing file")));
            assert!(link.is_symlink());
        }
    }

    #[test]
    fn a_folder_is_no_file() {
        let folder = tempfile::tempdir().unwrap();
        assert!(Saved::new(folder.path()).is_err());
    }
}
