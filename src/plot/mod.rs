//! Drawings for people.

mod figure;
pub mod spectra;
