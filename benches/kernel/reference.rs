//! What the methods are measured against: form factors with 60 digits, and the bounces on undivided panels.

use std::fs;

use serde_json::Value;
use vfold::geometry::Fold;
use vfold::kernel::mesh::respond;
use vfold::paper::FoldKernel;

use crate::solutions::irradiance;

/// Reflectances at which radiances are compared.
pub const REFLECTANCES: [f64; 3] = [0.5, 0.9, 0.99];
/// Most patches along a side of a panel, in a fold and in one of 1°, whose bounces have hundreds of modes.
const PATCHES_MAX: [usize; 2] = [256, 40];

/// Largest difference of a form factor from those of 60 digits that this fold has: all of its entries where
/// there is a table of it, else those of 17 pairs of facets, the nearest and the furthest among them.
pub fn entry_error(fold: &Fold, kernel: &FoldKernel) -> f64 {
    let n = fold.facets().rows;
    let tables = read("facet_tables.json", "tables");
    let table = tables
        .iter()
        .find(|table| is_angle(fold, table) && ["nx", "ny"].iter().all(|side| index(&table[side]) == n));
    let entries: Vec<([usize; 3], f64)> = match table {
        Some(table) => {
            let entries = table["entries"].as_array().unwrap().iter();
            entries.map(|entry| ([0, 1, 2].map(|k| index(&entry[k])), number(&entry[3]))).collect()
        }
        None => {
            let pairs = read("facet_pairs.json", "pairs").into_iter().filter(|pair| is_angle(fold, pair));
            let pairs = pairs.map(|pair| (["k", "i", "j"].map(|key| index(&pair[key])), number(&pair["F"])));
            pairs.filter(|(at, _)| at.iter().all(|index| *index < n)).collect()
        }
    };
    let error = |([k, i, j], f): ([usize; 3], f64)| (kernel.form_factor(0, i, j, k) - f).abs();
    entries.into_iter().map(error).fold(0.0, f64::max)
}

/// The tightest tolerance of facet means that undivided panels reach within seconds.
pub fn tolerance(fold: &Fold) -> f64 {
    let by_angle = match fold.angle_deg() {
        angle if angle < 10.0 => 1e-4,
        angle if (40.0..80.0).contains(&angle) => 1e-7,
        _ => 1e-8,
    };
    match fold.facets().rows {
        few if few < 16 => by_angle,
        some if some < 256 => by_angle.max(1e-6),
        _ => 1e-5,
    }
}

/// Whether so many patches along a side take half a minute, themselves or on undivided panels.
pub fn too_many(fold: &Fold, patches: usize) -> bool {
    patches > PATCHES_MAX[usize::from(fold.angle_deg() < 10.0)]
}

/// Irradiance of every facet at each of the reflectances, and the error it is believed to have; none where it
/// takes half a minute.
pub fn irradiances(fold: &Fold) -> Option<([Vec<f64>; 3], f64)> {
    if too_many(fold, fold.facets().rows) {
        return None;
    }
    let (response, accuracy) = respond(fold, tolerance(fold)).unwrap();
    Some((REFLECTANCES.map(|r| irradiance(&response, r)), accuracy.facet_mean_error?))
}

/// Largest relative difference, of radiances as of irradiances.
pub fn relative_error(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max)
}

/// Irradiance of the facets of panel 0 in 14 digits, each facet being one flat patch, by reflectance.
pub fn radiances(fold: &Fold) -> Vec<(f64, Vec<f64>)> {
    let n = fold.facets().rows;
    let systems = read("radiance.json", "systems");
    let system = systems.iter().find(|system| is_angle(fold, system) && index(&system["nx"]) == n).unwrap();
    let row = |row: &Value| -> Vec<f64> {
        let half: Vec<f64> = row.as_array().unwrap().iter().map(number).collect();
        (0..n).map(|col| half[col.min(n - 1 - col)]).collect()
    };
    let solution = |solution: &Value| {
        let r = number(&solution["r"]);
        let facets = solution["L"].as_array().unwrap().iter().flat_map(row);
        (r, facets.map(|radiance| std::f64::consts::PI * radiance / r).collect())
    };
    system["radiance"].as_array().unwrap().iter().map(solution).collect()
}

fn read(name: &str, list: &str) -> Vec<Value> {
    let path = format!("{}/tests/data/reference/{name}", env!("CARGO_MANIFEST_DIR"));
    let mut value: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    serde_json::from_value(value[list].take()).unwrap()
}

fn is_angle(fold: &Fold, record: &Value) -> bool {
    number(&record["theta_deg"]).total_cmp(&fold.angle_deg()).is_eq()
}

fn index(value: &Value) -> usize {
    usize::try_from(value.as_u64().unwrap()).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_str().map_or_else(|| value.as_f64().unwrap(), |text| text.parse().unwrap())
}
