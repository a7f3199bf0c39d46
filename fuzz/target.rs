//! One fuzz target, built under each name of `targets::TARGETS`.

#![no_main]

use vfold_fuzz::targets::TARGETS;

libfuzzer_sys::fuzz_target!(
    // libFuzzer's own hook ends the process even where a panic of a library is caught
    init: std::panic::set_hook(Box::new(|panic| eprintln!("{panic}"))),
    |bytes: &[u8]| {
        let (_, target) = TARGETS.iter().find(|(name, _)| *name == env!("CARGO_BIN_NAME")).unwrap();
        target(bytes);
    }
);
