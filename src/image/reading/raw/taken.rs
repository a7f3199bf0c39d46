//! What a RAW file says of place, time and light.

use rawler::exif::{Exif, ExifGPS};
use rawler::formats::tiff::Rational;

use crate::image::photograph::Taken;
use crate::image::reading::taken::{degrees, other_light, universal};

/// What is missing or makes no sense is left out.
pub(super) fn taken(exif: &Exif) -> Taken {
    let local = || {
        let time = exif.date_time_original.as_deref().filter(|time| is_set(time))?;
        let offset = exif.offset_time_original.as_deref().filter(|offset| !offset.trim().is_empty())?;
        let (day, hour) = time.trim().split_once(' ')?;
        Some(format!("{}T{hour}{}", day.replace(':', "-"), offset.trim()))
    };
    let gps = exif.gps.as_ref();
    let of_gps = || {
        let gps = gps?;
        let date = gps.gps_date_stamp.as_deref().filter(|date| is_set(date))?;
        Some(universal(date, three(&gps.gps_timestamp)?))
    };
    Taken {
        place_deg: gps.and_then(place_deg),
        time: local().or_else(of_gps),
        other_light: other_light(
            exif.flash.is_some_and(|flash| flash & 1 == 1),
            exif.light_source.map(u32::from),
        ),
    }
}

/// Whether a date is one: clocks that were never set leave zeros or blanks.
fn is_set(date: &str) -> bool {
    date.chars().any(|character| ('1'..='9').contains(&character))
}

/// Zeros are what is written where there was no fix.
fn place_deg(gps: &ExifGPS) -> Option<[f64; 2]> {
    let latitude = degrees(three(&gps.gps_latitude)?, gps.gps_latitude_ref.as_deref()?, "S")?;
    let longitude = degrees(three(&gps.gps_longitude)?, gps.gps_longitude_ref.as_deref()?, "W")?;
    let is_nowhere = latitude.abs() + longitude.abs() <= 0.0;
    (!is_nowhere).then_some([latitude, longitude])
}

fn three(parts: &Option<[Rational; 3]>) -> Option<[f64; 3]> {
    let numbers = (*parts)?.map(|part| f64::from(part.n) / f64::from(part.d));
    numbers.iter().all(|part| (0.0..=180.0).contains(part)).then_some(numbers)
}
