//! Where, when and in which light a picture was taken.

/// What a camera wrote about the light of a picture.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Taken {
    /// Latitude, north being positive, and longitude, east being positive, degrees.
    pub place_deg: Option<[f64; 2]>,
    /// Date, time and its difference from UTC: `2026-06-21T14:30:00+02:00`.
    pub time: Option<String>,
    /// The light that the camera was set to or had itself, if it is not the sun's.
    pub other_light: Option<&'static str>,
}
