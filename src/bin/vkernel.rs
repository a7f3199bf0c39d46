//! `vkernel`

fn main() {}
