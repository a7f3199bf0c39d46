//! What a stored number means: black and white level, curve, and what a camera made of its own colours.

mod development;
mod scale;
mod transfer;

pub use development::Development;
pub use scale::ReadOptions;
pub(in crate::image) use scale::Scale;
pub use transfer::{Transfer, srgb_to_linear};
