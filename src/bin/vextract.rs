//! `vextract`

fn main() {}
