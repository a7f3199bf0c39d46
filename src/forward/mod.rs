//! From reflectance to what a camera sees of a folded sheet.

mod bispectral;
mod families;
mod fluorescence;
mod fold;
mod lighting;
pub mod model;
pub mod noise;
mod open_light;
pub mod render;
mod terms;
mod values;

pub use bispectral::{BispectralLight, BispectralSheet};
pub use fluorescence::Fluorescing;
pub(crate) use lighting::seen_bands;
pub use lighting::{Lighting, Lit};
pub use model::FacetModel;
pub(crate) use model::Source;
pub use open_light::OpenLight;
pub use terms::Card;
pub(crate) use terms::Terms;
pub use values::FacetValues;
