//! The spectra of a file, and what the file states about them.

use std::sync::Arc;

use super::quantity::Quantity;
use super::units::{self, Scale};
use crate::error::{Error, Result};
use crate::spectrum::Spectrum;
use crate::spectrum::channels::in_order;
use crate::spectrum::names::What;

/// The largest known set has 1269 spectra.
pub(super) const MAX_SPECTRA: usize = 10_000;
/// Sums and products of numbers up to this remain finite.
const LARGEST: f64 = 1e30;

/// The spectra of a file.
#[derive(Debug)]
pub struct Table {
    pub(super) spectra: Vec<Spectrum>,
    /// What the file states about each spectrum.
    pub(super) stated: Vec<Stated>,
    /// Notes on conversions.
    pub(super) notes: Vec<String>,
}

/// What a file states about a spectrum.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Stated {
    /// Unit of the values, if it is a reflectance.
    pub(super) scale: Scale,
    pub(super) quantity: Option<Quantity>,
}

impl Table {
    /// A table of spectra in nm about which the file states nothing else.
    ///
    /// # Errors
    /// [`Error::Spectrum`] if a number is too large to be a measurement.
    pub fn new(spectra: Vec<Spectrum>) -> Result<Self> {
        for spectrum in &spectra {
            if let Some(value) = spectrum.values().iter().find(|value| value.abs() > LARGEST) {
                let problem = format!("{value:e} is too large");
                return Err(Error::spectrum(spectrum.name(), problem, "rescale the spectrum"));
            }
        }
        Ok(Self { stated: vec![Stated::default(); spectra.len()], spectra, notes: Vec::new() })
    }

    /// The same table, whose quantity the file states: `reflectance`, `irradiance`.
    #[must_use]
    pub fn called(mut self, quantity: &str) -> Self {
        self.stated.iter_mut().for_each(|stated| stated.quantity = Quantity::called(quantity));
        self
    }

    /// Checks that the file does not state its spectra, or the one named, to be anything but `what`.
    ///
    /// # Errors
    /// [`Error::Spectrum`] with the quantity stated.
    pub(in crate::spectrum) fn check_quantity(
        &self,
        path: &str,
        what: What,
        member: Option<&str>,
    ) -> Result<()> {
        let mut named = self.spectra.iter().zip(&self.stated);
        let other = named.find_map(|(spectrum, stated)| {
            let is_meant = member.is_none_or(|member| spectrum.name() == member);
            stated.quantity.filter(|quantity| is_meant && !quantity.suits(what))
        });
        match other {
            Some(quantity) => {
                let problem = format!("the file says it holds {}, not {}", quantity.name(), wanted(what));
                let remedy = "export it again with the right quantity, or name another file";
                Err(Error::spectrum(path, problem, remedy))
            }
            None => Ok(()),
        }
    }

    /// The same table with the spectra as reflectances in fractions. `percent`, if known, says whether
    /// spectra whose unit the file does not state are in percent.
    pub(in crate::spectrum) fn in_fractions(mut self, path: &str, percent: Option<bool>) -> Result<Self> {
        let scales: Vec<_> = self.stated.iter().map(|stated| stated.scale).collect();
        let percent = units::percent(path, &self.spectra, &scales, percent)?;
        for (spectrum, _) in self.spectra.iter_mut().zip(&percent).filter(|(_, percent)| **percent) {
            spectrum.values.iter_mut().for_each(|value| *value /= 100.0);
        }
        if percent.contains(&true) {
            self.notes.push("percent read as fractions".to_owned());
        }
        Ok(self)
    }

    /// The same table with the spectra as channels of a camera, in order.
    pub(in crate::spectrum) fn into_channels(mut self, path: &str) -> Result<Self> {
        let (spectra, notes) = in_order(path, &self.spectra)?;
        self.notes.extend(notes);
        Ok(Self { spectra, ..self })
    }

    /// The spectra, each with a note on conversions.
    pub(in crate::spectrum) fn spectra(self, path: &str) -> Vec<Spectrum> {
        let note = (!self.notes.is_empty()).then(|| Arc::from(format!("{path}: {}", self.notes.join(", "))));
        self.spectra.into_iter().map(|spectrum| spectrum.noted(note.as_ref())).collect()
    }
}

fn wanted(what: What) -> &'static str {
    match what {
        What::Cameras => "sensitivities of a camera",
        What::Illuminants => "the power of a light",
        What::Reflectances => "reflectances",
    }
}
