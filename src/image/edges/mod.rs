//! Where the picture has edges, and the corners between them.

mod edge;
mod refine;

pub use refine::{Marked, Refinement, refine};
