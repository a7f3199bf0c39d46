//! Place, time and light according to EXIF.

use exif::{Rational, Tag, Value};

use super::taken::{by_clock, local, other_light, place_deg, universal};
use crate::image::photograph::Taken;

/// From the values that tags have; missing or implausible ones are omitted.
pub(super) fn taken<'v>(field: impl Fn(Tag) -> Option<&'v Value>) -> Taken {
    let text = |tag| ascii(field(tag)?).map(|text| String::from_utf8_lossy(text).trim().to_owned());
    let number = |tag| field(tag).and_then(|value| value.get_uint(0));
    let place_deg = || {
        let (north, east) = (text(Tag::GPSLatitudeRef)?, text(Tag::GPSLongitudeRef)?);
        let (latitude, longitude) = (three(field(Tag::GPSLatitude)?)?, three(field(Tag::GPSLongitude)?)?);
        place_deg((latitude, &north), (longitude, &east))
    };
    let local = || local(&text(Tag::DateTimeOriginal)?, &text(Tag::OffsetTimeOriginal)?);
    let of_gps = || universal(&text(Tag::GPSDateStamp)?, three(field(Tag::GPSTimeStamp)?)?);
    Taken {
        place_deg: place_deg(),
        time: local().or_else(of_gps),
        clock: text(Tag::DateTimeOriginal).and_then(|clock| by_clock(&clock)),
        other_light: other_light(
            number(Tag::Flash).is_some_and(|flash| flash & 1 == 1),
            number(Tag::LightSource),
        ),
    }
}

fn ascii(value: &Value) -> Option<&[u8]> {
    let Value::Ascii(lines) = value else { return None };
    lines.first().map(Vec::as_slice)
}

fn three(value: &Value) -> Option<[f64; 3]> {
    let Value::Rational(parts) = value else { return None };
    let numbers: Vec<f64> = parts.iter().map(Rational::to_f64).collect();
    numbers.try_into().ok().filter(|parts: &[f64; 3]| parts.iter().all(|part| (0.0..=180.0).contains(part)))
}
