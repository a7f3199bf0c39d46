//! Messages of `-v` on a sample: decisions and results.

use vfold::error::counted;
use vfold::estimate::data::FacetData;
use vfold::estimate::noise::{Noise, NoiseSource};
use vfold::estimate::{Estimate, Exposure};
use vfold::forward::FacetValues;
use vfold::solve::Termination;

/// How well facets with these standard deviations are known, and how that is known.
pub fn known_to(noise: &Noise, sd: &FacetValues) -> String {
    let noise_from = match noise.source {
        NoiseSource::Stated(_) => "--noise-sd",
        NoiseSource::OfFacets(_) => "facet_sd",
        NoiseSource::Unexplained => "what no reflectance explains",
    };
    let model = match noise.model_error {
        error if error > 0.0 => format!(", model {error:.1e} of the value"),
        _ => String::new(),
    };
    format!("facets known to {:.1e} (noise from {noise_from}{model})", rms(sd))
}

/// Root mean square of the facets' values.
pub fn rms(facets: &FacetValues) -> f64 {
    let values: Vec<f64> = facets.measured().collect();
    (values.iter().map(|value| value * value).sum::<f64>() / values.len().max(1) as f64).sqrt()
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
