//! Marks pictures made for the eye, in which nothing can be measured: a plain sentence, stored where other
//! programs keep it when they save the picture again.

use std::io::{self, Read, Seek, SeekFrom};

/// The sentence.
pub(super) const MARK: &str = "A picture for the eye, made by vfold: not to be measured";
/// Its keywords in PNG texts: a TIFF or JPEG gets one as its image description, the other as its comment.
pub(super) const MARK_KEYWORDS: [&str; 2] = ["Description", "Comment"];
/// The sentence is searched for in this many bytes at either end of a file: programs write texts before or
/// after the pixels.
const SOUGHT: u64 = 1 << 16;

/// Whether vfold made this file for the eye: a preview, an overlay, a drawing or a render for the screen,
/// even if another program saved it again and kept its description or comment. False for a file that cannot
/// be read.
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
