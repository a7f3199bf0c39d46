//! Black and white as a directory states them.

use super::directory::Directory;
use super::tags::{BLACK_LEVEL, REFERENCE_BLACK_WHITE, WHITE_LEVEL};
use crate::image::reading::levels::Levels;

/// `ReferenceBlackWhite`, of two numbers per colour, or DNG's tags, which others write, too.
pub(super) fn levels(page: &Directory) -> Option<Levels> {
    let reals = |tag| page.reals(tag).unwrap_or_default();
    let reference = reals(REFERENCE_BLACK_WHITE);
    if !reference.is_empty() {
        let every_other = |from| reference.iter().skip(from).step_by(2).copied().collect();
        return Some(Levels { by: "ReferenceBlackWhite", black: every_other(0), white: every_other(1) });
    }
    let (black, white) = (reals(BLACK_LEVEL), reals(WHITE_LEVEL));
    let by = match (black.is_empty(), white.is_empty()) {
        (true, true) => return None,
        (true, false) => "WhiteLevel",
        (false, true) => "BlackLevel",
        (false, false) => "BlackLevel and WhiteLevel",
    };
    Some(Levels { by, black, white })
}

#[cfg(test)]
mod tests {
    use super::super::directory::{file, read_all};
    use super::super::tags::SHORT;
    use super::*;

    #[test]
    fn tags_state_black_and_white() {
        let of = |entries: &[(u16, u16, u32, u32)]| {
            let bytes = file(&[entries]);
            levels(&read_all(&mut std::io::Cursor::new(&bytes), bytes.len() as u64).unwrap()[0])
        };
        assert!(of(&[]).is_none());
        let both = of(&[(BLACK_LEVEL, SHORT, 2, 7 << 16 | 5), (WHITE_LEVEL, SHORT, 1, 4095)]).unwrap();
        assert_eq!((both.black, both.white), (vec![5.0, 7.0], vec![4095.0]));
        let pairs = of(&[(REFERENCE_BLACK_WHITE, SHORT, 2, 255 << 16 | 16)]).unwrap();
        assert_eq!((pairs.black, pairs.white), (vec![16.0], vec![255.0]));
    }
}
