//! A fold in its light as sources, which unknowns change.

use nalgebra::{DMatrix, DVector};

use super::Factor;
use crate::camera::CameraResponse;
use crate::error::Result;
use crate::estimate::photograph::conditions::Daylight;
use crate::forward::{Card, Lighting, Lit};
use crate::geometry::{Fold, Light};
use crate::response::{ModeLight, Response};
use crate::spectrum::WavelengthGrid;

/// A fold in its light, as far as it is known.
pub struct FoldInLight {
    /// The fold.
    pub fold: Fold,
    /// What all bounces on it make of light.
    pub response: Response,
    /// Relative error that facet means were allowed, where the mesh is as fine as that asks for; none where
    /// the mesh was given.
    pub tolerance: Option<f64>,
    /// Sun and sky as the camera responds to them.
    pub lighting: Lighting,
    /// Relative power of the sun, one value per waveband.
    pub sun_power: DVector<f64>,
    /// Mean daylight and its two characteristic vectors: waveband by three.
    pub daylight_vectors: DMatrix<f64>,
    /// The daylight that the sun was said to be, if it is any.
    pub daylight: Option<Daylight>,
    /// Whether the colour of the sky is given.
    pub has_sky_illuminant: bool,
    /// The card in the place of one panel, if there is one.
    pub card: Option<Card>,
    /// Wavelengths.
    pub grid: WavelengthGrid,
    /// Sensitivities of the camera, `[channel][waveband]`.
    pub sensitivities: Vec<Vec<f64>>,
}

/// What a source's amount is of some unknowns, by their names; of all others it is the same.
pub type Factors = Vec<(&'static str, Factor)>;

/// A light, on any fold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lamp {
    /// The sun where it stands.
    Sun,
    /// What panels receive alike from a sun on the bisecting plane.
    EvenSun,
    /// What panel 0 receives more and panel 1 less for each unit of the sine of the sun's tilt.
    OddSun,
    /// A uniform sky.
    Sky {
        /// Irradiance of an open plane, the sun's being 1.
        irradiance: f64,
    },
}

impl Lamp {
    /// The same on `fold`, the sun standing as in `light`.
    fn on(self, fold: &Fold, light: &Light) -> Result<ModeLight> {
        let [even, odd] = light.even_and_odd(fold);
        Ok(match self {
            Self::Sun => {
                let sky = if light.sun() > 0.0 { light.sky() } else { f64::INFINITY };
                let light = Light::new(fold, light.tilt_deg(), light.slant_deg(), sky)?;
                ModeLight::Sun(light.panel_irradiance())
            }
            Self::EvenSun => ModeLight::Sun([even, even]),
            Self::OddSun => ModeLight::Sun([odd, -odd]),
            Self::Sky { irradiance } => ModeLight::Sky(irradiance),
        })
    }

    fn is_sky(self) -> bool {
        match self {
            Self::Sun | Self::EvenSun | Self::OddSun => false,
            Self::Sky { .. } => true,
        }
    }
}

/// A lamp that the camera sees, with what its amount depends on.
#[derive(Clone, Debug)]
pub struct Source {
    /// The lamp.
    pub lamp: Lamp,
    camera: CameraResponse,
    factors: Factors,
}

impl Source {
    /// A lamp in the amount 1.
    #[must_use]
    pub fn new(lamp: Lamp, camera: CameraResponse) -> Self {
        Self { lamp, camera, factors: Vec::new() }
    }

    /// The same in an amount that also is this `factor` of the `unknown` of that name.
    #[must_use]
    pub fn with(&self, unknown: &'static str, factor: Factor) -> Self {
        let factors = self.factors.iter().copied().chain([(unknown, factor)]).collect();
        Self { factors, ..self.clone() }
    }

    /// The same with another lamp.
    #[must_use]
    pub fn shining(self, lamp: Lamp) -> Self {
        Self { lamp, ..self }
    }

    /// The same with another response of the camera.
    #[must_use]
    pub fn seen_by(&self, camera: CameraResponse) -> Self {
        Self { camera, ..self.clone() }
    }
}

/// A fold that the scene's may be, solved.
pub struct State {
    /// The fold.
    pub fold: Fold,
    /// Its response.
    pub response: Response,
    /// In what amount its light counts.
    pub factors: Factors,
}

/// All that facets are a sum of: every lamp on every state of the fold.
pub struct Sources {
    /// Folds of which the scene's is one, or between which it lies.
    pub states: Vec<State>,
    lamps: Vec<Source>,
}

impl Sources {
    /// Sources of which nothing is unknown.
    pub(super) fn of(scene: &FoldInLight) -> Self {
        let FoldInLight { fold, response, lighting, .. } = scene;
        let state = State { fold: *fold, response: response.clone(), factors: Vec::new() };
        let sun = Source::new(Lamp::Sun, lighting.sun.clone());
        let irradiance = lighting.light.sky();
        let sky = Source::new(Lamp::Sky { irradiance }, lighting.sky.clone());
        let (sun, sky) = ((lighting.light.sun() > 0.0).then_some(sun), (irradiance > 0.0).then_some(sky));
        Self { states: vec![state], lamps: sun.into_iter().chain(sky).collect() }
    }

    /// Puts others in the place of each lamp.
    pub fn replace(&mut self, by: impl Fn(Source) -> Vec<Source>) {
        self.lamps = std::mem::take(&mut self.lamps).into_iter().flat_map(by).collect();
    }

    /// Adds a lamp.
    pub fn add(&mut self, lamp: Source) {
        self.lamps.push(lamp);
    }

    /// The lamps on the states, suns before skies, with all that their amounts depend on.
    pub(super) fn on_states(&self, light: &Light) -> Result<Vec<(Lit<'_>, Factors)>> {
        let (skies, suns): (Vec<_>, Vec<_>) = self.lamps.iter().partition(|source| source.lamp.is_sky());
        let mut all = Vec::new();
        for lamps in [suns, skies] {
            for (response, state) in self.states.iter().enumerate() {
                for Source { lamp, camera, factors } in &lamps {
                    let lit = Lit { response, light: lamp.on(&state.fold, light)?, camera };
                    all.push((lit, state.factors.iter().chain(factors).copied().collect()));
                }
            }
        }
        Ok(all)
    }
}
