//! Form factors against reference values computed with 60-digit arithmetic (two independent methods).

// a test stops at the first surprise, and says what it measured
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use std::fs;
use std::path::Path;

use serde_json::Value;
use vfold::geometry::{FacetGrid, Fold};
use vfold::kernel::exact::FoldKernel;

fn reference(name: &str) -> Value {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/reference");
    serde_json::from_str(&fs::read_to_string(folder.join(name)).unwrap()).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_str().map_or_else(|| value.as_f64().unwrap(), |text| text.parse().unwrap())
}

fn index(value: &Value) -> usize {
    value.as_u64().unwrap() as usize
}

fn kernel(angle_deg: f64, width: f64, depth: f64, rows: usize, cols: usize) -> FoldKernel {
    FoldKernel::new(&Fold::new(angle_deg, width, depth, FacetGrid { rows, cols }).unwrap())
}

#[test]
fn every_entry_of_the_tables_is_within_1e_12() {
    let data = reference("facet_tables.json");
    for table in data["tables"].as_array().unwrap() {
        let [angle, width, depth] = ["theta_deg", "width", "depth"].map(|key| number(&table[key]));
        let kernel = kernel(angle, width, depth, index(&table["ny"]), index(&table["nx"]));
        let mut worst: f64 = 0.0;
        for entry in table["entries"].as_array().unwrap() {
            let [k, i, j] = [0, 1, 2].map(|n| index(&entry[n]));
            worst = worst.max((kernel.form_factor(i, j, k) - number(&entry[3])).abs());
        }
        println!("{angle}° {width}x{depth}: worst entry error {worst:.1e}");
        assert!(worst < 1e-12);
    }
}

#[test]
fn facet_pairs_from_0_1_to_179_degrees() {
    let data = reference("facet_pairs.json");
    for pair in data["pairs"].as_array().unwrap() {
        let [k, i, j] = ["k", "i", "j"].map(|key| index(&pair[key]));
        let angle = number(&pair["theta_deg"]);
        let (rows, cols) = (i.max(j) + 1, k + 1);
        let got = kernel(angle, cols as f64, rows as f64, rows, cols).form_factor(i, j, k);
        let want = number(&pair["F"]);
        assert!((got - want).abs() < 1e-12, "{pair}: {got}");
        assert!((got - want).abs() < 1e-9 * want, "{pair}: {got}, relative {:.1e}", got / want - 1.0);
    }
}

#[test]
fn whole_panels_of_equal_depth() {
    let data = reference("panel_factors.json");
    for panel in data["panels"].as_array().unwrap() {
        let [angle, width, depth, other] =
            ["theta_deg", "width", "depth0", "depth1"].map(|key| number(&panel[key]));
        if (depth - other).abs() > 0.0 {
            continue;
        }
        let got = kernel(angle, width, depth, 1, 1).form_factor(0, 0, 0);
        assert!((got - number(&panel["F"])).abs() < 1e-12, "{panel}: {got}");
    }
}
