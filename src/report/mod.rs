//! A report for people: one HTML file with all that a scored stream says, in drawings and words.
//!
//! [`Gallery`] keeps what is to be shown of a stream of any length, [`write()`] makes the page of it: `html` holds the elements,
//! `page` their look, `batch`, `sample` and `scene` the sections. The file needs no other, no script and no network.

mod batch;
mod gallery;
mod html;
mod overlay;
mod page;
mod sample;
mod scene;
mod words;

use std::path::{Path, PathBuf};

pub use gallery::{Gallery, Shown};

use crate::colorimetry::Observer;
use crate::error::Result;
use crate::files::Saved;
use crate::score::Summary;
use crate::spectrum::Spectrum;

/// Most samples that have a section.
pub const SECTIONS_MAX: usize = 24;

/// How sheets are looked at.
pub struct View<'a> {
    /// Illuminant of their colours.
    pub illuminant: &'a Spectrum,
    /// Observer of their colours.
    pub observer: Observer,
    /// Pictures of what was measured: each has its sample's name, or `{}` in the place of it; one alone may be called anything.
    pub overlays: &'a [PathBuf],
}

/// Writes the page of a gallery, and of the scores of all samples.
///
/// # Errors
/// [`crate::Error::File`] if it cannot be written, or an overlay cannot be read; [`crate::Error::Usage`] for an overlay of no sample;
/// [`crate::Error::Field`] if a record is not what the tools write.
pub fn write(path: &Path, gallery: &Gallery, summary: &Summary, view: &View) -> Result<()> {
    overlay::check(gallery, view)?;
    let mut sections = Vec::new();
    sections.extend(batch::section(gallery, summary)?);
    for (number, shown) in gallery.in_order().enumerate() {
        sections.push(sample::section(number, shown, gallery, view)?);
    }
    sections.extend(scene::sections(gallery)?);
    Saved::write(path, page::page(gallery, sections).as_bytes())
}
