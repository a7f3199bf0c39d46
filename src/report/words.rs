//! Names of fields and numbers for people unfamiliar with the records.

/// Names in reports of fields, by their dotted path, and of work that was skipped; others keep their own.
const WORDS: [(&str, &str); 32] = [
    ("rmse", "RMSE of the reflectance"),
    ("ciede2000", "colour difference, CIEDE2000"),
    ("method", "method"),
    ("prior", "prior on the reflectance"),
    ("exposure", "exposure: value of white facing the sun"),
    ("residual_rms", "reduced chi: residuals of the facets over their expected size"),
    ("iterations", "iterations"),
    ("termination.reason", "why iterations ended"),
    ("termination.gradient_norm", "slope that was left where iterations ended"),
    ("day.kind", "kind of day"),
    ("day.probability", "probability of that kind of day"),
    ("noise.from", "where the noise is taken from"),
    ("noise.model_error", "error of the model, relative to a facet"),
    ("image.file", "photograph"),
    ("image.width", "width, px"),
    ("image.height", "height, px"),
    ("image.stored_as", "stored as"),
    ("image.transfer", "transfer curve that was undone"),
    ("image.black_level", "stored number for no light"),
    ("image.white_level", "stored number for 1"),
    ("image.distortion", "lens distortion, K1 and K2"),
    ("image.make", "maker of the camera"),
    ("image.model", "camera"),
    ("image.exposure_s", "exposure time, s"),
    ("image.f_number", "f-number"),
    ("image.iso", "ISO"),
    ("image.margin_px", "distance kept from the panels' edges, px"),
    ("seed", "seed of the noise"),
    ("form factors of a panel with itself", "exchange of light within a panel"),
    ("equal form factors", "pairs of facets that exchange light as others do"),
    ("form factors of facets", "exchange of light between single facets"),
    ("modes", "patterns of bounces"),
];

/// The name of a field in reports.
pub(super) fn words(field: &str) -> String {
    let known = WORDS.iter().find(|(name, _)| *name == field);
    known.map_or_else(|| field.to_owned(), |(_, words)| (*words).to_owned())
}

/// Significant digits.
const DIGITS: i32 = 4;
/// Most decimals.
const DECIMALS_MAX: i32 = 9;
/// Numbers from this on, and below its inverse, are written with an exponent.
const LARGE: f64 = 1e7;
/// Numbers below this are rounding errors of 0.
const ROUNDING: f64 = 1e-12;

/// A number with four significant digits, counted from its error bar if that is larger.
pub(super) fn digits(value: f64, sd: f64) -> String {
    let size = value.abs().max(sd.abs());
    if size > 0.0 && size < ROUNDING {
        return "0".to_owned();
    }
    if size > 0.0 && !(1.0 / LARGE..LARGE).contains(&size) {
        return format!("{value:.3e}");
    }
    let leading = if size > 0.0 { size.log10().floor() as i32 } else { 0 };
    let decimals = (DIGITS - 1 - leading).clamp(0, DECIMALS_MAX) as usize;
    format!("{value:.decimals$}")
}

/// A number of a record with four significant digits; integers and other texts remain unchanged.
pub(super) fn rounded(text: &str) -> String {
    match text.parse::<f64>() {
        Ok(value)
            if text.contains(['.', 'e'])
                && text.chars().filter(char::is_ascii_digit).count() > DIGITS as usize =>
        {
            digits(value, 0.0)
        }
        _ => text.to_owned(),
    }
}

/// A list of a record, each number rounded.
pub(super) fn rounded_list(text: &str) -> String {
    text.split(", ").map(rounded).collect::<Vec<_>>().join(", ")
}

/// Seconds since 1970-01-01T00:00Z as a date and time in UTC.
///
/// # Source
/// H. Hinnant, *chrono-compatible low-level date algorithms*, `civil_from_days`.
pub(super) fn utc(seconds: f64) -> String {
    const DAY_S: i64 = 86_400;
    let seconds = seconds.floor() as i64;
    let (days, of_day) = (seconds.div_euclid(DAY_S) + 719_468, seconds.rem_euclid(DAY_S));
    let (era, of_era) = (days.div_euclid(146_097), days.rem_euclid(146_097));
    let year_of_era = (of_era - of_era / 1_460 + of_era / 36_524 - of_era / 146_096) / 365;
    // of a year that begins in March
    let of_year = of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let march = (5 * of_year + 2) / 153;
    let day = of_year - (153 * march + 2) / 5 + 1;
    let month = if march < 10 { march + 3 } else { march - 9 };
    let year = year_of_era + 400 * era + i64::from(month <= 2);
    let [hour, minute, second] = [of_day / 3600, of_day / 60 % 60, of_day % 60];
    format!("{year:04}-{month:02}-{day:02} {hour:02}:{minute:02}:{second:02} UTC")
}

/// A number with its standard deviation, which may begin a line.
pub(super) fn with_sd(value: f64, sd: f64) -> String {
    let value = digits(value, sd);
    let decimals = value.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    format!("{value} ±\u{a0}{sd:.decimals$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_digits_that_count() {
        let with_sd = |value, sd| with_sd(value, sd).replace('\u{a0}', " ");
        assert_eq!(with_sd(0.412_345, 0.0091), "0.4123 ± 0.0091");
        assert_eq!(with_sd(49.983, 0.065), "49.98 ± 0.07"); // an angle
        assert_eq!(with_sd(7957.0, 21.0), "7957 ± 21");
        assert_eq!(with_sd(-0.000_513, 0.000_52), "-0.0005130 ± 0.0005200");
        assert_eq!(with_sd(0.000_001, 0.05), "0.00000 ± 0.05000");
        assert_eq!(digits(0.0, 0.0), "0.000");
        assert_eq!(digits(7.006_7e-9, 0.0), "7.007e-9");
        assert_eq!(digits(-2.844e-143, 0.0), "0");
    }

    #[test]
    fn numbers_of_records_are_rounded_and_texts_are_not() {
        assert_eq!(rounded_list("0.42269735040598927, 2, 49.1"), "0.4227, 2, 49.1");
        for text in ["615252", "vfold/1", "0.1.0", "1.0", "canon-5d-mark-ii"] {
            assert_eq!(rounded(text), text);
        }
    }

    #[test]
    fn seconds_are_dates() {
        assert_eq!(utc(0.0), "1970-01-01 00:00:00 UTC");
        assert_eq!(utc(951_782_399.9), "2000-02-28 23:59:59 UTC");
        assert_eq!(utc(951_868_799.0), "2000-02-29 23:59:59 UTC");
        assert_eq!(utc(-1.0), "1969-12-31 23:59:59 UTC");
    }
}
