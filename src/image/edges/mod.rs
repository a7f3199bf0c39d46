//! Where the picture has edges, and the corners between them.

mod edge;
mod fit;
mod piece;
mod refine;

pub(in crate::image) use edge::Edge;
pub use refine::{Marked, Refinement, refine};
pub(in crate::image) use refine::{Settled, settle};
