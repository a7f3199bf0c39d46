//! Emission of the sheets in addition to their reflection, from the flags.

use vfold::forward::BispectralLight;
use vfold::scene::Setting;
use vfold::spectrum::{Bispectral, Outside, Spectrum, WavelengthGrid, in_ultraviolet};
use vfold::{Error, Result};

use super::Args;

/// The emission of sheets.
pub enum Emission {
    /// None: reflection only.
    None,
    /// A fraction of white under the same light, wherever light falls directly.
    Part(Vec<f64>),
    /// The response of their Donaldson matrices to these lights.
    Excited(Lights),
}

/// The lights of a scene, over the full range of their tables.
pub struct Lights {
    lamps: Vec<Spectrum>,
    sky: Spectrum,
}

impl Emission {
    /// From the flags, on the wavelengths of `grid`.
    ///
    /// # Errors
    /// [`Error::Usage`] for `--fluorescence` in several lights, in which the emitted fractions of one sheet
    /// differ; as [`Common::one_radiance_factor`](vfold::cli::Common::one_radiance_factor).
    pub fn of(args: &Args, grid: &WavelengthGrid) -> Result<Self> {
        if !args.donaldson.is_empty() {
            return Lights::of(args).map(Self::Excited);
        }
        let Some(spec) = &args.fluorescence else { return Ok(Self::None) };
        if args.optics.illuminant.len() > 1 || args.optics.sky_illuminant.is_some() {
            let problem = "the emitted fraction of white's light differs from light to light";
            return Err(Error::usage("--fluorescence", problem, "give one --illuminant"));
        }
        let spectrum = args.common.one_radiance_factor("--fluorescence", spec)?;
        spectrum.on(grid, Outside::Refuse).map(Self::Part)
    }
}

impl Lights {
    fn of(args: &Args) -> Result<Self> {
        let (lamps, sky) = args.optics.lights(&args.common)?;
        let lamps = lamps.into_iter().map(in_ultraviolet).collect::<Result<Vec<_>>>()?;
        let sky = sky.map_or_else(|| Ok(lamps[0].clone()), in_ultraviolet)?;
        Ok(Self { lamps, sky })
    }

    /// Checks that there is only one picture.
    ///
    /// # Errors
    /// [`Error::Usage`] for several.
    pub fn check(&self, setting: &Setting) -> Result<()> {
        if setting.pictures()? > 1 {
            let problem = "a fluorescent sheet is computed under one light at a time";
            return Err(Error::usage("--donaldson", problem, "give one --illuminant"));
        }
        Ok(())
    }

    /// The lights of the model's sources as they excite a sheet.
    ///
    /// # Errors
    /// As [`BispectralLight::new`].
    pub fn on(
        &self,
        sheet: &Bispectral,
        setting: &Setting,
        grid: &WavelengthGrid,
    ) -> Result<Vec<BispectralLight>> {
        let sources = setting.of_sources(&self.lamps, &self.sky)?;
        sources.iter().map(|light| BispectralLight::new(light, grid, sheet)).collect()
    }

    /// The first of the lights that starts at longer wavelengths than those that excite a sheet.
    pub fn begins_late(&self, excited_from_nm: f64) -> Option<&Spectrum> {
        self.lamps.iter().chain([&self.sky]).find(|light| light.range_nm().0 > excited_from_nm)
    }
}
