//! What the search for folds weighs in photographs, a line of JSON each, for `benches/find_fit.py`:
//! `cargo bench --bench find -- FOLDER/*.tif`.
#![allow(clippy::print_stdout)] // its output

use std::env::args;
use std::error::Error;
use std::path::Path;

use serde_json::{Value, json};
use vfold::image::{Photograph, ReadOptions, WeighedFold, weighed_folds};

fn main() -> Result<(), Box<dyn Error>> {
    for path in args().skip(1).filter(|argument| argument != "--bench") {
        let photograph = Photograph::open(Path::new(&path), &ReadOptions::default())?;
        let [hypotheses, candidates] =
            weighed_folds(&photograph).map(|folds| folds.iter().map(record).collect::<Vec<_>>());
        println!("{}", json!({ "image": path, "hypotheses": hypotheses, "candidates": candidates }));
    }
    Ok(())
}

fn record(fold: &WeighedFold) -> Value {
    json!({ "panels": fold.panels.map(|panel| panel.map(|corner| [corner.x, corner.y])), "weighed": fold.weighed })
}
