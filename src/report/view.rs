//! How samples are shown.

use std::path::PathBuf;

use crate::colorimetry::Observer;
use crate::spectrum::Spectrum;

/// Most samples that have a section.
pub const SECTIONS_MAX: usize = 24;

/// The conditions under which sheets are shown.
pub struct View<'a> {
    /// Illuminant of their colours.
    pub illuminant: &'a Spectrum,
    /// Observer of their colours.
    pub observer: Observer,
    /// Pictures of the measured facets: each has its sample's name, or `{}` in place of it; a single one may
    /// have any name.
    pub overlays: &'a [PathBuf],
}
