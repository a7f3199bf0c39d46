//! The ends of every range: nearly closed and nearly flat folds, thin and wide panels, one facet and many,
//! black and white sheets, dark and spiky light, one channel and many. In process the laws of light, through
//! the tools numbers with a bound.

// a test stops at the first surprise
#![allow(clippy::unwrap_used)]

#[path = "../common/mod.rs"]
mod common;
mod corners;
mod laws;
mod measured;
mod rows;
mod table;
