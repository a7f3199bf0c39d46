//! Ingredients of the facets of a photograph: the fold of the scene, the camera at the position given by the
//! corners, and all effects of real sheets and light.

mod ambient;
mod bends;
mod bins;
pub(super) mod eye;
mod framing;
mod reflections;
mod sheets;

use std::sync::Arc;

use bends::{BOWS_DEG, Bends, Bent};
use bins::Bins;
use framing::Pose;
use nalgebra::{Vector2, Vector3};
use ndarray::Array2;

use super::{FoldSetting, StatedSky, metered};
use crate::error::Result;
use crate::estimate::measured::{Measured, check_shape};
use crate::estimate::photograph::chebyshev::nodes;
use crate::estimate::photograph::conditions::Daylight;
use crate::estimate::photograph::parts::{Change, Parts, Radiance, Sunlit, Surroundings};
use crate::estimate::photograph::priors::Priors;
use crate::estimate::photograph::{StatedScene, Unmodelled};
use crate::estimate::unknowns::Normal;
use crate::forward::render::{FoldView, Frame, Viewpoint};
use crate::image::Framing;
use crate::kernel::bent::{BentExchange, BentFold};
use crate::response::ModeLight;
use crate::stream::Sample;

/// Sizes at which changes of the fold are tabulated: additional degrees between the panels, as large as
/// plausible errors, but at most a share of the angle.
const ANGLES_DEG: [f64; 4] = [-6.0, -2.0, 2.0, 6.0];
const ANGLE_MOST: f64 = 0.3;
/// Panel depth divided by the distance of a lamp.
const NEARNESSES: [f64; 2] = [0.08, 0.25];

/// Width and height of a photograph yet to be taken, px.
const SIZE: [usize; 2] = [640, 480];

/// The data of a photograph from which its parts are computed.
pub struct Picture<'a> {
    /// The facets.
    pub measured: &'a Measured<'a>,
    /// Position of the panels in it; `None` if it does not show two.
    pub framing: Option<Framing>,
    /// The exposure, if it is known.
    pub exposure: Option<f64>,
    /// True if its values were calibrated by a chart or a card.
    pub by_chart: bool,
    /// Value of a perfect white diffuser under 1000 lx, from the camera's settings, if they are known.
    pub white_per_klx: Option<f64>,
    /// The exposure shown by white paper and its standard deviation, if there is any.
    pub by_paper: Option<[f64; 2]>,
}

impl<'a> Picture<'a> {
    /// The photograph in which the facets of a sample were measured.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if the photograph's record is invalid.
    pub fn of(sample: &Sample, measured: &'a Measured<'a>, exposure: Option<f64>) -> Result<Self> {
        let by_chart = sample.chart_residual()?.is_some();
        let white_per_klx = sample.white_per_klx()?;
        let by_paper = sample.white_paper()?.map(|paper| [paper.exposure, paper.exposure_sd]);
        Ok(Self { measured, framing: sample.framing()?, exposure, by_chart, white_per_klx, by_paper })
    }
}

/// A fold that is photographed.
pub struct PhotographedFold<'a> {
    setting: &'a FoldSetting,
    nodes: Vec<f64>,
    priors: &'static Priors,
    /// Name of a measured sheet that is treated as unknown.
    left_out: Option<String>,
}

impl<'a> PhotographedFold<'a> {
    /// From a scene.
    #[must_use]
    pub fn of(setting: &'a FoldSetting) -> Self {
        Self { setting, nodes: nodes(), priors: &Priors::USUAL, left_out: None }
    }

    /// The same with one of the [measured sheets](crate::sheet::measured_names) treated as unknown, to test
    /// sheets that nobody measured.
    #[must_use]
    pub fn leaving_out(self, sheet: &str) -> Self {
        Self { left_out: Some(sheet.to_owned()), ..self }
    }

    /// The same under other priors, to test their effect.
    #[must_use]
    pub fn believing(self, priors: &'static Priors) -> Self {
        Self { priors, ..self }
    }

    /// The parts of a photograph with measured facets, or the reason why there are none.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if facets or corners do not fit the scene.
    pub fn parts(&self, picture: &Picture) -> Result<std::result::Result<Parts, Unmodelled>> {
        match self.setting.unmodelled()? {
            Some(why) => Ok(Err(why)),
            None => self.of_picture(picture),
        }
    }

    /// The parts of a photograph yet to be taken, from the viewpoint that vforward uses and with the facets
    /// of the model; or the reason why there are none.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if facets do not fit the scene, [`crate::Error::Usage`] if the fold is not
    /// visible.
    pub fn planned(
        &self,
        measured: &Measured,
        exposure: Option<f64>,
    ) -> Result<std::result::Result<Parts, Unmodelled>> {
        let frame = Frame::new(SIZE[0], SIZE[1])?;
        let mut panels = [None; 2];
        for (panel, corners) in FoldView::new(&self.setting.fold, &Viewpoint::default(), frame)?.corners() {
            panels[panel] = Some(corners);
        }
        let framing = Some(Framing { panels, size: SIZE.map(|px| px as f64), margin_px: 0.0 });
        let by_paper = None;
        self.parts(&Picture { measured, framing, exposure, by_chart: false, white_per_klx: None, by_paper })
    }

    fn of_picture(&self, picture: &Picture) -> Result<std::result::Result<Parts, Unmodelled>> {
        let FoldSetting { fold, light, .. } = self.setting;
        let Picture { measured, exposure, by_chart, white_per_klx, by_paper, .. } = *picture;
        let pose = picture.framing.as_ref().map(|framing| Pose::of(framing, fold)).transpose()?.flatten();
        let Some(pose) = pose else { return Ok(Err(Unmodelled::NoPose)) };
        let (optics, facets) = (self.setting.optics()?, fold.facets());
        let eye = eye::of(optics, self.priors)?;
        let shape = [2 * facets.len(), eye.sensitivities.ncols()];
        check_shape("facet_rgb", measured.rgb, shape)?;
        check_shape("facet_sd", measured.sd, shape)?;
        let bins = Bins::new(fold, measured, &pose);
        let Some(values) = bins.values() else { return Ok(Err(Unmodelled::NoFacets)) };
        let sun = light.towards();
        let daylight = Daylight::of(&eye.daylight, &eye.sun);
        let stated = StatedScene {
            exposure,
            metered: white_per_klx
                .zip(optics.illuminants.first())
                .and_then(|(white, light)| metered::in_the_sun(white, &light.name, self.priors)),
            by_paper: by_paper.map(|[exposure, sd]| Normal {
                mean: exposure.ln(),
                sd: (sd / exposure).hypot(self.priors.exposure_shown_sd),
            }),
            by_chart: by_chart && exposure.is_some(),
            // what surrounds a photograph in a lamp's light is not modelled
            has_sky_illuminant: daylight.is_some() && optics.sky.is_some(),
            ..self.setting.stated(self.priors, values.ncols(), daylight)
        };
        let bends = Bends::of(fold, pose.view());
        let left_out = self.left_out.as_deref();
        let sheets = || sheets::of((fold, &bends), [sun, pose.eye], (&self.nodes, &bins), left_out);
        let (light, sheets) = rayon::join(|| self.light(&pose, &bends, &bins), sheets);
        let (even_sky, lit, surroundings) = light?;
        Ok(Ok(Parts {
            stated,
            places: bins.places().to_vec(),
            sd: bins.sd().clone(),
            values: values.clone(),
            sun: Arc::new(lit),
            even_sky,
            surroundings: Arc::new(surroundings),
            sheets: Arc::new(sheets?),
            eye,
        }))
    }

    /// Uniform light, sunlight, and light of the surroundings.
    fn light(&self, pose: &Pose, bends: &Bends, bins: &Bins) -> Result<(Radiance, Sunlit, Surroundings)> {
        let FoldSetting { fold, light, sky, .. } = self.setting;
        let sun = light.towards();
        let lit = self.sunlit(bins, bends, sun)?;
        let even = self.exact(ModeLight::Sky(1.0));
        let zenith = sky.filter(StatedSky::is_zenith_stated).map(|sky| sky.zenith);
        let surroundings = ambient::of(fold, (pose, sun, zenith), (&self.nodes, &even), (bends, bins))?;
        Ok((bins.pool(&even), lit, surroundings))
    }

    fn sunlit(&self, bins: &Bins, bends: &Bends, sun: Vector3<f64>) -> Result<Sunlit> {
        let FoldSetting { fold, light, .. } = self.setting;
        let [even, odd] = light.even_and_odd(fold);
        let angle_deg = fold.angle_deg();
        let ideal = bends.ideal.facet_radiance(sun, &self.nodes)?;
        let effect = |bent: &BentExchange| -> Result<Radiance> {
            Ok(bins.pool(&(bent.facet_radiance(sun, &self.nodes)? - &ideal)))
        };
        let of_known = |all: &[Bent]| -> Result<Change> {
            let of = |(size, bent): &Bent| Ok((*size, effect(bent)?));
            Ok(Change { known: all.iter().map(of).collect::<Result<_>>()? })
        };
        let change = |sizes: &[f64], bend: &dyn Fn(f64) -> BentFold| -> Result<Change> {
            let of = |size: &f64| Ok((*size, effect(&BentExchange::new(&bend(*size), fold, bends.view))?));
            Ok(Change { known: sizes.iter().map(of).collect::<Result<_>>()? })
        };
        let flat = BentFold::ideal(angle_deg);
        let part = (ANGLE_MOST * angle_deg.min(180.0 - angle_deg) / ANGLES_DEG[3]).min(1.0);
        Ok(Sunlit {
            even: bins.pool(&self.exact(ModeLight::Sun([even, even]))),
            odd: bins.pool(&self.exact(ModeLight::Sun([odd, -odd]))),
            angle_deg: change(&ANGLES_DEG.map(|size| part * size), &|more| {
                BentFold::ideal(angle_deg + more)
            })?,
            crease_radius: of_known(&bends.rounded)?,
            bow_deg: of_known(&bends.bowed)?,
            bow_difference_deg: change(&BOWS_DEG, &|bow| BentFold { bow_deg: [bow, -bow], ..flat })?,
            nearness: Change { known: self.near(bins, &bends.ideal, sun, &ideal)? },
        })
    }

    /// The effect of a lamp in place of the sun.
    fn near(
        &self,
        bins: &Bins,
        exchange: &BentExchange,
        sun: Vector3<f64>,
        ideal: &Array2<f64>,
    ) -> Result<Vec<(f64, Radiance)>> {
        let fold = &self.setting.fold;
        let [depth, _] = fold.depths();
        let middle = Vector2::new(0.0, 0.5 * depth * (0.5 * fold.angle_rad()).cos());
        let of = |nearness: f64| {
            let lit = exchange.radiance_by_lamp(sun, (middle, depth / nearness), &self.nodes)?;
            Ok((nearness, bins.pool(&(lit - ideal))))
        };
        NEARNESSES.into_iter().map(of).collect()
    }

    /// Exact radiance of the ideal fold: facet by node.
    fn exact(&self, light: ModeLight) -> Array2<f64> {
        let response = &self.setting.response;
        let facets = response.facets();
        Array2::from_shape_fn((2 * facets, self.nodes.len()), |(facet, node)| {
            let albedo = self.nodes[node];
            albedo * response.irradiance(facet / facets, facet % facets, light, [albedo, albedo])
        })
    }
}
