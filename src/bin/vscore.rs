//! `vscore`

fn main() {}
