//! Drawings for people: each is a `figure` in its own file, SVG or PNG.
//!
//! [`sheets`] draws one or a few sheets, and many ([`multiples`]) in a small chart each, [`batch`] draws
//! scores, [`surface`] the effect of a kernel on its facets. They consist of [`spectra`], swatches and maps,
//! in one font and in colours that all readers can distinguish.

pub mod batch;
mod bitmap;
mod figure;
mod histogram;
pub mod maps;
pub mod multiples;
mod scale;
pub mod sheet;
pub mod sheets;
pub mod spectra;
pub mod surface;
mod swatches;
mod terminal;
mod text;

pub use bitmap::data_uri;
pub use figure::{COLOURS, load_font};
