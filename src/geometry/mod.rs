//! A fold and the light that falls on it; nothing here knows about reflectance or colour.
//!
//! A [`Fold`] has two [`Panel`]s, in which photographs are measured. Other shapes are in
//! [`surfaces`](crate::surfaces).

pub mod fold;
pub mod light;
pub mod panel;
pub mod source;
pub mod standard_sky;

pub use fold::{FacetGrid, Fold, Spacing};
pub use light::Light;
pub use panel::{Panel, joints};
pub use source::LightSource;
pub use standard_sky::StandardSky;

/// A point or direction in space.
pub type Vec3 = nalgebra::Vector3<f64>;
