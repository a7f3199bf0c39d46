//! Form factors by every method, against those of 60 digits.

use vfold::paper::Method;
use vfold::paper::monte_carlo::{MonteCarlo, Sampling};

use crate::common::{fold, timed};
use crate::point::Point;
use crate::reference::entry_error;

/// Angles at which all entries of 10 x 10 facets are known.
const ANGLES_DEG: [f64; 3] = [30.0, 45.0, 90.0];
const FACETS: usize = 10;
/// Samples of a Monte Carlo estimate.
const SAMPLES: [u32; 4] = [100, 1_000, 10_000, 100_000];

/// Prints a row a method, setting and angle.
pub fn measure() {
    let mut methods =
        vec![("exact", String::new(), Method::Exact), ("midpoint", String::new(), Method::Midpoint)];
    for (series, sampling) in [("monte-carlo area", Sampling::Area), ("monte-carlo cosine", Sampling::Cosine)]
    {
        for samples in SAMPLES {
            let method = Method::MonteCarlo(MonteCarlo::new(sampling, samples, 0).unwrap());
            methods.push((series, format!("{samples:e}"), method));
        }
    }
    for angle_deg in ANGLES_DEG {
        let fold = fold(angle_deg, FACETS);
        for (series, setting, method) in &methods {
            let (ms, (kernel, _)) = timed(|| method.form_factors(&fold));
            let panel = format!("{angle_deg}°");
            Point::print(&panel, series, setting, (ms, entry_error(&fold, &kernel)));
        }
    }
}
