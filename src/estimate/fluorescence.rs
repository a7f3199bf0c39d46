//! What a sheet sends out itself, as an estimate has it.

use super::doubt::Doubt;
use super::emission::Origin;

/// Light through a sheet is worth a word from this part of white on.
const NOTEWORTHY: f64 = 0.01;

/// What a sheet sends out itself.
#[derive(Clone, Debug, PartialEq)]
pub struct Fluorescence {
    /// How probable it is that it sends out anything.
    pub probability: f64,
    /// What most probably excites it.
    pub origin: Origin,
    /// Where most is sent out, nm.
    pub peak_nm: f64,
    /// The fraction of white there under the light of the scene, and its standard deviation.
    pub size: f64,
    /// Standard deviation of the size.
    pub size_sd: f64,
    /// Total radiance factor in every waveband, what is reflected and what is sent out under the light of the
    /// scene.
    pub total_radiance_factor: Vec<f64>,
    /// Its standard deviation.
    pub total_radiance_factor_sd: Vec<f64>,
}

impl Fluorescence {
    /// What it says against an estimate: light that bounces excites what visible light excites, too, which is
    /// not estimated.
    #[must_use]
    pub fn doubt(&self) -> Option<Doubt> {
        let remedy = "measure it with a bispectral instrument";
        let because = || {
            format!("this sheet fluoresces at about {:.0} nm; vfold can't measure it", self.rounded_peak_nm())
        };
        (self.origin == Origin::Visible).then(|| Doubt::new(because(), remedy))
    }

    /// What a brightener does, or light from behind, in words.
    #[must_use]
    pub fn words(&self) -> Option<String> {
        let Self { probability, size, size_sd, .. } = self;
        let per_cent = 100.0 * probability;
        match self.origin {
            Origin::Ultraviolet => Some(format!(
                "with a probability of {per_cent:.0} % the sheet is brightened: \
                 at about {:.0} nm it sends out {size:.2} ± {size_sd:.2} of white under this light",
                self.rounded_peak_nm()
            )),
            Origin::Behind if *size > NOTEWORTHY => Some(format!(
                "with a probability of {per_cent:.0} % light from behind comes through the sheet, \
                 {size:.2} ± {size_sd:.2} of white; back it with black card"
            )),
            Origin::Behind | Origin::Visible => None,
        }
    }

    /// Nobody sees a peak closer than that.
    fn rounded_peak_nm(&self) -> f64 {
        10.0 * (self.peak_nm / 10.0).round()
    }
}
