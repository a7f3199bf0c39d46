//! Where, when and in which light a picture was taken.

/// What a camera wrote about the light of a picture.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Taken {
    /// Latitude, north being positive, and longitude, east being positive, degrees.
    pub place_deg: Option<[f64; 2]>,
    /// Date, time and its difference from UTC: `2026-06-21T14:30:00+02:00`.
    pub time: Option<String>,
    /// Date and time by the camera's clock, wherever that was set: `2026-06-21T14:30:00`.
    pub clock: Option<String>,
    /// The light that the camera was set to or had itself, if it is not the sun's.
    pub other_light: Option<OtherLight>,
}

/// A light that is not the sun's, as cameras name it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OtherLight {
    /// A flash that fired, or that the camera was set to.
    Flash,
    /// Fluorescent lamps.
    FluorescentLamps,
    /// Incandescent ones.
    LightBulbs,
    /// Daylight from clouds.
    Clouds,
    /// Daylight from a sky whose sun is hidden.
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

    /// Whether it is daylight all the same.
    #[must_use]
    pub fn is_daylight(self) -> bool {
        matches!(self, Self::Clouds | Self::Shade)
    }
}
