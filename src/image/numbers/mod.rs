//! The meaning of stored numbers: black and white level, curve, and the camera's development.

mod development;
mod scale;
mod transfer;

pub use development::Development;
pub use scale::ReadOptions;
pub(in crate::image) use scale::Scale;
pub use transfer::{Transfer, srgb_to_linear};
