//! What the search for folds weighs in photographs, a line of JSON each, for `benches/find_fit.py`:
//! `cargo bench --bench find -- FOLDER/*.tif`. `charts` before the files: what that for charts does.
#![allow(clippy::print_stdout)] // its output

use std::env::args;
use std::error::Error;
use std::path::Path;

use serde_json::{Value, json};
use vfold::image::{Lens, Photograph, ReadOptions, WeighedFold, weighed_chart, weighed_folds};

fn main() -> Result<(), Box<dyn Error>> {
    let is_of_charts = args().nth(1).is_some_and(|first| first == "charts");
    for path in args().skip(1 + usize::from(is_of_charts)).filter(|argument| argument != "--bench") {
        let photograph = Photograph::open(Path::new(&path), &ReadOptions::default())?;
        if is_of_charts {
            println!("{}", chart(&path, &photograph));
            continue;
        }
        let [hypotheses, candidates] =
            weighed_folds(&photograph).map(|folds| folds.iter().map(record).collect::<Vec<_>>());
        println!("{}", json!({ "image": path, "hypotheses": hypotheses, "candidates": candidates }));
    }
    Ok(())
}

fn chart(path: &str, photograph: &Photograph) -> Value {
    let chart = weighed_chart(photograph, &Lens::STRAIGHT);
    let corners = chart.map(|(chart, _)| chart.corners.map(|corner| [corner.x, corner.y]));
    json!({ "image": path, "chart": corners, "weighed": chart.map(|(_, weighed)| weighed) })
}

fn record(fold: &WeighedFold) -> Value {
    json!({
        "panels": fold.panels.map(|panel| panel.map(|corner| [corner.x, corner.y])),
        "weighed": fold.weighed,
    })
}
