//! How much of the light that leaves one panel of a fold reaches the other: geometry alone, no light, no
//! colour.
//!
//! [`continuum`] holds the exchange between panels that are not divided at all, eqs. (1) to (4), which
//! [`refinement`] resolves as finely as asked for; [`respond`](mesh::respond) makes of it what light becomes.
//! Panels that are [`bent`] and the light of the [`environment`] go through flat strips and facets. Form
//! factors between facets, as the paper has them, are in [`paper`](crate::paper); what is no fold in
//! [`surfaces`](crate::surfaces).

pub mod bent;
pub mod continuum;
pub mod environment;
pub mod mesh;
pub mod quadrature;
pub mod refinement;
pub mod skipped;
pub mod wedge;
