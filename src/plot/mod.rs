//! Drawings for people: each a `figure` in a file of its own, SVG or PNG.
//!
//! [`sheets`] draws what is known of one sheet or of a few, and of many ([`multiples`]) a small chart each,
//! [`batch`] how far off they are, [`surface`] what a kernel makes of its facets. They are made of
//! [`spectra`], swatches and maps, in one font and in colours that all readers tell apart.

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
