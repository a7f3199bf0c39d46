//! What pictures say of place, time and light, as EXIF has it; the two readers of EXIF give the parts.

/// Degrees from degrees, minutes and seconds, below zero on the `negative` side; none if that is no place.
pub(super) fn degrees([degrees, minutes, seconds]: [f64; 3], side: &str, negative: &str) -> Option<f64> {
    let degrees = degrees + minutes / 60.0 + seconds / 3600.0;
    let degrees = if side.trim().eq_ignore_ascii_case(negative) { -degrees } else { degrees };
    (degrees.abs() <= 180.0).then_some(degrees)
}

/// A time of UTC, from its date (`2026:06:21`), hours, minutes and seconds.
pub(super) fn universal(date: &str, time: [f64; 3]) -> String {
    let [hour, minute, second] = time.map(|part| part.floor() as u64);
    format!("{}T{hour:02}:{minute:02}:{second:02}Z", date.trim().replace(':', "-"))
}

/// The light that is not the sun's, by the flash and the number that EXIF has for lights.
pub(super) fn other_light(has_fired: bool, source: Option<u32>) -> Option<&'static str> {
    match source {
        _ if has_fired => Some("flash"),
        Some(2 | 12..=16) => Some("fluorescent lamps"),
        Some(3 | 17 | 24) => Some("light bulbs"),
        Some(4) => Some("flash"),
        Some(10) => Some("clouds"),
        Some(11) => Some("shade"),
        _ => None,
    }
}
