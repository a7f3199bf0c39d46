//! Light emitted by a fluorescent sheet, as a fraction f of white under the light falling on it.
//!
//! Reflected light bounces on, and so does the part q of the exciting light that the sheet does not absorb:
//! radiosity is `(I − ρK)⁻¹(ρ + f(I − qK)⁻¹)E₀` at every wavelength, if light and kernel are those of the
//! exciting wavelengths, too. A band is log-normal in wavenumbers, with unknown size, position and width. A
//! sheet has at most one band, which is weighed by evidence.

pub(super) mod terms;

use std::iter;

use nalgebra::{DMatrix, DVector};

use super::gaussian::{logistic, logit};
use super::prior::{Class, Prior};
use super::unknowns::Normal;
use terms::ExcitingBounces;

/// Prior on a band.
#[derive(Debug, PartialEq)]
struct Band {
    /// What excites the band.
    origin: Origin,
    /// The maximum size: the size is the fraction of white under daylight that is emitted at the peak, with
    /// no more photons than are absorbed at shorter wavelengths.
    most: f64,
    /// Logit of the size relative to the maximum.
    size: Normal,
    /// Wavenumber of the peak, 1/cm.
    peak_per_cm: Normal,
    /// Logarithm of the standard deviation of wavenumbers, 1/cm.
    ln_width_per_cm: Normal,
    /// Fall of the logit of reflectance at 400 nm, where the sheet absorbs the exciting light.
    fall: Normal,
    /// Logit of the reflectance at the exciting wavelengths; `None` if light from behind takes their place.
    exciting: Option<Normal>,
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
    fn of_reflectance(self) -> i32 {
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
const BRIGHTENER: Band = Band {
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
    fn bands(self) -> &'static [Band] {
        match self {
            Self::Unknown => &BANDS,
            Self::Black => &BANDS[1..],
        }
    }
}

/// Wavelength below which a brightener absorbs (Siegrist et al.), and the distance from it, at 400 nm, over
/// which the logits fall by the amount of the fall.
const FALL_NM: f64 = 430.0;
const FALL_WITHIN_NM: f64 = 30.0;
/// Wavelength from which on power below [`FALL_NM`] stands for all that excites brighteners, and that power
/// relative to the power at the peak of emission in daylight of 6500 K. Incandescent lamps have two thirds of
/// it, and of daylight's ultraviolet; white LEDs hardly any, unless violet ones excite their phosphors;
/// fluorescent lamps a fifth in the waveband of mercury's line at 436 nm, which only fine wavebands resolve.
const EXCITING_NM: f64 = 400.0;
const EXCITING_DAYLIGHT: f64 = 0.92;
/// Lights of less than this share of it are taken to excite no brightener: a usual one would emit less than
/// two per cent of white at the peak.
const LEAST_EXCITATION: f64 = 0.3;
/// Lower limit on the power of a light relative to its mean: between the lines of a lamp f would be
/// unbounded.
const LEAST_POWER: f64 = 0.02;

/// How much of light with this `power` excites brighteners, relative to daylight, at most 1.
fn excitation(wavelengths_nm: &DVector<f64>, power: &DVector<f64>) -> f64 {
    let absorbed = wavelengths_nm.map(|nm| if nm < EXCITING_NM { 0.0 } else { (FALL_NM - nm).max(0.0) });
    let at_peak = power[nearest(wavelengths_nm, BRIGHTENER.peak_per_cm.mean)];
    let exciting = power.dot(&absorbed) / absorbed.sum();
    // wavebands that begin further on say nothing
    if absorbed.sum() > 0.0 { (exciting / at_peak / EXCITING_DAYLIGHT).min(1.0) } else { 1.0 }
}

/// Index of the waveband nearest to a wavenumber.
fn nearest(wavelengths_nm: &DVector<f64>, per_cm: f64) -> usize {
    wavelengths_nm.map(|nm| (1e7 / nm - per_cm).abs()).imin()
}

/// A band on the wavebands of a scene, in its light. Its unknowns are standard normal numbers, in this order:
/// size, peak, width, fall, reflectance at the exciting wavelengths.
#[derive(Clone, Debug)]
pub struct Emission {
    /// Its prior; `None` for a sheet without emission.
    band: Option<&'static Band>,
    /// All bands that a sheet may have.
    all: &'static [Band],
    /// How much of the light excites brighteners, relative to daylight, at most 1.
    excitation: f64,
    wavelengths_nm: DVector<f64>,
    /// Power of the light at the usual peak, divided by that in every waveband.
    by_light: DVector<f64>,
    /// Change of the logit of reflectance per unit of the fall.
    falling: DVector<f64>,
    usual: DVector<f64>,
}

/// Skewness of bands: the half at longer wavelengths is 1.4 times as wide as the other.
const SKEW: f64 = 0.3;

/// Standard normal numbers of the sizes for which forecasts are made, with their probabilities.
pub(super) const SIZES: [(f64, f64); 5] = [(0.07, -2.0), (0.24, -1.0), (0.38, 0.0), (0.24, 1.0), (0.07, 2.0)];

/// Number of unknowns of a band, and the indices of two of them: the fall, and the reflectance at the
/// exciting wavelengths.
pub(super) const UNKNOWNS: usize = 5;
const FALL: usize = 3;
pub(super) const EXCITING_PLACE: usize = 4;

/// Logarithm of the shape of a band, which is 1 at its peak, with first and second derivative; `u` is the
/// wavenumber from the peak in units of the width. `None` beyond the end of the band.
///
/// # Source
/// The log-normal function: D. B. Siano, D. E. Metzler, *Journal of Chemical Physics* 51 (1969), p. 1856, for
/// bands of emission E. A. Burstein, V. I. Emelyanenko, *Photochemistry and Photobiology* 64 (1996), p. 316.
fn ln_log_normal(u: f64) -> Option<[f64; 3]> {
    let rest = 1.0 - SKEW * u;
    if rest <= 0.0 {
        return None;
    }
    let v = -rest.ln() / SKEW;
    let slope = rest.recip();
    Some([-0.5 * v * v, -v * slope, -slope * slope * (1.0 + SKEW * v)])
}

/// Emission, with derivatives by the unknowns.
pub struct Sent {
    /// Fraction of white per waveband, at reflectance 1 if the emission depends on it.
    pub fraction: DVector<f64>,
    /// Waveband by unknown.
    pub slopes: DMatrix<f64>,
    /// Second derivatives of the logarithm in every waveband, for [`Sent::curvature`].
    ln_curvatures: Vec<[[f64; UNKNOWNS]; UNKNOWNS]>,
}

impl Emission {
    /// All bands that a sheet may have in light of this relative `power`, preceded by the sheet without a
    /// band.
    #[must_use]
    pub fn all(wavelengths_nm: &[f64], power: &[f64], backing: Backing) -> Vec<Self> {
        let all = backing.bands();
        let of = |band: Option<&'static Band>| Self::on(wavelengths_nm, power, (band, all));
        iter::once(None).chain(all.iter().map(Some)).map(of).collect()
    }

    fn on(
        wavelengths_nm: &[f64],
        power: &[f64],
        (band, all): (Option<&'static Band>, &'static [Band]),
    ) -> Self {
        let wavelengths_nm = DVector::from_column_slice(wavelengths_nm);
        let power = DVector::from_column_slice(power);
        let power = power.map(|own| own.max(LEAST_POWER * power.mean()));
        let excitation = excitation(&wavelengths_nm, &power);
        let falling = wavelengths_nm.map(|nm| -(FALL_NM - nm).max(0.0) / FALL_WITHIN_NM);
        let mut own = Self {
            band,
            all,
            excitation,
            wavelengths_nm,
            by_light: power.map(f64::recip),
            falling,
            usual: DVector::zeros(0),
        };
        if let Some(Band { origin: Origin::Behind, .. }) = band {
            own.by_light.fill(1.0);
        } else if let Some(band) = band {
            own.by_light *= power[nearest(&own.wavelengths_nm, band.peak_per_cm.mean)];
        }
        own.usual = own.at(&[0.0; UNKNOWNS]).fraction;
        own
    }

    /// The same band in light of another relative `power`.
    #[must_use]
    pub fn in_light(&self, power: &[f64]) -> Self {
        Self::on(self.wavelengths_nm.as_slice(), power, (self.band, self.all))
    }

    /// False for a brightener in light that hardly excites one.
    #[must_use]
    pub fn is_excited(&self) -> bool {
        self.band.is_none_or(|band| self.excites(band))
    }

    fn excites(&self, band: &Band) -> bool {
        band.origin != Origin::Ultraviolet || self.excitation >= LEAST_EXCITATION
    }

    /// What excites the band; `None` without emission.
    #[must_use]
    pub fn origin(&self) -> Option<Origin> {
        Some(self.band?.origin)
    }

    /// Power of the reflectance to which the emission is proportional.
    #[must_use]
    pub fn power_of_reflectance(&self) -> i32 {
        self.band.map_or(0, |band| band.origin.of_reflectance())
    }

    /// Number of its unknowns.
    #[must_use]
    pub fn unknowns(&self) -> usize {
        if self.band.is_some() { UNKNOWNS } else { 0 }
    }

    /// Log probabilities of the classes of spectra, given those for all sheets, plus that of the band for
    /// sheets of each class.
    #[must_use]
    pub fn ln_class_shares(&self, of_all: Vec<f64>, prior: &Prior) -> Vec<f64> {
        let means = prior.classes().iter().map(Class::mean);
        iter::zip(of_all, means).map(|(of_class, mean)| of_class + self.ln_share(mean)).collect()
    }

    /// Logarithm of the probability of the band for sheets with these logits.
    #[must_use]
    pub fn ln_share(&self, logits: &DVector<f64>) -> f64 {
        let share = |band: &Band| match band.share {
            Share::OfAll(share) => share,
            Share::OfWhite(share) => {
                let at_peak = logits[nearest(&self.wavelengths_nm, band.peak_per_cm.mean)];
                share * logistic((at_peak - logit(PASTEL)) / PASTEL_LOGIT)
            }
        };
        match self.band {
            Some(band) => share(band).ln(),
            None => {
                let excited = self.all.iter().filter(|band| self.excites(band));
                (1.0 - excited.map(share).sum::<f64>()).ln()
            }
        }
    }

    /// Wavelengths, nm.
    #[must_use]
    pub fn wavelengths_nm(&self) -> &[f64] {
        self.wavelengths_nm.as_slice()
    }

    /// The waveband of strongest emission for this `fraction` of white; where a lamp is dark, fractions are
    /// large.
    #[must_use]
    pub fn peak(&self, fraction: &[f64]) -> usize {
        let power = DVector::from_column_slice(fraction).component_div(&self.by_light);
        power.imax()
    }

    /// The effect of bounced exciting light on terms with these `poles`, for the unknowns `w`.
    #[must_use]
    pub fn exciting_bounces(&self, poles: &[f64], w: &[f64]) -> ExcitingBounces {
        let reflected = self.band.and_then(|band| band.exciting).map_or([0.0; 3], |Normal { mean, sd }| {
            let q = logistic(mean + sd * w[EXCITING_PLACE]);
            let slope = sd * q * (1.0 - q);
            [q, slope, sd * (1.0 - 2.0 * q) * slope]
        });
        ExcitingBounces::new(poles, reflected)
    }

    /// The emission for the unknowns `w`, each standard normal.
    #[must_use]
    pub fn at(&self, w: &[f64]) -> Sent {
        let bands = self.by_light.len();
        let Some(band) = self.band else {
            return Sent {
                fraction: DVector::zeros(bands),
                slopes: DMatrix::zeros(bands, 0),
                ln_curvatures: Vec::new(),
            };
        };
        let part = logistic(band.size.mean + band.size.sd * w[0]);
        let most = if band.origin == Origin::Ultraviolet { self.excitation * band.most } else { band.most };
        let (ln_size, by_size) = ((most * part).ln(), band.size.sd * (1.0 - part));
        let peak = band.peak_per_cm.mean + band.peak_per_cm.sd * w[1];
        let width = (band.ln_width_per_cm.mean + band.ln_width_per_cm.sd * w[2]).exp();
        let (peak_sd, width_sd) = (band.peak_per_cm.sd / width, band.ln_width_per_cm.sd);
        let mut fraction = self.by_light.clone();
        let mut slopes = DMatrix::zeros(bands, UNKNOWNS);
        let mut ln_curvatures = vec![[[0.0; UNKNOWNS]; UNKNOWNS]; bands];
        for (n, nm) in self.wavelengths_nm.iter().enumerate() {
            let u = (1e7 / nm - peak) / width;
            let Some([ln_shape, slope, bend]) = ln_log_normal(u) else {
                fraction[n] = 0.0;
                continue;
            };
            fraction[n] *= (ln_size + ln_shape).exp();
            // derivatives of u by peak and width
            let by = [-peak_sd, -width_sd * u];
            let twice = [[0.0, peak_sd * width_sd], [peak_sd * width_sd, width_sd * width_sd * u]];
            slopes[(n, 0)] = fraction[n] * by_size;
            ln_curvatures[n][0][0] = -band.size.sd * by_size * part;
            for j in 0..2 {
                slopes[(n, 1 + j)] = fraction[n] * slope * by[j];
                for k in 0..2 {
                    ln_curvatures[n][1 + j][1 + k] = bend * by[j] * by[k] + slope * twice[j][k];
                }
            }
        }
        Sent { fraction, slopes, ln_curvatures }
    }

    /// Sizes relative to the usual one, with their probabilities.
    #[must_use]
    pub fn sizes(&self) -> [(f64, f64); SIZES.len()] {
        let part = |w: f64| self.band.map_or(0.0, |band| logistic(band.size.mean + band.size.sd * w));
        SIZES.map(|(probability, w)| (probability, part(w) / part(0.0)))
    }

    /// The usual emission, as a fraction of white per waveband.
    #[must_use]
    pub fn usual(&self) -> &DVector<f64> {
        &self.usual
    }

    /// Change of logits for the unknowns `w`, with its derivative by the fall and the index of that unknown.
    #[must_use]
    pub fn fall(&self, w: &[f64]) -> Option<Fall<'_>> {
        let band = self.band.filter(|band| band.fall.sd > 0.0)?;
        Some(Fall {
            place: FALL,
            amount: band.fall.mean + band.fall.sd * w[FALL],
            sd: band.fall.sd,
            falling: &self.falling,
        })
    }
}

/// Fall of logits towards the exciting wavelengths of a band.
pub struct Fall<'a> {
    /// Index of the unknown among those of the band.
    pub place: usize,
    /// Amount.
    pub amount: f64,
    /// Its prior standard deviation.
    pub sd: f64,
    /// Change per waveband for unit amount.
    pub falling: &'a DVector<f64>,
}

impl Sent {
    /// Second derivatives of `Σ weight·fraction`, one weight per waveband: unknown by unknown.
    #[must_use]
    pub fn curvature(&self, weights: &DVector<f64>) -> DMatrix<f64> {
        let count = self.slopes.ncols();
        DMatrix::from_fn(count, count, |j, k| {
            let of_band = |n: usize| {
                let product =
                    self.slopes[(n, j)] * self.slopes[(n, k)] / self.fraction[n].max(f64::MIN_POSITIVE);
                weights[n] * (product + self.fraction[n] * self.ln_curvatures[n][j][k])
            };
            (0..self.fraction.len()).map(of_band).sum()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid() -> Vec<f64> {
        (0..41).map(|n| 380.0 + 10.0 * f64::from(n)).collect()
    }

    #[test]
    fn what_is_sent_out_has_its_derivatives() {
        let power: Vec<f64> = grid().iter().map(|nm| 1.0 + 0.3 * (nm / 40.0).sin()).collect();
        let weights = DVector::from_fn(41, |n, _| (n as f64).cos());
        for emission in &Emission::all(&grid(), &power, Backing::Unknown)[1..] {
            let w = [0.3, -0.8, 0.5, 0.1, -0.4];
            let sent = emission.at(&w);
            let moved = |k: usize, by: f64| {
                let mut w = w;
                w[k] += by;
                emission.at(&w)
            };
            let curvature = sent.curvature(&weights);
            for k in 0..UNKNOWNS {
                let [below, above] = [-1e-5, 1e-5].map(|by| moved(k, by));
                let slope = (&above.fraction - &below.fraction) / 2e-5;
                assert!((slope - sent.slopes.column(k)).amax() < 1e-8, "{k}");
                let by = (above.slopes.tr_mul(&weights) - below.slopes.tr_mul(&weights)) / 2e-5;
                assert!((by - curvature.column(k)).amax() < 1e-7, "{k}");
            }
        }
    }

    #[test]
    fn where_a_lamp_is_dark_is_no_peak() {
        // dark at 470 nm
        let power: Vec<f64> = (0..41).map(|n| if n == 9 { 0.1 } else { 1.0 }).collect();
        let all = Emission::all(&grid(), &power, Backing::Black);
        let brightened = all[1].usual();
        assert!((brightened.imax(), all[0].peak(brightened.as_slice())) == (9, 6), "470 nm, 440 nm");
    }

    #[test]
    fn brighteners_emit_in_light_that_excites_them() {
        let in_light = |power: &dyn Fn(f64) -> f64| {
            let power: Vec<f64> = grid().into_iter().map(power).collect();
            let all = Emission::all(&grid(), &power, Backing::Black);
            (all[1].is_excited(), all[1].usual()[6], all[2].is_excited()) // 440 nm
        };
        let (violet, blue) =
            (|nm: f64| (-((nm - 410.0) / 20.0).powi(2)).exp(), |nm: f64| f64::from(nm > 425.0));
        let [white, violet, blue] = [&|_| 1.0, &violet as &dyn Fn(f64) -> f64, &blue].map(in_light);
        assert!(white.0 && violet.0 && !blue.0, "{white:?} {violet:?} {blue:?}");
        assert!(white.1 > 0.05 && blue.1 < 0.01, "{white:?} {blue:?}");
        assert!(white.2 && blue.2, "visible light excites dyes");
    }

    #[test]
    fn white_sheets_are_often_brightened_and_deep_ones_hardly() {
        let prior = Prior::built_in(&grid()).unwrap();
        let all = Emission::all(&grid(), &[1.0; 41], Backing::Black);
        for (n, class) in prior.classes().iter().enumerate() {
            let [plain, brightened] = [0, 1].map(|of| all[of].ln_share(class.mean()).exp());
            let at_430 = logistic(class.mean()[5]);
            assert!((plain + brightened - 0.998).abs() < 1e-9);
            assert!(if at_430 > 0.7 { brightened > 0.25 } else { brightened < 0.32 }, "{n}: {brightened}");
            assert!(at_430 > 0.08 || brightened < 0.03, "{n}: {brightened}");
        }
    }
}
