//! What EXIF says of place, time and light.

use exif::{DateTime, Exif, In, Rational, Tag, Value};

use crate::image::photograph::Taken;

/// What is missing or makes no sense is left out.
pub(super) fn taken(exif: &Exif) -> Taken {
    let field = |tag| exif.get_field(tag, In::PRIMARY).map(|field| &field.value);
    let place = |tag, side, negative: u8| {
        let degrees = degrees(field(tag)?)?;
        Some(if ascii(field(side)?)?.first()?.eq_ignore_ascii_case(&negative) { -degrees } else { degrees })
    };
    let latitude = place(Tag::GPSLatitude, Tag::GPSLatitudeRef, b'S');
    let longitude = place(Tag::GPSLongitude, Tag::GPSLongitudeRef, b'W');
    let local = || {
        let text = |tag| ascii(field(tag)?).map(|text| String::from_utf8_lossy(text).trim().to_owned());
        let offset = text(Tag::OffsetTimeOriginal).filter(|text| !text.is_empty())?;
        Some(format!(
            "{}{offset}",
            date_and_time(&DateTime::from_ascii(ascii(field(Tag::DateTimeOriginal)?)?).ok()?)
        ))
    };
    let universal = || {
        let day = ascii(field(Tag::GPSDateStamp)?)?;
        let [hour, minute, second] = three(field(Tag::GPSTimeStamp)?)?.map(|part| part.floor() as u64);
        let day = String::from_utf8_lossy(day).trim().replace(':', "-");
        Some(format!("{day}T{hour:02}:{minute:02}:{second:02}Z"))
    };
    let fired = field(Tag::Flash).and_then(|value| value.get_uint(0)).is_some_and(|flash| flash & 1 == 1);
    let source = field(Tag::LightSource).and_then(|value| value.get_uint(0));
    Taken {
        place_deg: latitude.zip(longitude).map(|(latitude, longitude)| [latitude, longitude]),
        time: local().or_else(universal),
        other_light: if fired { Some("flash") } else { source.and_then(other_light) },
    }
}

/// The name of a light that is not the sun's, by its number in EXIF.
pub(super) fn other_light(source: u32) -> Option<&'static str> {
    match source {
        2 | 12..=16 => Some("fluorescent lamps"),
        3 | 17 | 24 => Some("light bulbs"),
        4 => Some("flash"),
        10 => Some("clouds"),
        11 => Some("shade"),
        _ => None,
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

/// Degrees, minutes and seconds.
fn degrees(value: &Value) -> Option<f64> {
    let [degrees, minutes, seconds] = three(value)?;
    Some(degrees + minutes / 60.0 + seconds / 3600.0).filter(|degrees| *degrees <= 180.0)
}

fn three(value: &Value) -> Option<[f64; 3]> {
    let Value::Rational(parts) = value else { return None };
    let numbers: Vec<f64> = parts.iter().map(Rational::to_f64).collect();
    numbers.try_into().ok().filter(|parts: &[f64; 3]| parts.iter().all(|part| (0.0..=180.0).contains(part)))
}
