//! From reflectance to what a camera sees of a folded sheet.

pub mod bounces;
mod families;
pub mod model;
pub mod noise;
pub mod nonuniform;
pub mod render;

pub use model::{Card, FacetModel, Lighting, Lit};
