//! Inputs that fuzzing kept: one of each kind that a reader tells apart, and every one that ever broke
//! something.
//!
//! `targets` has what is done with them; `sheen/` does it with new ones, under the guidance of what they
//! reach.

// a test stops at the first surprise
#![allow(clippy::unwrap_used, clippy::panic)]

mod commands;
mod mutations;
mod targets;

use std::path::{Path, PathBuf};

use proptest::prelude::ProptestConfig;
use proptest::test_runner::RngSeed;

/// The kept inputs of a target.
fn kept(target: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus/kept").join(target);
    let mut files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|file| file.unwrap().path()).collect();
    files.sort();
    files
}

/// So many cases, the same in every run, or as many as the environment asks for, others in every run: chance
/// looks for faults where somebody waits for what it finds.
fn cases(few: u32) -> ProptestConfig {
    let asked = std::env::var("PROPTEST_CASES").ok().and_then(|cases| cases.parse().ok());
    let rng_seed = if asked.is_some() { RngSeed::Random } else { RngSeed::Fixed(0) };
    ProptestConfig {
        cases: asked.unwrap_or(few),
        failure_persistence: None,
        rng_seed,
        ..ProptestConfig::default()
    }
}

#[test]
fn kept_inputs_are_taken_or_refused_plainly() {
    for (name, target) in targets::TARGETS {
        let breaks = |file: &PathBuf| {
            let bytes = std::fs::read(file).unwrap();
            std::panic::catch_unwind(|| target(&bytes)).is_err()
        };
        let files = kept(name);
        let broken: Vec<_> = files.iter().filter(|file| breaks(file)).collect();
        assert!(!files.is_empty() && broken.is_empty(), "{name}: {broken:#?}");
    }
}
