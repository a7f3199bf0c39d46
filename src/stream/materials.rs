//! Materials: groups of a surface's facets whose reflectance is known, and the model of the others.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Scene;
use super::fields::finite;
use crate::camera::CameraResponse;
use crate::error::{Error, Result};
use crate::forward::FacetModel;
use crate::geometry::Shape;
use crate::kernel::surface::lit::LitSurface;

/// A group of facets of known reflectance, on the scene's wavelengths.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema, PartialEq)]
pub struct Material {
    /// The group's name.
    pub group: String,
    /// Built-in name or file.
    pub name: String,
    /// Reflectance, a number a waveband.
    #[schemars(inner(range(min = 0, max = 1)))]
    pub reflectance: Vec<f64>,
}

impl Scene {
    /// Says which groups are of known reflectance.
    ///
    /// # Errors
    /// [`Error::Field`] if a number is not finite.
    pub fn set_materials(&mut self, materials: &[Material]) -> Result<()> {
        finite("materials", materials.iter().flat_map(|material| &material.reflectance))?;
        self.fields.set("materials", materials)
    }

    /// The materials that are known; none where the surface is of one reflectance.
    ///
    /// # Errors
    /// [`Error::Field`] if a reflectance is none, or not on the scene's wavelengths.
    pub fn materials(&self) -> Result<Vec<Material>> {
        let materials: Vec<Material> = self.fields.get("materials")?.unwrap_or_default();
        let bands = self.grid()?.len();
        for (n, Material { group, reflectance, .. }) in materials.iter().enumerate() {
            if materials[..n].iter().any(|other| other.group == *group) {
                return Err(Error::field("materials", format!("'{group}' has two reflectances; keep one")));
            }
            if reflectance.len() != bands || !reflectance.iter().all(|r| (0.0..=1.0).contains(r)) {
                let problem = format!("that of '{group}' needs a number from 0 to 1 a waveband");
                return Err(Error::field("materials", problem));
            }
        }
        Ok(materials)
    }

    /// The model of a surface that is no fold.
    pub(super) fn surface_model(&self) -> Result<FacetModel> {
        self.surface_model_seen_by(self.source_responses()?)
    }

    /// The same as others see it: `cameras` are responses to the sources.
    ///
    /// # Errors
    /// As [`Scene::model`].
    pub fn surface_model_seen_by(&self, cameras: Vec<CameraResponse>) -> Result<FacetModel> {
        if self.fields.has("reference_panel") {
            let problem = "panels are those of a fold; say which group is known with --material GROUP=SPEC";
            return Err(Error::field("reference_panel", problem));
        }
        let materials = self.materials()?;
        if materials.is_empty() {
            let lights: Vec<_> = self.responses()?.into_iter().zip(cameras).collect();
            return Ok(FacetModel::of_surface(&lights));
        }
        let part_of_facet = part_of_facets(&self.shape()?, &materials)?;
        let exchange = self.lit_surface()?.reduce(&part_of_facet, self.tolerance()?)?;
        let known = materials.into_iter().map(|material| Some(material.reflectance));
        let parts: Vec<_> = std::iter::once(None).chain(known).collect();
        FacetModel::beside_known(&exchange, &parts, &cameras)
    }

    /// The surface in its light, divided as its response was solved.
    ///
    /// # Errors
    /// As [`Scene::shape`] and [`Scene::sources`].
    pub fn lit_surface(&self) -> Result<LitSurface> {
        LitSurface::again(&self.shape()?, &self.sources()?, self.unknowns()?, self.tolerance()?)
    }
}

/// The part of every facet: 0 where nothing is known, then one a material.
fn part_of_facets(shape: &Shape, materials: &[Material]) -> Result<Vec<usize>> {
    let mut part_of = vec![0; shape.len()];
    for (n, material) in materials.iter().enumerate() {
        let mut groups = shape.groups().iter().filter(|group| group.name == material.group).peekable();
        if groups.peek().is_none() {
            let names: Vec<_> = shape.groups().iter().map(|group| group.name.as_str()).collect();
            let problem = format!("no group is called '{}'; there are {}", material.group, names.join(", "));
            return Err(Error::field("materials", problem));
        }
        groups.for_each(|group| part_of[group.facets.clone()].fill(n + 1));
    }
    if part_of.contains(&0) {
        Ok(part_of)
    } else {
        Err(Error::field("materials", "all groups are known: leave out the one that is the sheet"))
    }
}
