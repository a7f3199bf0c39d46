//! Place, time and light according to a RAW file.

use rawler::exif::{Exif, ExifGPS};
use rawler::formats::tiff::Rational;

use crate::image::photograph::Taken;
use crate::image::reading::taken::{by_clock as clock, local, other_light, place_deg, universal};

/// Missing or implausible fields are omitted.
pub(super) fn taken(exif: &Exif) -> Taken {
    let gps = exif.gps.as_ref();
    let by_clock = || local(exif.date_time_original.as_deref()?, exif.offset_time_original.as_deref()?);
    let by_gps = || universal(gps?.gps_date_stamp.as_deref()?, three(&gps?.gps_timestamp)?);
    Taken {
        place_deg: gps.and_then(place),
        time: by_clock().or_else(by_gps),
        clock: exif.date_time_original.as_deref().and_then(clock),
        other_light: other_light(
            exif.flash.is_some_and(|flash| flash & 1 == 1),
            exif.light_source.map(u32::from),
        ),
    }
}

fn place(gps: &ExifGPS) -> Option<[f64; 2]> {
    let latitude = (three(&gps.gps_latitude)?, gps.gps_latitude_ref.as_deref()?);
    let longitude = (three(&gps.gps_longitude)?, gps.gps_longitude_ref.as_deref()?);
    place_deg(latitude, longitude)
}

fn three(parts: &Option<[Rational; 3]>) -> Option<[f64; 3]> {
    let numbers = (*parts)?.map(|part| f64::from(part.n) / f64::from(part.d));
    numbers.iter().all(|part| (0.0..=180.0).contains(part)).then_some(numbers)
}
