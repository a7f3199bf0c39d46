//! Estimates of the samples of a stream.

use std::sync::{Arc, Mutex, PoisonError};

use vfold::cli;
use vfold::estimate::data::FacetData;
use vfold::estimate::light::{Candidate, Others};
use vfold::estimate::measured::Measured;
use vfold::estimate::measurement::{Facets, Measurement};
use vfold::estimate::noise::{Noise, deviations};
use vfold::estimate::photograph::Unmodelled;
use vfold::estimate::prior::Prior;
use vfold::estimate::shadow::Shadow;
use vfold::estimate::unknowns::{AUTO, EXPOSURE, NONE};
use vfold::estimate::verdict::{Verdict, refuse_unexplained};
use vfold::estimate::{Estimate, Exposure, classes, map};
use vfold::forward::FacetValues;
use vfold::paper::components::FlatSheet;
use vfold::paper::smooth;
use vfold::scene::{Setting, other_lights, photographed};
use vfold::spectrum::{
    Outside, Spectrum, WavelengthGrid, candidate_lights_and_between, equal_candidates, fine_candidate_lights,
};
use vfold::stream::{
    CameraRecord, EstimateRecord, Fields, NewEstimate, ReferencePanel, Sample, Scene, Transform, trace,
};
use vfold::{Error, Result};

use super::Args;
use super::asked::Asked;
use super::context::{Context, SceneMethod};
use super::flat::FlatEstimator;
use super::known_fold::KnownFold;
use super::messages::{self, Deviations};
use super::settings::{MUNSELL, SHEETS, Smoothness};

/// The method, from `--method` and `--prior`.
enum Method {
    /// The spectra of the prior; none for the built-in one.
    Map(Option<PriorSpectra>),
    Smooth(Smoothness),
    Flat(FlatEstimator),
}

/// The results for a sample.
pub struct Made {
    /// The estimate in the form of its record.
    pub estimate: EstimateRecord,
    /// Records of the iterations, if requested.
    pub trace: Vec<Fields>,
}

/// Spectra of a prior, and their classes if known.
type PriorSpectra = (Vec<Spectrum>, Option<Vec<usize>>);

/// Estimates as the flags request.
pub struct Estimator<'a> {
    /// The flags for every sample.
    pub asked: Asked<'a>,
    method: Method,
    /// The reflectance of `--reference-panel`.
    reference_panel: Option<Spectrum>,
    /// The initial reflectance.
    start: Option<Spectrum>,
    /// The candidates for the light that `--illuminants` names.
    illuminants: Option<Vec<Spectrum>>,
    /// Whether the light is to be inferred, ignoring the scenes' statements.
    forgets_light: bool,
    /// A known fold that determines the light.
    known_fold: Option<KnownFold>,
    /// The prior of the previous scene, with its wavelengths, nm.
    last_prior: Mutex<Option<(Vec<f64>, Arc<Prior>)>>,
    /// The alternatives to the light of the previous scene.
    last_others: Mutex<Option<Arc<Others>>>,
}

/// The paper's estimator fits no unknown of the scene other than the exposure.
fn check_fit(args: &Args) -> Result<()> {
    if args.fit.contains(&EXPOSURE.flag) && args.exposure.is_some_and(|exposure| exposure != Exposure::Free) {
        let problem = "--exposure already sets the exposure";
        return Err(Error::usage("--fit", problem, "leave one of them out"));
    }
    if let Some(alone) = args.fit.iter().find(|flag| [&AUTO, &NONE].contains(flag))
        && args.fit.len() > 1
    {
        let problem = format!("{} cannot be combined with others", alone.value);
        return Err(Error::usage("--fit", problem, "leave it out, or the others"));
    }
    if args.fit.iter().any(|flag| ![EXPOSURE.flag, &NONE].contains(flag)) && !args.has_prior() {
        let problem = format!("with --prior {} only the exposure can be fitted", args.prior());
        return Err(Error::usage("--fit", problem, "leave --prior out, or name spectra"));
    }
    Ok(())
}

fn method(args: &Args) -> Result<Method> {
    if let Some(flat) = FlatEstimator::of(args)? {
        return Ok(Method::Flat(flat));
    }
    check_fit(args)?;
    if let Some(error) = args.model_error.filter(|error| !(0.0..=1.0).contains(error)) {
        return Err(Error::usage("--model-error", format!("{error} is not a relative error"), "give 0 to 1"));
    }
    let is_surplus = args.smoothness.is_some() && args.prior() != "smooth";
    let (problem, remedy) = (format!("not used by --prior {}", args.prior()), "give --prior smooth");
    cli::refuse([("--smoothness", is_surplus)], &problem, remedy)?;
    Ok(match args.prior() {
        "smooth" => Method::Smooth(args.smoothness.unwrap_or(Smoothness::Weight(smooth::SMOOTHNESS))),
        "none" => Method::Smooth(Smoothness::Weight(0.0)),
        SHEETS => Method::Map(None),
        spec => {
            let classes = (spec == MUNSELL).then(classes::of_munsell);
            let spectra = args.common.reflectances(spec)?;
            if spectra.len() < 2 {
                let problem = format!("'{spec}' holds only one spectrum");
                return Err(Error::usage("--prior", problem, "name a set or a file of two or more"));
            }
            Method::Map(Some((spectra, classes)))
        }
    })
}

impl Transform for Estimator<'_> {
    type Context = Context;
    type Aside = Made;

    fn scene(&self, scene: &mut Scene) -> Result<Context> {
        let grid = scene.grid()?;
        if self.forgets_light {
            scene.forget_light()?;
        }
        if let Some(card) = &self.reference_panel {
            let reflectance = card.on(&grid, Outside::Refuse).map_err(|e| e.of_flag("--reference-panel"))?;
            scene.set_reference_panel(&ReferencePanel::new(1, card.name(), reflectance))?;
        }
        if self.asked.args.backed {
            scene.set_backed()?;
        }
        let materials = self.asked.args.materials.on(&grid, &self.asked.args.common)?;
        if !materials.is_empty() {
            scene.set_materials(&materials)?;
        }
        let lights =
            if scene.is_light_unknown()? { self.lights_before(&scene.camera()?, &grid)? } else { Vec::new() };
        if lights.is_empty() && self.illuminants.is_some() {
            let line = "--illuminants is not used: the light is stated; --illuminant unknown has it found";
            self.asked.args.common.say_once("vestimate", line);
        }
        // the scene has the same components in any light
        let lit = if lights.is_empty() { None } else { Some(scene.in_assumed_light(&grid)?) };
        let method = match &self.method {
            Method::Map(spectra) => SceneMethod::Map(self.prior_on(&grid, spectra.as_ref())?),
            Method::Smooth(smoothness) => SceneMethod::Smooth(*smoothness),
            Method::Flat(flat) => {
                SceneMethod::Flat(flat.context(&grid, &Setting::of(lit.as_ref().unwrap_or(scene))?.model()?)?)
            }
        };
        if !self.asked.args.common.no_history {
            scene.fields.add_history("vestimate")?;
        }
        let start = self.start.as_ref().map(|start| start.on(&grid, Outside::Refuse)).transpose();
        let start = start.map_err(|e| e.of_flag("--start"))?;
        let lit = lit.as_ref().unwrap_or(scene);
        let others = self.shared(other_lights(&lit.optics()?, lit.is_daylight_assumed()?));
        let (lights, shown) = match &self.known_fold {
            Some(known) => known.shown(&self.asked, (lit, &method), (lights, others.as_deref()))?,
            None => (lights, None),
        };
        Context::new(lit, method, start, &self.asked.fit, (lights, others, shown))
    }

    fn sample(&self, context: &Context, sample: &mut Sample) -> Result<Made> {
        let (rgb, noise, exposure) =
            (sample.facet_rgb()?, self.asked.noise(sample)?, self.asked.exposure_of(sample)?);
        self.known_fold.iter().try_for_each(|known| known.check(sample, exposure))?;
        let (estimate, verdict, how) = match &context.method {
            SceneMethod::Map(prior) => {
                let deviations = Deviations::of(&noise, context.model.facets(), &rgb)?;
                let is_photograph = sample.is_photograph();
                let fold = context.fold.as_deref();
                let photographed_fold = fold.filter(|_| is_photograph);
                let shadows =
                    photographed_fold.map(|fold| fold.shadows(&Measured { rgb: &rgb, sd: &deviations.sd }));
                let shadows = shadows.unwrap_or_default();
                let rgb = Shadow::left_out(&shadows, &rgb);
                let measured = &Measured { rgb: &rgb, sd: &deviations.sd };
                let inference = context.inference(prior, self.is_auto());
                let data = inference.data(measured, exposure, is_photograph)?;
                let photograph = || photographed(fold, sample, (measured, shadows), exposure);
                let photograph = is_photograph.then(photograph).transpose()?;
                let is_modelled = photograph.as_ref().is_some_and(|one| matches!(one.parts, Some(Ok(_))));
                if !(is_modelled && self.is_auto()) {
                    self.say_paper_unused(sample, exposure)?;
                }
                let facets = Facets { measured, exposure, photograph: photograph.as_ref() };
                let Measurement { estimate, verdict, unmodelled, .. } = inference.measure(&facets, &data)?;
                unmodelled.iter().for_each(|why| self.say_unmodelled(sample, &estimate, *why));
                let how =
                    format!("prior {}, {deviations}, {}", self.asked.args.prior(), messages::size(&data));
                (estimate, Some(verdict), how)
            }
            SceneMethod::Smooth(smoothness) => {
                self.say_paper_unused(sample, exposure)?;
                let (estimate, how) = self.smooth(context, &rgb, &noise, exposure, *smoothness)?;
                (estimate, None, how)
            }
            SceneMethod::Flat(flat) => {
                self.say_paper_unused(sample, exposure)?;
                let measured = Measured { rgb: &rgb, sd: &alike(&rgb) };
                let sheet = FlatSheet::new(context.model.facets(), &measured, exposure)?;
                (flat.estimate(&sheet)?, None, flat.to_string())
            }
        };
        self.finish(context, sample, &noise, (&estimate, verdict.as_ref()), &how, &[])
    }

    fn is_made(&self, sample: &Sample, kept: &Sample) -> bool {
        kept.is_estimate_of(sample)
    }
}

impl<'a> Estimator<'a> {
    /// # Errors
    /// Flags that contradict each other, or spectra of flags that cannot be read.
    pub fn new(args: &'a Args) -> Result<Self> {
        let reflectance = |flag, spec: &Option<String>| {
            spec.as_deref().map(|spec| args.common.one_reflectance(flag, spec)).transpose()
        };
        let illuminants = args.illuminants.as_deref().map(|spec| args.common.illuminants(spec));
        Ok(Self {
            // read before the samples, so that errors name the flag or its file, not the stream
            reference_panel: reflectance("--reference-panel", &args.reference_panel)?,
            start: reflectance("--start", &args.start)?,
            illuminants: illuminants.transpose()?,
            asked: Asked::new(args),
            method: method(args)?,
            forgets_light: args.planning.forgets_light(args.kernel.kernel.is_some())?,
            known_fold: KnownFold::of(args)?,
            last_prior: Mutex::default(),
            last_others: Mutex::default(),
        })
    }

    /// Its flags.
    pub fn args(&self) -> &Args {
        self.asked.args
    }

    /// The estimate from facets with uniform noise of this standard deviation.
    pub fn of_facets(
        &self,
        context: &Context,
        rgb: &FacetValues,
        noise_sd: f64,
        exposure: Exposure,
    ) -> Result<Estimate> {
        let sd = deviations(rgb, |_| noise_sd, self.asked.args.model_error.unwrap_or(0.0));
        let inference = context.inference(self.prior_of(context)?, self.is_auto());
        let data = inference.data(&Measured { rgb, sd: &sd }, exposure, false)?;
        map::estimate(&data, inference.prior, inference.start)
    }

    /// The prior on the wavelengths of a scene. It takes time and memory to compute, so successive scenes on
    /// the same wavelengths share it.
    fn prior_on(&self, grid: &WavelengthGrid, spectra: Option<&PriorSpectra>) -> Result<Arc<Prior>> {
        let wavelengths_nm = grid.wavelengths_nm();
        let mut last = self.last_prior.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((of_last_nm, prior)) = &*last
            && of_last_nm == wavelengths_nm
        {
            return Ok(Arc::clone(prior));
        }
        let prior = Arc::new(match spectra {
            None => Prior::built_in(wavelengths_nm)?,
            Some((spectra, classes)) => {
                let on_grid = spectra.iter().map(|one| one.on(grid, Outside::Refuse));
                let on_grid: Vec<_> = on_grid.collect::<Result<_>>().map_err(|e| e.of_flag("--prior"))?;
                Prior::from_spectra(wavelengths_nm, &on_grid, classes.as_deref())?
            }
        });
        *last = Some((wavelengths_nm.to_vec(), Arc::clone(&prior)));
        Ok(prior)
    }

    /// Alternatives to a light. Computing them takes longer than an estimate, so successive scenes with the
    /// same camera share them.
    fn shared(&self, others: Option<Others>) -> Option<Arc<Others>> {
        let others = others?;
        let mut last = self.last_others.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(last) = &*last
            && last.are_those_of(&others)
        {
            return Some(Arc::clone(last));
        }
        Some(Arc::clone(last.insert(Arc::new(others))))
    }

    /// Candidates for an unknown light, for this camera.
    ///
    /// # Errors
    /// [`Error::Usage`] if flags request something that cannot be combined with inferring the light; lights
    /// that do not cover the wavelengths.
    fn lights_before(&self, camera: &CameraRecord, grid: &WavelengthGrid) -> Result<Vec<Candidate>> {
        let fits_scene = self.asked.fit.iter().any(|unknown| **unknown != EXPOSURE);
        if !self.asked.args.has_prior() || self.asked.args.join.is_some() || fits_scene {
            let problem = "an unknown light is found only with a prior, for each photograph by itself, \
                           and with no more fitted than the exposure";
            return Err(Error::usage(
                "--illuminant",
                problem,
                "leave --prior, --method, --join and --fit out, or state the light to vextract",
            ));
        }
        let all = |lights: &[_]| Candidate::all(lights, grid, &camera.sensitivities);
        let lights = match &self.illuminants {
            Some(spectra) => {
                let named = all(&equal_candidates(spectra.clone()));
                return named.map_err(|e| e.of_flag("--illuminants"));
            }
            // a known sheet distinguishes more similar lights
            None if self.known_fold.as_ref().is_some_and(|known| !known.is_photograph()) => {
                fine_candidate_lights()?
            }
            None => candidate_lights_and_between()?,
        };
        all(&lights)
    }

    /// The prior on reflectances in a scene.
    ///
    /// # Errors
    /// [`Error::Usage`] if there is none, so that the error of an estimate is unknown.
    pub fn prior_of<'c>(&self, context: &'c Context) -> Result<&'c Prior> {
        match &context.method {
            SceneMethod::Map(prior) => Ok(prior),
            SceneMethod::Smooth(_) | SceneMethod::Flat(_) => {
                let prior = self.asked.args.prior();
                let problem =
                    format!("--plan and --join need error bars, which --prior {prior} does not give");
                Err(Error::usage("--prior", problem, "leave --prior and --method out, or name spectra"))
            }
        }
    }

    /// Whether the flags state that a photograph may show a real sheet.
    pub fn asks_for_auto(&self) -> bool {
        self.asked.args.fit.contains(&&AUTO)
    }

    /// Whether the photograph determines what is fitted.
    pub fn is_auto(&self) -> bool {
        self.asked.args.fit.is_empty() || self.asks_for_auto()
    }

    /// Adds an estimate made from facets of this noise by the method `how`, with its verdict, and the ids of
    /// all `joined` samples if there were several.
    pub fn finish(
        &self,
        context: &Context,
        sample: &mut Sample,
        noise: &Noise,
        (estimate, verdict): (&Estimate, Option<&Verdict>),
        how: &str,
        joined: &[String],
    ) -> Result<Made> {
        if self.asked.args.common.verbose {
            let (id, exposure) = (sample.id(), self.asked.exposure_of(sample)?);
            cli::say("vestimate", &format!("{id}: {how}; {}", messages::outcome(estimate, exposure)));
        }
        // methods that do not weight facets know their noise nevertheless
        let rms = || Ok(Deviations::of(noise, context.model.facets(), &sample.facet_rgb()?)?.rms());
        refuse_unexplained(estimate, || verdict.map_or_else(rms, |_| Ok(1.0)))?;
        let (method, prior) = match &context.method {
            SceneMethod::Flat(flat) => (flat.name(), flat.basis()),
            SceneMethod::Map(_) | SceneMethod::Smooth(_) => ("interreflection", self.asked.args.prior()),
        };
        let with_covariance =
            self.asked.args.common.save.iter().any(|(field, _)| field.ends_with("covariance"));
        let record = sample.set_estimate(&NewEstimate {
            method,
            prior,
            wavelengths_nm: context.grid.wavelengths_nm(),
            estimate,
            noise: verdict.map(|_| noise),
            joined,
            verdict,
            with_covariance,
        })?;
        let asked = self.asked.args.trace.as_ref().map(|_| trace(&sample.id(), &estimate.trace));
        Ok(Made { estimate: record, trace: asked.transpose()?.unwrap_or_default() })
    }

    /// Warns that a photograph whose facets an ideal fold does not explain is nevertheless treated as one.
    fn say_unmodelled(&self, sample: &Sample, ideal: &Estimate, why: Unmodelled) {
        if !self.asked.args.common.quiet {
            let (id, reduced_chi) = (sample.id(), ideal.residual_rms);
            let text = format!(
                "{id}: residual {reduced_chi:.1} times the expected error: this is not an ideal fold. \
                 Real-sheet effects cannot be modelled here ({why}); errors may exceed the bars"
            );
            cli::say("vestimate", &text);
        }
    }

    /// Warns that white paper in a photograph does not give the exposure of a sheet that is treated as ideal:
    /// how white it is has an error, which only the model of real sheets takes into account.
    fn say_paper_unused(&self, sample: &Sample, exposure: Exposure) -> Result<()> {
        let is_asked = !self.asked.args.common.quiet && exposure.known().is_none();
        if is_asked && sample.white_paper()?.is_some() {
            let text = "the white paper does not give the exposure here: only photographs of folds use \
                        it, and only with --fit auto; state --exposure, or mark a card and give vextract \
                        its --white-reflectance";
            cli::say("vestimate", &format!("{}: {text}", sample.id()));
        }
        Ok(())
    }

    /// The paper's objective, which weights all facets equally, white being 1; and a description of it.
    fn smooth(
        &self,
        context: &Context,
        rgb: &FacetValues,
        noise: &Noise,
        exposure: Exposure,
        smoothness: Smoothness,
    ) -> Result<(Estimate, String)> {
        let measured = Measured { rgb, sd: &alike(rgb) };
        let data = FacetData::new(&context.model, &measured, exposure, smooth::CUTOFF)?;
        let middle = vec![0.5; context.grid.len()];
        let start = context.start.as_ref().unwrap_or(&middle);
        let (estimate, weight) = match smoothness {
            Smoothness::Weight(weight) => (smooth::estimate(&data, weight, start)?, format!("{weight:e}")),
            Smoothness::Auto => {
                let noise = Deviations::of(noise, context.model.facets(), rgb)?;
                (
                    smooth::estimate_by_discrepancy(&data, noise.rms(), start)?,
                    format!("as allowed by {noise}"),
                )
            }
        };
        Ok((estimate, format!("smoothness {weight}, {}", messages::size(&data))))
    }
}

/// Equal standard deviations for all facets, white being 1.
fn alike(rgb: &FacetValues) -> FacetValues {
    rgb.map(|_, _| 1.0)
}
