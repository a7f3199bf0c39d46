//! The metrics, one row each: name, quantity, and format in a table.

use super::{goodness_of_fit, pearson_distance, rmse, spectral_angle_deg};
use crate::colorimetry::Colorimeter;

/// A kind of score.
#[derive(Debug)]
pub struct Metric {
    /// Its name for `vscore --metrics`.
    pub flag: &'static str,
    /// Its name in records; that of a further illuminant follows, as in `ciede2000_A`.
    pub name: &'static str,
    /// What it measures.
    pub help: &'static str,
    /// Which of its values are worse.
    pub worse: Worse,
    /// Least width of its column in a table, characters.
    pub width: usize,
    /// Decimals in a table.
    pub decimals: usize,
    /// Whether it is scored by default.
    pub by_default: bool,
    /// How it is computed.
    pub measure: Measure,
}

/// Which values of a metric are worse.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Worse {
    /// Larger ones: a distance.
    Larger,
    /// Smaller ones: a similarity.
    Smaller,
}

/// The function of a metric, of the true and the estimated reflectance per waveband.
#[derive(Debug)]
pub enum Measure {
    /// From the spectra alone.
    Spectra(fn(&[f64], &[f64]) -> f64),
    /// Under each illuminant.
    Illuminant(fn(&Colorimeter, &[f64], &[f64]) -> f64),
    /// Under each further illuminant, the second argument being the first illuminant.
    Change(fn(&Colorimeter, &Colorimeter, &[f64], &[f64]) -> f64),
}

/// All metrics, in the order of scoring.
pub static METRICS: [Metric; 6] = [
    Metric {
        flag: "rmse",
        name: "rmse",
        help: "Root mean square error",
        worse: Worse::Larger,
        width: 8,
        decimals: 4,
        by_default: true,
        measure: Measure::Spectra(rmse),
    },
    Metric {
        flag: "ciede2000",
        name: "ciede2000",
        help: "Colour difference under each illuminant",
        worse: Worse::Larger,
        width: 10,
        decimals: 3,
        by_default: true,
        measure: Measure::Illuminant(Colorimeter::delta_e_2000),
    },
    Metric {
        flag: "pd",
        name: "pd",
        help: "What the paper calls Pearson distance",
        worse: Worse::Larger,
        width: 10,
        decimals: 5,
        by_default: true,
        measure: Measure::Spectra(pearson_distance),
    },
    Metric {
        flag: "gfc",
        name: "gfc",
        help: "Goodness of fit coefficient",
        worse: Worse::Smaller,
        width: 8,
        decimals: 5,
        by_default: false,
        measure: Measure::Spectra(goodness_of_fit),
    },
    Metric {
        flag: "angle",
        name: "angle_deg",
        help: "Spectral angle",
        worse: Worse::Larger,
        width: 10,
        decimals: 3,
        by_default: false,
        measure: Measure::Spectra(spectral_angle_deg),
    },
    Metric {
        flag: "metamerism",
        name: "metamerism",
        help: "From the first illuminant to each other one",
        worse: Worse::Larger,
        width: 10,
        decimals: 3,
        by_default: true,
        measure: Measure::Change(Colorimeter::metamerism_index),
    },
];

impl Metric {
    /// The metric of a score in a record, under any illuminant; none if it is not one of [`METRICS`].
    ///
    /// # Example
    /// ```
    /// use vfold::score::Metric;
    /// assert_eq!(Metric::of_score("ciede2000_A").unwrap().flag, "ciede2000");
    /// assert_eq!(Metric::of_score("angle_deg").unwrap().flag, "angle");
    /// assert!(Metric::of_score("gfc2").is_none());
    /// ```
    #[must_use]
    pub fn of_score(name: &str) -> Option<&'static Self> {
        let is_of = |metric: &&Self| {
            name.strip_prefix(metric.name).is_some_and(|rest| rest.is_empty() || rest.starts_with('_'))
        };
        METRICS.iter().find(is_of)
    }

    /// Whether it needs more than one illuminant.
    #[must_use]
    pub fn needs_change(&self) -> bool {
        matches!(self.measure, Measure::Change(_))
    }

    /// The names of its scores under these illuminants, at least one.
    #[must_use]
    pub fn score_names(&self, illuminants: &[&str]) -> Vec<String> {
        let first = || std::iter::once(self.name.to_owned());
        let further = || illuminants[1..].iter().map(|light| format!("{}_{light}", self.name));
        match self.measure {
            Measure::Spectra(_) => first().collect(),
            Measure::Illuminant(_) => first().chain(further()).collect(),
            Measure::Change(_) => further().collect(),
        }
    }

    /// Its scores, one for each of [`Metric::score_names`]; there is one colorimeter per illuminant.
    #[must_use]
    pub fn scores(&self, colorimeters: &[Colorimeter], truth: &[f64], estimate: &[f64]) -> Vec<f64> {
        match self.measure {
            Measure::Spectra(score) => vec![score(truth, estimate)],
            Measure::Illuminant(score) => {
                colorimeters.iter().map(|meter| score(meter, truth, estimate)).collect()
            }
            Measure::Change(score) => {
                let (first, further) = (&colorimeters[0], &colorimeters[1..]);
                further.iter().map(|meter| score(meter, first, truth, estimate)).collect()
            }
        }
    }
}

impl Worse {
    /// For the scores called `name`; larger ones if the metric is unknown.
    pub(super) fn of_score(name: &str) -> Self {
        Metric::of_score(name).map_or(Self::Larger, |metric| metric.worse)
    }
}
