//! Files that appear when they are complete: a reader never sees half of one, and a run that fails or is
//! killed leaves none.

mod checksum;
pub(crate) mod forms;

use std::collections::BTreeSet;
use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

pub use checksum::sha256;
use tempfile::NamedTempFile;
use unicode_normalization::UnicodeNormalization;

use crate::error::{Error, Result};

/// A name normalised for comparison: systems write the same letters composed (é) or as a letter and its
/// accent.
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

/// A file in its own folder that gets its name when it is complete. A pipe or device keeps its name and takes
/// bytes as they come.
///
/// Until then the file has no name at all, so whatever ends the run, SIGKILL included, leaves nothing behind.
/// On file systems without unnamed files (NFS, FAT) it is called `.vfold-` and six letters, and remains if a
/// signal ends the run.
pub struct Saved {
    target: Target,
    path: PathBuf,
    /// `None` for a pipe or device, which may take several outputs.
    _claim: Option<Claim>,
}

enum Target {
    #[cfg(target_os = "linux")]
    Unnamed(File),
    Named(NamedTempFile),
    Special(File),
}

impl Saved {
    /// Opens the file without a name, or the pipe or device.
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
            // A link to a file remains a link: its target is replaced.
            Ok(_) => path.canonicalize().map_err(failed)?,
            // A link to itself or to nothing is not what was meant.
            Err(_) if path.is_symlink() => {
                return Err(failed(io::Error::other("a link that leads to no file")));
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

    /// The name the file will have.
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

    /// Gives the file its name once it is on the disk: only then are all possible errors known.
    ///
    /// # Errors
    /// [`Error::File`] if the rest of the file cannot be written, or it cannot be renamed.
    pub fn keep(mut self) -> Result<()> {
        if !matches!(self.target, Target::Special(_)) {
            self.file_mut().sync_data().map_err(|e| Error::file(self.path.display(), e))?;
        }
        let named = match self.target {
            #[cfg(target_os = "linux")]
            Target::Unnamed(file) => unnamed::temporary_name(&file, &self.path),
            Target::Named(file) => Ok(file.into_temp_path()),
            Target::Special(_) => return Ok(()),
        };
        named
            .and_then(|named| named.persist(&self.path).map_err(|e| e.error))
            .map_err(|e| Error::file(self.path.display(), e))
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

/// True if `{}` in a file name stands for another name.
#[must_use]
pub fn is_pattern(path: &Path) -> bool {
    path.to_str().is_some_and(|text| text.contains("{}"))
}

/// The file that a pattern stands for, with `name` in place of each `{}`.
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

/// The exclusive right to a file's name while the file is written: of two outputs with one name, one would be
/// lost.
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
        let problem = format!("two of this run would go to {}", path.display());
        Err(Error::usage("outputs", problem, "give each a name of its own"))
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

/// A file in the folder of `path`: unnamed where possible, else with a temporary name.
fn target_beneath(path: &Path) -> io::Result<Target> {
    #[cfg(target_os = "linux")]
    if let Some(file) = unnamed::open(folder(path)) {
        return Ok(Target::Unnamed(file));
    }
    let mut builder = temporary();
    // Temporary files are private by default; results are for everyone whom the umask allows.
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

/// Files without a name, which vanish with the process (open(2), `O_TMPFILE`).
#[cfg(target_os = "linux")]
mod unnamed {
    use std::os::fd::AsRawFd;

    use rustix::fs::{AtFlags, CWD, Mode, OFlags, linkat, openat};
    use tempfile::TempPath;

    use super::{File, Path, PathBuf, folder, io, temporary};

    /// `None` if the file system has no unnamed files, or could not name them later.
    pub(super) fn open(folder: &Path) -> Option<File> {
        let flags = OFlags::TMPFILE | OFlags::WRONLY | OFlags::CLOEXEC;
        let file = File::from(openat(CWD, folder, flags, Mode::from_raw_mode(0o666)).ok()?);
        descriptor(&file).exists().then_some(file)
    }

    /// Gives it a temporary name: a rename can replace another file, a link cannot.
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
            assert!(Saved::new(&link).is_err_and(|error| error.to_string().contains("leads to no file")));
            assert!(link.is_symlink());
        }
    }

    #[test]
    fn a_folder_is_no_file() {
        let folder = tempfile::tempdir().unwrap();
        assert!(Saved::new(folder.path()).is_err());
    }
}
