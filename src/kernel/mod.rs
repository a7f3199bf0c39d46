//! Share of the light leaving one panel of a fold that reaches the other: geometry alone, without light or
//! colour.
//!
//! [`continuum`] holds the exchange between undivided panels, eqs. (1) to (4), which [`refinement`] resolves
//! as finely as required; [`respond`](mesh::respond) turns it into the response to light. Panels that are
//! [`bent`] and the light of the [`environment`] are computed with flat strips and facets. Form factors
//! between facets, as in the paper, are in [`paper`](crate::paper); shapes other than folds in
//! [`surfaces`](crate::surfaces).

pub mod bent;
pub mod continuum;
pub mod environment;
pub mod mesh;
pub mod panels;
pub mod quadrature;
pub mod refinement;
pub mod skipped;
pub mod wedge;
