//! `--plan`: the expected accuracy of estimates, before any photograph.

use clap::Args;
use rayon::prelude::*;
use vfold::cli::{self, Common, OpticsArgs, refuse};
use vfold::estimate::measured::Measured;
use vfold::estimate::noise::deviations;
use vfold::estimate::photograph::{self, Parts};
use vfold::estimate::{Estimate, Exposure};
use vfold::forward::FacetValues;
use vfold::scene::{ExpectedError, PhotographedFold, Setting};
use vfold::spectrum::{ASSUMED_LIGHT, Outside, UNKNOWN_LIGHT, WavelengthGrid};
use vfold::stream::{Fields, NewPlan, Output, Reader, Record, Scene, Transform, needs_fold, plan};
use vfold::{Error, Result};

use super::context::Context;
use super::estimator::Estimator;
use super::join;
use super::settings::NoiseSd;

/// Default noise of facets, white being 1.
pub const NOISE_SD: &str = "1e-3";

/// What is planned.
#[derive(Args)]
#[command(next_help_heading = "Planning")]
pub struct PlanArgs {
    /// Take scenes without samples and report the expected errors: one record per scene, for --noise-sd
    /// [default: 1e-3]; for ideal folds, for photographs of real sheets with --fit auto, and with --join
    /// for the first scene together with each of the others
    #[arg(long, conflicts_with_all = ["plot", "trace", "spectra", "start", "smoothness", "illuminants"])]
    pub plan: bool,
    /// Reflectances that will be photographed [default: cc24]
    #[arg(long, value_name = "SPEC", requires = "plan")]
    pub reflectance: Option<String>,
    /// Camera of a scene that has none [default: canon-5d-mark-ii]
    #[arg(long, value_name = "SPEC", requires = "scene without a camera")]
    pub camera: Option<String>,
    /// Illuminant of a scene that has none; repeated: a picture under each, or one per light as for vforward
    /// [default: D65]; unknown: ignore the illuminants of the scenes, and find them
    #[arg(long, value_name = "SPEC", value_parser = cli::light)]
    pub illuminant: Vec<String>,
    /// Illuminant of the sky of a scene that has none [default: the same as the sun's]
    #[arg(long, value_name = "SPEC", requires = "scene without a camera", value_parser = cli::light)]
    pub sky_illuminant: Option<String>,
}

/// A scene in which sheets will be photographed.
struct Planned {
    scene: Scene,
    context: Context,
    angle_deg: Option<f64>,
    sheets: Sheets,
}

/// The assumed sheets.
enum Sheets {
    /// Ideal folds: the facets of each.
    Ideal(Vec<FacetValues>),
    /// Real sheets, with all effects unknown: the parts of each photograph's model.
    Real(Vec<Parts>),
}

impl PlanArgs {
    /// Writes a plan for every scene of `reader`, and no other record except samples that carry an error,
    /// which may represent a lost scene.
    pub fn run(&self, estimator: &Estimator, reader: &mut Reader, out: &mut Output) -> Result<()> {
        let mut first = None;
        while let Some(record) = reader.read()? {
            let mut scene = match record {
                Record::Scene(scene) => scene,
                Record::Sample(sample) if sample.error().map_err(|e| reader.at(e))?.is_some() => {
                    out.sample(&sample)?;
                    continue;
                }
                Record::Sample(_) | Record::Other(_) => continue,
            };
            self.complete(&mut scene, &estimator.args().common).map_err(|e| reader.at(e))?;
            let planned = self.planned(estimator, scene).map_err(|e| reader.at(e))?;
            out.fields(&self.plan(estimator, &planned, first.as_ref()).map_err(|e| reader.at(e))?)?;
            if estimator.args().join.is_some() && first.is_none() {
                first = Some(planned);
            }
        }
        Ok(())
    }

    /// Whether the light of all scenes is to be inferred.
    ///
    /// # Errors
    /// [`Error::Usage`] if it is to be inferred without any data, or is stated for scenes that have one.
    pub fn forgets_light(&self, has_kernel: bool) -> Result<bool> {
        let is_unknown = self.illuminant.iter().any(|spec| spec == UNKNOWN_LIGHT);
        if self.plan || has_kernel {
            return match is_unknown {
                true => {
                    let problem = format!("'{UNKNOWN_LIGHT}' cannot be used with --plan or --kernel");
                    Err(Error::usage("--illuminant", problem, "name the light"))
                }
                false => Ok(false),
            };
        }
        match self.illuminant.as_slice() {
            [] => Ok(false),
            [_] if is_unknown => Ok(true),
            _ => {
                let problem = "the light of samples is stated to vextract or vforward, which made them";
                let remedy = "give it there, or 'unknown' here to have it found; \
                              only --plan and --kernel take the name of a light here";
                Err(Error::usage("--illuminant", problem, remedy))
            }
        }
    }

    /// Adds camera and light to a scene without them.
    pub fn complete(&self, scene: &mut Scene, common: &Common) -> Result<()> {
        if scene.has_camera() {
            let flags = [
                ("--camera", self.camera.is_some()),
                ("--illuminant", !self.illuminant.is_empty()),
                ("--sky-illuminant", self.sky_illuminant.is_some()),
            ];
            let problem = "the scene already has a camera, and its light is stated or to be found";
            return refuse(
                flags,
                problem,
                "leave it out, or plan with a scene from vkernel, which has neither",
            );
        }
        let daylight = vec![ASSUMED_LIGHT.to_owned()];
        let optics = OpticsArgs {
            illuminant: if self.illuminant.is_empty() { daylight } else { self.illuminant.clone() },
            sky_illuminant: self.sky_illuminant.clone(),
            wavelengths_nm: WavelengthGrid::uniform(400.0, 700.0, 5.0)?,
        };
        let camera = self.camera.as_deref().unwrap_or("canon-5d-mark-ii");
        scene.set_optics(&optics.resolve(&common.camera(camera)?, common)?)
    }

    /// The sheets in a scene: their facets are free of noise, but are assumed to have it.
    fn planned(&self, estimator: &Estimator, mut scene: Scene) -> Result<Planned> {
        let context = estimator.scene(&mut scene)?;
        let (grid, model, noise_sd) = (scene.grid()?, Setting::of(&scene)?.model()?, noise_sd(estimator)?);
        let exposure = estimator.asked.exposure_or(Exposure::Known(1.0)).known().unwrap_or(1.0);
        let spectra = estimator.args().common.reflectances(self.set())?;
        let facets = spectra.iter().map(|spectrum| {
            let facets = exposure * model.facet_rgb(&spectrum.on(&grid, Outside::Refuse)?);
            Ok(FacetValues::from(&facets))
        });
        let facets: Vec<FacetValues> = facets.collect::<Result<_>>()?;
        let angle_deg = context.fold.as_ref().map(|fold| fold.fold.angle_deg());
        let exposure = estimator.asked.exposure_or(Exposure::Free);
        // estimates by sums are those of ideal folds
        let is_real = estimator.asks_for_auto() && exposure != Exposure::Sum;
        let sheets = if estimator.args().join.is_some() || is_real {
            let photographed = PhotographedFold::of(context.fold.as_deref().ok_or_else(needs_fold)?);
            let parts = |rgb: &FacetValues| {
                let sd = deviations(rgb, |_| noise_sd, estimator.args().model_error.unwrap_or(0.0));
                let measured = Measured { rgb, sd: &sd };
                photographed.planned(&measured, exposure.known())?.map_err(|why| {
                    Error::field("geometry", format!("{why}; plan this fold without --fit auto"))
                })
            };
            Sheets::Real(facets.par_iter().map(parts).collect::<Result<_>>()?)
        } else {
            Sheets::Ideal(facets)
        };
        Ok(Planned { scene, context, angle_deg, sheets })
    }

    /// The plan of a scene, its pictures being estimated jointly with those of another if there is one.
    fn plan(&self, estimator: &Estimator, planned: &Planned, other: Option<&Planned>) -> Result<Fields> {
        let mut expected = ExpectedError::default();
        planned.estimates(estimator, other)?.iter().for_each(|estimate| expected.add(estimate));
        plan(
            &planned.scene,
            NewPlan {
                angle_deg: planned.angle_deg,
                with_photograph: other.map(|other| (&other.scene, other.angle_deg)),
                reflectances: self.set(),
                noise_sd: noise_sd(estimator)?,
                rmse: expected.rmse(),
                fitted_sd: expected.fitted_sd(),
            },
        )
    }

    /// The reflectances that will be photographed.
    fn set(&self) -> &str {
        self.reflectance.as_deref().unwrap_or("cc24")
    }
}

impl Planned {
    /// One estimate per sheet, whose error bars are the expected errors.
    fn estimates(&self, estimator: &Estimator, other: Option<&Self>) -> Result<Vec<Estimate>> {
        match &self.sheets {
            Sheets::Ideal(sheets) => {
                let exposure = estimator.asked.exposure_or(Exposure::Known(1.0));
                let noise_sd = noise_sd(estimator)?;
                let of = |rgb| estimator.of_facets(&self.context, rgb, noise_sd, exposure);
                sheets.iter().map(of).collect()
            }
            Sheets::Real(sheets) => {
                let prior = estimator.prior_of(&self.context)?;
                let others: &[Parts] = match other {
                    Some(Self { context, sheets: Sheets::Real(others), .. }) => {
                        join::check_wavelengths(context, &self.context)?;
                        others
                    }
                    _ => &[],
                };
                let of = |(n, own): (usize, &Parts)| {
                    let pictures: Vec<Parts> = others.get(n).into_iter().chain([own]).cloned().collect();
                    let mut found = photograph::estimate_usual(&pictures, prior)?;
                    found.photographs.pop().ok_or_else(|| Error::Numeric("no photograph".to_owned()))
                };
                sheets.par_iter().enumerate().map(of).collect()
            }
        }
    }
}

/// Noise of the facets.
///
/// # Errors
/// [`Error::Usage`] if it is to be taken from samples, which a plan has not.
fn noise_sd(estimator: &Estimator) -> Result<f64> {
    match estimator.args().noise_sd {
        NoiseSd::All(sd) => Ok(sd),
        NoiseSd::Auto => {
            let problem = "'auto' takes the noise from samples, and --plan has none";
            Err(Error::usage("--noise-sd", problem, "give a number, or leave it out"))
        }
    }
}
