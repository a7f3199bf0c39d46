//! Place, time and light of pictures from the fields that the two readers of EXIF return.

use crate::image::photograph::OtherLight;

/// Degrees, minutes and seconds, and the hemisphere.
pub(super) type Angle<'a> = ([f64; 3], &'a str);

/// Latitude and longitude, degrees, negative south and west. None if they are out of range, or both zero:
/// without a fix, or wiped.
pub(super) fn place_deg(latitude: Angle, longitude: Angle) -> Option<[f64; 2]> {
    let place = [degrees(latitude, ['N', 'S'], 90.0)?, degrees(longitude, ['E', 'W'], 180.0)?];
    place.iter().any(|degrees| degrees.abs() > 0.0).then_some(place)
}

/// The hemisphere may be a letter or a word, such as `South`.
fn degrees(([degrees, minutes, seconds], side): Angle, [above, below]: [char; 2], most: f64) -> Option<f64> {
    let degrees = degrees + minutes / 60.0 + seconds / 3600.0;
    let side = side.trim().chars().next()?.to_ascii_uppercase();
    let degrees = match side {
        _ if side == above => degrees,
        _ if side == below => -degrees,
        _ => return None,
    };
    (degrees.abs() <= most).then_some(degrees)
}

/// A time with its offset from UTC, from `2026:06:21 14:30:00` and `+02:00`; none if either is blank or
/// invalid.
pub(super) fn local(date_and_time: &str, offset: &str) -> Option<String> {
    let offset = offset.trim();
    let is_offset = match offset.as_bytes() {
        b"Z" => true,
        [b'+' | b'-', a, b, b':', c, d] => [a, b, c, d].into_iter().all(u8::is_ascii_digit),
        _ => false,
    };
    let at = by_clock(date_and_time)?;
    is_offset.then(|| at + offset)
}

/// A time by the clock, from `2026:06:21 14:30:00`; none if it is blank or invalid.
pub(super) fn by_clock(date_and_time: &str) -> Option<String> {
    let (date, time) = date_and_time.trim().split_once(' ')?;
    let time: Vec<f64> = time.trim().split(':').map(|part| part.parse().ok()).collect::<Option<_>>()?;
    moment(date, time.try_into().ok()?)
}

/// A time in UTC, from its date (`2026:06:21`), hours, minutes and seconds; none if they are invalid.
pub(super) fn universal(date: &str, time: [f64; 3]) -> Option<String> {
    moment(date, time).map(|at| at + "Z")
}

fn moment(date: &str, [hour, minute, second]: [f64; 3]) -> Option<String> {
    let date: Vec<u32> =
        date.trim().split([':', '-']).map(|part| part.parse().ok()).collect::<Option<_>>()?;
    let [year @ 1..=9999, month @ 1..=12, day @ 1..=31] = date[..] else { return None };
    let is_time =
        (0.0..24.0).contains(&hour) && (0.0..60.0).contains(&minute) && (0.0..61.0).contains(&second);
    let [hour, minute, second] = [hour, minute, second].map(|part| part.floor() as u32);
    let second = second.min(59);
    is_time.then(|| format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}"))
}

/// A light other than the sun, from the flash and EXIF's number of the light source.
pub(super) fn other_light(has_fired: bool, source: Option<u32>) -> Option<OtherLight> {
    match source {
        _ if has_fired => Some(OtherLight::Flash),
        Some(2 | 12..=16) => Some(OtherLight::FluorescentLamps),
        Some(3 | 17 | 24) => Some(OtherLight::LightBulbs),
        Some(4) => Some(OtherLight::Flash),
        Some(10) => Some(OtherLight::Clouds),
        Some(11) => Some(OtherLight::Shade),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_have_sides_and_are_not_nowhere() {
        let of = |latitude, south, longitude, west| {
            place_deg(([latitude, 30.0, 0.0], south), ([longitude, 0.0, 36.0], west))
        };
        assert_eq!(of(48.0, "N", 11.0, "E"), Some([48.5, 11.01]));
        for south in ["S", "s", "S ", "South", "south", " SOUTH"] {
            assert_eq!(of(48.0, south, 11.0, "West"), Some([-48.5, -11.01]), "{south}");
        }
        for (south, west) in [("", "E"), ("N", " "), ("E", "N"), ("?", "W")] {
            assert_eq!(of(48.0, south, 11.0, west), None, "{south} {west}");
        }
        assert_eq!(of(90.0, "N", 11.0, "E"), None);
        assert_eq!(place_deg(([0.0; 3], "N"), ([0.0; 3], "E")), None);
        assert_eq!(place_deg(([0.0; 3], "N"), ([0.0, 0.0, 36.0], "E")), Some([0.0, 0.01]));
    }

    #[test]
    fn times_are_whole_or_none() {
        assert_eq!(local("2026:06:21 14:30:05", "+02:00").as_deref(), Some("2026-06-21T14:30:05+02:00"));
        assert_eq!(local("2026:06:21 14:30:05 ", " Z").as_deref(), Some("2026-06-21T14:30:05Z"));
        for (time, offset) in [
            ("2026:06:21 14:30:05", ""),
            ("2026:06:21 14:30:05", "   :  "),
            ("2026:06:21 14:30:05", "+2"),
            ("0000:00:00 00:00:00", "+02:00"),
            ("    :  :     :  :  ", "+02:00"),
            ("2026:06:21", "+02:00"),
            ("2026:06:21 24:00:00", "+02:00"),
            ("2026:13:21 14:30:05", "+02:00"),
        ] {
            assert_eq!(local(time, offset), None, "{time} {offset}");
        }
        assert_eq!(by_clock(" 2026:06:21 14:30:05").as_deref(), Some("2026-06-21T14:30:05"));
        assert_eq!(by_clock("    :  :     :  :  "), None);
        assert_eq!(universal("2026:06:21", [10.0, 5.0, 60.5]).as_deref(), Some("2026-06-21T10:05:59Z"));
        assert_eq!(universal("2026-06-21", [10.0, 0.0, 0.9]).as_deref(), Some("2026-06-21T10:00:00Z"));
        for date in ["", "0000:00:00", "2026:06", "today"] {
            assert_eq!(universal(date, [10.0, 0.0, 0.0]), None, "{date}");
        }
    }
}
