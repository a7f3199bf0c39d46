//! Scores of the samples of a stream.

use vfold::colorimetry::{Colorimeter, ErrorBars, Observer};
use vfold::score::{Score, goodness_of_fit, pearson_distance, rmse, spectral_angle_deg};
use vfold::spectrum::{Spectrum, WavelengthGrid};
use vfold::stream::{EstimateRecord, ReflectanceRecord, Sample, Scene, Transform};
use vfold::{Error, Result};

use super::Args;
use super::metric::Metric;

/// Scores as the flags ask for.
pub struct Scorer<'a> {
    args: &'a Args,
    illuminants: Vec<Spectrum>,
    metrics: Vec<Metric>,
    /// The names of the scores that every sample gets, in their order.
    pub names: Vec<String>,
    truth: Option<Vec<Spectrum>>,
}

/// What the samples of one scene share.
pub struct Context {
    grid: WavelengthGrid,
    /// One an illuminant.
    colorimeters: Vec<Colorimeter>,
}

impl<'a> Scorer<'a> {
    pub fn new(args: &'a Args) -> Result<Self> {
        let truth = args.truth.as_deref().map(|spec| args.common.reflectances(spec)).transpose()?;
        let illuminants: Vec<_> =
            args.illuminant.iter().map(|spec| args.common.illuminant(spec)).collect::<Result<_>>()?;
        let metrics = metrics(args)?;
        let names = score_names(&metrics, &illuminants);
        if let Some((_, twice)) = names.iter().enumerate().find(|(n, name)| names[..*n].contains(name)) {
            let problem = format!("'{twice}' is asked for twice");
            return Err(Error::usage("--illuminant, --metrics", problem, "give each once"));
        }
        Ok(Self { args, metrics, names, illuminants, truth })
    }

    /// The illuminant of colours that are shown.
    pub fn first_illuminant(&self) -> &Spectrum {
        &self.illuminants[0]
    }

    fn scores(&self, context: &Context, truth: &[f64], estimate: &[f64]) -> Vec<Score> {
        let Context { colorimeters, .. } = context;
        let values = self.metrics.iter().flat_map(|metric| match metric {
            Metric::Rmse => vec![rmse(truth, estimate)],
            Metric::Pd => vec![pearson_distance(truth, estimate)],
            Metric::Gfc => vec![goodness_of_fit(truth, estimate)],
            Metric::Angle => vec![spectral_angle_deg(truth, estimate)],
            Metric::Ciede2000 => {
                colorimeters.iter().map(|meter| meter.delta_e_2000(truth, estimate)).collect()
            }
            Metric::Metamerism => {
                let index = |meter: &Colorimeter| meter.metamerism_index(&colorimeters[0], truth, estimate);
                colorimeters[1..].iter().map(index).collect()
            }
        });
        self.names.iter().zip(values).map(|(name, value)| Score::new(name, value)).collect()
    }

    /// The true spectrum; none only where drawings are asked for, which have more to show.
    fn truth_of(&self, sample: &Sample, grid: &WavelengthGrid) -> Result<Option<ReflectanceRecord>> {
        let truth = match (self.truth.as_deref(), sample.truth()?) {
            (Some([one]), _) => ReflectanceRecord::on(one, grid)?,
            (Some(spectra), _) => {
                let id = sample.id();
                // A column of a file is called after both: `truth:photo`.
                let named = |spectrum: &&Spectrum| {
                    spectrum.name() == id
                        || spectrum.name().split_once(':').is_some_and(|(_, member)| member == id)
                };
                let found = spectra.iter().find(named).ok_or_else(|| {
                    Error::field("id", format!("--truth has no member '{id}' among its {}", spectra.len()))
                })?;
                ReflectanceRecord::on(found, grid)?
            }
            (None, Some(truth)) => {
                let ReflectanceRecord { wavelengths_nm, reflectance, interpolation } = truth;
                let spectrum = Spectrum::new("truth", wavelengths_nm, reflectance)?.as_reflectance();
                let on_grid = ReflectanceRecord::on(&spectrum, grid)?;
                ReflectanceRecord { interpolation: on_grid.interpolation.or(interpolation), ..on_grid }
            }
            // what is drawn may be its old scores
            (None, None) if self.args.draws() => return sample.scores().map(|_| None),
            (None, None) => return Err(Error::field("truth", "missing; give --truth SPEC")),
        };
        Ok(Some(truth))
    }

    fn add_colour(&self, context: &Context, estimate: &EstimateRecord, sample: &mut Sample) -> Result<()> {
        let meter = &context.colorimeters[0];
        let EstimateRecord { reflectance, covariance, reflectance_sd: sd, .. } = estimate;
        let errors = match (covariance, sd) {
            (Some(rows), _) => Some(ErrorBars::Covariance(rows)),
            (None, Some(sd)) => Some(ErrorBars::Deviations(sd)),
            (None, None) => None,
        };
        let observer = match self.args.observer {
            Observer::Cie1931_2deg => "2 degrees",
            Observer::Cie1964_10deg => "10 degrees",
        };
        let sd = errors.map(|errors| meter.colour_sd(reflectance, errors));
        let seen = (self.illuminants[0].name(), observer);
        sample.set_colour(seen, &meter.colour(reflectance), sd.as_ref(), covariance.is_some())
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
            sample.set_truth(&truth)?;
            sample.set_scores(&self.scores(context, &truth.reflectance, &estimate.reflectance))?;
        }
        if self.args.colour { self.add_colour(context, &estimate, sample) } else { Ok(()) }
    }
}

/// The names of the scores of `metrics`: those under other illuminants than the first have its name.
fn score_names(metrics: &[Metric], illuminants: &[Spectrum]) -> Vec<String> {
    let others = |metric: &Metric| {
        let metric = metric.name();
        illuminants[1..].iter().map(move |light| format!("{metric}_{}", light.name()))
    };
    let mut names = Vec::new();
    for metric in metrics {
        names.extend((*metric != Metric::Metamerism).then(|| metric.name().to_owned()));
        names.extend(others(metric).filter(|_| matches!(metric, Metric::Ciede2000 | Metric::Metamerism)));
    }
    names
}

/// What is to be scored.
fn metrics(args: &Args) -> Result<Vec<Metric>> {
    let several = args.illuminant.len() > 1;
    if args.metrics.is_empty() {
        let always = [Metric::Rmse, Metric::Ciede2000, Metric::Pd];
        return Ok(always.into_iter().chain(several.then_some(Metric::Metamerism)).collect());
    }
    if args.metrics.contains(&Metric::Metamerism) && !several {
        let problem = "metamerism needs a change of illuminant";
        return Err(Error::usage("--metrics", problem, "give two, as in --illuminant D65 --illuminant A"));
    }
    Ok(args.metrics.clone())
}
