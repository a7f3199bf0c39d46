//! Scores of a sample, its colour, and the summary of many.

use schemars::JsonSchema;
use serde::Serialize;

use super::Sample;
use super::fields::{Fields, finite};
use super::named::Named;
use crate::colorimetry::Colour;
use crate::error::Result;
use crate::score::{Group, Score, Statistics, Summary};

/// Colour of the estimate.
#[derive(Serialize, JsonSchema)]
pub(super) struct ColourRecord {
    /// Name of the illuminant.
    illuminant: String,
    /// Field of view of the standard observer: 2 degrees or 10 degrees.
    observer: String,
    /// Tristimulus values, those of a perfect white diffuser being Y = 100.
    xyz: [f64; 3],
    /// CIELAB: L*, a*, b*.
    lab: [f64; 3],
    /// sRGB, 0 to 1; outside that range if a display cannot show the colour.
    srgb: [f64; 3],
    /// Standard deviations of `xyz`.
    #[serde(skip_serializing_if = "Option::is_none")]
    xyz_sd: Option<[f64; 3]>,
    /// Standard deviations of `lab`.
    #[serde(skip_serializing_if = "Option::is_none")]
    lab_sd: Option<[f64; 3]>,
    /// Standard deviations of `srgb`.
    #[serde(skip_serializing_if = "Option::is_none")]
    srgb_sd: Option<[f64; 3]>,
    /// What the standard deviations are computed from: covariance; or `reflectance_sd`, which gives upper
    /// limits only.
    #[serde(skip_serializing_if = "Option::is_none")]
    sd_from: Option<String>,
}

/// The last record of a scored stream: mean, median and worst of every score.
#[derive(Serialize, JsonSchema)]
#[serde(tag = "kind", rename = "summary")]
#[schemars(extend("x-writer" = "vscore"))]
pub(super) struct SummaryRecord {
    #[serde(flatten)]
    all: CountsRecord,
    /// The field by which samples are grouped.
    #[serde(skip_serializing_if = "Option::is_none")]
    by: Option<String>,
    /// The groups, in the order of their first samples.
    #[serde(skip_serializing_if = "Option::is_none")]
    groups: Option<Vec<GroupRecord>>,
}

/// Samples that share the value of a field.
#[derive(Serialize, JsonSchema)]
struct GroupRecord {
    /// The value, `(none)` where the field is absent.
    value: String,
    #[serde(flatten)]
    summary: CountsRecord,
}

/// Samples, and their scores by name.
#[derive(Serialize, JsonSchema)]
struct CountsRecord {
    /// Number of samples.
    samples: usize,
    /// Number of samples that have scores.
    scored: usize,
    #[serde(flatten)]
    scores: Named<StatisticsRecord>,
}

/// A score over many samples.
#[derive(Serialize, JsonSchema)]
struct StatisticsRecord {
    /// Mean.
    mean: f64,
    /// Median.
    median: f64,
    /// The worst: the largest, but the smallest of a goodness of fit (gfc).
    worst: f64,
}

impl From<&Summary> for CountsRecord {
    fn from(summary: &Summary) -> Self {
        let statistics =
            |Statistics { name, mean, median, worst }| (name, StatisticsRecord { mean, median, worst });
        let scores = Named(summary.statistics().into_iter().map(statistics).collect());
        Self { samples: summary.samples(), scored: summary.scored(), scores }
    }
}

/// The record that ends a scored stream: number of samples, and mean, median and worst of each score; the
/// same for each group of samples with equal values of a field, if grouped `by` one.
///
/// # Errors
/// [`crate::Error::Field`] if it cannot be written as JSON.
pub fn summary(all: &Summary, by: Option<(&str, &[Group])>) -> Result<Fields> {
    let group =
        |Group { value, summary }: &Group| GroupRecord { value: value.clone(), summary: summary.into() };
    Fields::of(&SummaryRecord {
        all: all.into(),
        by: by.map(|(field, _)| field.to_owned()),
        groups: by.map(|(_, groups)| groups.iter().map(group).collect()),
    })
}

impl Sample {
    /// Adds scores.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if a number is not finite.
    pub fn set_scores(&mut self, scores: &[Score]) -> Result<()> {
        finite("metrics", scores.iter().map(|score| &score.value))?;
        let named = scores.iter().map(|score| (score.name.clone(), score.value));
        self.fields.set("metrics", Named(named.collect()))
    }

    /// The sample's scores, if any; none for a sample that carries an error.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if they are not numbers.
    pub fn scores(&self) -> Result<Option<Vec<Score>>> {
        let metrics: Option<Named<f64>> = self.made("metrics")?;
        let score = |(name, value)| Score { name, value };
        Ok(metrics.map(|Named(metrics)| metrics.into_iter().map(score).collect()))
    }

    /// Adds the colour of the estimate under the illuminant of this name, with its standard deviations, which
    /// are `exact` if they come from a covariance, else upper bounds.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if a number is not finite.
    pub fn set_colour(
        &mut self,
        (illuminant, observer): (&str, &str),
        colour: &Colour,
        sd: Option<&Colour>,
        exact: bool,
    ) -> Result<()> {
        for Colour { xyz, lab, srgb } in std::iter::once(colour).chain(sd) {
            finite("colour", xyz.iter().chain(lab).chain(srgb))?;
        }
        let sd_from = if exact { "covariance" } else { "reflectance_sd, at most" };
        self.fields.set(
            "colour",
            ColourRecord {
                illuminant: illuminant.to_owned(),
                observer: observer.to_owned(),
                xyz: colour.xyz,
                lab: colour.lab,
                srgb: colour.srgb,
                xyz_sd: sd.map(|sd| sd.xyz),
                lab_sd: sd.map(|sd| sd.lab),
                srgb_sd: sd.map(|sd| sd.srgb),
                sd_from: sd.map(|_| sd_from.to_owned()),
            },
        )
    }
}
