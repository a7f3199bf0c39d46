//! The five tools as they are used, on command lines and in pipelines, beside what is known of the answer,
//! and with the programs that people use them with.

// a test stops at the first surprise, and prints what it measured
#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

mod angle;
mod cameras;
mod cli;
mod cluster;
#[path = "../common/mod.rs"]
mod common;
mod continuity;
mod cornell;
mod coverage;
mod daylight;
mod determinism;
mod estimates;
mod fit;
mod flat_sheets;
mod fluorescence;
mod ill_posed;
mod install;
mod joint;
mod known_fold;
mod levels;
mod measure;
mod no_fold;
mod not_modelled;
mod one_call;
mod photographs;
mod picker;
mod picture_files;
mod plots;
mod python;
#[cfg(feature = "raw")]
mod raw;
#[cfg(feature = "raw")]
mod raw_files;
#[cfg(feature = "raw")]
mod raw_layouts;
#[path = "../common/ready.rs"]
mod ready;
mod real_sheets;
mod report;
mod resume;
mod scripts;
mod silence;
mod spectra_files;
mod streams;
mod tables;
mod terminal;
mod unknown_light;
mod verdict;
