//! How much of the light that leaves one part of a surface reaches another: geometry alone, no light, no colour.
//!
//! Two answers to two questions: [`FoldKernel`] holds the form factors between facets, eq. (10), found by a method of its
//! own file ([`method`] names them, [`exact`] is right to rounding) and checked by [`check`]; [`continuum`] holds the exchange
//! between surfaces that are not divided at all, eqs. (1) to (4), which [`refinement`] resolves as finely as asked for.

pub mod bent;
pub mod check;
pub mod continuum;
pub mod dense;
pub mod environment;
pub mod exact;
pub mod facets;
pub mod fold_kernel;
pub mod given;
pub mod mesh;
pub mod method;
pub mod midpoint;
pub mod monte_carlo;
pub mod quadrature;
pub mod refinement;
pub mod skipped;
pub mod spectra;

pub mod surface;

pub use fold_kernel::FoldKernel;
pub use method::Method;
