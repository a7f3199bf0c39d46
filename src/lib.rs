//! vfold measures the spectral reflectance of a matte sheet with an ordinary camera.

pub mod error;
pub mod image;
pub mod spectrum;
pub mod colorimetry;
pub mod score;

pub use error::{Error, Result};
