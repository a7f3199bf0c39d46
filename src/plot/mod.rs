//! Drawings for people.

mod figure;
pub mod spectra;

pub use figure::{COLOURS, load_font};
