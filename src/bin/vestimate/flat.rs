//! `--method park|khan`: flat sheets, whose spectrum is a combination of a few components.

use std::fmt;

use clap::{Args, ValueEnum};
use nalgebra::DMatrix;
use vfold::Result;
use vfold::cli::refuse;
use vfold::error::counted;
use vfold::estimate::Estimate;
use vfold::forward::FacetModel;
use vfold::paper::components::{FlatSheet, autocorrelation};
use vfold::paper::{khan, park};
use vfold::spectrum::{Outside, Spectrum, WavelengthGrid};

use super::settings::{NoiseSd, Smoothness};

/// A method for flat sheets.
struct FlatMethod {
    name: &'static str,
    /// Default number of components, if as many values are known.
    components: usize,
    /// Default weight of smoothness.
    smoothness: f64,
    estimate: fn(&FlatSheet, &DMatrix<f64>, usize, f64) -> Result<Estimate>,
}

static PARK: FlatMethod = FlatMethod {
    name: "park",
    components: park::COMPONENTS,
    smoothness: park::SMOOTHNESS,
    estimate: park::estimate,
};
static KHAN: FlatMethod = FlatMethod {
    name: "khan",
    components: khan::COMPONENTS,
    smoothness: khan::SMOOTHNESS,
    estimate: khan::estimate,
};

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
    /// Estimate from the bounces in a fold (interreflection), or from the mean colour of a flat sheet
    /// (vkernel --angle-deg 180): park (2007), principal components and smoothness, or khan (2013), the
    /// components that camera and lights can see
    #[arg(long, value_name = "METHOD", default_value = "interreflection", hide_possible_values = true)]
    pub method: MethodName,
    /// Number of components of a spectrum, 1 to 1000
    /// [default: 8 for park, 9 for khan, no more than channels times lights]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1000))]
    pub components: Option<u16>,
    /// Spectra from which the components are computed [default: munsell]
    #[arg(long, value_name = "SPEC")]
    pub basis: Option<String>,
}

/// Estimates of flat sheets as the flags request.
pub struct FlatEstimator {
    method: &'static FlatMethod,
    components: Option<usize>,
    basis: Vec<Spectrum>,
    basis_name: String,
    smoothness: f64,
}

/// The same for the samples of one scene.
pub struct FlatContext {
    method: &'static FlatMethod,
    components: usize,
    autocorrelation: DMatrix<f64>,
    smoothness: f64,
    basis_name: String,
}

impl FlatEstimator {
    /// The method requested by the flags, if it is one for flat sheets.
    pub fn of(args: &super::Args) -> Result<Option<Self>> {
        let MethodArgs { method, components, basis } = &args.method;
        let method = match method {
            MethodName::Park => &PARK,
            MethodName::Khan => &KHAN,
            MethodName::Interreflection => return check_fold(&args.method).map(|()| None),
        };
        check_flat(args, method.name)?;
        let smoothness = match args.smoothness {
            Some(Smoothness::Weight(weight)) => weight,
            _ => method.smoothness,
        };
        let basis_name = basis.clone().unwrap_or_else(|| super::settings::MUNSELL.to_owned());
        let basis = args.common.reflectances(&basis_name)?;
        Ok(Some(Self { method, components: components.map(usize::from), basis, basis_name, smoothness }))
    }

    /// The method on the wavelengths of a scene, with its channels.
    pub fn context(&self, grid: &WavelengthGrid, model: &FacetModel) -> Result<FlatContext> {
        let spectra = self.basis.iter().map(|spectrum| spectrum.on(grid, Outside::Refuse));
        let spectra: Vec<_> = spectra.collect::<Result<_>>().map_err(|e| e.of_flag("--basis"))?;
        let known = model.sources()[0].camera.channels().min(spectra.len());
        Ok(FlatContext {
            method: self.method,
            components: self.components.unwrap_or(self.method.components.min(known)),
            autocorrelation: autocorrelation(&spectra),
            smoothness: self.smoothness,
            basis_name: self.basis_name.clone(),
        })
    }
}

impl FlatContext {
    /// Name of the method.
    pub fn name(&self) -> &'static str {
        self.method.name
    }

    /// Name of the spectra from which the components are derived.
    pub fn basis(&self) -> &str {
        &self.basis_name
    }

    /// The spectrum of a sheet.
    pub fn estimate(&self, sheet: &FlatSheet) -> Result<Estimate> {
        (self.method.estimate)(sheet, &self.autocorrelation, self.components, self.smoothness)
    }
}

impl fmt::Display for FlatContext {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { method, components, basis_name, smoothness, .. } = self;
        let components = counted(components, "component");
        write!(f, "{}, {components} of {basis_name}, smoothness {smoothness:e}", method.name)
    }
}

/// Refuses flags that apply to flat sheets only.
fn check_fold(args: &MethodArgs) -> Result<()> {
    let surplus = [("--components", args.components.is_some()), ("--basis", args.basis.is_some())];
    refuse(surplus, "not used by --method interreflection", "give --method park or khan")
}

/// Refuses flags that do not apply to flat sheets.
fn check_flat(args: &super::Args, name: &str) -> Result<()> {
    let surplus = [
        ("--plan", args.planning.plan),
        ("--prior", args.prior.is_some()),
        ("--smoothness auto", matches!(args.smoothness, Some(Smoothness::Auto))),
        ("--noise-sd", !matches!(args.noise_sd, NoiseSd::Auto)),
        ("--model-error", args.model_error.is_some()),
        ("--fit", !args.fit.is_empty()),
        ("--start", args.start.is_some()),
        ("--reference-panel", args.reference_panel.is_some()),
        ("--trace", args.trace.is_some()),
    ];
    refuse(surplus, &format!("not used by --method {name}"), "leave one of them out")
}
