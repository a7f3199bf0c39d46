//! Estimates of the samples of a stream.

use std::sync::Arc;

use vfold::cli;
use vfold::estimate::data::FacetData;
use vfold::estimate::light::{Candidate, Others};
use vfold::estimate::measured::Measured;
use vfold::estimate::measurement::{Facets, Inference, Measurement};
use vfold::estimate::noise::{Noise, deviations};
use vfold::estimate::photograph::Unmodelled;
use vfold::estimate::prior::Prior;
use vfold::estimate::unknowns::{AUTO, EXPOSURE};
use vfold::estimate::verdict::{Verdict, refuse_unexplained};
use vfold::estimate::{Estimate, Exposure, map};
use vfold::forward::FacetValues;
use vfold::paper::components::FlatSheet;
use vfold::paper::smooth;
use vfold::scene::{Setting, other_cameras, other_lights, photographed, stated};
use vfold::spectrum::{
    Outside, Spectrum, WavelengthGrid, candidate_lights_and_between, equal_candidates, fine_candidate_lights,
};
use vfold::stream::{
    CameraRecord, EstimateRecord, Fields, NewEstimate, Optics, ReferencePanel, Sample, Scene, Transform,
    trace,
};
use vfold::{Error, Result};

use super::Args;
use super::asked::Asked;
use super::context::{Context, SceneMethod, fold_of};
use super::known_fold::KnownFold;
use super::latest::Latest;
use super::messages;
use super::method::Method;
use super::settings::Smoothness;

/// The results for a sample.
pub struct Made {
    /// The estimate in the form of its record.
    pub estimate: EstimateRecord,
    /// Records of the iterations, if requested.
    pub trace: Vec<Fields>,
}

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
    /// The alternatives to a stated light, on these wavelengths for these sensitivities of the camera.
    other_lights: Latest<(WavelengthGrid, Vec<Vec<f64>>), Arc<Others>>,
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
            let line =
                "--illuminants is not used: the light is stated; to have it found, give --illuminant unknown";
            self.asked.args.common.say_once("vestimate", line);
        }
        // the scene has the same components in any light
        let lit = if lights.is_empty() { None } else { Some(scene.in_assumed_light(&grid)?) };
        let method = match &self.method {
            Method::Map(prior) => SceneMethod::Map(prior.on(&grid)?),
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
        let (optics, is_daylight_assumed) = (lit.optics()?, lit.is_daylight_assumed()?);
        let other_lights = self.other_lights(&optics, is_daylight_assumed)?;
        let (lights, shown) = match &self.known_fold {
            Some(known) => known.shown(&self.asked, (lit, &method), (lights, other_lights.as_deref()))?,
            None => (lights, None),
        };
        let setting = Setting::of(lit)?;
        let (model, fold) = (setting.model_to_fit(&self.asked.fit)?, fold_of(lit, setting)?);
        let stated = stated(&optics, is_daylight_assumed);
        let inference = Inference {
            model,
            wavelengths_nm: grid.wavelengths_nm().to_vec(),
            start,
            is_auto: self.is_auto(),
            stated: if lights.is_empty() { stated } else { stated.but_light() },
            lights,
            other_lights,
            other_cameras: other_cameras(&optics),
            shown,
            panel: fold.as_ref().map(|fold| fold.fold.facets()),
        };
        Ok(Context { inference, method, fold })
    }

    fn sample(&self, context: &Context, sample: &mut Sample) -> Result<Made> {
        let (rgb, noise, exposure) =
            (sample.facet_rgb()?, self.asked.noise(sample)?, self.asked.exposure_of(sample)?);
        self.known_fold.iter().try_for_each(|known| known.check(sample, exposure))?;
        let (estimate, verdict, how) = match &context.method {
            SceneMethod::Map(prior) => {
                let Context { inference, fold, .. } = context;
                let sd = noise.deviations(inference.model.facets(), &rgb)?;
                let is_photograph = sample.is_photograph();
                let (rgb, shadows) = match fold {
                    Some(fold) if is_photograph => fold.out_of_shadows(&rgb, &sd),
                    _ => (rgb, Vec::new()),
                };
                let measured = &Measured { rgb: &rgb, sd: &sd };
                let data = inference.data(measured, exposure, is_photograph)?;
                let photograph = || photographed(fold.as_deref(), sample, (measured, shadows), exposure);
                let photograph = is_photograph.then(photograph).transpose()?;
                let is_modelled = photograph.as_ref().is_some_and(|one| matches!(one.parts, Some(Ok(_))));
                if !(is_modelled && self.is_auto()) {
                    self.say_paper_unused(sample, exposure)?;
                }
                let facets = Facets { measured, exposure, photograph: photograph.as_ref() };
                let Measurement { estimate, verdict, unmodelled, .. } =
                    inference.measure(&facets, &data, prior)?;
                unmodelled.iter().for_each(|why| self.say_unmodelled(sample, &estimate, *why));
                let (prior, known_to) = (self.asked.args.prior(), messages::known_to(&noise, &sd));
                let how = format!("prior {prior}, {known_to}, {}", messages::size(&data));
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
                let sheet = FlatSheet::new(context.inference.model.facets(), &measured, exposure)?;
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
            method: Method::of(args)?,
            forgets_light: args.planning.forgets_light(args.kernel.kernel.is_some())?,
            known_fold: KnownFold::of(args)?,
            other_lights: Latest::default(),
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
        let data = context.inference.data(&Measured { rgb, sd: &sd }, exposure, false)?;
        map::estimate(&data, self.prior_of(context)?, context.inference.start.as_deref())
    }

    /// Alternatives to the light of a scene, if there are any.
    fn other_lights(&self, optics: &Optics, is_daylight_assumed: bool) -> Result<Option<Arc<Others>>> {
        let Some(others) = other_lights(optics, is_daylight_assumed) else { return Ok(None) };
        let of = (optics.grid.clone(), optics.camera.sensitivities.clone());
        self.other_lights.get(of, |_| Ok(Arc::new(others))).map(Some)
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
                           and with nothing but the exposure fitted";
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
        let sd = || noise.deviations(context.inference.model.facets(), &sample.facet_rgb()?);
        let rms = || Ok(messages::rms(&sd()?));
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
            wavelengths_nm: &context.inference.wavelengths_nm,
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
        let Inference { model, wavelengths_nm, start, .. } = &context.inference;
        let data = FacetData::new(model, &measured, exposure, smooth::CUTOFF)?;
        let middle = vec![0.5; wavelengths_nm.len()];
        let start = start.as_ref().unwrap_or(&middle);
        let (estimate, weight) = match smoothness {
            Smoothness::Weight(weight) => (smooth::estimate(&data, weight, start)?, format!("{weight:e}")),
            Smoothness::Auto => {
                let sd = noise.deviations(model.facets(), rgb)?;
                (
                    smooth::estimate_by_discrepancy(&data, messages::rms(&sd), start)?,
                    format!("as allowed by {}", messages::known_to(noise, &sd)),
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
