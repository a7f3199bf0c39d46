//! The photographs to be measured: if too many for a command line, they can be listed in a file.

use std::path::{Path, PathBuf};

use vfold::files::lines;
use vfold::{Error, Result};

use super::Args;

/// Those on the command line, then those in the list.
///
/// # Errors
/// [`Error::Usage`] if no pictures are named; [`Error::File`] if the list cannot be read, or is no text in
/// UTF-8 or UTF-16.
pub fn images(args: &Args) -> Result<Vec<PathBuf>> {
    let mut images = args.images.clone();
    if let Some(list) = &args.files_from {
        images.extend(names(list)?);
        if images.is_empty() {
            let problem = format!("{} names no photograph", list.display());
            return Err(Error::usage("--files-from", problem, "write one name per line"));
        }
    }
    Ok(images)
}

fn names(list: &Path) -> Result<Vec<PathBuf>> {
    Ok(lines(list)?.into_iter().filter(|name| !name.is_empty()).map(PathBuf::from).collect())
}
