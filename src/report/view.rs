//! How samples are shown.

use std::path::PathBuf;

use crate::colorimetry::Observer;
use crate::spectrum::Spectrum;

/// Most samples that have a section.
pub const SECTIONS_MAX: usize = 24;

/// How sheets are looked at.
pub struct View<'a> {
    /// Illuminant of their colours.
    pub illuminant: &'a Spectrum,
    /// Observer of their colours.
    pub observer: Observer,
    /// Pictures of what was measured: each has its sample's name, or `{}` in the place of it; one alone may
    /// be called anything.
    pub overlays: &'a [PathBuf],
}
