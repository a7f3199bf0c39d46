//! Position of the sun: stated as an angle, or computed for a place and a time.

use solar_positioning::time::JulianDate;
use solar_positioning::{Location, RefractionCorrection, SolarPositions, delta_t};

use crate::error::{Error, Result};

/// The sun as seen from the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sun {
    zenith_deg: f64,
    /// Day of the year, from 1; `None` if only the angle is known.
    day: Option<u32>,
}

/// How a sun is specified.
const FORMS: &str = "write sun:40deg, its angle from the zenith, or sun:LAT,LON,TIME as \
                     in sun:48.1,11.6,2026-06-21T14:30+02:00";

impl Sun {
    /// The sun at this angle from the zenith, at its mean distance.
    ///
    /// # Errors
    /// [`Error::Spectrum`] if it is not above the horizon.
    pub fn at_zenith_deg(zenith_deg: f64) -> Result<Self> {
        let sun = Self { zenith_deg, day: None };
        sun.above_horizon(&format!("sun:{zenith_deg}deg"), "give an angle from 0, overhead, to less than 90")
    }

    /// The sun given by the words of a SPEC after `sun:`, either `40deg` or latitude, longitude and time.
    /// Atmospheric refraction is that of 15 °C at sea level.
    ///
    /// # Source
    /// I. Reda, A. Andreas, "Solar position algorithm for solar radiation applications", *Solar Energy* 76
    /// (2004), p. 577, as implemented in the crate solar-positioning.
    ///
    /// # Errors
    /// [`Error::Spectrum`] if place or time is impossible, or the sun is below the horizon there and then.
    ///
    /// # Example
    /// ```
    /// use vfold::spectrum::Sun;
    /// let noon = Sun::parse("48.14,11.58,2026-06-21T12:00+02:00")?;
    /// assert!((noon.zenith_deg() - 28.877).abs() < 1e-2);
    /// assert!(Sun::parse("48.14,11.58,2026-06-21T00:00+02:00").is_err()); // night
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn parse(text: &str) -> Result<Self> {
        if let Some(degrees) = text.strip_suffix("deg") {
            let degrees = degrees.trim().parse();
            return degrees.map_or_else(|_| Err(wrong(text, "not an angle", FORMS)), Self::at_zenith_deg);
        }
        let mut parts = text.splitn(3, ',');
        let (Some(latitude), Some(longitude), Some(time)) = (parts.next(), parts.next(), parts.next()) else {
            return Err(wrong(text, "not a place and time", FORMS));
        };
        let degrees = |part: &str, most: f64| part.trim().parse().ok().filter(|deg: &f64| deg.abs() <= most);
        let (Some(latitude), Some(longitude)) = (degrees(latitude, 90.0), degrees(longitude, 180.0)) else {
            let problem = format!("'{latitude},{longitude}' is not a place");
            let remedy = "give degrees north, -90 to 90, and east, -180 to 180; south and west are negative";
            return Err(wrong(text, problem, remedy));
        };
        let moment = Moment::parse(time.trim()).ok_or_else(|| {
            let remedy = "write date, time and its difference from UTC, as in 2026-06-21T14:30+02:00 \
                          or 2026-06-21T12:30Z";
            wrong(text, format!("'{time}' is not a time"), remedy)
        })?;
        let failed = |e: solar_positioning::Error| wrong(text, e.to_string(), FORMS);
        let seen = SolarPositions::new()
            .at_from_julian(
                moment.julian().map_err(failed)?,
                Location { latitude, longitude },
                0.0,
                Some(RefractionCorrection::standard()),
            )
            .map_err(failed)?;
        let sun = Self { zenith_deg: seen.zenith_angle(), day: Some(moment.day_of_year()) };
        sun.above_horizon(
            &format!("sun:{text}"),
            "check the time, its difference from UTC, and the signs of latitude and longitude",
        )
    }

    /// The same sun on this day of the year, from 1.
    #[must_use]
    pub fn on_day(self, day: u32) -> Self {
        Self { day: Some(day), ..self }
    }

    /// Apparent angle from the zenith, degrees.
    #[must_use]
    pub fn zenith_deg(&self) -> f64 {
        self.zenith_deg
    }

    fn above_horizon(self, name: &str, remedy: &str) -> Result<Self> {
        if (0.0..90.0).contains(&self.zenith_deg) {
            return Ok(self);
        }
        let problem = format!("the sun is below the horizon, {:.1}° from the zenith", self.zenith_deg);
        let problem =
            if self.zenith_deg >= 90.0 { problem } else { format!("{}° is not an angle", self.zenith_deg) };
        Err(Error::spectrum(name, problem, remedy))
    }

    /// Square of the ratio of the mean distance to that of the day; Spencer (1971), eqs. 2-2 and 2-3 of Bird
    /// and Riordan.
    pub(super) fn nearness(&self) -> f64 {
        let Some(day) = self.day else { return 1.0 };
        let turn = std::f64::consts::TAU * (f64::from(day) - 1.0) / 365.0;
        let (once, twice) = (turn.sin_cos(), (2.0 * turn).sin_cos());
        1.00011 + 0.034221 * once.1 + 0.00128 * once.0 + 0.000719 * twice.1 + 7.7e-5 * twice.0
    }

    /// Air mass relative to that overhead; Kasten and Young, *Applied Optics* 28 (1989), p. 4735.
    #[must_use]
    pub fn air_mass(&self) -> f64 {
        1.0 / (self.cos() + 0.50572 * (96.07995 - self.zenith_deg).powf(-1.6364))
    }

    /// Ozone mass relative to that overhead, at a height of 22 km; eq. 2-10.
    pub(super) fn ozone_mass(&self) -> f64 {
        let height = 22.0 / 6370.0;
        (1.0 + height) / (self.cos().powi(2) + 2.0 * height).sqrt()
    }

    fn cos(&self) -> f64 {
        self.zenith_deg.to_radians().cos()
    }
}

fn wrong(text: &str, problem: impl Into<String>, remedy: &str) -> Error {
    Error::spectrum(format!("sun:{text}"), problem, remedy)
}

/// A calendar time, and its offset from UTC.
struct Moment {
    year: i32,
    month: u32,
    day: u32,
    hour: u32,
    minute: u32,
    second: f64,
    ahead_h: f64,
}

impl Moment {
    /// Parses RFC 3339; seconds may be omitted, and a space or lower case letters may replace `T` and `Z`.
    fn parse(text: &str) -> Option<Self> {
        let (date, rest) = text.split_once(['T', 't', ' '])?;
        let (time, ahead_h) = match rest.strip_suffix(['Z', 'z']) {
            Some(time) => (time, 0.0),
            None => {
                let at = rest.rfind(['+', '-'])?;
                (&rest[..at], ahead_h(&rest[at..])?)
            }
        };
        let mut date = date.splitn(3, '-');
        let (year, month, day) =
            (digits(date.next()?, 4)?, digits(date.next()?, 2)?, digits(date.next()?, 2)?);
        let mut time = time.splitn(3, ':');
        let (hour, minute) = (digits(time.next()?, 2)?, digits(time.next()?, 2)?);
        let second = time.next().map_or(Some(0.0), |text| text.parse().ok())?;
        let moment = Self { year: year.try_into().ok()?, month, day, hour, minute, second, ahead_h };
        moment.julian().ok().map(|_| moment)
    }

    fn julian(&self) -> solar_positioning::Result<JulianDate> {
        let Self { year, month, day, hour, minute, second, ahead_h } = *self;
        let delta_t_s = delta_t::estimate_from_date(year, month)?;
        let local = JulianDate::from_utc(year, month, day, hour, minute, second, delta_t_s)?;
        JulianDate::new(local.julian_date() - ahead_h / 24.0, delta_t_s)
    }

    /// From 1; by the local calendar, which changes the sun's distance by less than 1e-4.
    fn day_of_year(&self) -> u32 {
        const BEFORE: [u32; 12] = [0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334];
        let leap = self.year % 4 == 0 && (self.year % 100 != 0 || self.year % 400 == 0);
        BEFORE[self.month as usize - 1] + self.day + u32::from(leap && self.month > 2)
    }
}

/// Hours of `+02:00` or `-0330`.
fn ahead_h(text: &str) -> Option<f64> {
    let (sign, text) = (if text.starts_with('-') { -1.0 } else { 1.0 }, text.get(1..)?);
    let (hours, minutes) = text.split_once(':').or_else(|| text.split_at_checked(2))?;
    let (hours, minutes) = (digits(hours, 2)?, digits(minutes, 2)?);
    (hours <= 14 && minutes < 60).then(|| sign * (f64::from(hours) + f64::from(minutes) / 60.0))
}

/// A number with exactly `count` digits.
fn digits(text: &str, count: usize) -> Option<u32> {
    let right = text.len() == count && text.bytes().all(|letter| letter.is_ascii_digit());
    right.then(|| text.parse().ok())?
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(text: &str) -> String {
        Sun::parse(text).unwrap_err().to_string()
    }

    #[test]
    fn times_are_those_of_rfc_3339() {
        let same = [
            "2026-06-21T14:30:00+02:00",
            "2026-06-21T12:30Z",
            "2026-06-21 09:00-03:30",
            "2026-06-21t12:30:00.0z",
        ];
        for time in same {
            let zenith_deg = Sun::parse(&format!("48,11,{time}")).unwrap().zenith_deg();
            assert!((zenith_deg - 28.43).abs() < 0.01, "{time}: {zenith_deg}");
        }
        for time in [
            "2026-06-21T14:30",
            "2026-06-21",
            "2026-02-29T12:00Z",
            "2026-06-21T25:00Z",
            "2026-6-21T12:00Z",
            "2026-06-21T12:00+15:00",
            "2026-06-21T12:00+é0",
            "noon",
            "",
            "2026-06-21T12:60Z",
            "2026-06-21T12:00:nanZ",
        ] {
            assert!(message(&format!("48,11,{time}")).contains("is not a time; write date"), "{time}");
        }
    }

    #[test]
    fn what_cannot_be_is_refused() {
        for place in ["91,0", "0,181", "x,0", "nan,0", "Paris,France"] {
            assert!(
                message(&format!("{place},2026-06-21T12:00Z")).contains("is not a place; give degrees"),
                "{place}"
            );
        }
        assert!(message("Paris").contains("not a place and time; write sun:40deg"));
        assert!(message("xdeg").contains("not an angle"));
        assert!(message("95deg").contains("below the horizon"));
        assert!(message("-5deg").contains("not an angle"));
        assert!(message("nandeg").contains("not an angle"));
        assert!(message("48.1,11.6,2026-06-21T23:30+02:00").contains("below the horizon"));
    }

    #[test]
    fn days_are_counted_with_leap_years() {
        let day = |date: &str| Moment::parse(&format!("{date}T12:00Z")).unwrap().day_of_year();
        assert_eq!(
            [day("2026-01-01"), day("2026-12-31"), day("2024-12-31"), day("2024-02-29")],
            [1, 365, 366, 60]
        );
    }
}
