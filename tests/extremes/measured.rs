//! What the tools make of an extreme, beside NumPy and the truth.

use std::time::Instant;

use crate::common::{Ended, Workdir};
use crate::rows::Row;

/// Cameras and lights that rows name.
pub const SPECTRA: &str = include_str!("spectra.sh");

/// What was measured, in the order of the bounds.
pub struct Measured {
    pub facets: f64,
    /// None if the sample was refused.
    pub estimate: Option<[f64; 2]>,
    /// Of all tools together.
    pub seconds: f64,
}

impl Row {
    /// Runs the four tools, clean facets and an estimate from noisy ones, then NumPy.
    pub fn measure(&self) -> Measured {
        let Self { scene, seen, sheets: [bright, known], .. } = self;
        let mesh = if self.undivided { "" } else { "--mesh facets --tolerance 1e-9" };
        let folder = Workdir::new();
        self.succeeds(folder.sh(SPECTRA));
        let start = Instant::now();
        self.succeeds(folder.sh(&format!(
            "vkernel {scene} {mesh} -o scene
            vforward scene {seen} --reflectance {bright} --save facet_rgb=clean.npy -o clean
            vforward scene {seen} --reflectance {known} --noise-sd 1e-3 --seed 1 -o noisy
            vestimate -q noisy -o estimated || [ $? = 3 ]
            vscore estimated -o scored || [ $? = 3 ]"
        )));
        let seconds = start.elapsed().as_secs_f64();
        let python = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/extremes/measure.py");
        let numbers = self.succeeds(folder.sh(&format!("python3 -B {python}")));
        let numbers: Vec<f64> = numbers.split_whitespace().map(|text| text.parse().unwrap()).collect();
        let estimate = numbers.get(1..3).map(|both| [both[0], both[1]]);
        Measured { facets: numbers[0], estimate, seconds }
    }

    fn succeeds(&self, run: Ended) -> String {
        assert!(run.status == 0 && tells_failures_alone(&run), "{}: {run:?}", self.what);
        run.stdout
    }

    /// Whether the bounds hold; an estimate that must be refused is.
    pub fn holds(&self, measured: &Measured) -> bool {
        let estimate = match (self.estimate, measured.estimate) {
            (Some(bounds), Some(found)) => found.iter().zip(bounds).all(|(found, bound)| *found <= bound),
            (bounds, found) => bounds.is_none() && found.is_none(),
        };
        measured.facets <= self.facets && estimate
    }
}

/// Whether standard error says nothing but that the one sample failed: facets without light have no estimate.
pub fn tells_failures_alone(run: &Ended) -> bool {
    run.stderr.lines().all(|line| line.contains(": 1 of 1 failed; first: "))
}
