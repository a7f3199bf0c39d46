//! Spectra named by flags, with notes on their conversion.

use std::path::Path;

use super::{Common, say};
use crate::error::{Error, Result};
use crate::spectrum::{Sensitivities, Spectrum};
use crate::stream;

impl Common {
    /// The reflectances named by `spec`.
    ///
    /// # Errors
    /// As [`Specs::reflectances`](crate::spectrum::spec::Specs::reflectances).
    pub fn reflectances(&self, spec: &str) -> Result<Vec<Spectrum>> {
        let spectra = stream::specs().in_percent(self.percent).reflectances(spec)?;
        self.say_notes(&spectra);
        Ok(spectra)
    }

    /// The single reflectance named by a flag.
    ///
    /// # Errors
    /// As [`Specs::reflectances`](crate::spectrum::spec::Specs::reflectances), or [`Error::Usage`] if it is a
    /// set or a number that is no reflectance.
    pub fn one_reflectance(&self, flag: &'static str, spec: &str) -> Result<Spectrum> {
        match spec.trim().parse::<f64>() {
            Ok(number) if !(0.0..=1.0).contains(&number) => {
                let problem = format!("reflectance {number} is outside 0..1");
                Err(Error::usage(flag, problem, "give a number from 0 to 1, a name or a file"))
            }
            _ => one(flag, spec, self.reflectances(spec)?),
        }
    }

    /// The radiance factors named by `spec`.
    ///
    /// # Errors
    /// As [`Specs::radiance_factors`](crate::spectrum::spec::Specs::radiance_factors).
    pub fn radiance_factors(&self, spec: &str) -> Result<Vec<Spectrum>> {
        let spectra = stream::specs().in_percent(self.percent).radiance_factors(spec)?;
        self.say_notes(&spectra);
        Ok(spectra)
    }

    /// The single radiance factor named by a flag.
    ///
    /// # Errors
    /// As [`Common::radiance_factors`], or [`Error::Usage`] if it is a set.
    pub fn one_radiance_factor(&self, flag: &'static str, spec: &str) -> Result<Spectrum> {
        one(flag, spec, self.radiance_factors(spec)?)
    }

    /// The illuminant named by `spec`.
    ///
    /// # Errors
    /// As [`Specs::illuminant`](crate::spectrum::spec::Specs::illuminant).
    pub fn illuminant(&self, spec: &str) -> Result<Spectrum> {
        let spectrum = stream::specs().illuminant(spec)?;
        self.say_notes([&spectrum]);
        Ok(spectrum)
    }

    /// All illuminants named by `spec`.
    ///
    /// # Errors
    /// As [`Specs::illuminants`](crate::spectrum::spec::Specs::illuminants).
    pub fn illuminants(&self, spec: &str) -> Result<Vec<Spectrum>> {
        let spectra = stream::specs().illuminants(spec)?;
        self.say_notes(&spectra);
        Ok(spectra)
    }

    /// The camera named by `spec`.
    ///
    /// # Errors
    /// As [`Specs::camera`](crate::spectrum::spec::Specs::camera).
    pub fn camera(&self, spec: &str) -> Result<Sensitivities> {
        let camera = stream::specs().camera(spec)?;
        self.say_notes(&camera.channels);
        Ok(camera)
    }

    /// Prints the notes on spectra as they were read, each once.
    fn say_notes<'a>(&self, spectra: impl IntoIterator<Item = &'a Spectrum>) {
        spectra.into_iter().filter_map(Spectrum::note).for_each(|note| self.say_once(&called(), note));
    }

    /// Prints a line in a tool's name, if it is new and `--quiet` allows it.
    pub fn say_once(&self, tool: &str, line: &str) {
        if !self.quiet && self.notes.is_new(line) {
            say(tool, line);
        }
    }
}

fn one(flag: &'static str, spec: &str, mut spectra: Vec<Spectrum>) -> Result<Spectrum> {
    match (spectra.pop(), spectra.is_empty()) {
        (Some(spectrum), true) => Ok(spectrum),
        _ => Err(Error::usage(flag, format!("'{spec}' is a set"), "name one member, as in cc24:white")),
    }
}

/// The name by which the tool was called.
fn called() -> String {
    let path = std::env::args_os().next().unwrap_or_default();
    Path::new(&path).file_name().unwrap_or_default().to_string_lossy().into_owned()
}
