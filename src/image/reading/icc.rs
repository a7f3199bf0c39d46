//! ICC profiles in PNG, TIFF and JPEG files.

use moxcms::{CicpProfile, ColorProfile, DataColorSpace, ProfileClass, ProfileText, ToneReprCurve, Xyzd};

use super::code_points;
use super::stated::{OTHER_COLOURS, OTHER_CURVE, Statement, UNREADABLE, curve_like};
use crate::image::numbers::Transfer;

/// Largest difference, in XYZ under D50, between equal primaries: writers round them in various ways.
const SAME_PRIMARY: f64 = 3e-3;
/// Red, green and blue of sRGB, adapted to D50.
///
/// # Source
/// IEC 61966-2-1:1999, annex F, as in the ICC's `sRGB2014.icc`.
const SRGB_PRIMARIES: [[f64; 3]; 3] =
    [[0.43607, 0.22249, 0.01392], [0.38515, 0.71687, 0.09708], [0.14307, 0.06061, 0.71410]];

/// Colour tables, which outrank curves: a profile with both has them since they differ.
const TABLES: [[u8; 4]; 7] = [*b"A2B0", *b"A2B1", *b"A2B2", *b"D2B0", *b"D2B1", *b"D2B2", *b"D2B3"];

/// A profile's statement on the numbers of a picture in colour or grey.
pub(super) fn statement(bytes: &[u8], is_in_colour: bool) -> Statement {
    match ColorProfile::new_from_slice(bytes) {
        Ok(profile) => {
            let meaning = objection(bytes, &profile, is_in_colour).map_or_else(|| meaning(&profile), Err);
            of_profile(meaning.map_err(|why| format!("'{}', {why}", name(&profile))))
        }
        Err(_) => unreadable(),
    }
}

/// The statement of a profile that is damaged.
pub(super) fn unreadable() -> Statement {
    of_profile(Err(UNREADABLE.to_owned()))
}

fn of_profile(says: Result<Transfer, String>) -> Statement {
    Statement { by: "ICC profile", says }
}

/// Why a profile is none of a picture like this, or says it elsewhere than in its curves. RGB fits grey
/// numbers, too: these are three equal ones.
fn objection(bytes: &[u8], profile: &ColorProfile, is_in_colour: bool) -> Option<&'static str> {
    use ProfileClass::{ColorSpace, DisplayDevice, InputDevice, OutputDevice};
    if !matches!(profile.profile_class, InputDevice | DisplayDevice | OutputDevice | ColorSpace) {
        return Some("which is not that of a picture");
    }
    if is_in_colour && profile.color_space == DataColorSpace::Gray {
        return Some("which is for grey numbers");
    }
    tags(bytes).any(|tag| TABLES.contains(&tag)).then_some("whose colour table outranks its curve")
}

/// The tags of a profile.
fn tags(bytes: &[u8]) -> impl Iterator<Item = [u8; 4]> {
    /// Header and number of tags.
    const BEFORE_TAGS: usize = 132;
    const ENTRY_BYTES: usize = 12;
    let count =
        bytes.get(..BEFORE_TAGS).and_then(|head| head.last_chunk().copied()).map_or(0, u32::from_be_bytes);
    let entries = bytes.get(BEFORE_TAGS..).unwrap_or_default().chunks_exact(ENTRY_BYTES).take(count as usize);
    entries.filter_map(|entry| entry.first_chunk().copied())
}

fn meaning(profile: &ColorProfile) -> Result<Transfer, &'static str> {
    let curve = of_tones(profile)?;
    match &profile.cicp {
        Some(points) if of_points(points) != Ok(curve) => Err("whose code points contradict its curve"),
        _ => Ok(curve),
    }
}

/// The meaning of code points; matrix and range are those of video, and writers state any.
fn of_points(points: &CicpProfile) -> Result<Transfer, String> {
    code_points::transfer([points.color_primaries as u8, points.transfer_characteristics as u8, 0], true)
}

fn of_tones(profile: &ColorProfile) -> Result<Transfer, &'static str> {
    match profile.color_space {
        DataColorSpace::Gray => curve(profile.gray_trc.as_ref()),
        DataColorSpace::Rgb => {
            let [red, green, blue] =
                [&profile.red_trc, &profile.green_trc, &profile.blue_trc].map(Option::as_ref);
            let curve = curve(red)?;
            if [green, blue].into_iter().any(|other| self::curve(other) != Ok(curve)) {
                return Err(OTHER_CURVE);
            }
            has_srgb_primaries(profile).then_some(curve).ok_or(OTHER_COLOURS)
        }
        _ => Err("which is for numbers that are neither RGB nor grey"),
    }
}

/// The curve of a channel; an error where a colour table takes its place.
fn curve(tone: Option<&ToneReprCurve>) -> Result<Transfer, &'static str> {
    let tone = tone.and_then(|tone| tone.make_linear_evaluator().ok()).ok_or(OTHER_CURVE)?;
    curve_like(|stored| tone.evaluate_value(stored as f32).into()).ok_or(OTHER_CURVE)
}

fn has_srgb_primaries(profile: &ColorProfile) -> bool {
    let of_profile = [profile.red_colorant, profile.green_colorant, profile.blue_colorant];
    of_profile.iter().zip(SRGB_PRIMARIES).all(|(Xyzd { x, y, z }, srgb)| {
        [x, y, z].into_iter().zip(srgb).all(|(got, want)| (got - want).abs() < SAME_PRIMARY)
    })
}

/// The name in a profile.
fn name(profile: &ColorProfile) -> String {
    let text = match &profile.description {
        Some(ProfileText::PlainString(text)) => Some(text),
        Some(ProfileText::Localizable(texts)) => texts.first().map(|text| &text.value),
        Some(ProfileText::Description(text)) => Some(&text.ascii_string),
        None => None,
    };
    text.map_or_else(|| "a profile without a name".to_owned(), |text| text.trim_end_matches('\0').to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(profile: ColorProfile) -> Result<Transfer, String> {
        statement(&profile.encode().unwrap(), profile.color_space == DataColorSpace::Rgb).says
    }

    #[test]
    fn profiles_say_linear_srgb_or_something_else() {
        assert_eq!(of(ColorProfile::new_srgb()), Ok(Transfer::Srgb));
        let mut linear = ColorProfile::new_srgb();
        linear.cicp = None;
        let straight = Some(ToneReprCurve::Lut(Vec::new()));
        (linear.red_trc, linear.green_trc) = (straight.clone(), straight.clone());
        assert!(of(linear.clone()).unwrap_err().contains("curve"), "blue is not straight yet");
        linear.blue_trc = straight;
        assert_eq!(of(linear), Ok(Transfer::Linear));
        assert!(of(ColorProfile::new_adobe_rgb()).unwrap_err().contains("curve"));
        assert!(of(ColorProfile::new_display_p3()).unwrap_err().contains("primaries"));
        assert!(of(ColorProfile::new_gray_with_gamma(2.2)).unwrap_err().contains("curve"));
        assert_eq!(of(ColorProfile::new_gray_with_gamma(1.0)), Ok(Transfer::Linear));
        assert!(of(ColorProfile::new_bt2020()).is_err());
    }

    #[test]
    fn tables_outrank_curves() {
        let bytes = ColorProfile::new_srgb().encode().unwrap();
        let at = bytes.windows(4).position(|tag| tag == b"wtpt").unwrap();
        let with_table = [&bytes[..at], b"D2B1", &bytes[at + 4..]].concat();
        assert!(statement(&with_table, true).says.unwrap_err().contains("table outranks its curve"));
    }

    #[test]
    fn what_is_no_profile_is_said() {
        assert!(statement(b"no profile", true).says.unwrap_err().contains("cannot be read"));
    }
}
