//! vfold measures the spectral reflectance of a matte sheet with an ordinary camera.

pub mod camera;
pub mod cli;
pub mod colorimetry;
pub mod error;
pub mod estimate;
pub mod files;
pub mod forward;
pub mod geometry;
pub mod image;
pub mod kernel;
pub mod plot;
pub mod response;
pub mod score;
pub mod solve;
pub mod spectrum;
pub mod stream;

pub use error::{Error, Result};
