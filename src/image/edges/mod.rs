//! Edges in the picture, and the corners between them.

mod bend;
mod edge;
mod fit;
mod piece;
mod refine;

pub(in crate::image) use edge::{Edge, MOST_OF_PIECE};
pub use refine::{Marked, REFINED_WITHIN_PX, Refinement, refine};
pub(in crate::image) use refine::{Settled, refine_in_sight, settle};
