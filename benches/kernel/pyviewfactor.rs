//! What `benches/pyviewfactor_kernel.py` measured on the 10 x 10 facets of a 45° fold, beside the exact
//! kernel.

use std::fs;

use crate::common::results;
use crate::table::Row;

/// Where the script leaves its rows, and a 45° fold of what facets they are of.
const FILE: &str = "pyviewfactor.csv";
const FOLD: (f64, usize) = (45.0, 10);

/// Rows of the script, `setting,milliseconds,entry error,row sum error`; none where it has not run.
pub fn rows() -> Vec<Row> {
    let text = fs::read_to_string(results(FILE)).unwrap_or_default();
    text.lines().filter(|line| !line.starts_with('#')).skip(1).map(row).collect()
}

fn row(line: &str) -> Row {
    let cells: Vec<_> = line.split(',').collect();
    let [kernel_ms, entry_error, row_sum_error] = [1, 2, 3].map(|n| cells[n].parse().unwrap());
    let row = Row::new(FOLD.0, FOLD.1, "pyviewfactor", cells[0].to_owned());
    Row { kernel_ms, entry_error, row_sum_error, ..row }
}

/// Prints how many times faster and nearer the exact kernel is.
pub fn compare(ours: &[Row], theirs: &[Row]) {
    let Some(exact) = ours.iter().find(|row| row.method == "exact" && row.n == FOLD.1 && is_angle(row))
    else {
        return;
    };
    for row in theirs {
        println!(
            "exact ({:.3} ms, entry error {:.1e}) is {:.0} times faster than pyviewfactor ({}: \
             {:.0} ms, {:.1e}) at {:.1e} times less error",
            exact.kernel_ms,
            exact.entry_error,
            row.kernel_ms / exact.kernel_ms,
            row.setting,
            row.kernel_ms,
            row.entry_error,
            row.entry_error / exact.entry_error
        );
    }
}

fn is_angle(row: &Row) -> bool {
    row.angle_deg.total_cmp(&FOLD.0).is_eq()
}
