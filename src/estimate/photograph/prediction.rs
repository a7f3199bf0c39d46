//! Facets predicted from a spectrum and conditions.

use std::borrow::Cow;
use std::iter;

use nalgebra::{DMatrix, DVector};

use super::conditions::Conditions;
use super::fold_changes::departed;
use super::lens::Lens;
use super::lighting::Lighting;
use super::parts::{Ambient, Parts, Radiance, Surroundings};
use super::sheets::Departure;
use crate::estimate::unknowns::Whose;
use crate::solve::dense::{add_product, product};

/// Values of the terms for a spectrum of albedo: functions of albedo that are 1 at one node and 0 at the
/// others.
#[derive(Clone, Debug)]
pub struct Terms {
    /// Node by waveband.
    pub values: DMatrix<f64>,
    /// Their derivatives by albedo, node by waveband.
    pub slopes: DMatrix<f64>,
}

/// Light on the facets, and its effect in the channels.
pub struct Light<'a> {
    /// Facet by node.
    pub radiance: Cow<'a, Radiance>,
    /// By waveband.
    pub power: DVector<f64>,
    /// Waveband by channel.
    pub weights: DMatrix<f64>,
    /// Effect of the radiance at the nodes in the channels: node by channel.
    pub to_channels: DMatrix<f64>,
}

/// Predicted facets with their ingredients.
pub struct Predicted<'a> {
    /// Facet by channel.
    pub values: DMatrix<f64>,
    /// Values before the lens: facet by channel.
    radiances: DMatrix<f64>,
    /// The lens.
    pub lens: Lens,
    lighting: Lighting,
    conditions: Conditions,
    /// That of the sun comes first, those of sky and ground next if it is daylight.
    pub lights: Vec<Light<'a>>,
}

/// Predicts the facets of a photograph, given the terms of a spectrum and sensitivities: waveband by channel.
pub struct Predictor<'a, 'b> {
    /// Ingredients of the photograph.
    pub parts: &'a Parts,
    /// Terms of the spectrum.
    pub terms: &'b Terms,
    /// Sensitivities of the camera.
    pub sensitivities: &'b DMatrix<f64>,
}

impl Predicted<'_> {
    /// Values in the same light with these terms instead, node by waveband: facet by channel.
    pub fn with_terms(&self, terms: &DMatrix<f64>) -> DMatrix<f64> {
        let mut radiances = DMatrix::zeros(self.radiances.nrows(), self.radiances.ncols());
        for light in &self.lights {
            add_product(&mut radiances, &light.radiance, &product(terms, &light.weights));
        }
        self.lens.seen(radiances)
    }
}

impl<'a> Predictor<'a, '_> {
    /// The facets of a sheet that departs from a Lambertian one by `beyond`.
    pub fn facets(&self, conditions: &Conditions, beyond: &Departure) -> Predicted<'a> {
        let sunlit = Cow::Owned(sunlit(self.parts, conditions, beyond));
        self.in_light(conditions, sunlit, self.surroundings(conditions))
    }

    /// Values of the facets near `here`, under conditions that differ only in the part named by `whose`; the
    /// other parts are not recomputed.
    pub fn shifted(
        &self,
        here: &Predicted<'a>,
        conditions: &Conditions,
        beyond: &Departure,
        whose: Whose,
    ) -> DMatrix<f64> {
        let sun = &here.lights[0];
        match whose {
            Whose::Sheet | Whose::Fold => {
                let mut radiances = here.radiances.clone();
                let more = sunlit(self.parts, conditions, beyond) - sun.radiance.as_ref();
                add_product(&mut radiances, &more, &sun.to_channels);
                here.lens.seen(radiances)
            }
            Whose::Light if conditions.distribute_alike(&here.conditions) => {
                let lighting = Lighting::new(self.parts, conditions);
                let mut radiances = here.radiances.clone();
                for (light, power) in here.lights.iter().zip(self.powers(&lighting, conditions)) {
                    if power != light.power {
                        let more = self.to_channels(&self.weights(&power)) - &light.to_channels;
                        add_product(&mut radiances, &light.radiance, &more);
                    }
                }
                Lens::new(self.parts, conditions, &lighting).seen(radiances)
            }
            Whose::Light => {
                // the radiance includes the sun's amount
                let sunlit = Cow::Borrowed(sun.radiance.as_ref());
                self.in_light(conditions, sunlit, self.surroundings(conditions)).values
            }
            Whose::Scene => self.facets(conditions, beyond).values,
            Whose::Lens => Lens::new(self.parts, conditions, &here.lighting).seen(here.radiances.clone()),
        }
    }

    /// Values of the facets in the light of `here`, under the same conditions, as this camera sees them.
    pub fn seen(&self, here: &Predicted) -> DMatrix<f64> {
        let lighting = Lighting::new(self.parts, &here.conditions);
        let mut radiances = DMatrix::zeros(here.radiances.nrows(), self.sensitivities.ncols());
        for (light, power) in here.lights.iter().zip(self.powers(&lighting, &here.conditions)) {
            add_product(&mut radiances, &light.radiance, &self.to_channels(&self.weights(&power)));
        }
        Lens::new(self.parts, &here.conditions, &lighting).seen(radiances)
    }

    /// Light of the sky and of the ground on the facets, for an amount of 1; `None` if it is no daylight.
    fn surroundings<'l>(&self, conditions: &Conditions) -> Option<[Cow<'l, Radiance>; 2]> {
        let Parts { stated, surroundings, .. } = self.parts;
        stated.daylight.is_some().then(|| {
            let Surroundings { clear, overcast, ground } = surroundings.as_ref();
            let of = |all: &[(&Ambient, f64)]| Cow::Owned(ambient(conditions, all, stated.angle_deg));
            [of(&[(clear, 1.0 - conditions.cloud), (overcast, conditions.cloud)]), of(&[(ground, 1.0)])]
        })
    }

    /// Power of every light: of the sun, of sky and ground in daylight, and of a uniform sky if there is one.
    fn powers(&self, lighting: &Lighting, conditions: &Conditions) -> Vec<DVector<f64>> {
        let is_daylight = self.parts.stated.daylight.is_some();
        let ambient = lighting.ambient.iter().filter(|_| is_daylight).map(|(amount, power)| *amount * power);
        let even_sky = (conditions.even_sky > 0.0).then(|| conditions.even_sky * &lighting.ambient[0].1);
        iter::once(lighting.sun.clone()).chain(ambient).chain(even_sky).collect()
    }

    /// Sensitivities to light of this power: waveband by channel.
    fn weights(&self, power: &DVector<f64>) -> DMatrix<f64> {
        let mut weights = self.sensitivities.clone();
        weights.column_iter_mut().for_each(|mut channel| channel.component_mul_assign(power));
        weights
    }

    /// Effect of the radiance at the nodes in the channels: node by channel.
    fn to_channels(&self, weights: &DMatrix<f64>) -> DMatrix<f64> {
        product(&self.terms.values, weights)
    }

    fn in_light<'l>(
        &self,
        conditions: &Conditions,
        sunlit: Cow<'l, Radiance>,
        surroundings: Option<[Cow<'l, Radiance>; 2]>,
    ) -> Predicted<'l>
    where
        'a: 'l,
    {
        let Self { parts, sensitivities, .. } = self;
        let lighting = Lighting::new(parts, conditions);
        let light = |(radiance, power): (Cow<'l, Radiance>, DVector<f64>)| {
            let weights = self.weights(&power);
            let to_channels = self.to_channels(&weights);
            Light { radiance, power, weights, to_channels }
        };
        let even_sky = Cow::Borrowed(&parts.even_sky);
        let radiances = iter::once(sunlit).chain(surroundings.into_iter().flatten()).chain([even_sky]);
        let lights: Vec<_> = radiances.zip(self.powers(&lighting, conditions)).map(light).collect();
        let lens = Lens::new(parts, conditions, &lighting);
        let mut radiances = DMatrix::zeros(parts.places.len(), sensitivities.ncols());
        for light in &lights {
            add_product(&mut radiances, &light.radiance, &light.to_channels);
        }
        let values = lens.seen(radiances.clone());
        Predicted { values, radiances, lens, lighting, conditions: conditions.clone(), lights }
    }
}

/// Sunlight on the facets, for a sheet that departs from a Lambertian one by `beyond`.
fn sunlit(parts: &Parts, conditions: &Conditions, beyond: &Departure) -> Radiance {
    let (sun, stated) = (&parts.sun, &parts.stated);
    let (sin, cos) = conditions.tilt_deg.to_radians().sin_cos();
    let mut radiance = cos * &sun.even + sin * &sun.odd;
    sun.angle_deg.add_to(&mut radiance, 1.0, conditions.angle_deg - stated.angle_deg);
    sun.crease_radius.add_to(&mut radiance, 1.0, conditions.crease_radius);
    sun.bow_deg.add_to(&mut radiance, 1.0, conditions.bow_deg);
    sun.bow_difference_deg.add_to(&mut radiance, 1.0, conditions.bow_difference_deg);
    sun.nearness.add_to(&mut radiance, 1.0, conditions.nearness);
    conditions.sun * (radiance + departed(parts, conditions, beyond))
}

/// The sum of these lights on the facets, in these amounts.
fn ambient(conditions: &Conditions, all: &[(&Ambient, f64)], stated_deg: f64) -> Radiance {
    let mut sum = Radiance::zeros(all[0].0.by_angle.nrows(), all[0].0.by_angle.ncols());
    for (light, amount) in all {
        light.add_to(&mut sum, *amount, conditions, stated_deg);
    }
    sum
}
