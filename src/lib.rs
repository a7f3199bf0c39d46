//! vfold measures the spectral reflectance of a matte sheet with an ordinary camera.

pub mod colorimetry;
pub mod error;
pub mod geometry;
pub mod image;
pub mod kernel;
pub mod response;
pub mod score;
pub mod spectrum;

pub use error::{Error, Result};
