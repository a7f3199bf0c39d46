//! What is fitted along with a spectrum, by name.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::estimate::unknowns::Quantity;

/// Something of each number of a scene that was fitted; what was not is absent.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub(super) struct Quantities<T> {
    /// Exposure: value of a perfect white diffuser that faces the sun, in its strongest channel.
    #[serde(skip_serializing_if = "Option::is_none")]
    exposure: Option<T>,
    /// Angle between the panels, degrees.
    #[serde(skip_serializing_if = "Option::is_none")]
    angle_deg: Option<T>,
    /// Angle of the sun off the plane that halves the fold, degrees.
    #[serde(skip_serializing_if = "Option::is_none")]
    tilt_deg: Option<T>,
    /// Irradiance by the sky of an open plane that faces the sun, relative to the sun's.
    #[serde(skip_serializing_if = "Option::is_none")]
    sky: Option<T>,
    /// Correlated colour temperature of the sky, K.
    #[serde(skip_serializing_if = "Option::is_none")]
    sky_cct_k: Option<T>,
}

impl<T> Quantities<T> {
    /// Those of a list; none if it is empty.
    pub(super) fn of(list: impl IntoIterator<Item = (Quantity, T)>) -> Option<Self> {
        let mut list = list.into_iter().peekable();
        list.peek()?;
        let mut all = Self { exposure: None, angle_deg: None, tilt_deg: None, sky: None, sky_cct_k: None };
        for (quantity, one) in list {
            *all.place(quantity) = Some(one);
        }
        Some(all)
    }

    fn place(&mut self, quantity: Quantity) -> &mut Option<T> {
        match quantity {
            Quantity::Exposure => &mut self.exposure,
            Quantity::AngleDeg => &mut self.angle_deg,
            Quantity::TiltDeg => &mut self.tilt_deg,
            Quantity::Sky => &mut self.sky,
            Quantity::SkyCctK => &mut self.sky_cct_k,
        }
    }

    /// Those that are there.
    pub(super) fn iter(&self) -> impl Iterator<Item = (Quantity, &T)> {
        let all = [
            (Quantity::Exposure, &self.exposure),
            (Quantity::AngleDeg, &self.angle_deg),
            (Quantity::TiltDeg, &self.tilt_deg),
            (Quantity::Sky, &self.sky),
            (Quantity::SkyCctK, &self.sky_cct_k),
        ];
        all.into_iter().filter_map(|(quantity, one)| Some((quantity, one.as_ref()?)))
    }
}
