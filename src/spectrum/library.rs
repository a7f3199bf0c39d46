//! The built-in spectra of `share/`, parsed only when named; `share/README.md` gives origin and licence of
//! each.

use std::sync::OnceLock;

pub use super::names::What;
use super::names::{same_name, unknown};
use super::tables::builtin;
use super::{ClearSky, Spectrum, Sun, black_body, cameras, daylight, munsell, own};
use crate::error::{Error, Result};

/// A table embedded in the program, with the file that it comes from.
macro_rules! shared {
    ($file:literal) => {
        builtin(concat!("share/", $file), include_str!(concat!("../../share/", $file)))
    };
}

struct Camera {
    name: &'static str,
    description: &'static str,
    exif_make: &'static str,
    exif_model: &'static str,
    channels: fn() -> Result<Vec<Spectrum>>,
}

const CAMERAS: [Camera; 3] = [
    Camera {
        name: "canon-5d-mark-ii",
        description: "Canon EOS 5D Mark II, 380..780 nm by 5 \
                      (rawtoaces: scitech 2017), used for its pictures",
        exif_make: "Canon",
        exif_model: "Canon EOS 5D Mark II",
        channels: || shared!("canon-5d-mark-ii.csv"),
    },
    Camera {
        name: "nikon-d5100",
        description: "Nikon D5100, 380..780 nm by 5 (National Physical Laboratory)",
        exif_make: "NIKON CORPORATION",
        exif_model: "NIKON D5100",
        channels: || shared!("nikon-d5100.csv"),
    },
    Camera {
        name: "sigma-sd-merrill",
        description: "Sigma SD1 Merrill, layered Foveon X3 sensor, 400..680 nm by 10 \
                      (National Physical Laboratory)",
        exif_make: "SIGMA",
        exif_model: "SIGMA SD1 Merrill",
        channels: || shared!("sigma-sd-merrill.csv"),
    },
];

struct ReflectanceSet {
    name: &'static str,
    description: &'static str,
    members: fn() -> Result<Vec<Spectrum>>,
}

const REFLECTANCE_SETS: [ReflectanceSet; 4] = [
    ReflectanceSet {
        name: "cc24",
        description: "24 ColorChecker patches, Ohta 1997 (cc24:dark-skin, cc24:red, cc24:neutral-6-5, ...)",
        members: || members_of("cc24", shared!("cc24.csv")?),
    },
    ReflectanceSet {
        name: "cc24-babelcolor",
        description: "24 ColorChecker patches, mean of 30 charts, BabelColor 2012",
        members: || members_of("cc24-babelcolor", shared!("cc24-babelcolor.csv")?),
    },
    ReflectanceSet {
        name: "cc24-iso17321",
        description: "24 ColorChecker patches, ISO 17321-1:2012 (the same values as cc24)",
        members: || members_of("cc24-iso17321", shared!("cc24.csv")?),
    },
    ReflectanceSet {
        name: "munsell",
        description: "1269 matte Munsell chips by hue, value/chroma (munsell:5R6/12, ...)",
        members: munsell::chips,
    },
];

/// Names and one-line descriptions of built-in spectra, and of the files in the directory `VFOLD_DATA`.
///
/// # Errors
/// [`Error::File`] if that directory cannot be read.
///
/// # Example
/// ```
/// use vfold::spectrum::library::{What, list};
/// let cameras = list(What::Cameras)?;
/// assert!(cameras.iter().any(|(name, _)| name == "nikon-d5100"));
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn list(what: What) -> Result<Vec<(String, String)>> {
    let mut rows = listed(what)?;
    for file in own::files()? {
        let hidden = if find(what, &file.name)?.is_some() { "; its name means a built-in one" } else { "" };
        let description = format!("own, {} in {}{hidden}", file.file_name(), own::VARIABLE);
        rows.push((file.name, description));
    }
    Ok(rows)
}

/// Names of built-in spectra, without those that stand for a family, such as `daylight:CCT` and `2856K`.
///
/// # Errors
/// Only if the embedded tables are damaged.
pub fn built_in(what: What) -> Result<Vec<String>> {
    let is_of_many = |name: &String| name.contains(':') || black_body::temperature_k(name).is_some();
    Ok(listed(what)?.into_iter().map(|(name, _)| name).filter(|name| !is_of_many(name)).collect())
}

/// True if a built-in spectrum is called `name`.
///
/// # Example
/// ```
/// use vfold::spectrum::library::{What, is_built_in};
/// assert!(is_built_in(What::Cameras, "Nikon-D5100") && !is_built_in(What::Cameras, "mine.csv"));
/// ```
#[must_use]
pub fn is_built_in(what: What, name: &str) -> bool {
    find(what, name).is_ok_and(|found| found.is_some())
}

/// Names and descriptions of built-in spectra.
fn listed(what: What) -> Result<Vec<(String, String)>> {
    Ok(match what {
        What::Cameras => listed_cameras(),
        What::Reflectances => rows(REFLECTANCE_SETS.iter().map(|set| (set.name, set.description))),
        What::Illuminants => {
            let cie = cie_illuminants()?;
            let daylight = ("daylight:CCT", "CIE daylight of 4000..25000 K, such as daylight:5500");
            let sun = "direct sun of a cloudless day, at an angle from the zenith (sun:40deg) or at a place \
                       and time: sun:48.1,11.6,2026-06-21T14:30+02:00";
            let sky =
                "skylight with that sun, on level ground; --sky-illuminant sky: that of --illuminant sun:...";
            let black_body = ("2856K", "black body of 1000..25000 K, such as 3200K for a lamp");
            let computed = [daylight, black_body, ("sun:WHERE", sun), ("sky:WHERE", sky)];
            rows(cie.iter().map(|cie| (cie.name(), description(cie.name()))).chain(computed))
        }
    })
}

fn rows<'a>(rows: impl Iterator<Item = (&'a str, &'a str)>) -> Vec<(String, String)> {
    rows.map(|(name, description)| (name.to_owned(), description.to_owned())).collect()
}

/// The first three, then those of rawtoaces-data except one that is among the three.
fn listed_cameras() -> Vec<(String, String)> {
    let first = rows(CAMERAS.iter().map(|camera| (camera.name, camera.description)));
    let measured = cameras::measured_cameras().map(|camera| (camera.name(), camera.description()));
    let others = measured.filter(|(name, _)| CAMERAS.iter().all(|camera| camera.name != name.as_str()));
    first.into_iter().chain(others).collect()
}

fn description(illuminant: &str) -> &'static str {
    match illuminant {
        "A" => "CIE standard illuminant A, light bulb, 2856 K",
        "E" => "equal energy at every wavelength",
        name if name.starts_with("LCD") => {
            "red, green or blue of a display, Apple Studio Display, Fairchild and Wyble 1998"
        }
        name if name.starts_with("LED") => "CIE typical white LED lamp",
        name if name.starts_with("FL") => "CIE typical fluorescent lamp",
        _ => "CIE daylight, temperature in hundreds of K",
    }
}

/// Parsed once, as all candidate lights are looked up one by one.
fn cie_illuminants() -> Result<&'static [Spectrum]> {
    static PARSED: OnceLock<Vec<Spectrum>> = OnceLock::new();
    if let Some(parsed) = PARSED.get() {
        return Ok(parsed);
    }
    let parsed = shared!("illuminants.csv")?;
    Ok(PARSED.get_or_init(|| parsed))
}

fn members_of(set: &str, members: Vec<Spectrum>) -> Result<Vec<Spectrum>> {
    Ok(members.into_iter().map(|member| member.renamed(|patch| format!("{set}:{patch}"))).collect())
}

/// The built-in spectra called `name`: a set, a member, an illuminant or the channels of a camera; `None` if
/// there are none.
pub(super) fn find(what: What, name: &str) -> Result<Option<Vec<Spectrum>>> {
    match what {
        What::Cameras => {
            let channels = match CAMERAS.iter().find(|camera| same_name(camera.name, name)) {
                Some(camera) => Some((camera.channels)()),
                None => cameras::by_name(name).map(|camera| camera.channels()),
            };
            channels.transpose()
        }
        What::Illuminants => Ok(illuminant(name)?.map(|illuminant| vec![illuminant])),
        What::Reflectances => {
            let set_name = name.split_once(':').map_or(name, |(set, _)| set);
            let set = REFLECTANCE_SETS.iter().find(|set| same_name(set.name, set_name));
            set.map(|set| members_called(name, (set.members)()?)).transpose()
        }
    }
}

/// All members if `name` is the set's, else the member of that name.
fn members_called(name: &str, mut members: Vec<Spectrum>) -> Result<Vec<Spectrum>> {
    if !name.contains(':') {
        return Ok(members);
    }
    match members.iter().position(|member| same_name(member.name(), name)) {
        Some(at) => Ok(vec![members.swap_remove(at)]),
        None => Err(unknown(What::Reflectances, name, members.iter().map(Spectrum::name))),
    }
}

fn illuminant(name: &str) -> Result<Option<Spectrum>> {
    let clear_sky = |place| Sun::parse(place).map(ClearSky::usual);
    let named = |spectrum: Spectrum| Some(spectrum.renamed(|_| name.to_owned()));
    match name.split_once(':') {
        Some(("sun", place)) => clear_sky(place)?.direct().map(named),
        Some(("sky", place)) => clear_sky(place).map_err(of_sky)?.diffuse().map(named),
        _ => cie_illuminant(name),
    }
}

/// An error in the sun's position, renamed to the sky for which it was given.
fn of_sky(error: Error) -> Error {
    match error {
        Error::Spectrum { name, problem, remedy } => {
            Error::Spectrum { name: name.replacen("sun:", "sky:", 1), problem, remedy }
        }
        other => other,
    }
}

/// A tabulated illuminant, or daylight or a black body of a given temperature.
fn cie_illuminant(name: &str) -> Result<Option<Spectrum>> {
    if let Some(temperature_k) = black_body::temperature_k(name) {
        return black_body::black_body(temperature_k).map(Some);
    }
    let Some(cct_k) = name.strip_prefix("daylight:") else {
        return Ok(cie_illuminants()?.iter().find(|cie| same_name(cie.name(), name)).cloned());
    };
    let cct_k = cct_k.parse().map_err(|_| {
        let problem = format!("'{cct_k}' is not a colour temperature");
        Error::spectrum(name, problem, "write kelvins, such as daylight:5500")
    })?;
    daylight::daylight(cct_k).map(Some)
}

/// The built-in camera that writes these EXIF fields Make and Model into its pictures.
///
/// # Example
/// ```
/// use vfold::spectrum::camera_by_exif;
/// assert_eq!(camera_by_exif("Canon", "Canon EOS 5D Mark II").as_deref(), Some("canon-5d-mark-ii"));
/// assert_eq!(camera_by_exif("NIKON CORPORATION", "NIKON D70").as_deref(), Some("nikon-d70"));
/// assert_eq!(camera_by_exif("Canon", "Canon EOS 1000D"), None);
/// ```
#[must_use]
pub fn camera_by_exif(make: &str, model: &str) -> Option<String> {
    let found = |camera: &&Camera| same_name(camera.exif_make, make) && same_name(camera.exif_model, model);
    let first = CAMERAS.iter().find(found).map(|camera| camera.name.to_owned());
    first.or_else(|| cameras::by_exif(make, model).map(|camera| camera.name()))
}

/// Names of other built-in measurements of the camera model behind the built-in camera `name`.
///
/// # Example
/// ```
/// use vfold::spectrum::other_measurements;
/// assert_eq!(other_measurements("canon-5d-mark-ii"), ["canon-eos-5d-mark-ii"]);
/// assert!(other_measurements("nikon-d5100").is_empty());
/// ```
#[must_use]
pub fn other_measurements(name: &str) -> Vec<String> {
    let known = |camera: &&Camera| same_name(camera.name, name);
    let of_first =
        CAMERAS.iter().find(known).and_then(|camera| cameras::by_exif(camera.exif_make, camera.exif_model));
    let found = of_first.or_else(|| cameras::by_name(name));
    let of_measured = found.into_iter().flat_map(|found| {
        let same = CAMERAS
            .iter()
            .filter(move |camera| cameras::by_exif(camera.exif_make, camera.exif_model) == Some(found));
        same.map(|camera| camera.name.to_owned()).chain([found.name()])
    });
    let mut others: Vec<String> = of_measured.filter(|other| !same_name(other, name)).collect();
    others.dedup();
    others
}

/// True if the built-in camera `name` was measured on another model than the one that writes these EXIF
/// fields Make and Model into its pictures; false if there is no such camera, or the picture names no model.
///
/// # Example
/// ```
/// use vfold::spectrum::is_other_camera;
/// assert!(is_other_camera("nikon-d850", "Canon", "Canon EOS R5"));
/// assert!(!is_other_camera("nikon-d850", "NIKON CORPORATION", "NIKON D850"));
/// assert!(!is_other_camera("mine.csv", "Canon", "Canon EOS R5"));
/// ```
#[must_use]
pub fn is_other_camera(name: &str, make: &str, model: &str) -> bool {
    if model.trim().is_empty() {
        return false;
    }
    let first = CAMERAS.iter().find(|camera| same_name(camera.name, name));
    let is_first =
        |camera: &Camera| cameras::is_same_model((camera.exif_make, camera.exif_model), (make, model));
    match (first, cameras::by_name(name)) {
        (Some(camera), _) if is_first(camera) => false,
        (_, Some(measured)) => cameras::by_exif(make, model) != Some(measured),
        (first, None) => first.is_some(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cameras by the EXIF data of their pictures, by name, by alias, by another measurement, and by sensor.
    #[test]
    fn cameras_are_told_from_others() {
        let (canon, nikon) = ("Canon", "NIKON CORPORATION");
        for (name, make, model, other) in [
            ("canon-5d-mark-ii", canon, "Canon EOS 5D Mark II", false),
            ("canon-eos-5d-mark-ii", canon, "Canon EOS 5D Mark II", false),
            ("canon-5d-mark-ii", canon, "Canon EOS 5D Mark III", true),
            ("Canon-EOS-Rebel-T3i", canon, "Canon EOS 600D", false),
            ("canon-eos-r6m2", canon, "Canon EOS R8", false),
            ("nikon-d5100", nikon, "NIKON D5100", false),
            ("nikon-d5100", nikon, "NIKON D1", true),
            ("sigma-sd-merrill", "SIGMA", "SIGMA SD1 Merrill", false),
            ("sigma-sd-merrill", "SIGMA", "SIGMA fp", true),
            ("nikon-d850", canon, "", false),
            ("nikon-d850.csv", canon, "Canon EOS R5", false),
        ] {
            assert_eq!(is_other_camera(name, make, model), other, "{name}, {model}");
        }
        assert_eq!(other_measurements("canon-eos-5d-mark-ii"), ["canon-5d-mark-ii"]);
        for name in ["sigma-sd-merrill", "canon-eos-r5", "mine.csv"] {
            assert!(other_measurements(name).is_empty(), "{name}");
        }
    }

    #[test]
    fn every_listed_name_is_found() {
        for (what, count) in [(What::Reflectances, 4), (What::Cameras, 54), (What::Illuminants, 50)] {
            let names = listed(what).unwrap();
            assert_eq!(names.len(), count);
            for (name, _) in names {
                assert!(
                    find(what, &name.replace("CCT", "5500").replace("WHERE", "40deg")).unwrap().is_some(),
                    "{name}"
                );
            }
        }
    }

    #[test]
    fn every_set_of_patches_has_the_same_names() {
        let members = |set: &str| -> Vec<String> {
            let members = find(What::Reflectances, set).unwrap().unwrap();
            members.iter().map(|member| member.name().replace(set, "")).collect()
        };
        assert_eq!(members("cc24").len(), 24);
        assert_eq!(members("cc24"), members("cc24-babelcolor"));
        assert_eq!(members("cc24"), members("cc24-iso17321"));
    }

    #[test]
    fn exif_may_be_padded_or_in_capitals() {
        assert_eq!(camera_by_exif("SIGMA ", "Sigma SD1 MERRILL").as_deref(), Some("sigma-sd-merrill"));
    }
}
