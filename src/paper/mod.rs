//! The method as published, and its rivals: what the paper compares with, and what this crate is compared
//! with.
//!
//! The rest of the crate does without this room: it solves undivided panels where the paper divides them into
//! facets, and weighs classes of spectra where the paper asks for smoothness. Here are the form factors
//! between facets, eq. (10), by every [`Method`], with the laws that they should obey ([`check`]) and the
//! bounces on them ([`respond`]); light [bounce by bounce](bounces) and [facet by facet](nonuniform); the
//! paper's estimator ([`smooth`]) and those of flat sheets ([`park`], [`khan`]). The tools come in by this
//! door, and records that say how a scene was made.

pub mod bounces;
mod bounds;
pub mod check;
pub mod components;
mod conjugate_gradients;
mod facets;
mod fold_kernel;
mod form_factors;
pub mod interior_point;
pub mod khan;
mod mesh;
mod method;
pub mod midpoint;
pub mod monte_carlo;
pub mod nonuniform;
pub mod park;
pub mod smooth;
pub mod spectra;

pub use conjugate_gradients::conjugate_gradients;
pub use facets::FacetOperator;
pub use fold_kernel::FoldKernel;
pub use form_factors::form_factors;
pub use mesh::respond;
pub use method::Method;
