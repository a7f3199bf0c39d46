//! How the kernel and products with it grow with the facets along a side.

use std::fs;

use vfold::paper::form_factors;
use vfold::paper::spectra::Spectra;

use crate::common::{fold, machine, results, timed};
use crate::drawing;
use crate::point::Point;
use crate::products::{direct, exitance, transformed};

const ANGLE_DEG: f64 = 45.0;
const SIDES: [usize; 6] = [8, 16, 32, 64, 128, 256];
/// Products by entries grow with the fourth power: more facets would take seconds each.
const DIRECT_MAX: usize = 128;
/// Points that tell the exponent: the largest ones.
const FITTED: usize = 3;

/// Prints the exponents, and leaves a table and a drawing.
pub fn measure() {
    let mut series = [("distinct entries, count", vec![]), ("form factors, ms", vec![])].to_vec();
    series.extend([("product by entries, ms", vec![]), ("product by FFT, ms", vec![])]);
    for n in SIDES {
        eprintln!("{n}x{n} facets");
        let (ms, kernel) = timed(|| form_factors(&fold(ANGLE_DEG, n)));
        series[0].1.push((n as f64, kernel.entries() as f64));
        series[1].1.push((n as f64, ms));
        let (x, spectra) = (exitance(n), Spectra::new(&kernel));
        if n <= DIRECT_MAX {
            series[2].1.push((n as f64, timed(|| direct(&kernel, &x)).0));
        }
        series[3].1.push((n as f64, timed(|| transformed(&kernel, &spectra, &x)).0));
    }
    let mut table = format!("# {}; {ANGLE_DEG}°\nseries,facets along a side,value\n", machine());
    let mut points = Vec::new();
    for (what, values) in &series {
        let name = format!("{what}: n^{:.2}", exponent(&values[values.len() - FITTED..]));
        println!("{name}");
        for (n, value) in values {
            table += &format!("{name},{n},{value:.3e}\n");
            let (panel, series, setting) = ("45°".to_owned(), name.clone(), String::new());
            points.push(Point { panel, series, setting, ms: *n, error: *value });
        }
    }
    fs::write(results("growth.csv"), table).unwrap();
    drawing::growth(&points);
}

/// Slope of the line through the logarithms, by least squares.
fn exponent(values: &[(f64, f64)]) -> f64 {
    let logs = values.iter().map(|(n, value)| (n.ln(), value.ln()));
    let count = values.len() as f64;
    let (mx, my) = logs.clone().fold((0.0, 0.0), |(sx, sy), (x, y)| (sx + x / count, sy + y / count));
    let (xy, xx) =
        logs.fold((0.0, 0.0), |(xy, xx), (x, y)| (xy + (x - mx) * (y - my), xx + (x - mx).powi(2)));
    xy / xx
}
