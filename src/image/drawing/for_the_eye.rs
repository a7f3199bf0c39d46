//! The mark of pictures for the eye, in which nothing can be measured: a sentence in plain letters, where other programs keep it when they save
//! the picture again.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::Path;

/// The sentence.
pub(super) const MARK: &str = "A picture for the eye, made by vfold: not to be measured";
/// Keywords of PNG texts for it: one becomes a TIFF's or JPEG's image description, the other their comment.
pub(super) const MARK_KEYWORDS: [&str; 2] = ["Description", "Comment"];
/// Bytes at a file's beginning and at its end among which the sentence is: programs write texts before the pixels or after them.
const SOUGHT: u64 = 1 << 16;

/// Whether a file is a picture that vfold made for the eye: a preview, an overlay, a drawing or a render for the screen, also if another
/// program saved it again and kept its description or comment. A file that cannot be read is none, nor is a pipe.
#[must_use]
pub fn is_for_the_eye(path: &Path) -> bool {
    has_mark(path).unwrap_or(false)
}

fn has_mark(path: &Path) -> io::Result<bool> {
    let mut file = File::open(path)?;
    let about = file.metadata()?;
    if !about.is_file() {
        return Ok(false);
    }
    let mut bytes = Vec::new();
    for from in [0, about.len().saturating_sub(SOUGHT)] {
        file.seek(SeekFrom::Start(from))?;
        (&mut file).take(SOUGHT).read_to_end(&mut bytes)?;
    }
    Ok(bytes.windows(MARK.len()).any(|window| window == MARK.as_bytes()))
}
