//! Drawings for people: each a `figure` in a file of its own, SVG or PNG.
//!
//! [`sheets`] draws what is known of one sheet or of a few, [`batch`] how far off many are, [`surface`] what a kernel makes of its
//! facets. They are made of [`spectra`], swatches and maps, in one font and in colours that all readers tell apart.

pub mod batch;
mod bitmap;
mod figure;
mod histogram;
pub mod maps;
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
