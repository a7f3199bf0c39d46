//! The model of a scene of which not all is known.

use super::Scene;
use crate::camera::CameraResponse;
use crate::error::{Error, Result};
use crate::estimate::unknowns::{Factor, Quantity, SceneModel, Unknown};
use crate::forward::{FacetModel, Lit};
use crate::geometry::{Fold, Light};
use crate::kernel::mesh::{Mesh, respond};
use crate::response::{ModeLight, Response};
use crate::spectrum::{self, Outside};

/// Standard deviation of a tilt, degrees, or a quarter of the opening if that is less: who turns a sheet to the sun by eye errs
/// by a few degrees, and a sun further off shades a panel, which one sees.
const TILT_SD_DEG: f64 = 10.0;
/// Standard deviation of the sky: a clear one gives a tenth to a third of the sun's light, a hazy one half of it, of which
/// a sheet among houses gets a part.
const SKY_SD: f64 = 0.25;
/// Reciprocal colour temperature of the sky, 1e-6/K, and its standard deviation: 10000 K, two of three between 7700 K and
/// 14300 K. An overcast sky has 6500 K, a clear blue one up to 25000 K, where CIE daylight ends.
const SKY_MIRED: f64 = 100.0;
const SKY_MIRED_SD: f64 = 30.0;
/// Skies between which that of any temperature is interpolated, K.
const SKIES_K: [u32; 3] = [20_000, 10_000, 6_250];
/// Standard deviation of an angle, degrees, or a tenth of it if that is less: what a protractor and a sheet that springs back
/// leave. The light of a fold is interpolated between folds that far apart.
const ANGLE_SD_DEG: f64 = 2.0;

/// What the amount of a source is of some quantities.
type Factors = Vec<(Quantity, Factor)>;

/// Folds of which the scene's is one, or between which it lies.
struct Folds {
    folds: Vec<(Fold, Factors)>,
    responses: Vec<Response>,
}

impl Scene {
    /// The model of facet RGB with the quantities of `fit` unknown. A sky of no given colour is daylight of unknown temperature.
    /// An unknown angle takes three more solutions of the bounces, 10 to 25 ms each.
    ///
    /// # Errors
    /// As [`Scene::model`]; [`Error::Field`] if the angle of a scene with a given mesh is to be fitted, or of a flat sheet.
    pub fn model_to_fit(&self, fit: &[Quantity]) -> Result<SceneModel> {
        let mut unknowns = Vec::new();
        let Folds { folds, responses } = self.folds(fit, &mut unknowns)?;
        let suns = self.suns(fit, &folds, &mut unknowns)?;
        let skies = self.skies(fit, folds.len(), &mut unknowns)?;
        let sources: Vec<_> = suns.into_iter().chain(skies).collect();
        let lights: Vec<Lit> = sources.iter().map(FittedSource::lit).collect();
        let facets = FacetModel::new(&responses, &lights, self.card()?);
        let factor = |source: &FittedSource, unknown: &Unknown| {
            let all = folds[source.response].1.iter().chain(&source.factors);
            all.copied().find(|(quantity, _)| *quantity == unknown.quantity).map_or(Factor::One, |(_, f)| f)
        };
        let factors = sources.iter().map(|s| unknowns.iter().map(|u| factor(s, u)).collect()).collect();
        Ok(SceneModel::new(facets, unknowns, factors))
    }

    fn folds(&self, fit: &[Quantity], unknowns: &mut Vec<Unknown>) -> Result<Folds> {
        let fold = self.fold()?;
        if !fit.contains(&Quantity::AngleDeg) {
            return Ok(Folds { folds: vec![(fold, Vec::new())], responses: vec![self.response()?] });
        }
        if self.mesh()? != Mesh::Auto.to_string() {
            let problem =
                "an angle is fitted between folds that vkernel --mesh auto solves; make the scene so";
            return Err(Error::field("accuracy.mesh", problem));
        }
        let angle_deg = fold.angle_deg();
        let sd = ANGLE_SD_DEG.min(0.1 * angle_deg);
        if angle_deg + sd > 180.0 {
            return Err(Error::field("geometry.angle_deg", format!("{angle_deg} is flat: no angle to fit")));
        }
        unknowns.push(Unknown { quantity: Quantity::AngleDeg, mean: angle_deg, sd });
        let nodes = [angle_deg - sd, angle_deg, angle_deg + sd];
        let mut all = Folds { folds: Vec::new(), responses: Vec::new() };
        for (at, node) in nodes.into_iter().enumerate() {
            let fold = fold.with_angle_deg(node)?;
            all.responses.push(respond(&fold, Mesh::Auto, self.tolerance()?)?.0);
            all.folds.push((fold, vec![(Quantity::AngleDeg, Factor::Node { nodes, at })]));
        }
        Ok(all)
    }

    fn suns(
        &self,
        fit: &[Quantity],
        folds: &[(Fold, Factors)],
        unknowns: &mut Vec<Unknown>,
    ) -> Result<Vec<FittedSource>> {
        let (light, camera) = (self.light()?, self.lighting()?.sun);
        let tilts = fit.contains(&Quantity::TiltDeg);
        if tilts {
            let sd = TILT_SD_DEG.min(0.25 * self.fold()?.angle_deg());
            unknowns.push(Unknown { quantity: Quantity::TiltDeg, mean: light.tilt_deg(), sd });
        }
        let mut suns = Vec::new();
        for (response, (fold, _)) in folds.iter().enumerate() {
            let mut add = |on_panels, factors| {
                let light = ModeLight::Sun(on_panels);
                suns.push(FittedSource { response, light, camera: camera.clone(), factors });
            };
            if tilts {
                let [even, odd] = light.even_and_odd(fold);
                add([even, even], vec![(Quantity::TiltDeg, Factor::Cosine)]);
                add([odd, -odd], vec![(Quantity::TiltDeg, Factor::Sine)]);
            } else {
                let light = Light::new(fold, light.tilt_deg(), light.slant_deg(), light.sky())?;
                add(light.panel_irradiance(), Vec::new());
            }
        }
        Ok(suns)
    }

    fn skies(
        &self,
        fit: &[Quantity],
        folds: usize,
        unknowns: &mut Vec<Unknown>,
    ) -> Result<Vec<FittedSource>> {
        let (known, lighting) = (self.light()?.sky(), self.lighting()?);
        let fits = fit.contains(&Quantity::Sky);
        let mut cameras = vec![(lighting.sky, Vec::new())];
        if fits {
            unknowns.push(Unknown { quantity: Quantity::Sky, mean: known, sd: SKY_SD });
            if !self.has_sky_illuminant() {
                unknowns.push(Unknown { quantity: Quantity::SkyCctK, mean: SKY_MIRED, sd: SKY_MIRED_SD });
                cameras = self.daylights(&lighting.sun)?;
            }
            cameras.iter_mut().for_each(|(_, factors)| factors.push((Quantity::Sky, Factor::Amount)));
        } else if known <= 0.0 {
            return Ok(Vec::new());
        }
        let light = ModeLight::Sky(if fits { 1.0 } else { known });
        let source = |(response, (camera, factors))| FittedSource { response, light, camera, factors };
        let on = |response| cameras.iter().cloned().map(move |camera| source((response, camera)));
        Ok((0..folds).flat_map(on).collect())
    }

    /// The camera's response to the skies between which others are interpolated.
    fn daylights(&self, sun: &CameraResponse) -> Result<Vec<(CameraResponse, Factors)>> {
        let (grid, sensitivities) = (self.grid()?, self.camera()?.sensitivities);
        let nodes = SKIES_K.map(|cct_k| 1e6 / f64::from(cct_k));
        let sky = |(at, cct_k)| {
            let power = spectrum::illuminant(&format!("daylight:{cct_k}"))?.on(&grid, Outside::Refuse)?;
            let camera = sun.to_other_light(&grid, &sensitivities, &power)?;
            Ok((camera, vec![(Quantity::SkyCctK, Factor::Node { nodes, at })]))
        };
        SKIES_K.iter().enumerate().map(sky).collect()
    }
}

/// A light on one of several folds, with what its amount depends on.
struct FittedSource {
    response: usize,
    light: ModeLight,
    camera: CameraResponse,
    factors: Factors,
}

impl FittedSource {
    fn lit(&self) -> Lit<'_> {
        Lit { response: self.response, light: self.light, camera: &self.camera }
    }
}
