//! One way to do a thing: the time that it takes and the error that it leaves.

use std::fmt;
use std::io::BufRead;

/// Columns of a [`Point`].
pub const HEAD: &str = "panel,series,setting,ms,error";

/// A setting of one method.
#[derive(Clone, Debug)]
pub struct Point {
    /// What all points of a panel have in common.
    pub panel: String,
    pub series: String,
    pub setting: String,
    /// Processor's time, one thread.
    pub ms: f64,
    pub error: f64,
}

impl fmt::Display for Point {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Self { panel, series, setting, ms, error } = self;
        write!(f, "{panel},{series},{setting},{ms:.3e},{error:.3e}")
    }
}

impl Point {
    /// Prints it.
    pub fn print(panel: &str, series: &str, setting: &str, (ms, error): (f64, f64)) {
        let [panel, series, setting] = [panel, series, setting].map(str::to_owned);
        println!("{}", Self { panel, series, setting, ms, error });
    }

    /// All points on standard input; lines that begin with `#` are handed back as they are.
    pub fn read() -> (Vec<Self>, Vec<String>) {
        let lines = std::io::stdin().lock().lines().map(Result::unwrap);
        let (notes, rows): (Vec<_>, Vec<_>) = lines.partition(|line| line.starts_with('#'));
        (rows.iter().map(|row| Self::parse(row)).collect(), notes)
    }

    fn parse(row: &str) -> Self {
        let cells: Vec<_> = row.split(',').collect();
        let [panel, series, setting] = [0, 1, 2].map(|n| cells[n].to_owned());
        Self { panel, series, setting, ms: cells[3].parse().unwrap(), error: cells[4].parse().unwrap() }
    }
}

/// Those that none of the others beats in both time and error, by time.
pub fn front<'a>(points: impl Iterator<Item = &'a Point>) -> Vec<&'a Point> {
    let mut points: Vec<_> = points.collect();
    points.sort_by(|a, b| a.ms.total_cmp(&b.ms).then(a.error.total_cmp(&b.error)));
    let mut least = f64::INFINITY;
    points.retain(|point| {
        let better = point.error < least;
        least = least.min(point.error);
        better
    });
    points
}
