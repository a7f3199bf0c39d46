//! Bands of emission that sheets may have: their prior, with its sources.

use nalgebra::DVector;

use crate::estimate::gaussian::{logistic, logit};
use crate::estimate::unknowns::Normal;

/// Prior on a band.
#[derive(Debug, PartialEq)]
pub(super) struct Band {
    /// What excites the band.
    pub origin: Origin,
    /// The maximum size: the size is the fraction of white under daylight that is emitted at the peak, with
    /// no more photons than are absorbed at shorter wavelengths.
    pub most: f64,
    /// Logit of the size relative to the maximum.
    pub size: Normal,
    /// Wavenumber of the peak, 1/cm.
    pub peak_per_cm: Normal,
    /// Logarithm of the standard deviation of wavenumbers, 1/cm.
    pub ln_width_per_cm: Normal,
    /// Fall of the logit of reflectance at 400 nm, where the sheet absorbs the exciting light.
    pub fall: Normal,
    /// Logit of the reflectance at the exciting wavelengths; `None` if light from behind takes their place.
    pub exciting: Option<Normal>,
    /// Probability of the band for a sheet of a class.
    share: Share,
}

/// Origin of the light that a sheet emits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// Light from behind that passes through a thin sheet: no fluorescence.
    Behind,
    /// Ultraviolet: an optical brightener.
    Ultraviolet,
    /// Visible light of shorter wavelengths: a fluorescent dye or pigment.
    Visible,
}

impl Origin {
    /// Power of the reflectance to which the emitted light is proportional. A sheet absorbs transmitted and
    /// reflected light alike, and both increase for paler colours. By the equations of Kubelka and Munk,
    /// transmittances of sheets of 1.5 to 8 scattering lengths vary as reflectances to powers of 1.8 to 2.7.
    pub(super) fn of_reflectance(self) -> i32 {
        match self {
            Self::Behind => 2,
            Self::Ultraviolet | Self::Visible => 0,
        }
    }
}

/// Probability that sheets have a band.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Share {
    /// The same for all classes of spectra.
    OfAll(f64),
    /// This for sheets that are white at the band, almost none for deep colours: brighteners are added to
    /// things that should look white.
    OfWhite(f64),
}

/// Reflectance at the peak of a brightener at which sheets are brightened half as often as white ones, and
/// the logit over which that falls by a factor of e: pastel papers are made by dyeing the pulp of white ones,
/// and prints lie on them, but in deep colours a brightener would have no visible effect.
const PASTEL: f64 = 0.4;
const PASTEL_LOGIT: f64 = 0.5;

/// Reflectance at the wavelengths that excite a brightener, its logarithm of odds: around 370 nm, where two
/// in three such sheets reflect a tenth to a quarter.
const AT_ULTRAVIOLET: Normal = Normal { mean: -1.7, sd: 0.5 };
/// The same for a dye that visible light excites: so strong a dye absorbs seven eighths at its maximum.
const AT_DYE: Normal = Normal { mean: -2.0, sd: 0.5 };

/// Stilbenes in paper, cloth and plastics absorb 300 to 430 nm and emit about 400 to 500 nm, and a brightened
/// sheet is brightest at 435 to 440 nm (A. E. Siegrist et al., "Optical brighteners", *Ullmann's Encyclopedia
/// of Industrial Chemistry* 25 (2012)). The four classes of ISO 15397, by how much brightness a paper loses
/// without ultraviolet (1 to 4, to 8, to 14, to 25 %), have about 3, 9, 17 and 30 % at the peak, and prints
/// less; the size here is as often below 7 % of white as above, and two in three lie between 2 and 19 %.
/// Daylight has photons for 0.7. Half of white paper and washed cloth has one, other white sheets, such as
/// painted ones, less often. At the absorption maximum, 370 nm, the logit of reflectance has fallen by about
/// three, from 0.8 to 0.2.
pub(super) const BRIGHTENER: Band = Band {
    origin: Origin::Ultraviolet,
    most: 0.7,
    size: Normal { mean: -2.2, sd: 1.2 },
    peak_per_cm: Normal { mean: 1e7 / 435.0, sd: 260.0 },
    ln_width_per_cm: Normal { mean: 7.17, sd: 0.2 },
    fall: Normal { mean: 1.5, sd: 0.8 },
    exciting: Some(AT_ULTRAVIOLET),
    share: Share::OfWhite(0.35),
};

/// Dyes of sticky notes, safety cloth and markers, such as coumarins, fluoresceins and rhodamines: emission
/// from blue green to red, 30 to 70 nm wide at half maximum (J. R. Lakowicz, *Principles of Fluorescence
/// Spectroscopy* (2006), chapter 3), together in one sheet in five hundred: if it were one in two hundred, a
/// measured cardboard of unknown exposure would be taken for dyed.
const fn dye(peak_nm: f64) -> Band {
    let peak_per_cm = 1e7 / peak_nm;
    Band {
        origin: Origin::Visible,
        most: 2.0,
        size: Normal { mean: -1.4, sd: 1.0 },
        // neighbours are 25 nm apart
        peak_per_cm: Normal { mean: peak_per_cm, sd: 15.0 * peak_per_cm / peak_nm },
        ln_width_per_cm: Normal { mean: 6.8, sd: 0.25 },
        fall: Normal { mean: 0.0, sd: 0.0 },
        exciting: Some(AT_DYE),
        share: Share::OfAll(0.002 / 7.0),
    }
}

/// Light of table, ground and sky behind a single sheet in free air, up to a third of white, of which
/// printing paper transmits a tenth to a quarter, and cloth more (P. Kubelka, *Journal of the Optical Society
/// of America* 38 (1948), p. 448): broad, and red rather than blue. One sheet in twenty is thin and has no
/// backing.
const THROUGH: Band = Band {
    origin: Origin::Behind,
    most: 0.3,
    size: Normal { mean: -1.2, sd: 1.0 },
    peak_per_cm: Normal { mean: 1e7 / 600.0, sd: 1500.0 },
    ln_width_per_cm: Normal { mean: 8.7, sd: 0.2 },
    fall: Normal { mean: 0.0, sd: 0.0 },
    exciting: None,
    share: Share::OfAll(0.05),
};

impl Band {
    /// Usual wavelength of the peak.
    pub fn peak_nm(&self) -> f64 {
        1e7 / self.peak_per_cm.mean
    }

    /// Probability that a sheet with these `logits` of reflectance has the band.
    pub fn share(&self, wavelengths_nm: &DVector<f64>, logits: &DVector<f64>) -> f64 {
        match self.share {
            Share::OfAll(share) => share,
            Share::OfWhite(share) => {
                let at_peak = logits[wavelengths_nm.map(|nm| (nm - self.peak_nm()).abs()).imin()];
                share * logistic((at_peak - logit(PASTEL)) / PASTEL_LOGIT)
            }
        }
    }
}

/// Light from behind comes first, so that the rest is what a sheet before black card may have.
static BANDS: [Band; 9] =
    [THROUGH, BRIGHTENER, dye(480.0), dye(505.0), dye(530.0), dye(555.0), dye(580.0), dye(605.0), dye(630.0)];

/// What is behind a sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Backing {
    /// Not stated: light may come through a thin sheet.
    Unknown,
    /// A black card or its like, which sends no light through the sheet.
    Black,
}

impl Backing {
    /// Bands that a sheet before it may have.
    pub(super) fn bands(self) -> &'static [Band] {
        match self {
            Self::Unknown => &BANDS,
            Self::Black => &BANDS[1..],
        }
    }
}
