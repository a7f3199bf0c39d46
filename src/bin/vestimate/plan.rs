//! `--plan`: what estimates will be worth, before any photograph.

use clap::Args;
use vfold::cli::{Common, OpticsArgs};
use vfold::estimate::Exposure;
use vfold::scene::{ExpectedError, Setting};
use vfold::spectrum::{Outside, WavelengthGrid};
use vfold::stream::{NewPlan, Output, Reader, Record, Scene, Transform, plan};
use vfold::{Error, Result};

use super::estimator::Estimator;
use super::settings::NoiseSd;

/// Noise of facets, white being 1, if none is given.
const NOISE_SD: f64 = 1e-3;

/// What is planned.
#[derive(Args)]
#[command(next_help_heading = "Planning")]
pub struct PlanArgs {
    /// Take scenes without samples and say how far off estimates will be: one record per scene, for --noise-sd [default: 1e-3]
    #[arg(long, conflicts_with_all = ["plot", "trace"])]
    pub plan: bool,
    /// Reflectances that will be photographed [default: cc24]
    #[arg(long, value_name = "SPEC", requires = "plan")]
    pub reflectance: Option<String>,
    /// Camera of a scene that has none [default: canon-5d-mark-ii]
    #[arg(long, value_name = "SPEC", requires = "scene without a camera")]
    pub camera: Option<String>,
    /// Illuminant of a scene that has none; repeated: a picture under each, or one per light as for vforward [default: D65]
    #[arg(long, value_name = "SPEC", requires = "scene without a camera")]
    pub illuminant: Vec<String>,
    /// Illuminant of its sky [default: that of the sun]
    #[arg(long, value_name = "SPEC", requires = "scene without a camera")]
    pub sky_illuminant: Option<String>,
}

impl PlanArgs {
    /// Writes a plan for every scene of `reader`, and no other record.
    pub fn run(&self, estimator: &Estimator, reader: &mut Reader, out: &mut Output) -> Result<()> {
        while let Some(record) = reader.read()? {
            if let Record::Scene(mut scene) = record {
                self.complete(&mut scene, &estimator.args().common).map_err(|e| reader.at(e))?;
                let plan = self.of_scene(estimator, &mut scene).map_err(|e| reader.at(e))?;
                out.fields(&plan)?;
            }
        }
        Ok(())
    }

    /// Gives camera and light to a scene that has none.
    pub fn complete(&self, scene: &mut Scene, common: &Common) -> Result<()> {
        if scene.has_camera() {
            let flags = [&self.camera, &self.sky_illuminant];
            if flags.iter().any(|flag| flag.is_some()) || !self.illuminant.is_empty() {
                let problem = "the scene has a camera and an illuminant already";
                return Err(Error::usage(
                    "--camera",
                    problem,
                    "leave these flags out, or plan with vkernel's scene",
                ));
            }
            return Ok(());
        }
        let daylight = vec!["D65".to_owned()];
        let optics = OpticsArgs {
            illuminant: if self.illuminant.is_empty() { daylight } else { self.illuminant.clone() },
            sky_illuminant: self.sky_illuminant.clone(),
            wavelengths_nm: WavelengthGrid::uniform(400.0, 700.0, 5.0)?,
        };
        let camera = self.camera.as_deref().unwrap_or("canon-5d-mark-ii");
        scene.set_optics(&optics.resolve(camera, common)?)
    }

    /// Estimates from facets without noise, taken to have it: their error bars are what to expect.
    fn of_scene(&self, estimator: &Estimator, scene: &mut Scene) -> Result<vfold::stream::Fields> {
        let context = estimator.scene(scene)?;
        let setting = Setting::of(scene)?;
        let (grid, model) = (scene.grid()?, setting.model()?);
        let noise_sd = match estimator.args().noise_sd {
            NoiseSd::All(sd) => sd,
            NoiseSd::Auto => NOISE_SD,
        };
        let set = self.reflectance.as_deref().unwrap_or("cc24");
        let mut expected = ExpectedError::default();
        for spectrum in estimator.args().common.reflectances(set)? {
            let facets = model.facet_rgb(&spectrum.on(&grid, Outside::Refuse)?);
            let rgb: Vec<_> = facets.row_iter().map(|row| Some(row.iter().copied().collect())).collect();
            let exposure = estimator.exposure_or(Exposure::Known(1.0));
            expected.add(&estimator.of_facets(&context, &rgb, noise_sd, exposure)?);
        }
        let angle_deg = match &setting {
            Setting::Fold(fold) => Some(fold.fold().angle_deg()),
            Setting::Surface(_) => None,
        };
        let (rmse, fitted_sd) = (expected.rmse(), expected.fitted_sd());
        plan(scene, NewPlan { angle_deg, reflectances: set, noise_sd, rmse, fitted_sd })
    }
}
