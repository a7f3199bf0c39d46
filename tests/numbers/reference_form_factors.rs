//! Form factors against reference values computed with 60-digit arithmetic (two independent methods).

use std::fs;
use std::path::Path;

use serde_json::Value;
use vfold::geometry::{FacetGrid, Fold};
use vfold::paper::{FoldKernel, form_factors};

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
    form_factors(&Fold::new(angle_deg, width, depth, FacetGrid { rows, cols }).unwrap())
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
            worst = worst.max((kernel.form_factor(0, i, j, k) - number(&entry[3])).abs());
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
        let got = kernel(angle, cols as f64, rows as f64, rows, cols).form_factor(0, i, j, k);
        let want = number(&pair["F"]);
        assert!((got - want).abs() < 1e-12, "{pair}: {got}");
        assert!((got - want).abs() < 1e-9 * want, "{pair}: {got}, relative {:.1e}", got / want - 1.0);
    }
}

/// Form factor from rectangle `[x0, x1, s0, s1]` of panel 0 to one of panel 1, put together from square
/// facets.
fn rectangles(angle_deg: f64, a: [f64; 4], b: [f64; 4]) -> f64 {
    let whole = |unit: f64| a.iter().chain(&b).all(|edge| (edge / unit - (edge / unit).round()).abs() < 1e-9);
    let unit = [1.0, 0.5, 0.25, 0.1].into_iter().find(|unit| whole(*unit)).unwrap();
    let [a, b] = [a, b].map(|edges| edges.map(|edge| (edge / unit).round() as usize));
    let (cols, rows) = (a[1].max(b[1]), a[3].max(b[3]));
    let kernel = kernel(angle_deg, cols as f64, rows as f64, rows, cols);
    let mut sum = 0.0;
    for (x, s) in (a[0]..a[1]).flat_map(|x| (a[2]..a[3]).map(move |s| (x, s))) {
        for (y, t) in (b[0]..b[1]).flat_map(|y| (b[2]..b[3]).map(move |t| (y, t))) {
            sum += kernel.shifts(s, t)[x.abs_diff(y)];
        }
    }
    sum / ((a[1] - a[0]) * (a[3] - a[2])) as f64
}

#[test]
fn whole_panels_of_equal_and_unequal_depth() {
    let data = reference("panel_factors.json");
    for panel in data["panels"].as_array().unwrap() {
        let [angle, width, depth, other] =
            ["theta_deg", "width", "depth0", "depth1"].map(|key| number(&panel[key]));
        let want = number(&panel["F"]);
        let got = rectangles(angle, [0.0, width, 0.0, depth], [0.0, width, 0.0, other]);
        assert!((got - want).abs() < 1e-12, "{panel}: {got}");
        let fold = Fold::new(angle, width, depth, FacetGrid { rows: 1, cols: 1 }).unwrap();
        let whole = form_factors(&fold.with_panel1_depth(other).unwrap()).form_factor(0, 0, 0, 0);
        assert!((whole - want).abs() < 1e-12, "{panel}: {whole}");
    }
}

#[test]
fn rectangles_anywhere_on_the_panels() {
    let data = reference("rectangle_pairs.json");
    for pair in data["pairs"].as_array().unwrap() {
        let [a, b] = ["a", "b"].map(|key| [0, 1, 2, 3].map(|n| number(&pair[key][n])));
        let got = rectangles(number(&pair["theta_deg"]), a, b);
        assert!((got - number(&pair["F"])).abs() < 1e-12, "{pair}: {got}");
    }
}
