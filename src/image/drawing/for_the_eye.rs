//! The mark of pictures for the eye, in which nothing can be measured: a sentence in plain letters, where
//! other programs keep it when they save the picture again.

use std::io::{self, Read, Seek, SeekFrom};

/// The sentence.
pub(super) const MARK: &str = "A picture for the eye, made by vfold: not to be measured";
/// Keywords of PNG texts for it: one becomes a TIFF's or JPEG's image description, the other their comment.
pub(super) const MARK_KEYWORDS: [&str; 2] = ["Description", "Comment"];
/// Bytes at a file's beginning and at its end among which the sentence is: programs write texts before the
/// pixels or after them.
const SOUGHT: u64 = 1 << 16;

/// Whether a file is a picture that vfold made for the eye: a preview, an overlay, a drawing or a render for
/// the screen, also if another program saved it again and kept its description or comment. A file that cannot
/// be read is none.
#[must_use]
pub fn is_for_the_eye(file: &mut (impl Read + Seek)) -> bool {
    has_mark(file).unwrap_or(false)
}

fn has_mark(file: &mut (impl Read + Seek)) -> io::Result<bool> {
    let mut bytes = Vec::new();
    let length = file.seek(SeekFrom::End(0))?;
    for from in [0, length.saturating_sub(SOUGHT)] {
        file.seek(SeekFrom::Start(from))?;
        file.take(SOUGHT).read_to_end(&mut bytes)?;
    }
    file.rewind()?;
    Ok(bytes.windows(MARK.len()).any(|window| window == MARK.as_bytes()))
}
