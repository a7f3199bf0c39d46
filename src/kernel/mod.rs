//! How much of the light that leaves one part of a surface reaches another: geometry alone, no light, no colour.
//!
//! Two answers to two questions: [`FoldKernel`] holds the form factors between facets, eq. (10), found by a method of its
//! own file ([`exact`] is right to rounding); [`continuum`] solves the bounces between surfaces that are not divided at
//! all, eqs. (1) to (4).

pub mod continuum;
pub mod exact;
pub mod facets;
pub mod fold_kernel;
pub mod mesh;
pub mod panel;
pub mod quadrature;
pub mod spectra;

pub use fold_kernel::FoldKernel;
