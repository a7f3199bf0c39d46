//! `--method park|khan`: flat sheets, whose spectrum is a combination of few components.

use clap::{Args, ValueEnum};
use nalgebra::DMatrix;
use vfold::estimate::components::{FlatSheet, autocorrelation};
use vfold::estimate::{Estimate, khan, park};
use vfold::forward::FacetModel;
use vfold::spectrum::{self, Outside, Spectrum, WavelengthGrid};
use vfold::{Error, Result};

use super::settings::{NoiseSd, Smoothness};

/// Smoothness of Park's method: with three lights and no noise it has its least error on the 24 patches about there.
const PARK_SMOOTHNESS: f64 = 1e-4;

/// How a spectrum is found.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum MethodName {
    /// From the bounces of light between the panels of a fold.
    Interreflection,
    /// Flat sheet: combination of principal components, smooth.
    Park,
    /// Flat sheet: combination of the components that sensors and lights see.
    Khan,
}

/// The method, and what those of flat sheets need.
#[derive(Args)]
#[command(next_help_heading = "Flat sheets")]
pub struct MethodArgs {
    /// From the bounces in a fold, or from the mean colour of a flat sheet (vkernel --angle-deg 180): Park 2007, principal
    /// components and smoothness; Khan 2013, the components that sensors and lights see
    #[arg(long, value_name = "METHOD", default_value = "interreflection", hide_possible_values = true)]
    pub method: MethodName,
    /// Components that a spectrum is combined of [default: 8 for park, 9 for khan, no more than channels times lights]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1000))]
    pub components: Option<u16>,
    /// Spectra that have the components [default: munsell]
    #[arg(long, value_name = "SPEC")]
    pub basis: Option<String>,
}

/// A method of flat sheets as the flags ask for.
pub struct FlatMethod {
    name: &'static str,
    components: Option<usize>,
    basis: Vec<Spectrum>,
    basis_name: String,
    smoothness: f64,
}

/// The same in a scene.
pub struct FlatContext {
    name: &'static str,
    components: usize,
    autocorrelation: DMatrix<f64>,
    smoothness: f64,
    /// What is known of spectra beforehand.
    pub prior: String,
}

/// Refuses flags that the method does not know.
fn check(args: &super::Args, name: &str) -> Result<()> {
    let surplus = [
        ("--prior", args.prior.is_some()),
        ("--noise-sd", !matches!(args.noise_sd, NoiseSd::Auto)),
        ("--model-error", args.model_error.is_some()),
        ("--fit", !args.fit.is_empty()),
        ("--start", args.start.is_some()),
        ("--reference-panel", args.reference_panel.is_some()),
        ("--trace", args.trace.is_some()),
        ("--plan", args.planning.plan),
    ];
    match surplus.into_iter().find(|(_, given)| *given) {
        Some((flag, _)) => {
            Err(Error::usage(flag, format!("not known to --method {name}"), "leave one of them out"))
        }
        None => Ok(()),
    }
}

impl FlatMethod {
    /// The method that the flags ask for, if it is one of flat sheets.
    pub fn of(args: &super::Args) -> Result<Option<Self>> {
        let MethodArgs { method, components, basis } = &args.method;
        let (name, smoothness) = match method {
            MethodName::Park => ("park", PARK_SMOOTHNESS),
            MethodName::Khan => ("khan", 0.0),
            MethodName::Interreflection => {
                let given = [("--components", components.is_some()), ("--basis", basis.is_some())];
                let surplus = given.into_iter().find(|(_, given)| *given);
                return surplus.map_or(Ok(None), |(flag, _)| {
                    Err(Error::usage(flag, "not known to --method interreflection", "give park or khan"))
                });
            }
        };
        check(args, name)?;
        let smoothness = match args.smoothness {
            None => smoothness,
            Some(Smoothness::Weight(weight)) => weight,
            Some(Smoothness::Auto) => {
                return Err(Error::usage(
                    "--smoothness",
                    format!("auto with --method {name}"),
                    "give a number",
                ));
            }
        };
        let basis_name = basis.clone().unwrap_or_else(|| super::estimator::MUNSELL.to_owned());
        let basis = spectrum::reflectances(&basis_name)?;
        Ok(Some(Self { name, components: components.map(usize::from), basis, basis_name, smoothness }))
    }

    /// The method in a scene of these wavelengths.
    pub fn on(&self, grid: &WavelengthGrid, model: &FacetModel) -> Result<FlatContext> {
        let Self { name, smoothness, basis_name, .. } = self;
        let values = model.sources()[0].camera.channels();
        let usual = if *name == "park" { park::COMPONENTS } else { khan::COMPONENTS };
        let components = self.components.unwrap_or(usual.min(values));
        if components > self.basis.len() || (*name == "khan" && components > values) {
            let (spectra, problem) = (self.basis.len(), format!("{components} are more than there are"));
            let remedy =
                format!("{basis_name} has {spectra} spectra, channels and lights give {values} values");
            return Err(Error::usage("--components", problem, remedy));
        }
        let spectra: Vec<_> =
            self.basis.iter().map(|spectrum| spectrum.on(grid, Outside::Refuse)).collect::<Result<_>>()?;
        Ok(FlatContext {
            name,
            components,
            autocorrelation: autocorrelation(&spectra),
            smoothness: *smoothness,
            prior: format!("{components} components of {basis_name}"),
        })
    }
}

impl FlatContext {
    /// Name of the method.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// The spectrum of a sheet.
    pub fn estimate(&self, sheet: &FlatSheet) -> Result<Estimate> {
        let method = if self.name == "park" { park::estimate } else { khan::estimate };
        method(sheet, &self.autocorrelation, self.components, self.smoothness)
    }
}
