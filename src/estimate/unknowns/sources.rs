//! A fold in its light, as sources that unknowns modify.

use nalgebra::{DMatrix, DVector};

use super::Factor;
use crate::camera::CameraResponse;
use crate::error::Result;
use crate::estimate::photograph::StatedScene;
use crate::forward::{Card, Lighting, Lit};
use crate::geometry::{Fold, Light};
use crate::response::{ModeLight, Response};
use crate::spectrum::WavelengthGrid;

/// A fold in its light, as far as it is known.
pub struct FoldInLight {
    /// The fold.
    pub fold: Fold,
    /// Its response to light, all bounces included.
    pub response: Response,
    /// Relative error permitted for facet means, if the mesh follows from it; `None` if the mesh was given.
    pub tolerance: Option<f64>,
    /// Sun and sky in terms of the camera's response.
    pub lighting: Lighting,
    /// Relative power of the sun, one value per waveband.
    pub sun_power: DVector<f64>,
    /// Mean daylight and its two characteristic vectors: waveband by three.
    pub daylight_vectors: DMatrix<f64>,
    /// Everything stated about it.
    pub stated: StatedScene,
    /// The card in place of a panel, if there is one.
    pub card: Option<Card>,
    /// Wavelengths.
    pub grid: WavelengthGrid,
    /// Sensitivities of the camera, `[channel][waveband]`.
    pub sensitivities: Vec<Vec<f64>>,
}

/// Dependence of a source's amount on some unknowns, by name; it is independent of the others.
pub type Factors = Vec<(&'static str, Factor)>;

/// A light, on any fold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lamp {
    /// The sun at its position.
    Sun,
    /// The part of sunlight that both panels receive alike, for a sun on the bisecting plane.
    EvenSun,
    /// Sunlight that panel 0 gains and panel 1 loses per unit of the sine of the sun's tilt.
    OddSun,
    /// A uniform sky.
    Sky {
        /// Irradiance of an open plane, relative to the sun's.
        irradiance: f64,
    },
}

impl Lamp {
    /// The light on `fold`, with the sun positioned as in `light`.
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

/// A lamp as seen by the camera, with the dependences of its amount.
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

    /// The same with its amount multiplied by this `factor` of the `unknown` with that name.
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

    /// The same in three colours, given the camera's response to each at `nodes` of the `unknown` with that
    /// name: those in between are interpolated.
    #[must_use]
    pub fn in_colours(
        &self,
        unknown: &'static str,
        nodes: [f64; 3],
        cameras: &[CameraResponse],
    ) -> Vec<Self> {
        let of = |(at, camera): (usize, &CameraResponse)| {
            let coloured = Self { camera: camera.clone(), ..self.clone() };
            coloured.with(unknown, Factor::Node { nodes, at })
        };
        cameras.iter().enumerate().map(of).collect()
    }
}

/// A solved fold that may be that of the scene.
pub struct State {
    /// The fold.
    pub fold: Fold,
    /// Its response.
    pub response: Response,
    /// Dependences of the amount of its light.
    pub factors: Factors,
}

/// All terms of the facets' sum: every lamp on every state of the fold.
pub struct Sources {
    /// Folds among which, or between which, the scene's lies.
    pub states: Vec<State>,
    lamps: Vec<Source>,
}

impl Sources {
    /// Sources without unknowns.
    pub(super) fn of(scene: &FoldInLight) -> Self {
        let FoldInLight { fold, response, lighting, .. } = scene;
        let state = State { fold: *fold, response: response.clone(), factors: Vec::new() };
        let sun = Source::new(Lamp::Sun, lighting.sun.clone());
        let irradiance = lighting.light.sky();
        let sky = Source::new(Lamp::Sky { irradiance }, lighting.sky.clone());
        let (sun, sky) = ((lighting.light.sun() > 0.0).then_some(sun), (irradiance > 0.0).then_some(sky));
        Self { states: vec![state], lamps: sun.into_iter().chain(sky).collect() }
    }

    /// Replaces each lamp by others.
    pub fn replace(&mut self, by: impl Fn(Source) -> Vec<Source>) {
        self.lamps = std::mem::take(&mut self.lamps).into_iter().flat_map(by).collect();
    }

    /// Adds a lamp.
    pub fn add(&mut self, lamp: Source) {
        self.lamps.push(lamp);
    }

    /// The lamps on the states, suns before skies, with all dependences of their amounts.
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
