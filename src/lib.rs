//! vfold measures the spectral reflectance of a matte sheet with an ordinary camera.

pub mod colorimetry;
pub mod error;
pub mod image;
pub mod score;
pub mod spectrum;

pub use error::{Error, Result};
