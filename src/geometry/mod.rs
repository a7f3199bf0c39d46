//! Shapes and the light that falls on them; nothing here knows about reflectance or colour.

pub mod fold;
pub mod light;
pub mod panel;

pub use fold::{FacetGrid, Fold, Spacing};
pub use light::Light;
pub use panel::{Panel, joints};
