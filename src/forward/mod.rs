//! From reflectance to what a camera sees of a folded sheet, or of any other surface.

mod bispectral;
pub mod bounces;
mod families;
mod fluorescence;
mod fold;
mod known;
mod lighting;
pub mod model;
pub mod noise;
pub mod nonuniform;
mod open_light;
pub mod render;
mod surface;
mod terms;
mod values;

pub use bispectral::{BispectralLight, BispectralSheet};
pub use fluorescence::Fluorescing;
pub use lighting::{Lighting, Lit};
pub use model::FacetModel;
pub use open_light::OpenLight;
pub use terms::Card;
pub use values::FacetValues;
