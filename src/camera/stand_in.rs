//! Selects a measured camera to stand in for an unmeasured one.
//!
//! Among the same maker's cameras it is the one nearest to all others; without any, the one nearest to all
//! cameras. `benches/cameras.rs` leaves each camera out in turn and prints the errors. A camera with a known
//! colour matrix needs no stand-in: its sensitivities are [predicted](super::Predictor).

use super::measured::{KnownSensitivities, known_sensitivities, sensitivity_error};
use crate::error::Result;
use crate::spectrum::WavelengthGrid;

/// A camera in place of another.
#[derive(Clone, Debug, PartialEq)]
pub struct StandIn {
    /// Its name.
    pub name: String,
    /// Why it was selected.
    pub why: Why,
    /// Its index among the known.
    at: usize,
}

/// Why a camera stands in for another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Why {
    /// It is the most typical of the maker's cameras.
    Maker,
    /// It is the most typical of all cameras.
    Any,
}

impl Why {
    /// Expected error of the sensitivities, root mean square relative to green's peak, from leaving each
    /// camera out in turn.
    #[must_use]
    pub fn expected_error(self) -> f64 {
        match self {
            Self::Maker => 0.042,
            Self::Any => 0.063,
        }
    }

    /// In words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Maker => "the most typical of its maker",
            Self::Any => "the most typical of all makers",
        }
    }
}

/// Errors of the stand-ins for one camera, and of the mean of all others.
#[derive(Clone, Debug)]
pub struct LeftOut {
    /// The camera left out.
    pub camera: String,
    /// Its stand-ins by maker, and without considering the maker, each with its error.
    pub stand_ins: [(StandIn, f64); 2],
    /// Error of the mean of all others.
    pub mean_error: f64,
}

/// All possible stand-ins.
#[derive(Clone, Debug)]
pub struct StandIns {
    known: Vec<KnownSensitivities>,
    /// Distances between their sensitivities.
    distances: Vec<Vec<f64>>,
}

impl StandIns {
    /// The measured cameras.
    ///
    /// # Errors
    /// Only if the embedded tables are damaged.
    pub fn new() -> Result<Self> {
        let known = known_sensitivities(&WavelengthGrid::default())?;
        let row = |a: &KnownSensitivities| {
            known.iter().map(|b| sensitivity_error(&a.sensitivities, &b.sensitivities)).collect()
        };
        Ok(Self { distances: known.iter().map(row).collect(), known })
    }

    /// The camera that stands in for one by `make`, as written in its pictures.
    ///
    /// # Example
    /// ```
    /// use vfold::camera::{StandIns, Why};
    /// let stand_in = StandIns::new()?.for_camera("NIKON CORPORATION");
    /// assert!(stand_in.name.starts_with("nikon-") && stand_in.why == Why::Maker);
    /// # Ok::<(), vfold::Error>(())
    /// ```
    #[must_use]
    pub fn for_camera(&self, make: &str) -> StandIn {
        self.by_maker(make, &(0..self.known.len()).collect::<Vec<_>>())
    }

    /// Each camera left out in turn.
    #[must_use]
    pub fn left_out(&self) -> Vec<LeftOut> {
        let left_out = |at: usize| {
            let others: Vec<usize> = (0..self.known.len()).filter(|other| *other != at).collect();
            let stand_ins = [self.by_maker(self.known[at].camera.maker, &others), self.by_maker("", &others)];
            LeftOut {
                camera: self.known[at].camera.name(),
                stand_ins: stand_ins.map(|stand_in| {
                    let error = self.distances[at][stand_in.at];
                    (stand_in, error)
                }),
                mean_error: sensitivity_error(&self.known[at].sensitivities, &self.mean(&others)),
            }
        };
        (0..self.known.len()).map(left_out).collect()
    }

    fn by_maker(&self, make: &str, among: &[usize]) -> StandIn {
        let of_maker = |at: &usize| self.known[*at].camera.is_made_by(make);
        let same: Vec<usize> = among.iter().copied().filter(of_maker).collect();
        let (group, why) = if same.is_empty() { (among, Why::Any) } else { (same.as_slice(), Why::Maker) };
        self.least(group, why, |at| group.iter().map(|other| self.distances[at][*other]).sum())
    }

    fn least(&self, among: &[usize], why: Why, size: impl Fn(usize) -> f64) -> StandIn {
        let at = among.iter().copied().min_by(|a, b| size(*a).total_cmp(&size(*b))).unwrap_or(0);
        StandIn { name: self.known[at].camera.name(), why, at }
    }

    fn mean(&self, among: &[usize]) -> [Vec<f64>; 3] {
        let bands = self.known[0].sensitivities[0].len();
        let mean = |channel: usize, band: usize| {
            among.iter().map(|at| self.known[*at].sensitivities[channel][band]).sum::<f64>()
                / among.len() as f64
        };
        [0, 1, 2].map(|channel| (0..bands).map(|band| mean(channel, band)).collect())
    }
}
