//! Drawings for people.

mod figure;
pub mod spectra;
mod terminal;

pub use figure::{COLOURS, load_font};
