//! Any surface under its sources: a response to each, and groups of known reflectance if it has any.

use super::camera::{illuminant_responses, sky_response};
use crate::camera::CameraResponse;
use crate::error::{Error, Result};
use crate::forward::{FacetModel, OpenLight};
use crate::geometry::LightSource;
use crate::stream::{Material, Optics, Scene};
use crate::surfaces::Shape;
use crate::surfaces::kernel::lit::LitSurface;

/// A surface that is not a fold, or a fold under other sources, before a camera.
pub struct SurfaceSetting<'a> {
    /// Its record.
    pub scene: &'a Scene,
}

impl SurfaceSetting<'_> {
    /// The camera's responses to the sources. If there are several illuminants, each belongs to a source,
    /// skies aside, or, with a single source, to a picture.
    ///
    /// # Errors
    /// [`Error::Field`] if camera or illuminants are missing or not on the scene's wavelengths, or if there
    /// are several illuminants but not one per source.
    pub fn source_responses(&self) -> Result<Vec<CameraResponse>> {
        let sources = self.scene.sources()?;
        let responses = self.lamp_responses(&sources)?;
        let sky = sky_response(&self.scene.optics()?, &responses[0])?;
        self.of_sources(&responses, &sky)
    }

    /// Arranges values in the order of the sources: `lamps` in their own order, repeated, and `sky` for every
    /// sky.
    pub(super) fn of_sources<T: Clone>(&self, lamps: &[T], sky: &T) -> Result<Vec<T>> {
        let mut of_lamps = lamps.iter().cycle();
        let of = |source: &LightSource| if source.is_sky() { Some(sky) } else { of_lamps.next() };
        Ok(self.scene.sources()?.iter().filter_map(of).cloned().collect())
    }

    /// One response for all sources, or one for each that is not a sky.
    fn lamp_responses(&self, sources: &[LightSource]) -> Result<Vec<CameraResponse>> {
        let optics = self.scene.optics()?;
        let Optics { grid, camera, illuminants, .. } = &optics;
        let pictures = illuminant_responses(&optics)?;
        let lamps = lamps(sources);
        if lamps <= 1 {
            return Ok(vec![CameraResponse::of_pictures(pictures)]);
        }
        if illuminants.len() > 1 && illuminants.len() != lamps {
            let problem = format!(
                "{} for {lamps} sources; give --illuminant once, or once per source",
                illuminants.len()
            );
            return Err(Error::field("illuminants", problem));
        }
        // Powers are relative: the amounts of light from the sources refer to the first one's strongest
        // channel.
        let others = illuminants[1..]
            .iter()
            .map(|illuminant| pictures[0].to_other_light(grid, &camera.sensitivities, &illuminant.power));
        std::iter::once(Ok(pictures[0].clone())).chain(others).collect()
    }

    pub(super) fn open_light(&self) -> Result<OpenLight> {
        let responses = self.source_responses()?;
        Ok(OpenLight::new(&self.scene.sources()?.into_iter().zip(responses).collect::<Vec<_>>()))
    }

    pub(super) fn pictures(&self) -> Result<usize> {
        Ok(if lamps(&self.scene.sources()?) > 1 { 1 } else { self.scene.illuminants()?.len() })
    }

    pub(super) fn model(&self) -> Result<FacetModel> {
        self.model_of(&self.source_responses()?)
    }

    /// The model as seen by one `eye` in all lights.
    ///
    /// # Errors
    /// As [`Setting::model`](super::Setting::model).
    pub fn model_seen_by(&self, eye: &CameraResponse) -> Result<FacetModel> {
        self.model_of(&vec![eye.clone(); self.scene.sources()?.len()])
    }

    /// The model for these responses to the sources.
    fn model_of(&self, cameras: &[CameraResponse]) -> Result<FacetModel> {
        if self.scene.fields.has("reference_panel") {
            let problem = "only folds have panels; state known groups with --material GROUP=SPEC";
            return Err(Error::field("reference_panel", problem));
        }
        let materials = self.scene.materials()?;
        if materials.is_empty() {
            let lights: Vec<_> = self.scene.responses()?.into_iter().zip(cameras.iter().cloned()).collect();
            return Ok(FacetModel::of_surface(&lights));
        }
        let part_of_facet = part_of_facets(&self.scene.shape()?, &materials)?;
        let exchange = self.lit()?.reduce(&part_of_facet, self.scene.tolerance()?)?;
        let known = materials.into_iter().map(|material| Some(material.reflectance));
        let parts: Vec<_> = std::iter::once(None).chain(known).collect();
        FacetModel::with_known(&exchange, &parts, cameras)
    }

    /// The surface in its light, with the mesh on which its response was solved.
    ///
    /// # Errors
    /// As [`Scene::shape`] and [`Scene::sources`].
    pub fn lit(&self) -> Result<LitSurface> {
        let (unknowns, tolerance) = (self.scene.unknowns()?, self.scene.tolerance()?);
        LitSurface::again(&self.scene.shape()?, &self.scene.sources()?, unknowns, tolerance)
    }
}

/// Number of sources that are not skies.
fn lamps(sources: &[LightSource]) -> usize {
    sources.iter().filter(|source| !source.is_sky()).count()
}

/// The part of every facet: 0 where nothing is known, then one number per material.
fn part_of_facets(shape: &Shape, materials: &[Material]) -> Result<Vec<usize>> {
    let mut part_of = vec![0; shape.len()];
    for (n, material) in materials.iter().enumerate() {
        let mut groups = shape.groups().iter().filter(|group| group.name == material.group).peekable();
        if groups.peek().is_none() {
            let names: Vec<_> = shape.groups().iter().map(|group| group.name.as_str()).collect();
            let problem = format!("no group is called '{}'; groups are {}", material.group, names.join(", "));
            return Err(Error::field("materials", problem));
        }
        groups.for_each(|group| part_of[group.facets.clone()].fill(n + 1));
    }
    if part_of.contains(&0) {
        Ok(part_of)
    } else {
        Err(Error::field("materials", "all groups are known; leave out the one that is the sheet"))
    }
}
