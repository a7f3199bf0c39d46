//! Drawings for people.

pub mod spectra;
