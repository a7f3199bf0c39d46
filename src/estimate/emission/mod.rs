//! Light that a sheet sends out itself where it fluoresces, as a fraction f of white under the light that
//! falls on it.
//!
//! What is reflected bounces on; what is sent out is added once, where the light that excites it is taken in
//! by the sheet and so hardly bounces: radiosity is `(I − ρK)⁻¹(ρ + f)E₀` at every wavelength. A band is
//! log-normal in wavenumbers, with its size, place and width unknown; a sheet has one band or none, which is
//! weighed by evidence.

pub(super) mod terms;

use std::iter;

use nalgebra::{DMatrix, DVector};

use super::gaussian::{logistic, logit};
use super::prior::{Class, Prior};
use super::unknowns::Normal;

/// What is known of a band before a picture is looked at.
#[derive(Debug, PartialEq)]
struct Band {
    /// What excites it.
    origin: Origin,
    /// The largest size, the size being the fraction of white under daylight that is sent out at the peak: no
    /// more photons than are taken in at shorter wavelengths.
    most: f64,
    /// Logit of the part of that.
    size: Normal,
    /// Wavenumber of the peak, 1/cm.
    peak_per_cm: Normal,
    /// Logarithm of the standard deviation of wavenumbers, 1/cm.
    ln_width_per_cm: Normal,
    /// How far the logit of reflectance has fallen at 400 nm, where the sheet takes in what excites it.
    fall: Normal,
    /// How often a sheet of a class has it.
    share: Share,
}

/// Where light comes from that a sheet sends out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// Light from behind, which comes through a thin sheet: nothing fluoresces.
    Behind,
    /// Ultraviolet: an optical brightener.
    Ultraviolet,
    /// Visible light of shorter wavelengths: a fluorescent dye or pigment. What bounces excites, too, which
    /// the model leaves out.
    Visible,
}

impl Origin {
    /// Power of the reflectance with which light is sent out: a sheet takes in of light that goes through it
    /// what it takes in of light that it reflects, and both grow as its colour is paler. By Kubelka and
    /// Munk's equations transmittances of sheets of 1.5 to 8 scattering lengths are as reflectances to powers
    /// of 1.8 to 2.7.
    fn of_reflectance(self) -> i32 {
        match self {
            Self::Behind => 2,
            Self::Ultraviolet | Self::Visible => 0,
        }
    }
}

/// How often sheets have a band.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Share {
    /// All classes of spectra alike.
    OfAll(f64),
    /// That many of those that are white where the band is, hardly any of the deep ones: a brightener is put
    /// into what is to look white.
    OfWhite(f64),
}

/// Reflectance at the peak of a brightener at which half as many sheets as of the white ones are brightened,
/// and the logit over which that falls by e: pastel papers are dyed in the pulp of white ones, of deep
/// colours a brightener would change nothing that is seen.
const PASTEL: f64 = 0.5;
const PASTEL_LOGIT: f64 = 0.5;

/// Stilbenes in paper, cloth and plastics: they take in 300 to 430 nm and send out about 400 to 500 nm, and a
/// brightened sheet is brightest at 435 to 440 nm (A. E. Siegrist et al., "Optical brighteners", *Ullmann's
/// Encyclopedia of Industrial Chemistry* 25 (2012)). A size is as often below a tenth of white as above, two
/// of three lie between a twentieth and a fifth; daylight has photons for 0.7. Half of white paper and washed
/// cloth has one, of other white sheets, such as painted ones, fewer. Where it takes in most, at 370 nm, the
/// logit of reflectance has fallen by about three, from 0.8 to 0.2.
const BRIGHTENER: Band = Band {
    origin: Origin::Ultraviolet,
    most: 0.7,
    size: Normal { mean: -1.7, sd: 0.9 },
    peak_per_cm: Normal { mean: 1e7 / 435.0, sd: 260.0 },
    ln_width_per_cm: Normal { mean: 7.17, sd: 0.2 },
    fall: Normal { mean: 1.5, sd: 0.8 },
    share: Share::OfWhite(0.35),
};

/// Dyes of notes, safety cloth and markers, such as coumarins, fluoresceins and rhodamines: emission from
/// blue green to red, 30 to 70 nm wide at half its peak (J. R. Lakowicz, *Principles of Fluorescence
/// Spectroscopy* (2006), chapter 3), of one sheet in fifty in all.
const fn dye(peak_nm: f64) -> Band {
    let peak_per_cm = 1e7 / peak_nm;
    Band {
        origin: Origin::Visible,
        most: 2.0,
        size: Normal { mean: -1.4, sd: 1.0 },
        // neighbours lie 25 nm apart
        peak_per_cm: Normal { mean: peak_per_cm, sd: 15.0 * peak_per_cm / peak_nm },
        ln_width_per_cm: Normal { mean: 6.8, sd: 0.25 },
        fall: Normal { mean: 0.0, sd: 0.0 },
        share: Share::OfAll(0.02 / 7.0),
    }
}

/// Light of table, ground and sky behind a single sheet in free air, up to a third of white, of which
/// printing paper lets a tenth to a quarter through, cloth more (P. Kubelka, *Journal of the Optical Society
/// of America* 38 (1948), p. 448): broad, rather red than blue. One sheet in twenty is thin and not backed.
const THROUGH: Band = Band {
    origin: Origin::Behind,
    most: 0.3,
    size: Normal { mean: -1.2, sd: 1.0 },
    peak_per_cm: Normal { mean: 1e7 / 600.0, sd: 1500.0 },
    ln_width_per_cm: Normal { mean: 8.7, sd: 0.2 },
    fall: Normal { mean: 0.0, sd: 0.0 },
    share: Share::OfAll(0.05),
};

static BANDS: [Band; 9] =
    [THROUGH, BRIGHTENER, dye(480.0), dye(505.0), dye(530.0), dye(555.0), dye(580.0), dye(605.0), dye(630.0)];

/// What is behind a sheet.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Backing {
    /// Nobody said: perhaps light, if the sheet is thin.
    #[default]
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

/// Where a brightener begins to take in light (Siegrist et al.), and how much further the fall of logits is
/// its amount: at 400 nm.
const FALL_NM: f64 = 430.0;
const FALL_WITHIN_NM: f64 = 30.0;
/// Power of a light below which a share of its mean counts as that: between the lines of a lamp f would have
/// no bounds.
const LEAST_POWER: f64 = 0.02;

/// A band on the wavebands of a scene, in its light. Its unknowns are standard normal numbers, in this order:
/// size, peak, width, fall.
#[derive(Clone, Debug)]
pub struct Emission {
    /// What is known of it; none of a sheet that sends out nothing.
    band: Option<&'static Band>,
    /// What else sheets have.
    all: &'static [Band],
    wavelengths_nm: DVector<f64>,
    /// Power of the light at the usual peak over that in every waveband.
    by_light: DVector<f64>,
    /// Change of the logit of reflectance with the fall.
    falling: DVector<f64>,
    usual: DVector<f64>,
}

/// How skew bands are: half of a band on the side of longer wavelengths is 1.4 times as wide as the other.
const SKEW: f64 = 0.3;

/// Number of unknowns of a band, and the place of the fall among them.
pub(super) const UNKNOWNS: usize = 4;
const FALL: usize = 3;

/// Logarithm of the shape of a band, 1 at its peak, with its first and second derivative, `u` being
/// wavenumbers from the peak in units of the width; none beyond its end.
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

/// What is sent out, with derivatives by the unknowns.
pub struct Sent {
    /// Fraction of white in every waveband, of a sheet of reflectance 1 where it goes with that.
    pub fraction: DVector<f64>,
    /// Waveband by unknown.
    pub slopes: DMatrix<f64>,
    /// Second derivatives of the logarithm in every waveband, for [`Sent::curvature`].
    ln_curvatures: Vec<[[f64; UNKNOWNS]; UNKNOWNS]>,
}

impl Emission {
    /// All bands that a sheet may have in light of this relative `power`, the sheet without a band first.
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
        let falling = wavelengths_nm.map(|nm| -(FALL_NM - nm).max(0.0) / FALL_WITHIN_NM);
        let mut own = Self {
            band,
            all,
            wavelengths_nm,
            by_light: power.map(f64::recip),
            falling,
            usual: DVector::zeros(0),
        };
        if let Some(Band { origin: Origin::Behind, .. }) = band {
            own.by_light.fill(1.0);
        } else if let Some(band) = band {
            own.by_light *= power[own.nearest(band.peak_per_cm.mean)];
        }
        own.usual = own.at(&[0.0; UNKNOWNS]).fraction;
        own
    }

    /// What excites it; none if nothing is sent out.
    #[must_use]
    pub fn origin(&self) -> Option<Origin> {
        Some(self.band?.origin)
    }

    /// What light that is sent out goes with: this power of the reflectance.
    #[must_use]
    pub fn power_of_reflectance(&self) -> i32 {
        self.band.map_or(0, |band| band.origin.of_reflectance())
    }

    /// Number of its unknowns.
    #[must_use]
    pub fn unknowns(&self) -> usize {
        if self.band.is_some() { UNKNOWNS } else { 0 }
    }

    /// Logarithms of the shares of classes of spectra, those of all sheets being given, times how often
    /// sheets of each have it.
    #[must_use]
    pub fn ln_class_shares(&self, of_all: Vec<f64>, prior: &Prior) -> Vec<f64> {
        let means = prior.classes().iter().map(Class::mean);
        iter::zip(of_all, means).map(|(of_class, mean)| of_class + self.ln_share(mean)).collect()
    }

    /// Logarithm of how often sheets of these logits have it.
    #[must_use]
    pub fn ln_share(&self, logits: &DVector<f64>) -> f64 {
        let share = |band: &Band| match band.share {
            Share::OfAll(share) => share,
            Share::OfWhite(share) => {
                let at_peak = logits[self.nearest(band.peak_per_cm.mean)];
                share * logistic((at_peak - logit(PASTEL)) / PASTEL_LOGIT)
            }
        };
        match self.band {
            Some(band) => share(band).ln(),
            None => (1.0 - self.all.iter().map(share).sum::<f64>()).ln(),
        }
    }

    /// Wavelengths, nm.
    #[must_use]
    pub fn wavelengths_nm(&self) -> &[f64] {
        self.wavelengths_nm.as_slice()
    }

    /// The waveband in which most is sent out of all that is this `fraction` of white: where a lamp is dark
    /// fractions are large.
    #[must_use]
    pub fn peak(&self, fraction: &[f64]) -> usize {
        let power = DVector::from_column_slice(fraction).component_div(&self.by_light);
        power.imax()
    }

    /// The place of the waveband that is nearest to a wavenumber.
    fn nearest(&self, per_cm: f64) -> usize {
        self.wavelengths_nm.map(|nm| (1e7 / nm - per_cm).abs()).imin()
    }

    /// What is sent out where the unknowns are `w`, one standard normal number each.
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
        let (ln_size, by_size) = ((band.most * part).ln(), band.size.sd * (1.0 - part));
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

    /// What is usually sent out, as a fraction of white in every waveband.
    #[must_use]
    pub fn usual(&self) -> &DVector<f64> {
        &self.usual
    }

    /// Change of logits where the unknowns are `w`, and its derivative by the fall, which is the unknown of
    /// that place.
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

/// How logits fall towards what excites a band.
pub struct Fall<'a> {
    /// The place of the unknown among those of the band.
    pub place: usize,
    /// How much.
    pub amount: f64,
    /// Standard deviation of that before a picture is looked at.
    pub sd: f64,
    /// Change in every waveband with the amount.
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
            let w = [0.3, -0.8, 0.5, 0.1];
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
    fn white_sheets_are_often_brightened_and_deep_ones_hardly() {
        let prior = Prior::built_in(&grid()).unwrap();
        let all = Emission::all(&grid(), &[1.0; 41], Backing::Black);
        for (n, class) in prior.classes().iter().enumerate() {
            let [plain, brightened] = [0, 1].map(|of| all[of].ln_share(class.mean()).exp());
            let at_430 = logistic(class.mean()[5]);
            assert!((plain + brightened - 0.98).abs() < 1e-9);
            assert!(if at_430 > 0.7 { brightened > 0.25 } else { brightened < 0.3 }, "{n}");
            assert!(at_430 > 0.15 || brightened < 0.02, "{n}: {brightened}");
        }
    }
}
