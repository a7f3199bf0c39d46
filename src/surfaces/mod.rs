//! What is no fold: any surface of flat facets, what its parts hide from each other, and the light that it
//! exchanges.
//!
//! A fold has formulas of its own, for which the rest of the crate does without this room. Its door are the
//! items below: a [`Shape`], read from a file ([`obj`], [`ply`]) or built ([`Accordion`]); the form factors
//! between its patches and the light that falls on them ([`kernel`]); the bounces as poles and residues, of
//! one light ([`SurfaceResponse`]) or with parts of known reflectance ([`ReducedExchange`]); and photographs
//! of it ([`ShapeView`]). Only [`stream`](crate::stream), [`scene`](crate::scene) and the tools come in by
//! it: they are the places where a scene turns out to be a fold or not.

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
