//! Every row, measured; `EXTREMES=write` makes a page of them, without it the page is checked to state the
//! bounds that hold.

use std::fs;

use rayon::prelude::*;
use serde_json::Value;

use crate::common::Workdir;
use crate::measured::{Measured, SPECTRA};
use crate::rows::{ROWS, Row};

const PAGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/benches/results/extremes.md");
const HEAD: &str = "\
# Extremes

Unless a row states otherwise: 45°, square panels of 10 x 10 facets, a Canon EOS 5D Mark II and \
D65. First the bounds that
`cargo test --test extremes` holds, then what was measured:

- facets: largest error of facets without noise, over the brightest. The sheet reflects 0.9, the \
row's reflectance, or is `cc24:red`
  (lights and cameras). One flat patch per facet, solved to 1e-9, against NumPy: form factors by \
Sparrow's double integral, conjugate
  gradients. \"Undivided\" is `--mesh auto` against the limit of NumPy's patches, for panels 1000 \
times as wide as deep along an endless
  crease;
- RMSE of an estimate from facets with a noise of 1e-3 of white, exposure known, of `cc24:red` or \
the row's reflectance;
- deviations: root mean square of its errors in units of their standard deviations;
- s: seconds of the four tools, vforward twice. They are not promised.

| | facets | RMSE | deviations | facets | RMSE | deviations | s |
|---|---|---|---|---|---|---|---|
";

/// What is extreme, and the bounds.
fn bounds(row: &Row) -> String {
    let estimate = row.estimate.map(|bounds| bounds.map(|bound| bound.to_string()));
    format!("| {} | {:e} | {} |", row.what, row.facets, cells(estimate))
}

fn line(row: &Row, measured: &Measured) -> String {
    let estimate =
        measured.estimate.map(|[rmse, deviations]| [format!("{rmse:.4}"), format!("{deviations:.1}")]);
    format!("{} {:.0e} | {} | {:.2} |\n", bounds(row), measured.facets, cells(estimate), measured.seconds)
}

fn cells(estimate: Option<[String; 2]>) -> String {
    estimate.map_or("refused | ".to_owned(), |both| both.join(" | "))
}

#[test]
fn every_extreme_keeps_its_bounds() {
    if !Workdir::new().can("python3 -c 'import numpy'", "extremes are not compared with NumPy's solution") {
        return;
    }
    let measured: Vec<Measured> = ROWS.par_iter().map(Row::measure).collect();
    let lines: Vec<String> = ROWS.iter().zip(&measured).map(|(row, measured)| line(row, measured)).collect();
    let broken = ROWS.iter().zip(&measured).zip(&lines).filter(|((row, measured), _)| !row.holds(measured));
    let broken: String = broken.map(|(_, line)| line.as_str()).collect();
    assert!(broken.is_empty(), "bounds, then what was measured:\n{broken}");
    if std::env::var("EXTREMES").is_ok_and(|wish| wish == "write") {
        fs::write(PAGE, HEAD.to_owned() + &lines.concat()).unwrap();
    }
}

#[test]
fn the_page_states_the_bounds_that_hold() {
    let page = fs::read_to_string(PAGE).unwrap();
    assert!(page.starts_with(HEAD));
    let stated: Vec<&str> = page[HEAD.len()..].lines().collect();
    assert_eq!(stated.len(), ROWS.len());
    for (row, line) in ROWS.iter().zip(stated) {
        assert!(
            line.starts_with(&bounds(row)),
            "{line}\nmake it anew: EXTREMES=write cargo test --test extremes"
        );
    }
}

/// Finer than Lanczos' steps reach.
#[test]
fn a_tenth_of_a_degree_undivided_is_refused() {
    for flags in ["-q", "-q --tolerance 1e-2"] {
        let run = Workdir::new().sh(&format!("vkernel --angle-deg 0.1 {flags}"));
        assert!(
            run.status == 2
                && run.stderr.contains("give more than 0.2°")
                && run.stderr.lines().count() == 1
                && run.stdout.is_empty(),
            "{flags}: {run:?}"
        );
    }
}

/// It tells the reflectance there, and nothing of the rest.
#[test]
fn a_light_of_one_line_tells_the_reflectance_of_one_waveband() {
    let folder = Workdir::new();
    folder.sh(SPECTRA);
    let run = folder.sh("vkernel --mesh facets | vforward --reflectance cc24:red --illuminant line.csv \
        --noise-sd 1e-3 --seed 1 | vestimate -q | tail -n 1");
    let sample: Value = serde_json::from_str(&run.stdout).unwrap();
    let at = |spectrum: &Value, nm: usize| spectrum[(nm - 400) / 5].as_f64().unwrap();
    let estimate = &sample["estimate"];
    let off = at(&estimate["reflectance"], 550) - at(&sample["truth"]["reflectance"], 550);
    let sd = |nm: usize| at(&estimate["reflectance_sd"], nm);
    assert!(sd(550) < 1e-3 && off.abs() < 3.0 * sd(550), "off by {off}, said {}", sd(550));
    assert!([400, 450, 650, 700].into_iter().all(|nm| sd(nm) > 0.02), "{estimate}");
}
