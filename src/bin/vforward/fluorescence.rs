//! What the sheets send out beside what they reflect, as the flags say it.

use vfold::spectrum::{Outside, WavelengthGrid};
use vfold::{Error, Result};

use super::Args;

/// The part of white's light that `--fluorescence` names, on the wavelengths of `grid`.
///
/// # Errors
/// [`Error::Usage`] in several lights, in which one sheet sends out different parts; as [`Common::one_fluorescence`](vfold::cli::Common).
pub fn of(args: &Args, grid: &WavelengthGrid) -> Result<Option<Vec<f64>>> {
    let Some(spec) = &args.fluorescence else { return Ok(None) };
    if args.optics.illuminant.len() > 1 || args.optics.sky_illuminant.is_some() {
        let problem = "what a sheet sends out in one light is another part of white's in a second one";
        return Err(Error::usage("--fluorescence", problem, "give one --illuminant"));
    }
    let spectrum = args.common.one_fluorescence("--fluorescence", spec)?;
    spectrum.on(grid, Outside::Refuse).map(Some)
}
