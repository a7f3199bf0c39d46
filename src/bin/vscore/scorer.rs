//! Scores of the samples of a stream.

use std::collections::HashSet;

use vfold::colorimetry::{Colorimeter, ErrorBars, Observer};
use vfold::error::counted;
use vfold::score::{METRICS, Metric, Score};
use vfold::spectrum::{Outside, Spectrum, WavelengthGrid, near_names};
use vfold::stream::{EstimateRecord, ReflectanceRecord, Sample, Scene, Transform};
use vfold::{Error, Result};

use super::{Args, Condition};

/// Scores as the flags request.
pub struct Scorer<'a> {
    args: &'a Args,
    illuminants: Vec<Spectrum>,
    metrics: Vec<&'static Metric>,
    /// The scores of every sample, in order: their metrics and names.
    pub scores: Vec<(&'static Metric, String)>,
    truth: Option<Vec<Spectrum>>,
}

/// What the samples of one scene share.
pub struct Context {
    grid: WavelengthGrid,
    /// One per illuminant.
    colorimeters: Vec<Colorimeter>,
}

impl<'a> Scorer<'a> {
    pub fn new(args: &'a Args) -> Result<Self> {
        let read = |spec: &str| match args.condition {
            Condition::M1 => args.common.radiance_factors(spec),
            Condition::M2 => args.common.reflectances(spec),
        };
        let truth = args.truth.as_deref().map(read).transpose()?;
        let illuminants: Vec<_> =
            args.illuminant.iter().map(|spec| args.common.illuminant(spec)).collect::<Result<_>>()?;
        let metrics = metrics(args)?;
        let lights: Vec<_> = illuminants.iter().map(Spectrum::name).collect();
        let named = |metric: &&'static Metric| {
            let metric = *metric;
            metric.score_names(&lights).into_iter().map(move |name| (metric, name))
        };
        let scores: Vec<_> = metrics.iter().flat_map(named).collect();
        let mut seen = HashSet::new();
        if let Some((_, twice)) = scores.iter().find(|(_, name)| !seen.insert(name)) {
            let problem = format!("'{twice}' is requested twice");
            return Err(Error::usage("--illuminant, --metrics", problem, "give each once"));
        }
        Ok(Self { args, metrics, scores, illuminants, truth })
    }

    /// The illuminant of displayed colours.
    pub fn first_illuminant(&self) -> &Spectrum {
        &self.illuminants[0]
    }

    fn scores(&self, context: &Context, truth: &[f64], estimate: &[f64]) -> Vec<Score> {
        let values =
            self.metrics.iter().flat_map(|metric| metric.scores(&context.colorimeters, truth, estimate));
        self.scores.iter().zip(values).map(|((_, name), value)| Score::new(name, value)).collect()
    }

    /// The scores of an estimate under the measurement condition.
    fn compare(&self, context: &Context, truth: &ReflectanceRecord, estimate: &EstimateRecord) -> Vec<Score> {
        match self.args.condition {
            Condition::M1 => {
                self.scores(context, truth.total_radiance_factor(), estimate.total_radiance_factor())
            }
            Condition::M2 => self.scores(context, &truth.reflectance, &estimate.reflectance),
        }
    }

    /// The true spectrum; none only with drawings, which show more than scores.
    fn truth_of(&self, sample: &Sample, grid: &WavelengthGrid) -> Result<Option<ReflectanceRecord>> {
        let truth = match (self.truth.as_deref(), sample.truth()?) {
            (Some([one]), own) => self.measured(one, own, grid)?,
            (Some(spectra), own) => {
                let id = sample.id();
                // a column of a file has a compound name: `truth:photo`
                let named = |spectrum: &&Spectrum| {
                    spectrum.name() == id
                        || spectrum.name().split_once(':').is_some_and(|(_, member)| member == id)
                };
                let found = spectra.iter().find(named).ok_or_else(|| self.no_truth(&id, spectra))?;
                self.measured(found, own, grid)?
            }
            (None, Some(own)) => on_grid(own, grid)?,
            // the drawing may show its old scores
            (None, None) if self.args.draws() => return sample.scores().map(|_| None),
            (None, None) => return Err(Error::field("truth", "missing; give --truth SPEC")),
        };
        Ok(Some(truth))
    }

    /// The error for a sample that has no namesake among the spectra of `--truth`.
    fn no_truth(&self, id: &str, spectra: &[Spectrum]) -> Error {
        let near = match near_names(id, spectra.iter().map(Spectrum::name)).as_slice() {
            [] => String::new(),
            near => format!(" (nearest: {})", near.join(", ")),
        };
        let file = self.args.truth.as_deref().unwrap_or_default();
        let count = counted(spectra.len(), "spectrum");
        let problem = format!(
            "--truth {file} has no '{id}' among its {count}{near}; give one of them as --truth {file}:NAME, \
             or make the names agree"
        );
        Error::field("id", problem)
    }

    /// A spectrum named by `--truth`: under M1 the total radiance factor, from which the reflected part
    /// cannot be derived.
    fn measured(
        &self,
        spectrum: &Spectrum,
        own: Option<ReflectanceRecord>,
        grid: &WavelengthGrid,
    ) -> Result<ReflectanceRecord> {
        let found = ReflectanceRecord::on(spectrum, grid)?;
        if self.args.condition == Condition::M2 {
            return Ok(found);
        }
        let reflected = match own {
            Some(own) => on_grid(own, grid)?,
            None => ReflectanceRecord { reflectance: Vec::new(), ..found.clone() },
        };
        Ok(ReflectanceRecord { total_radiance_factor: Some(found.reflectance), ..reflected })
    }

    fn add_colour(&self, context: &Context, estimate: &EstimateRecord, sample: &mut Sample) -> Result<()> {
        let meter = &context.colorimeters[0];
        let is_total = self.args.condition == Condition::M1 && estimate.total_radiance_factor.is_some();
        let (spectrum, errors) = if is_total {
            let sd = estimate.total_radiance_factor_sd.as_deref();
            (estimate.total_radiance_factor(), sd.map(ErrorBars::Deviations))
        } else {
            (estimate.reflectance.as_slice(), estimate.error_bars())
        };
        let observer = match self.args.observer {
            Observer::Cie1931_2deg => "2 degrees",
            Observer::Cie1964_10deg => "10 degrees",
        };
        let sd = errors.map(|errors| meter.colour_sd(spectrum, errors));
        let seen = (self.illuminants[0].name(), observer);
        let has_covariance = matches!(errors, Some(ErrorBars::Covariance(_)));
        sample.set_colour(seen, &meter.colour(spectrum), sd.as_ref(), has_covariance)
    }
}

impl Transform for Scorer<'_> {
    type Context = Context;
    type Aside = ();

    fn scene(&self, scene: &mut Scene) -> Result<Context> {
        if !self.args.common.no_history {
            scene.fields.add_history("vscore")?;
        }
        let grid = scene.grid()?;
        let meter = |illuminant| Colorimeter::new(&grid, illuminant, self.args.observer);
        Ok(Context { colorimeters: self.illuminants.iter().map(meter).collect::<Result<_>>()?, grid })
    }

    fn sample(&self, context: &Context, sample: &mut Sample) -> Result<()> {
        let Some(estimate) = sample.estimate()? else {
            return Err(Error::field("estimate", "missing; run the samples through vestimate first"));
        };
        if estimate.wavelengths_nm != context.grid.wavelengths_nm() {
            return Err(Error::field("estimate", "not on the wavelengths of its scene; estimate it again"));
        }
        if let Some(truth) = self.truth_of(sample, &context.grid)? {
            if !truth.reflectance.is_empty() {
                sample.set_truth(&truth)?;
            }
            sample.set_scores(&self.compare(context, &truth, &estimate))?;
        }
        if self.args.colour { self.add_colour(context, &estimate, sample) } else { Ok(()) }
    }
}

/// The truth in a sample, on the wavelengths of `grid`.
fn on_grid(own: ReflectanceRecord, grid: &WavelengthGrid) -> Result<ReflectanceRecord> {
    let ReflectanceRecord { wavelengths_nm, reflectance, interpolation, total_radiance_factor } = own;
    let total = total_radiance_factor
        .map(|total| Spectrum::new("truth", wavelengths_nm.clone(), total)?.on(grid, Outside::Refuse));
    let spectrum = Spectrum::new("truth", wavelengths_nm, reflectance)?.as_reflectance();
    let found = ReflectanceRecord::on(&spectrum, grid)?;
    Ok(ReflectanceRecord {
        interpolation: found.interpolation.or(interpolation),
        total_radiance_factor: total.transpose()?,
        ..found
    })
}

/// The metrics to be scored.
fn metrics(args: &Args) -> Result<Vec<&'static Metric>> {
    let several = args.illuminant.len() > 1;
    if args.metrics.is_empty() {
        let by_default = METRICS.iter().filter(|metric| metric.by_default);
        return Ok(by_default.filter(|metric| several || !metric.needs_change()).collect());
    }
    match args.metrics.iter().find(|metric| metric.needs_change()) {
        Some(metric) if !several => {
            let problem = format!("{} needs a change of illuminant", metric.flag);
            Err(Error::usage("--metrics", problem, "give two, as in --illuminant D65 --illuminant A"))
        }
        _ => Ok(args.metrics.clone()),
    }
}
