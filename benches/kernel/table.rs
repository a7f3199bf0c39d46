//! One line a method: what it took and how far off it was.

use std::fmt;
use std::fs;

use crate::common::{machine, results};

/// Columns of a [`Row`].
pub const HEAD: &str = "angle_deg,facets,method,setting,kernel_ms,total_ms,entry_error,row_sum_error,\
                        radiance_error_r0.5,radiance_error_r0.9,radiance_error_r0.99,note";

/// A method on a fold; a number that does not exist is NaN.
#[derive(Clone, Debug)]
pub struct Row {
    pub angle_deg: f64,
    /// Facets along a side of each panel.
    pub n: usize,
    pub method: &'static str,
    pub setting: String,
    /// Time of the form factors.
    pub kernel_ms: f64,
    /// Time of form factors and bounces.
    pub total_ms: f64,
    /// Largest difference of a form factor.
    pub entry_error: f64,
    /// Largest difference of what a facet hands on.
    pub row_sum_error: f64,
    /// Largest relative difference of a facet's mean radiance, at each of the reflectances.
    pub radiance_errors: [f64; 3],
    /// Why a number does not exist.
    pub note: String,
}

impl Row {
    /// A row of which nothing is known yet.
    pub fn new(angle_deg: f64, n: usize, method: &'static str, setting: String) -> Self {
        let unknown = f64::NAN;
        Self {
            angle_deg,
            n,
            method,
            setting,
            kernel_ms: unknown,
            total_ms: unknown,
            entry_error: unknown,
            row_sum_error: unknown,
            radiance_errors: [unknown; 3],
            note: String::new(),
        }
    }
}

impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let times = [self.kernel_ms, self.total_ms].map(number).join(",");
        let errors = [self.entry_error, self.row_sum_error].map(number).join(",");
        let radiance = self.radiance_errors.map(number).join(",");
        let Self { angle_deg, n, method, setting, note, .. } = self;
        write!(f, "{angle_deg},{n},{method},{setting},{times},{errors},{radiance},{note}")
    }
}

/// Three digits; nothing for what does not exist.
pub fn number(value: f64) -> String {
    if value.is_nan() { String::new() } else { format!("{value:.2e}") }
}

/// Writes a table with a line about the machine above it.
pub fn write(name: &str, head: &str, lines: impl Iterator<Item = String>) {
    let lines: Vec<_> = [format!("# {}", machine()), head.to_owned()].into_iter().chain(lines).collect();
    fs::write(results(name), lines.join("\n") + "\n").unwrap();
}
