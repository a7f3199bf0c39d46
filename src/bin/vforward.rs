//! `vforward`

fn main() {}
