//! The library's numbers: laws of light, reference values, published tables, pictures whose answer is known.

// a test stops at the first surprise, and prints what it measured
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::print_stdout)]

mod bent;
mod calibration;
mod cameras;
mod clear_sky;
mod colorimetry;
#[path = "../common/mod.rs"]
mod common;
mod emission;
mod false_maxima;
mod fold_angle;
mod image_facets;
mod image_files;
mod image_refine;
mod image_statements;
mod image_tiff;
mod kernel_methods;
mod laws;
mod lights;
mod mesh;
mod photograph;
mod published;
mod reference_form_factors;
mod sensor;
mod shapes;
mod sheets;
mod surfaces;
