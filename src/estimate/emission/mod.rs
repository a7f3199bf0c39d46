//! Light emitted by a fluorescent sheet, as a fraction f of white under the light falling on it.
//!
//! Reflected light bounces on, and so does the part q of the exciting light that the sheet does not absorb:
//! radiosity is `(I − ρK)⁻¹(ρ + f(I − qK)⁻¹)E₀` at every wavelength, if light and kernel are those of the
//! exciting wavelengths, too. A band is log-normal in wavenumbers, with unknown size, position and width. A
//! sheet has at most one band, which is weighed by evidence.

mod bands;
mod excitation;
mod sent;
pub(super) mod terms;

use std::iter;

use nalgebra::{DMatrix, DVector};

use super::gaussian::logistic;
use super::prior::{Class, Prior};
use super::unknowns::Normal;
use bands::Band;
pub use bands::{Backing, Origin};
use excitation::{excitation, falling, is_enough, power_near};
pub use sent::Sent;
pub(super) use sent::{EXCITING_PLACE, UNKNOWNS};
use sent::{FALL, ln_log_normal};
use terms::ExcitingBounces;

/// Lower limit on the power of a light relative to its mean: between the lines of a lamp f would be
/// unbounded.
const LEAST_POWER: f64 = 0.02;

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
    /// Power of the light about the usual peak, divided by that in every waveband.
    by_light: DVector<f64>,
    /// Change of the logit of reflectance per unit of the fall.
    falling: DVector<f64>,
    usual: DVector<f64>,
}

/// Standard normal numbers of the sizes for which forecasts are made, with their probabilities.
pub(super) const SIZES: [(f64, f64); 5] = [(0.07, -2.0), (0.24, -1.0), (0.38, 0.0), (0.24, 1.0), (0.07, 2.0)];

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
        let falling = falling(&wavelengths_nm);
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
            own.by_light *= power_near(band.peak_nm(), &own.wavelengths_nm, &power);
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
        band.origin != Origin::Ultraviolet || is_enough(self.excitation)
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
        let share = |band: &Band| band.share(&self.wavelengths_nm, logits);
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
