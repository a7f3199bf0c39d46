//! One or a few sheets: spectra, appearance and, for a single sheet, the residuals of its facets.

use std::path::Path;

use super::figure::{Above, save, svg};
use super::maps::{FacetMap, Maps};
use super::multiples::{MULTIPLES_MAX, Multiples};
use super::scale::Scale;
use super::sheet::Sheet;
use super::spectra::{CURVES_MAX, Spectra};
use super::swatches::Swatches;
use super::terminal;
use crate::error::{Error, Result};

/// Every scale reaches at least this many standard deviations, so that noise looks the same in all drawings.
const USUAL: f64 = 4.0;

impl Sheet {
    /// Spectrum and colours as SVG.
    ///
    /// # Errors
    /// [`Error::Numeric`] if they cannot be drawn.
    pub fn spectrum_svg(&self) -> Result<String> {
        svg(&spectra(std::slice::from_ref(self)))
    }

    /// Maps of the residuals as SVG; `None` without residuals.
    ///
    /// # Errors
    /// [`Error::Numeric`] if they cannot be drawn.
    pub fn residuals_svg(&self) -> Result<Option<String>> {
        self.residual_maps().map(|maps| svg(&maps)).transpose()
    }

    fn residual_maps(&self) -> Option<Maps<'_>> {
        let residuals = self.residuals.as_ref().filter(|_| !self.panels.is_empty())?;
        let values = |channel: usize| {
            let of = move |facet: &Option<Vec<f64>>| facet.as_ref()?.get(channel).copied();
            residuals.facets.iter().map(of).collect()
        };
        let map =
            |(channel, name): (usize, &String)| FacetMap { title: name.clone(), values: values(channel) };
        Some(Maps {
            title: format!("measured − estimated facets, rms {:.2} standard deviations", residuals.rms()),
            panels: &self.panels,
            maps: residuals.channels.iter().enumerate().map(map).collect(),
            scale: Scale::around_zero(residuals.facets.iter().flatten().flatten().copied(), USUAL),
            unit: "standard deviations",
        })
    }
}

/// Draws the first sheets of `all`, as SVG or PNG: a single one with its residuals, up to [`CURVES_MAX`] on
/// one chart, up to [`MULTIPLES_MAX`] on one each; `-` is the terminal, which only shows the spectra of the
/// first [`CURVES_MAX`].
///
/// # Errors
/// [`Error::File`] if it cannot be written, [`Error::NothingToDraw`] if there is nothing to draw.
pub fn draw(path: &Path, sheets: &[Sheet], all: usize) -> Result<()> {
    let maps = match sheets {
        [] => return Err(Error::NothingToDraw("no sample has an estimate to draw")),
        [one] => one.residual_maps(),
        _ => None,
    };
    if path == Path::new("-") {
        let shown = &sheets[..sheets.len().min(CURVES_MAX)];
        terminal::draw(shown.iter().map(|sheet| &sheet.curve), all);
        return Ok(());
    }
    if sheets.len() > CURVES_MAX {
        return save(path, &Multiples { sheets: &sheets[..sheets.len().min(MULTIPLES_MAX)], all });
    }
    save(path, &Above(spectra(sheets), maps))
}

fn spectra(sheets: &[Sheet]) -> Above<Spectra<'_>, Swatches<'_>> {
    Above(Spectra(sheets.iter().map(|sheet| &sheet.curve).collect()), Some(Swatches(sheets)))
}
