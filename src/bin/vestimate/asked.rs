//! What the flags ask of every sample.

use vfold::Result;
use vfold::estimate::Exposure;
use vfold::estimate::noise::Noise;
use vfold::estimate::unknowns::{self, AUTO, EXPOSURE, Unknown};
use vfold::stream::Sample;

use super::Args;
use super::settings::NoiseSd;

/// The flags, and what follows from them for every sample.
pub struct Asked<'a> {
    pub args: &'a Args,
    /// What is fitted along with the spectrum.
    pub fit: Vec<&'static Unknown>,
}

impl<'a> Asked<'a> {
    /// That of some flags.
    pub fn new(args: &'a Args) -> Self {
        Self { args, fit: if args.fit.contains(&&AUTO) { Vec::new() } else { unknowns::of_flags(&args.fit) } }
    }

    /// How the exposure enters, `stated` being what the sample states.
    pub fn exposure_or(&self, stated: Exposure) -> Exposure {
        let fits = self.fit.contains(&&EXPOSURE);
        self.args.exposure.or(fits.then_some(Exposure::Free)).unwrap_or(stated)
    }

    /// How the exposure of a sample enters.
    pub fn exposure_of(&self, sample: &Sample) -> Result<Exposure> {
        Ok(self.exposure_or(sample.exposure()?.map_or(Exposure::Free, Exposure::Known)))
    }

    /// What facets are worth.
    pub fn noise(&self, sample: &Sample) -> Result<Noise> {
        let sd = match self.args.noise_sd {
            NoiseSd::All(sd) => Some(sd),
            NoiseSd::Auto => None,
        };
        sample.noise(sd, self.args.model_error)
    }
}
