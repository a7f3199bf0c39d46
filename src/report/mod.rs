//! A report for people: one HTML file with the contents of a scored stream, as drawings and text.
//!
//! [`Gallery`] selects what to show of a stream of any length, [`write()`] makes its page: `html` has the
//! elements, `page` their style, `batch`, `sample` and `scene` the sections, `colours`, `photograph` and
//! `command` parts of these. The file needs no other file, script or network.

mod batch;
mod colours;
mod command;
mod gallery;
mod html;
mod overlay;
mod page;
mod photograph;
mod sample;
mod scene;
mod tables;
mod view;
mod words;

use std::path::Path;

pub use gallery::{Gallery, Shown};
pub use view::{SECTIONS_MAX, View};

use crate::error::Result;
use crate::files::Saved;
use crate::score::Summary;

/// Writes the page of a gallery, with the scores of all samples.
///
/// # Errors
/// [`crate::Error::File`] if it cannot be written, or an overlay cannot be read; [`crate::Error::Usage`] for
/// an overlay without a sample; [`crate::Error::Field`] if a record is invalid.
pub fn write(path: &Path, gallery: &Gallery, summary: &Summary, view: &View) -> Result<()> {
    overlay::check(gallery, view)?;
    let mut sections = Vec::new();
    sections.extend(batch::section(gallery, summary)?);
    for (number, shown) in gallery.in_order().enumerate() {
        sections.push(sample::section(number, shown, gallery, view)?);
    }
    sections.extend(scene::sections(gallery)?);
    Saved::write(path, page::page(gallery, sections)?.as_bytes())
}
