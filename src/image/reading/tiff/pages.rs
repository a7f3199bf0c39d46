//! Selects the page of a TIFF file.

use std::path::Path;

use super::directory::Directory;
use super::tags::{DNG_VERSION, HEIGHT, NEW_SUBFILE_TYPE, PHOTOMETRIC, WIDTH};
use crate::{Error, Result};

const MOSAIC: u64 = 32803;

/// The pages of a file, at least one.
pub(super) struct Pages {
    directories: Vec<Directory>,
    /// Index of the selected page.
    pub meant: usize,
}

impl Pages {
    /// Selects the first page that is not a copy of reduced size; the first page if all are.
    pub fn new(directories: Vec<Directory>) -> Self {
        let meant = directories.iter().position(is_full).unwrap_or(0);
        Self { directories, meant }
    }

    /// The directory of the selected page.
    pub fn directory(&self) -> &Directory {
        &self.directories[self.meant]
    }

    /// Whether the first directory is that of a DNG, of a mosaic, or of a preview that no full picture
    /// follows: then the picture itself is the sensor's, as in NEF and ARW.
    pub fn is_raw(&self) -> bool {
        let first = &self.directories[0];
        let is_preview =
            !is_full(first) && (first.has_sub_directories() || !self.directories.iter().any(is_full));
        first.has(DNG_VERSION) || first.number(PHOTOMETRIC) == Some(MOSAIC) || is_preview
    }

    /// A note on other pages of full size.
    pub fn note(&self) -> Option<String> {
        let full = self.directories.iter().filter(|directory| is_full(directory)).count();
        (full > 1).then(|| format!("TIFF: it has {full} pages, of which the first is read"))
    }

    /// # Errors
    /// [`Error::Picture`] if the selected page may be an undeclared small copy of another.
    pub fn check(&self, path: &Path) -> Result<()> {
        let size = |page: &Directory| Some([page.number(WIDTH)?, page.number(HEIGHT)?]);
        let Some([width, height]) = size(self.directory()) else { return Ok(()) };
        let larger = self.directories.iter().filter(|page| is_full(page)).filter_map(size);
        let Some([wide, high]) = larger.into_iter().find(|[w, h]| *w > width && *h > height) else {
            return Ok(());
        };
        let problem = format!("its first page is {width} x {height} px, but a later one {wide} x {high} px");
        Err(Error::picture(path, problem, "save the intended page alone"))
    }
}

/// Whether a directory is that of a full-size picture.
fn is_full(directory: &Directory) -> bool {
    const REDUCED_OR_MASK: u64 = 0b101;
    directory.number(NEW_SUBFILE_TYPE).unwrap_or(0) & REDUCED_OR_MASK == 0
}

#[cfg(test)]
mod tests {
    use super::super::directory::{file, read_all};
    use super::super::tags::{LONG, SHORT, SUB_DIRECTORIES};
    use super::*;

    type Entry = (u16, u16, u32, u32);

    fn pages(directories: &[&[Entry]]) -> Pages {
        let bytes = file(directories);
        Pages::new(read_all(&mut std::io::Cursor::new(&bytes), bytes.len() as u64).unwrap())
    }

    const WHOLE: Entry = (NEW_SUBFILE_TYPE, LONG, 1, 0);
    const PREVIEW: Entry = (NEW_SUBFILE_TYPE, LONG, 1, 1);
    const PAGE: Entry = (NEW_SUBFILE_TYPE, LONG, 1, 2);
    const MASK: Entry = (NEW_SUBFILE_TYPE, LONG, 1, 4);

    #[test]
    fn raw_files_are_told_from_pictures() {
        let (rgb, mosaic) = ((PHOTOMETRIC, SHORT, 1, 2), (PHOTOMETRIC, SHORT, 1, 32803));
        for (directories, raw) in [
            (&[&[WHOLE][..]][..], false),
            (&[&[PREVIEW]], true),
            (&[&[PREVIEW, (SUB_DIRECTORIES, LONG, 1, 8)], &[WHOLE]], true),
            (&[&[PREVIEW], &[PREVIEW]], true),
            (&[&[PREVIEW], &[WHOLE]], false),
            (&[&[PAGE]], false),
            (&[&[rgb]], false),
            (&[&[mosaic]], true),
            (&[&[(DNG_VERSION, 1, 4, 0x0401)]], true),
        ] {
            assert_eq!(pages(directories).is_raw(), raw, "{directories:?}");
        }
    }

    #[test]
    fn the_first_page_of_full_size_is_meant() {
        let meant = |directories: &[&[Entry]]| (pages(directories).meant, pages(directories).note());
        assert_eq!(meant(&[&[PREVIEW], &[MASK], &[WHOLE]]), (2, None));
        let (page, note) = meant(&[&[PAGE], &[PREVIEW], &[]]);
        assert_eq!((page, note.as_deref()), (0, Some("TIFF: it has 2 pages, of which the first is read")));
    }

    #[test]
    fn a_first_page_smaller_than_another_is_refused() {
        let size = |px| [(WIDTH, SHORT, 1, px), (HEIGHT, SHORT, 1, px)];
        let check = |a, b| pages(&[&size(a), &size(b)]).check(Path::new("a.tif"));
        assert!(check(8, 8).is_ok() && check(8, 4).is_ok());
        let message = check(4, 8).unwrap_err().to_string();
        assert!(
            message.contains("first page is 4 x 4 px, but a later one 8 x 8 px; save the intended page"),
            "{message}"
        );
    }
}
