//! The photographs to be measured: if too many for a command line, they can be listed in a file.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};
use std::path::{Path, PathBuf};

use vfold::{Error, Result};

use super::Args;

/// Those on the command line, then those in the list.
///
/// # Errors
/// [`Error::Usage`] if no pictures are named; [`Error::File`] if the list cannot be read.
pub fn images(args: &Args) -> Result<Vec<PathBuf>> {
    let mut images = args.images.clone();
    if let Some(list) = &args.files_from {
        images.extend(names(list).map_err(|e| Error::file(list.display(), e))?);
        if images.is_empty() {
            let problem = format!("{} names no photograph", list.display());
            return Err(Error::usage("--files-from", problem, "write one name per line"));
        }
    }
    Ok(images)
}

fn names(list: &Path) -> io::Result<Vec<PathBuf>> {
    let source: Box<dyn Read> = match list.to_str() {
        Some("-") => Box::new(io::stdin()),
        _ => Box::new(File::open(list)?),
    };
    let names =
        BufReader::new(source).lines().filter(|name| name.as_ref().map_or(true, |name| !name.is_empty()));
    names.map(|name| name.map(PathBuf::from)).collect()
}
