//! The light on a sheet (sun, sky and ground), and its effect on a white chart.

use nalgebra::DVector;

use super::conditions::{Conditions, Daylight};
use super::parts::{Parts, Surroundings, shares_at};

/// Sun, sky and ground in terms of the channels.
pub struct Lighting {
    /// Power of the sun, normalised to 1 in the reference channel.
    pub sun: DVector<f64>,
    /// Power of the sky and of the ground, each with the irradiance of an open plane facing it: the former
    /// for irradiance 1 from the sky in the reference channel, the latter for ground of reflectance 1.
    pub ambient: [(f64, DVector<f64>); 2],
    /// Light received by a white sheet facing the sun, channel by channel, relative to the stated sun; `None`
    /// if the exposure refers to the sun alone, which it does where the sun shines and no chart is used.
    white: Option<DVector<f64>>,
}

impl Lighting {
    /// For a photograph taken under these conditions.
    #[must_use]
    pub fn new(parts: &Parts, conditions: &Conditions) -> Self {
        let [sun, sky, ground] = powers(parts, conditions);
        let sky_amount = conditions.sky.max(0.0);
        let Surroundings { clear, overcast, ground: below } = parts.surroundings.as_ref();
        let shares = shares_at(conditions.elevation_deg);
        let sun_height = conditions.elevation_deg.clamp(0.0, 90.0).to_radians().sin();
        let ground_amount = conditions.ground * (sun_height * conditions.sun + sky_amount);
        let is_sun_alone = conditions.day.has_sun() && !parts.stated.is_exposure_of_all_light();
        let white = (!is_sun_alone).then(|| {
            let sensitivities = &parts.eye.sensitivities;
            let nominal = sensitivities.tr_mul(&parts.eye.sun);
            let of_sky = (1.0 - conditions.cloud) * clear.open_at(shares)
                + conditions.cloud * overcast.open_at(shares);
            let light = conditions.sun * &sun
                + (sky_amount * of_sky + conditions.even_sky) * &sky
                + ground_amount * below.open_at(shares) * &ground;
            sensitivities.tr_mul(&light).component_div(&nominal) * nominal[parts.eye.reference]
        });
        Self { sun, ambient: [(sky_amount, sky), (ground_amount, ground)], white }
    }

    /// The exposure: value of a perfect white diffuser facing the sun, in the sun alone.
    #[must_use]
    pub fn exposure(&self, parts: &Parts, conditions: &Conditions) -> f64 {
        conditions.exposure / self.white.as_ref().map_or(1.0, |white| white[parts.eye.reference])
    }

    /// Gains of the channels: in the actual light, a chart adjusts them to those of the stated light.
    #[must_use]
    pub fn gains(&self, parts: &Parts, conditions: &Conditions) -> DVector<f64> {
        let Parts { eye, .. } = parts;
        let mut gains = match &self.white {
            Some(white) if parts.stated.by_chart => white.map(|value| white[eye.reference] / value),
            _ => DVector::from_element(eye.sensitivities.ncols(), 1.0),
        };
        if let [first, _, last] = gains.as_mut_slice() {
            *first *= conditions.gains[0];
            *last *= conditions.gains[1];
        }
        gains
    }
}

fn powers(parts: &Parts, conditions: &Conditions) -> [DVector<f64>; 3] {
    let eye = &parts.eye;
    let daylight = |mired: f64| Daylight::power(&eye.daylight, mired);
    let sun = match conditions.sun_mired.zip(parts.stated.daylight) {
        Some((mired, nominal)) => {
            eye.sun.component_mul(&daylight(mired).component_div(&daylight(nominal.mired)))
        }
        None => eye.sun.clone(),
    };
    let sky = conditions.sky_mired.map_or_else(|| eye.sky.clone(), daylight);
    let reference = eye.sensitivities.column(eye.reference);
    let [sun, sky] = [sun, sky].map(|power| &power / reference.dot(&power));
    let redness = |nm: &f64| (1.0 + conditions.ground_redness * (nm - 550.0) / 150.0).max(0.0);
    let ground = sun.as_slice().iter().zip(&eye.wavelengths_nm).map(|(power, nm)| power * redness(nm));
    let ground = DVector::from_iterator(sun.len(), ground);
    [sun, sky, ground]
}
