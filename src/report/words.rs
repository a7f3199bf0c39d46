//! Fields and numbers in words, for people who have not read what records hold.

/// Names of fields by their dotted path, and what they are called; others keep their names.
const WORDS: [(&str, &str); 21] = [
    ("rmse", "RMSE of the reflectance"),
    ("ciede2000", "colour difference, CIEDE2000"),
    ("method", "method"),
    ("prior", "what is known beforehand"),
    ("exposure", "exposure: value of white facing the sun"),
    ("residual_rms", "what is left of the facets, in units of their expected error"),
    ("iterations", "iterations"),
    ("termination.reason", "why they ended"),
    ("noise.model_error", "error of the model, relative to a facet"),
    ("image.file", "photograph"),
    ("image.width", "width, px"),
    ("image.height", "height, px"),
    ("image.stored_as", "stored as"),
    ("image.transfer", "curve that was undone"),
    ("image.make", "maker of the camera"),
    ("image.model", "camera"),
    ("image.exposure_s", "exposure time, s"),
    ("image.f_number", "focal length over aperture"),
    ("image.iso", "ISO"),
    ("image.margin_px", "distance kept from the sides of facets, px"),
    ("seed", "seed of the noise"),
];

/// What a field is called.
pub(super) fn words(field: &str) -> String {
    let known = WORDS.iter().find(|(name, _)| *name == field);
    known.map_or_else(|| field.to_owned(), |(_, words)| (*words).to_owned())
}

/// A number with three digits that count, or more where its error bar has a digit there.
pub(super) fn digits(value: f64, sd: f64) -> String {
    let leading = |size: f64| if size > 0.0 { size.log10().floor() as i32 } else { 0 };
    let decimals = (2 - leading(value.abs())).max(-leading(sd.abs())).clamp(0, 9) as usize;
    format!("{value:.decimals$}")
}

/// A number with its standard deviation.
pub(super) fn with_sd(value: f64, sd: f64) -> String {
    let value = digits(value, sd);
    let decimals = value.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    format!("{value} ± {sd:.decimals$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_digits_that_count() {
        assert_eq!(with_sd(0.412_345, 0.0091), "0.412 ± 0.009");
        assert_eq!(with_sd(49.983, 0.065), "49.98 ± 0.07"); // an angle
        assert_eq!(with_sd(7957.0, 21.0), "7957 ± 21");
        assert_eq!(with_sd(-0.000_513, 0.000_52), "-0.000513 ± 0.000520");
        assert_eq!(digits(0.0, 0.0), "0.00");
    }
}
