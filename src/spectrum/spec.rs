//! SPEC, the command line's notation for spectra.
//!
//! In this order: a number (flat), a built-in name, `set:member`, `daylight:CCT`, `2856K`, `sun:WHERE` or
//! `sky:WHERE`, the same in the directory `VFOLD_DATA`, a file, one column of a file as `file.csv:column`. A
//! file with a built-in name is reached as `./D65`.

use super::formats::{self, ENDINGS, JsonReader, has_ending, no_json};
use super::names::{What, unknown};
use super::own::{self, OwnFile};
use super::quantities::{Sensitivities, check_power, check_radiance_factor, check_reflectance};
use super::{Spectrum, library};
use crate::error::{Error, Result};
use crate::message::printable;
use std::path::Path;
use std::sync::Arc;

/// The reflectances named by `spec`: every member of a set, every column of a file.
///
/// # Errors
/// As [`Specs::reflectances`]; JSON is not read.
///
/// # Example
/// ```
/// use vfold::spectrum::reflectances;
/// assert_eq!(reflectances("cc24")?.len(), 24);
/// assert_eq!(reflectances("munsell:5R6/12")?[0].name(), "munsell:5R6/12");
/// assert_eq!(reflectances("0.18")?[0].values(), [0.18, 0.18]);
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn reflectances(spec: &str) -> Result<Vec<Spectrum>> {
    Specs::default().reflectances(spec)
}

/// The illuminant named by `spec`, relative power.
///
/// # Errors
/// As [`Specs::illuminant`]; JSON is not read.
///
/// # Example
/// ```
/// use vfold::spectrum::{Outside, WavelengthGrid, illuminant};
/// let grid = WavelengthGrid::uniform(555.0, 560.0, 5.0)?;
/// assert_eq!(illuminant("D65")?.on(&grid, Outside::Refuse)?, [102.023, 100.0]);
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn illuminant(spec: &str) -> Result<Spectrum> {
    Specs::default().illuminant(spec)
}

/// The camera named by `spec`; a number is one channel with uniform sensitivity.
///
/// # Errors
/// As [`Specs::camera`]; JSON is not read.
///
/// # Example
/// ```
/// let camera = vfold::spectrum::camera("canon-5d-mark-ii")?;
/// assert_eq!(camera.channels[1].name(), "G");
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn camera(spec: &str) -> Result<Sensitivities> {
    Specs::default().camera(spec)
}

/// Largest radiance factor of a sheet: larger values are percent.
const FLUORESCENCE_MAX: f64 = 2.0;

/// Finds the spectra that a SPEC names.
#[derive(Clone, Copy, Debug)]
pub struct Specs {
    json: JsonReader,
    percent: Option<bool>,
}

impl Default for Specs {
    fn default() -> Self {
        Self::with_json(no_json)
    }
}

impl Specs {
    /// With a reader of JSON files.
    #[must_use]
    pub fn with_json(json: JsonReader) -> Self {
        Self { json, percent: None }
    }

    /// The same, with `percent` saying whether reflectances are in percent in files that do not say it.
    #[must_use]
    pub fn in_percent(self, percent: Option<bool>) -> Self {
        Self { percent, ..self }
    }

    /// The reflectances named by `spec`: every member of a set, every column of a file. Percent is converted
    /// to fractions.
    ///
    /// # Errors
    /// [`crate::Error::UnknownName`] if nothing has that name, [`crate::Error::File`] or
    /// [`crate::Error::Table`] for a file that cannot be read, [`crate::Error::Spectrum`] for values outside
    /// 0..1.
    pub fn reflectances(self, spec: &str) -> Result<Vec<Spectrum>> {
        let spectra = self.find(What::Reflectances, spec)?;
        spectra.iter().try_for_each(check_reflectance).map_err(|e| in_file(spec, e))?;
        Ok(spectra.into_iter().map(Spectrum::as_reflectance).collect())
    }

    /// Radiance factors named by `spec`, relative to white, found as reflectances are. Those of fluorescent
    /// sheets may exceed 1; above 2, or where stated, they are in percent.
    ///
    /// # Errors
    /// As [`Specs::reflectances`], except that only values below 0 are refused.
    pub fn radiance_factors(self, spec: &str) -> Result<Vec<Spectrum>> {
        let mut spectra = self.in_percent(self.percent.or(Some(false))).find(What::Reflectances, spec)?;
        let is_large = spectra.iter().flat_map(Spectrum::values).any(|value| *value > FLUORESCENCE_MAX);
        if is_large && self.percent.is_none() {
            spectra = self.find(What::Reflectances, spec)?;
        }
        spectra.iter().try_for_each(check_radiance_factor).map_err(|e| in_file(spec, e))?;
        Ok(spectra)
    }

    /// The illuminant named by `spec`, relative power.
    ///
    /// # Errors
    /// As [`Specs::reflectances`]; a file with several columns; a power that is negative, or zero throughout.
    pub fn illuminant(self, spec: &str) -> Result<Spectrum> {
        let mut columns = self.find(What::Illuminants, spec)?;
        let illuminant = columns.swap_remove(0);
        if !columns.is_empty() {
            let problem = format!("{} columns, but one illuminant is needed", columns.len() + 1);
            return Err(Error::spectrum(spec, problem, format!("name one of them, such as {spec}:COLUMN")));
        }
        check_power(&illuminant, 0.0).map_err(|e| in_file(spec, e))?;
        Ok(illuminant.as_power())
    }

    /// All illuminants named by `spec`: every column of a file.
    ///
    /// # Errors
    /// As [`Specs::illuminant`], except that there may be several.
    pub fn illuminants(self, spec: &str) -> Result<Vec<Spectrum>> {
        let lights = self.find(What::Illuminants, spec)?;
        lights.iter().try_for_each(|light| check_power(light, 0.0)).map_err(|e| in_file(spec, e))?;
        Ok(lights.into_iter().map(Spectrum::as_power).collect())
    }

    /// The camera named by `spec`.
    ///
    /// # Errors
    /// As [`Specs::reflectances`] and [`Sensitivities::new`].
    pub fn camera(self, spec: &str) -> Result<Sensitivities> {
        Sensitivities::new(spec, self.find(What::Cameras, spec)?)
    }

    /// The spectra named by `spec`, at least one, not checked for their use.
    fn find(self, what: What, spec: &str) -> Result<Vec<Spectrum>> {
        if let Some(value) = spec.parse().ok().filter(|value: &f64| value.is_finite()) {
            return Ok(vec![Spectrum::flat(spec, value)]);
        }
        let own_files = own::files()?;
        let own_file = own::find(&own_files, spec)?;
        match (library::find(what, spec)?, own_file) {
            (Some(spectra), None) => Ok(spectra),
            (Some(spectra), Some((file, _))) => Ok(noted_as_built_in(spec, file, spectra)),
            (None, Some((file, member))) => self.file(what, &file.path, member),
            (None, None) => self.named_file(what, spec),
        }
    }

    /// The spectra of the file, or the member of a file, named by `spec`.
    fn named_file(self, what: What, spec: &str) -> Result<Vec<Spectrum>> {
        let (path, member) = path_and_member(spec);
        if !Path::new(path).exists() && !path.contains('/') && !has_ending(path, &ENDINGS) {
            return Err(unknown(what, spec, library::list(what)?.iter().map(|(name, _)| name.as_str())));
        }
        self.file(what, path, member)
    }

    fn file(self, what: What, path: &str, member: Option<&str>) -> Result<Vec<Spectrum>> {
        let mut table = formats::read(path, self.json)?;
        table.check_quantity(path, what, member)?;
        match what {
            What::Reflectances => table = table.in_fractions(path, self.percent)?,
            What::Cameras if member.is_none() => table = table.into_channels(path)?,
            What::Cameras | What::Illuminants => {}
        }
        let spectra = column_called(path, member, table.spectra(path))?;
        Ok(if what == What::Cameras { spectra } else { called_after_file(path, member, spectra) })
    }
}

/// The file at the beginning of `spec`, and the member after its colon, whose name may contain colons, too.
fn path_and_member(spec: &str) -> (&str, Option<&str>) {
    let exists = |path: &str| Path::new(path).exists();
    let mut splits = spec.match_indices(':').map(|(at, _)| (&spec[..at], &spec[at + 1..]));
    match splits.find(|(path, _)| exists(path)).or_else(|| spec.rsplit_once(':')) {
        Some((path, member)) if !exists(spec) => (path, Some(member)),
        _ => (spec, None),
    }
}

/// Adds a note that a built-in name hides a file.
fn noted_as_built_in(name: &str, file: &OwnFile, spectra: Vec<Spectrum>) -> Vec<Spectrum> {
    let (hidden, variable) = (file.file_name(), own::VARIABLE);
    let note = Arc::from(format!("{name}: the built-in one is used; give a path for {hidden} of {variable}"));
    spectra.into_iter().map(|spectrum| spectrum.noted(Some(&note))).collect()
}

/// The requested column, or all of them.
fn column_called(path: &str, column: Option<&str>, mut spectra: Vec<Spectrum>) -> Result<Vec<Spectrum>> {
    let Some(column) = column else { return Ok(spectra) };
    let column = printable(column);
    let Some(at) = spectra.iter().position(|spectrum| spectrum.name() == column) else {
        let names: Vec<_> = spectra.iter().map(Spectrum::name).collect();
        let hint = format!("the columns are {}", names[..names.len().min(12)].join(", "));
        return Err(Error::spectrum(path, format!("there is no column '{column}'"), hint));
    };
    Ok(vec![spectra.swap_remove(at)])
}

/// The same error about a spectrum of the file in `spec`, named as a SPEC names it: `red.csv`,
/// `red.csv:COLUMN`.
fn in_file(spec: &str, error: Error) -> Error {
    let (path, _) = path_and_member(spec);
    match error {
        Error::Spectrum { name, problem, remedy } if Path::new(path).is_file() => {
            let column = name.split_once(':').map(|(_, column)| format!(":{column}")).unwrap_or_default();
            Error::Spectrum { name: format!("{path}{column}"), problem, remedy }
        }
        other => other,
    }
}

/// The spectrum of `red.csv` is `red` if it is the only column, else `red:COLUMN`.
fn called_after_file(path: &str, column: Option<&str>, spectra: Vec<Spectrum>) -> Vec<Spectrum> {
    let stem = Path::new(path).file_stem().map_or(path.into(), |stem| stem.to_string_lossy());
    let alone = spectra.len() == 1 && column.is_none();
    let name = |column: &str| if alone { stem.to_string() } else { format!("{stem}:{column}") };
    spectra.into_iter().map(|spectrum| spectrum.renamed(name)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs::write;

    /// Runs `test` with the path of a CSV file with this text.
    fn with_csv(text: &str, test: impl FnOnce(&str)) {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("paint.csv");
        write(&path, text).unwrap();
        test(path.to_str().unwrap());
    }

    fn message<T: std::fmt::Debug>(result: Result<T>) -> String {
        result.unwrap_err().to_string()
    }

    #[test]
    fn names_are_found_in_any_case() {
        assert_eq!(illuminant("d65").unwrap().name(), "D65");
        assert_eq!(reflectances("Munsell:5r 6/12").unwrap()[0].name(), "munsell:5R6/12");
        assert_eq!(reflectances("munsell").unwrap().len(), 1269);
        assert_eq!(camera("1").unwrap().channels.len(), 1);
    }

    #[test]
    fn files_give_all_columns_or_one() {
        with_csv("nm,red,blue\n400,0.1,0.2\n700,0.3,0.4\n", |path| {
            let both = reflectances(path).unwrap();
            assert_eq!([both[0].name(), both[1].name()], ["paint:red", "paint:blue"]);
            let blue = reflectances(&format!("{path}:blue")).unwrap();
            assert_eq!((blue.len(), &blue[0]), (1, &both[1]));
            assert_eq!(camera(path).unwrap().channels[0].name(), "red");
            assert!(message(illuminant(path)).contains("2 columns, but one illuminant is needed; name one"));
            assert!(message(reflectances(&format!("{path}:pink"))).contains("the columns are red, blue"));
        });
        with_csv("nm,r\n400,0.1\n700,0.3\n", |path| {
            assert_eq!(reflectances(path).unwrap()[0].name(), "paint");
        });
    }

    #[test]
    fn values_that_cannot_be_are_refused() {
        for (value, want) in [
            (-0.1, "set negative"),
            (1.44, "fluorescent"),
            (-44.0, "set negative"),
            (444.0, "give fractions"),
        ] {
            with_csv(&format!("nm,r\n400,0.1\n700,{value}\n"), |path| {
                let message = message(reflectances(path));
                assert!(message.contains(&format!("reflectance {value} is outside")), "{message}");
                assert!(message.contains(want), "{message}");
            });
        }
        assert!(message(illuminant("-1")).contains("below 0"));
        assert!(message(camera("0")).contains("zero at every wavelength"));
    }

    #[test]
    fn percent_is_judged_by_the_whole_file() {
        with_csv("um,black,white\n0.4,0.5,90\n0.7,0.25,95\n", |path| {
            let black = &reflectances(&format!("{path}:black")).unwrap()[0];
            assert_eq!((black.values(), black.wavelengths_nm()), (&[0.005, 0.0025][..], &[400.0, 700.0][..]));
            let note = format!("{path}: micrometres read as nm, percent read as fractions");
            assert_eq!(black.note(), Some(note.as_str()));
            assert_eq!(illuminant(&format!("{path}:white")).unwrap().values(), [90.0, 95.0]);
        });
        with_csv("nm,r [%]\n400,0.5\n700,0.75\n", |path| {
            assert_eq!(reflectances(path).unwrap()[0].values(), [0.005, 0.0075]);
        });
        with_csv("nm,grey 50%\n400,0.5\n700,0.75\n", |path| {
            assert!(message(reflectances(path)).contains("--percent=no if the values are fractions"));
            let in_percent = |percent| Specs::default().in_percent(Some(percent)).reflectances(path).unwrap();
            assert_eq!(in_percent(true)[0].values(), [0.005, 0.0075]);
            assert_eq!(in_percent(false)[0].values(), [0.5, 0.75]);
        });
    }

    #[test]
    fn unknown_names_get_the_nearest_ones() {
        assert_eq!(
            message(illuminant("D56")),
            "no illuminant is called 'D56'; did you mean D50 or D55 or D60? \
             vextract --list illuminants shows all names, and a file needs its ending, such as .csv"
        );
        assert!(message(reflectances("cc24:redd")).contains("did you mean cc24:red "));
        let leica = message(camera("leica"));
        assert!(leica.starts_with("no camera is called 'leica'; vextract --list cameras shows"));
        assert!(matches!(reflectances("no-such.csv"), Err(Error::File { .. })));
        assert!(message(illuminant("daylight:3000")).contains("4000..25000 K"));
        assert!(message(illuminant("nan")).starts_with("no illuminant"));
    }
}
