//! Place, time and light of a picture.

/// The camera's notes on the light of a picture.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Taken {
    /// Latitude, north being positive, and longitude, east being positive, degrees.
    pub place_deg: Option<[f64; 2]>,
    /// Date, time and offset from UTC: `2026-06-21T14:30:00+02:00`.
    pub time: Option<String>,
    /// Date and time by the camera's clock, whatever its time zone: `2026-06-21T14:30:00`.
    pub clock: Option<String>,
    /// The light that the camera was set to or fired, if other than the sun.
    pub other_light: Option<OtherLight>,
}

/// A light other than the sun, as cameras name it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OtherLight {
    /// A flash that fired, or the setting for one.
    Flash,
    /// Fluorescent lamps.
    FluorescentLamps,
    /// Incandescent lamps.
    LightBulbs,
    /// Daylight from clouds.
    Clouds,
    /// Daylight from the sky with the sun hidden.
    Shade,
}

impl OtherLight {
    /// In a word or two.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Flash => "flash",
            Self::FluorescentLamps => "fluorescent lamps",
            Self::LightBulbs => "light bulbs",
            Self::Clouds => "clouds",
            Self::Shade => "shade",
        }
    }

    /// Whether it is nevertheless daylight.
    #[must_use]
    pub fn is_daylight(self) -> bool {
        matches!(self, Self::Clouds | Self::Shade)
    }
}
