//! `--method` and `--prior`.

use std::sync::Arc;

use vfold::cli;
use vfold::estimate::prior::Prior;
use vfold::estimate::unknowns::{AUTO, EXPOSURE, NONE};
use vfold::estimate::{Exposure, classes};
use vfold::paper::smooth;
use vfold::spectrum::{Outside, Spectrum, WavelengthGrid};
use vfold::{Error, Result};

use super::Args;
use super::flat::FlatEstimator;
use super::latest::Latest;
use super::settings::{MUNSELL, SHEETS, Smoothness};

/// The method, from `--method` and `--prior`.
pub enum Method {
    Map(MapPrior),
    Smooth(Smoothness),
    Flat(FlatEstimator),
}

/// The prior on reflectances.
pub struct MapPrior {
    /// Its spectra, and their classes if known; `None` for the built-in one.
    spectra: Option<(Vec<Spectrum>, Option<Vec<usize>>)>,
    latest: Latest<WavelengthGrid, Arc<Prior>>,
}

impl MapPrior {
    /// The prior on these wavelengths.
    pub fn on(&self, grid: &WavelengthGrid) -> Result<Arc<Prior>> {
        self.latest.get(grid.clone(), |grid| {
            let Some((spectra, classes)) = &self.spectra else {
                return Ok(Arc::new(Prior::built_in(grid.wavelengths_nm())?));
            };
            let on_grid = spectra.iter().map(|one| one.on(grid, Outside::Refuse));
            let on_grid: Vec<_> = on_grid.collect::<Result<_>>().map_err(|e| e.of_flag("--prior"))?;
            Ok(Arc::new(Prior::from_spectra(grid.wavelengths_nm(), &on_grid, classes.as_deref())?))
        })
    }
}

impl Method {
    /// The method that the flags request.
    ///
    /// # Errors
    /// Flags that contradict each other, or spectra that cannot be read.
    pub fn of(args: &Args) -> Result<Self> {
        if let Some(flat) = FlatEstimator::of(args)? {
            return Ok(Self::Flat(flat));
        }
        check_fit(args)?;
        if let Some(error) = args.model_error.filter(|error| !(0.0..=1.0).contains(error)) {
            return Err(Error::usage(
                "--model-error",
                format!("{error} is not a relative error"),
                "give 0 to 1",
            ));
        }
        let is_surplus = args.smoothness.is_some() && args.prior() != "smooth";
        let (problem, remedy) = (format!("not used by --prior {}", args.prior()), "give --prior smooth");
        cli::refuse([("--smoothness", is_surplus)], &problem, remedy)?;
        Ok(match args.prior() {
            "smooth" => Self::Smooth(args.smoothness.unwrap_or(Smoothness::Weight(smooth::SMOOTHNESS))),
            "none" => Self::Smooth(Smoothness::Weight(0.0)),
            SHEETS => Self::Map(MapPrior { spectra: None, latest: Latest::default() }),
            spec => {
                let classes = (spec == MUNSELL).then(classes::of_munsell);
                let spectra = args.common.reflectances(spec)?;
                if spectra.len() < 2 {
                    let problem = format!("'{spec}' holds only one spectrum");
                    return Err(Error::usage("--prior", problem, "name a set or a file of two or more"));
                }
                Self::Map(MapPrior { spectra: Some((spectra, classes)), latest: Latest::default() })
            }
        })
    }
}

/// The paper's estimator fits no unknown of the scene other than the exposure.
fn check_fit(args: &Args) -> Result<()> {
    if args.fit.contains(&EXPOSURE.flag) && args.exposure.is_some_and(|exposure| exposure != Exposure::Free) {
        let problem = "--exposure already sets the exposure";
        return Err(Error::usage("--fit", problem, "leave one of them out"));
    }
    if let Some(alone) = args.fit.iter().find(|flag| [&AUTO, &NONE].contains(flag))
        && args.fit.len() > 1
    {
        let problem = format!("{} cannot be combined with others", alone.value);
        return Err(Error::usage("--fit", problem, "leave it out, or the others"));
    }
    if args.fit.iter().any(|flag| ![EXPOSURE.flag, &NONE].contains(flag)) && !args.has_prior() {
        let problem = format!("with --prior {} only the exposure can be fitted", args.prior());
        return Err(Error::usage("--fit", problem, "leave --prior out, or name spectra"));
    }
    Ok(())
}
