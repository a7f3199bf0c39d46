//! `vestimate`

fn main() {}
