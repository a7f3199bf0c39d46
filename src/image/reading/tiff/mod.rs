//! TIFF files: which page is meant, how its samples lie, and what it says of them.
//!
//! The crate `tiff` decodes strips and tiles whose samples lie side by side. A file that keeps planes apart,
//! or has more samples a pixel than colours and alpha, is shown to it as one that does neither, by a
//! directory made here; what is wanted is picked from what comes out. What nobody decodes is refused by its
//! name: only a file that contradicts itself is damaged.

mod described;
mod directory;
mod layout;
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
use super::refused::{TOO_LARGE, check_size, undecodable};
use super::stated::Statement;
use crate::{Result, room};

/// A TIFF file whose directories have been read.
pub(super) struct Tiff {
    pages: Pages,
    length: u64,
}

impl Tiff {
    /// Reads the directories of a file of so many bytes.
    pub fn open(file: &mut (impl BufRead + Seek), length: u64) -> io::Result<Self> {
        let directories = directory::read_all(file, length)?;
        Ok(Self { pages: Pages::new(directories), length })
    }

    /// Whether it holds what a sensor saw, and at best a preview for other programs.
    pub fn is_raw(&self) -> bool {
        self.pages.is_raw()
    }

    /// The number of the page that is meant, from 0.
    pub fn page(&self) -> usize {
        self.pages.meant
    }

    /// What is to be known of the pages that are not read.
    pub fn note(&self) -> Option<String> {
        self.pages.note()
    }

    /// What the page that is meant says of its numbers.
    pub fn statements(&self) -> Vec<Statement> {
        statements::statements(self.pages.directory())
    }

    /// The pixels of the page that is meant.
    ///
    /// # Errors
    /// [`Error::Picture`] with the reason if they cannot be read.
    pub fn pixels(&self, path: &Path, file: &mut (impl BufRead + Seek)) -> Result<DynamicImage> {
        self.pages.check(path)?;
        let layout = Layout::of(path, self.pages.directory(), self.length)?;
        let bytes = layout.bytes();
        check_size(path, (layout.width, layout.height), layout.stored_bytes(), self.length)?;
        room::ask(bytes + layout.other_bytes(), &path.display().to_string(), TOO_LARGE)?;
        DynamicImage::from_decoder(Pixels { file, layout: &layout, length: self.length })
            .map_err(|error| undecodable(path, error))
    }
}
