//! Surfaces other than a fold: any surface of flat facets, what its parts hide from each other, and the light
//! that they exchange.
//!
//! A fold has formulas of its own, so the rest of the crate does not depend on this module. Its interface is
//! the items below: a [`Shape`], read from a file ([`obj`], [`ply`]) or built ([`Accordion`]); the form
//! factors between its patches and the light that falls on them ([`kernel`]); the bounces as poles and
//! residues, for one light ([`SurfaceResponse`]) or with parts of known reflectance ([`ReducedExchange`]);
//! and photographs of it ([`ShapeView`]). Only [`stream`](crate::stream), [`scene`](crate::scene) and the
//! tools use it: there it is decided whether a scene is a fold.

mod accordion;
mod dense;
mod exchange;
mod external;
mod faces;
mod file;
mod fold_shape;
pub mod kernel;
mod known;
mod merged;
mod model;
mod model_with_known;
pub mod obj;
mod panels;
pub mod ply;
mod polygon;
mod reduced;
mod response;
mod shape;
mod sight;
mod view;

pub use accordion::Accordion;
pub use dense::DenseExchange;
pub use exchange::Exchange;
pub use known::WithKnown;
pub use merged::merged;
pub use polygon::{Plane, Polygon};
pub use reduced::ReducedExchange;
pub use response::SurfaceResponse;
pub use shape::{FACETS_MAX, Group, Shape};
pub use sight::{Met, Sight};
pub use view::ShapeView;
