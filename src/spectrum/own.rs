//! The user's own spectra: the files in the directory named by the environment variable `VFOLD_DATA`.
//!
//! A file `paint.csv` there is called `paint`, and its column `red` is `paint:red`, as in a built-in set.
//! Built-in names take precedence, so that a record means the same everywhere; the file is then reached by
//! its path.

use std::path::{Path, PathBuf};

use super::formats::{ENDINGS, has_ending};
use super::names::same_name;
use crate::error::{Error, Result};

/// The environment variable.
pub(super) const VARIABLE: &str = "VFOLD_DATA";

/// A file of the directory.
pub(super) struct OwnFile {
    /// Its name without the ending.
    pub name: String,
    pub path: String,
}

impl OwnFile {
    /// The file's name with its ending.
    pub fn file_name(&self) -> String {
        Path::new(&self.path).file_name().unwrap_or_default().to_string_lossy().into_owned()
    }
}

/// The files by name; empty if the variable is not set.
///
/// # Errors
/// [`Error::File`] if the directory cannot be read.
pub(super) fn files() -> Result<Vec<OwnFile>> {
    match std::env::var_os(VARIABLE) {
        Some(folder) if !folder.is_empty() => files_in(&PathBuf::from(folder)),
        _ => Ok(Vec::new()),
    }
}

fn files_in(folder: &Path) -> Result<Vec<OwnFile>> {
    let failed = |e| Error::file(format!("{VARIABLE} {}", folder.display()), e);
    let mut files = Vec::new();
    for entry in folder.read_dir().map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        let Some(path_text) = path.to_str().filter(|text| has_ending(text, &ENDINGS)) else { continue };
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        if !name.starts_with('.') && path.is_file() {
            files.push(OwnFile { name, path: path_text.to_owned() });
        }
    }
    files.sort_by(|a, b| a.path.cmp(&b.path));
    Ok(files)
}

/// The file called `name`, or for `file:member` the file and the member.
///
/// # Errors
/// [`Error::Spectrum`] if two files have that name.
pub(super) fn find<'a>(
    files: &'a [OwnFile],
    name: &'a str,
) -> Result<Option<(&'a OwnFile, Option<&'a str>)>> {
    let whole = (name, None);
    let splits = name.match_indices(':').map(|(at, _)| (&name[..at], Some(&name[at + 1..])));
    for (stem, member) in std::iter::once(whole).chain(splits) {
        let mut called = files.iter().filter(|file| same_name(&file.name, stem));
        match (called.next(), called.next()) {
            (None, _) => {}
            (Some(file), None) => return Ok(Some((file, member))),
            (Some(one), Some(other)) => {
                let problem =
                    format!("{} and {} in {VARIABLE} share this name", one.file_name(), other.file_name());
                return Err(Error::spectrum(stem, problem, "rename one, or give the path"));
            }
        }
    }
    Ok(None)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_found_by_their_stem() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["paint.csv", "a:b.sp", "lamp.spdx", "lamp.txt", ".hidden.csv", "notes.md"] {
            std::fs::write(folder.path().join(name), "").unwrap();
        }
        let files = files_in(folder.path()).unwrap();
        let found =
            |name| find(&files, name).map(|file| file.map(|(file, member)| (file.file_name(), member)));
        assert_eq!(files.len(), 4);
        assert_eq!(found("Paint:red").unwrap(), Some(("paint.csv".to_owned(), Some("red"))));
        assert_eq!(found("a:b").unwrap(), Some(("a:b.sp".to_owned(), None)));
        assert_eq!(found("a:b:c").unwrap(), Some(("a:b.sp".to_owned(), Some("c"))));
        assert_eq!(found("notes").unwrap(), None);
        let message = found("lamp").unwrap_err().to_string();
        assert!(message.contains("lamp.spdx and lamp.txt in VFOLD_DATA"), "{message}");
        let message = files_in(&folder.path().join("none")).map(|_| ()).unwrap_err().to_string();
        assert!(message.starts_with("VFOLD_DATA /") && message.contains("No such file"), "{message}");
    }
}
