//! Messages of `-v` on a sample: decisions and results.

use std::fmt;

use vfold::Result;
use vfold::error::counted;
use vfold::estimate::data::FacetData;
use vfold::estimate::noise::{Noise, NoiseSource};
use vfold::estimate::{Estimate, Exposure};
use vfold::forward::{FacetModel, FacetValues};
use vfold::solve::Termination;

/// Standard deviations of facets, and their origin.
pub struct Deviations {
    /// Relative to white.
    pub sd: FacetValues,
    /// The part due to the model, relative to the facet's value.
    model_error: f64,
    /// The origin of the noise part.
    noise_from: &'static str,
}

impl Deviations {
    /// For facets `rgb`, from their noise.
    pub fn of(noise: &Noise, model: &FacetModel, rgb: &FacetValues) -> Result<Self> {
        let noise_from = match noise.source {
            NoiseSource::Stated(_) => "--noise-sd",
            NoiseSource::OfFacets(_) => "facet_sd",
            NoiseSource::Unexplained => "what no reflectance explains",
        };
        Ok(Self { sd: noise.deviations(model, rgb)?, model_error: noise.model_error, noise_from })
    }

    /// Root mean square.
    pub fn rms(&self) -> f64 {
        let values: Vec<f64> = self.sd.measured().collect();
        (values.iter().map(|value| value * value).sum::<f64>() / values.len().max(1) as f64).sqrt()
    }
}

impl fmt::Display for Deviations {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "facets known to {:.1e} (noise from {}", self.rms(), self.noise_from)?;
        if self.model_error > 0.0 {
            write!(f, ", model {:.1e} of the value", self.model_error)?;
        }
        f.write_str(")")
    }
}

/// The numbers of facet values before and after compression.
pub fn size(data: &FacetData) -> String {
    let (left, values) = data.size();
    format!("{} compressed to {left}", counted(values, "value"))
}

/// The result, in one line.
pub fn outcome(estimate: &Estimate, exposure: Exposure) -> String {
    let ended = match estimate.termination {
        Termination::Converged { .. } => "converged",
        Termination::IterationLimit => "stopped at the iteration limit",
        Termination::NoProgress { .. } => "stopped without progress",
    };
    let sd = estimate.reflectance_sd();
    let iterations = format!("{}, {ended}", counted(estimate.iterations, "iteration"));
    let reduced_chi = match &sd {
        Some(_) => format!("residual {:.2} times the expected error", estimate.residual_rms),
        // for a method that weights all facets equally
        None => format!("residuals {:.1e} of white", estimate.residual_rms),
    };
    let how = match exposure {
        Exposure::Known(_) => Some("known"),
        Exposure::Sum => Some("by sums"),
        // fitted with the rest, unless the method has no error bars
        Exposure::Free | Exposure::Expected(_) => estimate.fitted.is_empty().then_some("fitted"),
    };
    let exposure = how.map(|how| format!("exposure {:.4} {how}", estimate.exposure));
    let light = estimate.light.as_ref().and_then(|light| light.candidates.first());
    let light =
        light.map(|most| format!("light {} with a probability of {:.2}", most.name, most.probability));
    let fitted = estimate.fitted.iter().map(|one| {
        let model = if one.supported { "" } else { ", not determined by the facets" };
        format!("{} {:.4} ± {:.4}{model}", one.unknown.name, one.value, one.sd)
    });
    let sd = sd.map(|sd| {
        let (mean, most) = (sd.iter().sum::<f64>() / sd.len() as f64, sd.iter().copied().fold(0.0, f64::max));
        format!("reflectance known to {mean:.4}, at worst {most:.4}")
    });
    [iterations, reduced_chi]
        .into_iter()
        .chain(light)
        .chain(exposure)
        .chain(fitted)
        .chain(sd)
        .collect::<Vec<_>>()
        .join("; ")
}
