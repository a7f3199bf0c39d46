//! The estimated emission of a sheet.

use super::doubt::Doubt;
use super::emission::Origin;

/// Least amount of light through a sheet worth mentioning, as a fraction of white.
const NOTEWORTHY: f64 = 0.01;

/// The emission of a sheet.
#[derive(Clone, Debug, PartialEq)]
pub struct Fluorescence {
    /// Probability that it emits anything.
    pub probability: f64,
    /// The most probable cause.
    pub origin: Origin,
    /// Wavelength of strongest emission, nm.
    pub peak_nm: f64,
    /// Emission there under the light of the scene, as a fraction of white.
    pub size: f64,
    /// Standard deviation of the size.
    pub size_sd: f64,
    /// Total radiance factor per waveband: reflection plus emission under the light of the scene.
    pub total_radiance_factor: Vec<f64>,
    /// Its standard deviation.
    pub total_radiance_factor_sd: Vec<f64>,
}

impl Fluorescence {
    /// The doubt that it casts on an estimate: bands of dyes differ from the model's, and are large.
    #[must_use]
    pub fn doubt(&self) -> Option<Doubt> {
        let because = self.words().filter(|_| self.origin == Origin::Visible)?;
        Some(Doubt::new(because, "measure it with a bispectral instrument"))
    }

    /// A sentence about it; `None` if it is not worth mentioning.
    #[must_use]
    pub fn words(&self) -> Option<String> {
        let Self { probability, size, size_sd, .. } = self;
        let (per_cent, peak_nm) = (100.0 * probability, self.rounded_peak_nm());
        match self.origin {
            Origin::Ultraviolet => Some(format!(
                "with a probability of {per_cent:.0} % the sheet contains a brightener: \
                 at about {peak_nm:.0} nm it emits {size:.2} ± {size_sd:.2} of white under this light",
            )),
            Origin::Behind => (*size > NOTEWORTHY).then(|| {
                format!(
                    "with a probability of {per_cent:.0} % light from behind comes through the sheet, \
                     {size:.2} ± {size_sd:.2} of white; back it with black card"
                )
            }),
            Origin::Visible => {
                Some(format!("this sheet fluoresces at about {peak_nm:.0} nm; vfold cannot measure it"))
            }
        }
    }

    /// The peak is not known more precisely than this.
    fn rounded_peak_nm(&self) -> f64 {
        10.0 * (self.peak_nm / 10.0).round()
    }
}
