//! A report for people: one HTML file with all that a scored stream says, in drawings and words.
//!
//! [`Gallery`] keeps what is to be shown of a stream of any length, [`write()`] makes the page of it: `html`
//! holds the elements, `page` their look, `batch`, `sample` and `scene` the sections, `colours`, `photograph`
//! and `command` parts of these. The file needs no other, no script and no network.

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

/// Writes the page of a gallery, and of the scores of all samples.
///
/// # Errors
/// [`crate::Error::File`] if it cannot be written, or an overlay cannot be read; [`crate::Error::Usage`] for
/// an overlay of no sample; [`crate::Error::Field`] if a record is not what the tools write.
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
