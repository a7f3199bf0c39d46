//! What is written about the tools is true: man pages, completions, schemas, documentation, the map from the
//! paper to the code, the picture of which module uses which, without circles, and the words of names.

// a test stops at the first surprise, and prints what it found
#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout, clippy::print_stderr)]

mod circles;
#[path = "../common/mod.rs"]
mod common;
mod docs;
mod flags;
mod imports;
mod lines;
mod pages;
mod paper_map;
mod pictures;
mod schema;
mod words;
