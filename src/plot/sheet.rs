//! What can be drawn of a sheet: its spectrum, its appearance, the residuals of its facets.

use super::spectra::Curve;
use crate::geometry::Panel;

/// The drawable data of a sample.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// Its spectrum.
    pub curve: Curve,
    /// Its appearance.
    pub colours: Option<SheetColours>,
    /// The residuals of its facets.
    pub residuals: Option<Residuals>,
    /// Positions of its facets, by the panels' numbers.
    pub panels: Vec<(usize, Panel)>,
}

/// Colours on screen, sRGB from 0 to 1.
#[derive(Clone, Debug)]
pub struct SheetColours {
    /// Of the flat sheet, as estimated.
    pub estimate: [f64; 3],
    /// Of the flat sheet, true.
    pub truth: Option<[f64; 3]>,
    /// Of the facets, scaled so that the largest number is that of the flat sheet.
    pub folded: Vec<[f64; 3]>,
}

/// Measured minus estimated facets, in standard deviations.
#[derive(Clone, Debug)]
pub struct Residuals {
    /// Names of the channels.
    pub channels: Vec<String>,
    /// Facet by channel, none for a facet that was not measured.
    pub facets: Vec<Option<Vec<f64>>>,
}

impl Sheet {
    /// Colours of the folded sheet, if its facets can be drawn.
    pub(super) fn folded(&self) -> Option<&[[f64; 3]]> {
        let folded = self.colours.as_ref()?.folded.as_slice();
        (!folded.is_empty() && !self.panels.is_empty()).then_some(folded)
    }
}

impl Residuals {
    /// Root mean square over all facets and channels.
    #[must_use]
    pub fn rms(&self) -> f64 {
        let all: Vec<f64> = self.facets.iter().flatten().flatten().copied().collect();
        (all.iter().map(|value| value * value).sum::<f64>() / all.len().max(1) as f64).sqrt()
    }
}
