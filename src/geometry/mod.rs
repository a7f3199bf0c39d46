//! Shapes and the light that falls on them; nothing here knows about reflectance or colour.
//!
//! A [`Fold`] is two panels and has formulas of its own; a [`Shape`] is any surface of flat facets, read from a file ([`obj`]) or
//! built here ([`accordion`]). [`Panel`]s are what photographs of either are measured by.

pub mod accordion;
mod faces;
mod file;
pub mod fold;
mod fold_shape;
pub mod light;
pub mod merged;
pub mod obj;
pub mod panel;
pub mod ply;
pub mod polygon;
pub mod shape;
pub mod sight;
pub mod source;
pub mod standard_sky;

pub use fold::{FacetGrid, Fold, Spacing};
pub use light::Light;
pub use panel::{Panel, joints};
pub use polygon::{Polygon, Vec3};
pub use shape::{Group, Shape};
pub use source::LightSource;
pub use standard_sky::StandardSky;
