//! The folded sheets, from the flags.

use std::path::PathBuf;

use vfold::cli;
use vfold::spectrum::{Bispectral, Donaldson, Spectrum, WavelengthGrid};
use vfold::stream::{ReferencePanel, ReflectanceRecord};
use vfold::{Error, Result};

use super::Args;
use super::fluorescence::{Emission, Lights};

/// The folded sheets.
pub enum Subject {
    /// Sheets with one reflectance, each folded alone or facing the card.
    Sheets {
        /// At least one.
        sheets: Vec<Sheet>,
        card: Option<ReferencePanel>,
    },
    /// Files with one reflectance per facet.
    Facets(Vec<PathBuf>),
}

/// A reflectance on the scene's wavelengths.
pub struct Sheet {
    pub id: String,
    pub spectrum: ReflectanceRecord,
    /// Its response to other light, if known.
    pub bispectral: Option<Bispectral>,
}

impl Subject {
    /// From the flags, on the wavelengths of `grid`.
    pub fn of(args: &Args, grid: &WavelengthGrid, emission: &Emission) -> Result<Self> {
        if !args.facet_reflectance.is_empty() {
            return Ok(Self::Facets(args.facet_reflectance.clone()));
        }
        match emission {
            Emission::Excited(lights) => {
                Ok(Self::Sheets { sheets: excited_sheets(args, grid, lights)?, card: None })
            }
            Emission::None | Emission::Part(_) => sheets(args, grid),
        }
    }

    /// The card facing the sheets, if any.
    pub fn card(&self) -> Option<&ReferencePanel> {
        match self {
            Self::Sheets { card, .. } => card.as_ref(),
            Self::Facets(_) => None,
        }
    }
}

fn sheets(args: &Args, grid: &WavelengthGrid) -> Result<Subject> {
    let mut sheets = Vec::new();
    for spec in &args.reflectance {
        for spectrum in args.common.reflectances(spec)? {
            sheets.push(sheet(&spectrum, grid)?);
        }
    }
    let card = match panels(args, grid)? {
        [None, None] => None,
        [Some(card), None] => Some((0, card)),
        [None, Some(card)] => Some((1, card)),
        [Some(_), Some(_)] if !sheets.is_empty() => {
            let problem = "--panel-reflectance already sets both panels";
            return Err(Error::usage("--reflectance", problem, "leave it out"));
        }
        [Some(sheet), Some(card)] => {
            sheets = vec![Sheet { id: format!("{}+{}", sheet.id, card.id), ..sheet }];
            Some((1, card))
        }
    };
    if sheets.is_empty() {
        let problem = "missing, and --panel-reflectance sets only one panel";
        return Err(Error::usage("--reflectance", problem, "give it, or --panel-reflectance for the other"));
    }
    let card = card.map(|(panel, card)| ReferencePanel::new(panel, &card.id, card.spectrum.reflectance));
    Ok(Subject::Sheets { sheets, card })
}

/// The reflectances of single panels.
fn panels(args: &Args, grid: &WavelengthGrid) -> Result<[Option<Sheet>; 2]> {
    let card = args.reference_panel.iter().map(|spec| ("--reference-panel", 1, spec));
    let others = args.panel_reflectance.iter().map(|(panel, spec)| ("--panel-reflectance", *panel, spec));
    let mut panels = [None, None];
    for (flag, panel, spec) in card.chain(others) {
        let known = panels[panel].replace(sheet(&args.common.one_reflectance(flag, spec)?, grid)?);
        if known.is_some() {
            return Err(Error::usage(flag, format!("panel {panel} has two reflectances"), "give one"));
        }
    }
    Ok(panels)
}

/// The sheets from the matrices named by `--donaldson`, on the wavelengths of `grid`.
///
/// # Errors
/// As [`Donaldson::read`] and [`Donaldson::on`].
fn excited_sheets(args: &Args, grid: &WavelengthGrid, lights: &Lights) -> Result<Vec<Sheet>> {
    let sheet = |path: &String| {
        let matrix = Donaldson::read(path)?;
        let excited_from_nm = matrix.excited_from_nm();
        let late = excited_from_nm.and_then(|nm| Some((nm, lights.begins_late(nm)?)));
        if let Some((nm, light)) = late.filter(|_| !args.common.quiet) {
            let (light, from_nm) = (light.name(), light.range_nm().0);
            cli::say(
                "vforward",
                &format!(
                    "{light} is known only from {from_nm} nm: its light from {nm} nm, which excites {path}, \
                     is left out"
                ),
            );
        }
        let spectrum = ReflectanceRecord::on(matrix.reflectance(), grid)?;
        Ok(Sheet { id: matrix.reflectance().name().to_owned(), spectrum, bispectral: Some(matrix.on(grid)?) })
    };
    args.donaldson.iter().map(sheet).collect()
}

fn sheet(spectrum: &Spectrum, grid: &WavelengthGrid) -> Result<Sheet> {
    let (id, spectrum) = (spectrum.name().to_owned(), ReflectanceRecord::on(spectrum, grid)?);
    Ok(Sheet { id, spectrum, bispectral: None })
}

/// Parses `0=SPEC` or `1=SPEC`.
pub fn panel_and_spec(text: &str) -> std::result::Result<(usize, String), String> {
    match text.split_once('=') {
        Some(("0", spec)) => Ok((0, spec.to_owned())),
        Some(("1", spec)) => Ok((1, spec.to_owned())),
        _ => Err("write 0=SPEC or 1=SPEC".to_owned()),
    }
}
