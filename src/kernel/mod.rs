//! How much of the light that leaves one part of a surface reaches another: geometry alone, no light, no colour.
//!
//! Two answers to two questions: [`exact`] gives the form factors between facets, eq. (10), to rounding;
//! [`continuum`] solves the bounces between surfaces that are not divided at all, eqs. (1) to (4).

pub mod continuum;
pub mod exact;
pub mod facets;
pub mod mesh;
pub mod panel;
pub mod quadrature;
