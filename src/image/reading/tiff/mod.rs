//! TIFF files: selection of a page, layout of its samples, and statements on them.
//!
//! The crate `tiff` decodes strips and tiles with interleaved samples. A file with separate planes, or with
//! more samples per pixel than colours and alpha, is presented to it as grey samples by a directory made
//! here, and the required samples are selected from the result. Unsupported features are refused by name;
//! only a file that contradicts itself is reported as damaged.

mod described;
mod directory;
mod layout;
mod levels;
mod pages;
mod pixels;
mod statements;
pub(super) mod tags;
pub(super) mod written;

use std::io::{self, BufRead, Seek};
use std::path::Path;

use image::DynamicImage;

use self::layout::Layout;
use self::pages::Pages;
use self::pixels::Pixels;
use self::tags::{X_RESOLUTION, Y_RESOLUTION};
use super::alpha;
use super::levels::Levels;
use super::pixel_shape;
use super::refused::{TOO_LARGE, check_size, undecodable};
use super::stated::Statement;
use crate::{Result, room};

/// A TIFF file whose directories have been read.
pub(super) struct Tiff {
    pages: Pages,
    length: u64,
}

impl Tiff {
    /// Reads the directories of a file of this length.
    pub fn open(file: &mut (impl BufRead + Seek), length: u64) -> io::Result<Self> {
        let directories = directory::read_all(file, length)?;
        Ok(Self { pages: Pages::new(directories), length })
    }

    /// Whether it contains sensor data, and at best a preview for other programs.
    pub fn is_raw(&self) -> bool {
        self.pages.is_raw()
    }

    /// The number of the selected page, from 0.
    pub fn page(&self) -> usize {
        self.pages.meant
    }

    /// A note on pages that are not read.
    pub fn note(&self) -> Option<String> {
        self.pages.note()
    }

    /// Statements of the selected page on its numbers.
    pub fn statements(&self) -> Vec<Statement> {
        statements::statements(self.pages.directory())
    }

    /// The numbers that the selected page states for black and white.
    pub fn levels(&self) -> Option<Levels> {
        levels::levels(self.pages.directory())
    }

    /// Pixels of the selected page per unit of length, across and down.
    fn density(&self) -> Option<[f64; 2]> {
        let first = |tag| self.pages.directory().reals(tag)?.first().copied();
        Some([first(X_RESOLUTION)?, first(Y_RESOLUTION)?])
    }

    /// The pixels of the selected page.
    ///
    /// # Errors
    /// [`Error::Picture`] with the reason if they cannot be read.
    pub fn pixels(&self, path: &Path, file: &mut (impl BufRead + Seek)) -> Result<DynamicImage> {
        self.pages.check(path)?;
        pixel_shape::check(path, "XResolution and YResolution", self.density())?;
        let layout = Layout::of(path, self.pages.directory(), self.length)?;
        let bytes = layout.bytes();
        check_size(path, (layout.width, layout.height), layout.stored_bytes(), self.length)?;
        room::ask(bytes + layout.other_bytes(), &path.display().to_string(), TOO_LARGE)?;
        let mut picture = DynamicImage::from_decoder(Pixels { file, layout: &layout, length: self.length })
            .map_err(|error| undecodable(path, error))?;
        if layout.is_multiplied {
            alpha::divide(path, &mut picture)?;
        }
        Ok(picture)
    }
}
