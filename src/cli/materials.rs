//! Flags for groups of a shape with known reflectance.

use clap::Args;

use super::Common;
use crate::error::{Error, Result};
use crate::spectrum::{Outside, WavelengthGrid};
use crate::stream::Material;

/// Groups of known reflectance.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Materials")]
pub struct MaterialArgs {
    /// Reflectance of a group of a shape's facets; repeat for several groups. All other facets are the
    /// sheet
    #[arg(long, value_name = "GROUP=SPEC", value_parser = group_and_spec)]
    pub material: Vec<(String, String)>,
}

impl MaterialArgs {
    /// The materials on the wavelengths of `grid`.
    ///
    /// # Errors
    /// As [`Common::one_reflectance`]; [`Error::Usage`] if a group has two, or one does not cover the
    /// wavelengths.
    pub fn on(&self, grid: &WavelengthGrid, common: &Common) -> Result<Vec<Material>> {
        let mut materials: Vec<Material> = Vec::new();
        for (group, spec) in &self.material {
            if materials.iter().any(|material| material.group == *group) {
                return Err(Error::usage("--material", format!("'{group}' is stated twice"), "keep one"));
            }
            let spectrum = common.one_reflectance("--material", spec)?;
            let reflectance = spectrum.on(grid, Outside::Refuse).map_err(|e| e.of_flag("--material"))?;
            materials.push(Material { group: group.clone(), name: spectrum.name().to_owned(), reflectance });
        }
        Ok(materials)
    }
}

fn group_and_spec(text: &str) -> std::result::Result<(String, String), String> {
    match text.split_once('=') {
        Some((group, spec)) if !group.is_empty() && !spec.is_empty() => {
            Ok((group.to_owned(), spec.to_owned()))
        }
        _ => Err("write GROUP=SPEC, such as floor=cc24:white".to_owned()),
    }
}
