//! The 52 cameras of rawtoaces-data, found by make and model as in their pictures' metadata.
//!
//! Measured at Wētā Digital, scitech and the National Physical Laboratory; `share/make-cameras.py` created
//! the array and the names.

use std::sync::Arc;

use super::names::words;
use super::{Spectrum, WavelengthGrid};
use crate::error::{Error, Result};

const NAMES: &str = include_str!("../../share/cameras.txt");
const SENSITIVITIES: &[u8] = include_bytes!("../../share/cameras.npy");
/// Unit of the sensitivities in the array, as a fraction of 1.
const UNIT: f64 = 1.0 / 50_000.0;

/// A camera whose sensitivities were measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MeasuredCamera {
    /// The maker, in one or two words.
    pub maker: &'static str,
    /// The model, without its maker.
    pub model: &'static str,
    /// Who measured the camera, and when.
    pub measured_by: &'static str,
    /// Other names of the model, separated by semicolons.
    aliases: &'static str,
    /// Models with the same sensor, separated by semicolons.
    same_sensor: &'static str,
    /// Index in the array.
    at: usize,
}

/// All measured cameras, by maker and model.
///
/// # Example
/// ```
/// use vfold::spectrum::measured_cameras;
/// assert_eq!(measured_cameras().count(), 52);
/// assert_eq!(measured_cameras().last().unwrap().name(), "sony-ilce-9");
/// ```
pub fn measured_cameras() -> impl Iterator<Item = MeasuredCamera> {
    NAMES.lines().enumerate().map(|(at, line)| {
        let mut parts = line.split('\t');
        let [maker, model, measured_by, aliases, same_sensor] =
            std::array::from_fn(|_| parts.next().unwrap_or_default());
        MeasuredCamera { maker, model, measured_by, aliases, same_sensor, at }
    })
}

/// The channels R, G and B of all of them, 380..780 nm by 5, scaled to a peak of 1 for each camera.
///
/// # Errors
/// Only if the embedded array is damaged.
pub fn measured_sensitivities() -> Result<Vec<[Spectrum; 3]>> {
    let wavelengths_nm: Arc<[f64]> = WavelengthGrid::uniform(380.0, 780.0, 5.0)?.wavelengths_nm().into();
    let bands = wavelengths_nm.len();
    let units: Vec<u16> = npyz::NpyFile::new(SENSITIVITIES)
        .and_then(npyz::NpyFile::into_vec)
        .map_err(|e| Error::file("share/cameras.npy", e))?;
    let channel = |name: &str, units: &[u16]| {
        let values = units.iter().map(|&unit| f64::from(unit) * UNIT).collect();
        Spectrum::from_table(name.to_owned(), wavelengths_nm.clone(), values).linear()
    };
    let camera = |units: &[u16]| {
        let part = |k: usize| &units[k * bands..(k + 1) * bands];
        [channel("R", part(0)), channel("G", part(1)), channel("B", part(2))]
    };
    Ok(units.chunks_exact(3 * bands).map(camera).collect())
}

impl MeasuredCamera {
    /// Its name on the command line: `canon-eos-600d`.
    #[must_use]
    pub fn name(&self) -> String {
        words(self.maker).chain(words(self.model)).collect::<Vec<_>>().join("-")
    }

    /// One-line description.
    pub(super) fn description(&self) -> String {
        let list = |names: &str| names.replace(';', ", ");
        let aliases =
            if self.aliases.is_empty() { String::new() } else { format!(" ({})", list(self.aliases)) };
        let others = match self.same_sensor {
            "" => String::new(),
            same => format!("; also for {}, with the same sensor", list(same)),
        };
        let Self { maker, model, measured_by, .. } = self;
        format!("{maker} {model}{aliases}, 380..780 nm by 5 (rawtoaces-data: {measured_by}){others}")
    }

    /// Its channels.
    ///
    /// # Errors
    /// As [`measured_sensitivities`].
    pub(super) fn channels(&self) -> Result<Vec<Spectrum>> {
        let mut all = measured_sensitivities()?;
        if self.at >= all.len() {
            return Err(Error::Fault("share/cameras.npy has not all of share/cameras.txt".to_owned()));
        }
        Ok(all.swap_remove(self.at).into())
    }

    /// True if it is of the maker that writes `make` into its pictures.
    #[must_use]
    pub fn is_made_by(&self, make: &str) -> bool {
        words(self.maker).next() == words(make).next()
    }

    /// True if `model`, as written into pictures, is not this model but has the same sensor.
    #[must_use]
    pub fn has_same_sensor(&self, model: &str) -> bool {
        self.is_called(self.same_sensor, model)
    }

    fn is_called(&self, names: &str, model: &str) -> bool {
        let wanted = plain_model(self.maker, model);
        names.split(';').any(|name| !name.is_empty() && plain_model(self.maker, name) == wanted)
    }

    fn is_or_shares_sensor(&self, model: &str) -> bool {
        [self.model, self.aliases, self.same_sensor].iter().any(|names| self.is_called(names, model))
    }
}

/// The camera that writes this make and model into its pictures, or one with the same sensor.
pub(super) fn by_exif(make: &str, model: &str) -> Option<MeasuredCamera> {
    measured_cameras().find(|camera| camera.is_made_by(make) && camera.is_or_shares_sensor(model))
}

/// The camera called `name` on the command line: its maker and any name of its model.
pub(super) fn by_name(name: &str) -> Option<MeasuredCamera> {
    measured_cameras().find(|camera| camera.is_made_by(name) && camera.is_or_shares_sensor(name))
}

/// True if two makes and models, as written into pictures, denote one camera that is called differently
/// elsewhere.
pub(super) fn is_same_model((make, model): (&str, &str), (other_make, other): (&str, &str)) -> bool {
    words(make).next() == words(other_make).next() && plain_model(make, model) == plain_model(make, other)
}

/// What distinguishes a model from others of its maker: `NIKON D70` is `d70`, `Canon EOS 400D DIGITAL` is
/// `400d`.
fn plain_model(maker: &str, model: &str) -> String {
    let of_maker: Vec<String> = words(maker).collect();
    let says_nothing =
        |word: &String| of_maker.contains(word) || ["corporation", "eos", "digital"].contains(&word.as_str());
    words(model).filter(|word| !says_nothing(word)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn every_camera_has_its_curves_and_its_own_name() {
        let sensitivities = measured_sensitivities().unwrap();
        let names: HashSet<String> = measured_cameras().map(|camera| camera.name()).collect();
        assert_eq!((sensitivities.len(), names.len(), measured_cameras().count()), (52, 52, 52));
        for (camera, sensitivities) in measured_cameras().zip(sensitivities) {
            assert_eq!(by_name(&camera.name()), Some(camera));
            assert_eq!(camera.channels().unwrap(), sensitivities);
            let peak = sensitivities.iter().flat_map(Spectrum::values).copied().fold(0.0, f64::max);
            assert!((peak - 1.0).abs() < 1e-12, "{}: {peak}", camera.name());
        }
    }

    /// Names as the makers write them.
    #[test]
    fn models_are_known_by_all_their_names() {
        for (make, model, want) in [
            ("NIKON CORPORATION", "NIKON D850", "nikon-d850"),
            ("NIKON CORPORATION", "NIKON Z 6_2", "nikon-z-f"),
            ("Canon", "Canon EOS DIGITAL REBEL XTi", "canon-digital-rebel-xti"),
            ("Canon", "Canon EOS 400D DIGITAL", "canon-digital-rebel-xti"),
            ("Canon", "Canon EOS Kiss X5", "canon-eos-600d"),
            ("Canon", "Canon EOS REBEL T3i", "canon-eos-600d"),
            ("Canon", "Canon EOS-1Ds Mark III", "canon-eos-1ds-mark-iii"),
            ("Canon", "Canon EOS 5DS R", "canon-eos-5ds"),
            ("SONY", "ILCE-7RM5", "sony-ilce-7rm4"),
            ("FUJIFILM", "GFX100S", "fujifilm-gfx-100"),
            ("Arashi Vision", "Insta360 X5", "arashi-vision-insta360-x5"),
        ] {
            assert_eq!(by_exif(make, model).map(|camera| camera.name()).as_deref(), Some(want), "{model}");
        }
        for (make, model) in
            [("Canon", "Canon EOS 5D Mark"), ("NIKON", "X-T3"), ("Canon", ""), ("", "X-T3"), ("", "")]
        {
            assert_eq!(by_exif(make, model), None, "{make} {model}");
        }
    }
}
