//! Materials: groups of a surface's facets whose reflectance is known.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Scene;
use super::fields::finite;
use crate::error::{Error, Result};

/// A group of facets of known reflectance, at the wavelengths of the scene.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema, PartialEq)]
pub struct Material {
    /// The group's name.
    pub group: String,
    /// Built-in name or file.
    pub name: String,
    /// Reflectance, one per waveband.
    #[schemars(inner(range(min = 0, max = 1)))]
    pub reflectance: Vec<f64>,
}

impl Scene {
    /// Sets the groups of known reflectance.
    ///
    /// # Errors
    /// [`Error::Field`] if a number is not finite.
    pub fn set_materials(&mut self, materials: &[Material]) -> Result<()> {
        finite("materials", materials.iter().flat_map(|material| &material.reflectance))?;
        self.fields.set("materials", materials)
    }

    /// The known materials; empty if the surface has one reflectance.
    ///
    /// # Errors
    /// [`Error::Field`] if a number is not a reflectance, or not on the scene's wavelengths.
    pub fn materials(&self) -> Result<Vec<Material>> {
        let materials: Vec<Material> = self.fields.get("materials")?.unwrap_or_default();
        let bands = self.grid()?.len();
        for (n, Material { group, reflectance, .. }) in materials.iter().enumerate() {
            if materials[..n].iter().any(|other| other.group == *group) {
                return Err(Error::field("materials", format!("'{group}' has two reflectances; keep one")));
            }
            if reflectance.len() != bands || !reflectance.iter().all(|r| (0.0..=1.0).contains(r)) {
                let problem = format!("that of '{group}' needs one number from 0 to 1 per waveband");
                return Err(Error::field("materials", problem));
            }
        }
        Ok(materials)
    }
}
