//! What EXIF says of place, time and light.

use exif::{DateTime, Exif, In, Rational, Tag, Value};

use super::taken::{degrees, other_light, universal};
use crate::image::photograph::Taken;

/// What is missing or makes no sense is left out.
pub(super) fn taken(exif: &Exif) -> Taken {
    let field = |tag| exif.get_field(tag, In::PRIMARY).map(|field| &field.value);
    let text = |tag| ascii(field(tag)?).map(|text| String::from_utf8_lossy(text).trim().to_owned());
    let number = |tag| field(tag).and_then(|value| value.get_uint(0));
    let place = |tag, side, negative| degrees(three(field(tag)?)?, &text(side)?, negative);
    let latitude = place(Tag::GPSLatitude, Tag::GPSLatitudeRef, "S");
    let longitude = place(Tag::GPSLongitude, Tag::GPSLongitudeRef, "W");
    let local = || {
        let offset = text(Tag::OffsetTimeOriginal).filter(|text| !text.is_empty())?;
        Some(format!(
            "{}{offset}",
            date_and_time(&DateTime::from_ascii(ascii(field(Tag::DateTimeOriginal)?)?).ok()?)
        ))
    };
    let of_gps = || Some(universal(&text(Tag::GPSDateStamp)?, three(field(Tag::GPSTimeStamp)?)?));
    Taken {
        place_deg: latitude.zip(longitude).map(|(latitude, longitude)| [latitude, longitude]),
        time: local().or_else(of_gps),
        other_light: other_light(
            number(Tag::Flash).is_some_and(|flash| flash & 1 == 1),
            number(Tag::LightSource),
        ),
    }
}

fn date_and_time(at: &DateTime) -> String {
    let DateTime { year, month, day, hour, minute, second, .. } = at;
    format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}")
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
