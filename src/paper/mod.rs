//! The published method and its rivals: those with which the paper compares, and with which this crate is
//! compared.
//!
//! The rest of the crate does not depend on this module: it solves undivided panels where the paper divides
//! them into facets, and weights classes of spectra where the paper imposes smoothness. This module contains
//! the form factors between facets, eq. (10), by every [`Method`], with the laws that they should obey
//! ([`check`]) and the bounces on them ([`respond`]); light [bounce by bounce](bounces) and [facet by
//! facet](nonuniform); the paper's estimator ([`smooth`]) and those for flat sheets ([`park`], [`khan`]).
//! Only the tools use it, and the records on how a scene was made.

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
