//! What the flags request for every sample.

use vfold::Result;
use vfold::estimate::Exposure;
use vfold::estimate::noise::Noise;
use vfold::estimate::unknowns::{self, AUTO, EXPOSURE, Unknown};
use vfold::stream::Sample;

use super::Args;
use super::settings::NoiseSd;

/// The flags, and their consequences for every sample.
pub struct Asked<'a> {
    pub args: &'a Args,
    /// The unknowns fitted with the spectrum.
    pub fit: Vec<&'static Unknown>,
}

impl<'a> Asked<'a> {
    /// From these flags.
    pub fn new(args: &'a Args) -> Self {
        Self { args, fit: if args.fit.contains(&&AUTO) { Vec::new() } else { unknowns::of_flags(&args.fit) } }
    }

    /// Treatment of the exposure, with `stated` from the sample.
    pub fn exposure_or(&self, stated: Exposure) -> Exposure {
        let fits = self.fit.contains(&&EXPOSURE);
        self.args.exposure.or(fits.then_some(Exposure::Free)).unwrap_or(stated)
    }

    /// Treatment of a sample's exposure.
    pub fn exposure_of(&self, sample: &Sample) -> Result<Exposure> {
        Ok(self.exposure_or(sample.exposure()?.map_or(Exposure::Free, Exposure::Known)))
    }

    /// The noise of facets.
    pub fn noise(&self, sample: &Sample) -> Result<Noise> {
        let sd = match self.args.noise_sd {
            NoiseSd::All(sd) => Some(sd),
            NoiseSd::Auto => None,
        };
        sample.noise(sd, self.args.model_error)
    }
}
