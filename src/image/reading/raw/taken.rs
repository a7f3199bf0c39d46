//! What a RAW file says of place, time and light.

use rawler::exif::{Exif, ExifGPS};
use rawler::formats::tiff::Rational;

use crate::image::photograph::Taken;
use crate::image::reading::exif_taken::other_light;

/// What is missing or makes no sense is left out.
pub(super) fn taken(exif: &Exif) -> Taken {
    let local = || {
        let (time, offset) = (exif.date_time_original.as_deref()?, exif.offset_time_original.as_deref()?);
        let (day, hour) = time.trim().split_once(' ')?;
        Some(format!("{}T{hour}{}", day.replace(':', "-"), offset.trim()))
    };
    let gps = exif.gps.as_ref();
    let fired = exif.flash.is_some_and(|flash| flash & 1 == 1);
    Taken {
        place_deg: gps.and_then(place_deg),
        time: local().or_else(|| universal(gps?)),
        other_light: if fired {
            Some("flash")
        } else {
            exif.light_source.and_then(|source| other_light(source.into()))
        },
    }
}

fn place_deg(gps: &ExifGPS) -> Option<[f64; 2]> {
    let degrees = |parts: &Option<[Rational; 3]>, side: &Option<String>, negative: &str| {
        let [degrees, minutes, seconds] = three(parts)?;
        let degrees = degrees + minutes / 60.0 + seconds / 3600.0;
        Some(if side.as_deref()?.trim().eq_ignore_ascii_case(negative) { -degrees } else { degrees })
    };
    let latitude = degrees(&gps.gps_latitude, &gps.gps_latitude_ref, "S")?;
    Some([latitude, degrees(&gps.gps_longitude, &gps.gps_longitude_ref, "W")?])
}

fn universal(gps: &ExifGPS) -> Option<String> {
    let [hour, minute, second] = three(&gps.gps_timestamp)?.map(|part| part.floor() as u64);
    let day = gps.gps_date_stamp.as_deref()?.trim().replace(':', "-");
    Some(format!("{day}T{hour:02}:{minute:02}:{second:02}Z"))
}

fn three(parts: &Option<[Rational; 3]>) -> Option<[f64; 3]> {
    let numbers = (*parts)?.map(|part| f64::from(part.n) / f64::from(part.d));
    numbers.iter().all(|part| (0.0..=180.0).contains(part)).then_some(numbers)
}
