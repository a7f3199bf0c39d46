//! From reflectance to what a camera sees of a folded sheet.

pub mod model;
pub mod noise;
pub mod render;

pub use model::{FacetModel, Lighting};
