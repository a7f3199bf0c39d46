//! The scene record with all of its fields.

use schemars::JsonSchema;
use serde::Serialize;

use super::accuracy::AccuracyRecord;
use super::facets::FacetsRecord;
use super::fields::Fields;
use super::geometry::GeometryRecord;
use super::history::HistoryRecord;
use super::light::LightRecord;
use super::materials::Material;
use super::optics::{CameraRecord, SpectrumRecord};
use super::reference_panel::ReferencePanel;
use super::response::ResponseRecord;
use super::scene::{FORMAT, Scene};
use super::skipped::SkippedRecord;
use super::surface::Surface;
use crate::error::Result;
use crate::geometry::{Fold, Light, LightSource};
use crate::response::Response;
use crate::surfaces::SurfaceResponse;

/// A surface and its light, with the response of every facet to all bounces of light. Samples below it in the
/// stream belong to it.
#[derive(Serialize, JsonSchema)]
#[serde(tag = "kind", rename = "scene")]
#[schemars(extend("x-writer" = "vkernel"))]
pub(super) struct SceneRecord {
    /// Format of the stream.
    #[schemars(extend("const" = FORMAT))]
    format: &'static str,
    /// Name.
    id: String,
    /// The surface.
    geometry: GeometryRecord,
    /// The parts of the surface on each of which one colour is measured.
    facets: FacetsRecord,
    /// Where light comes from.
    light: LightRecord,
    /// The effect of all bounces of light, for every reflectance r at once. On a fold under sun and uniform
    /// sky, irradiance 1 on a panel becomes the irradiance `Σ_k residues[i][k] / (1 − r²·poles[k]²)` of its
    /// facet i, and the same with `r·poles[k]·residues[i][k]` of facet i of the other panel; on any other
    /// surface, and on a fold among other sources, a source gives facet i the irradiance `Σ_k residues[i][k]
    /// / (1 − r·poles[k])`.
    response: ResponseRecord,
    #[serde(flatten)]
    further: FurtherRecord,
}

/// What is added to a scene.
#[derive(Default, Serialize, JsonSchema)]
struct FurtherRecord {
    /// How accurately the bounces were solved.
    #[serde(skip_serializing_if = "Option::is_none")]
    accuracy: Option<AccuracyRecord>,
    /// Work that was skipped because the result does not need it.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vkernel, vforward"))]
    skipped: Option<Vec<SkippedRecord>>,
    /// The commands that made the scene and everything below it, in their order.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "all"))]
    history: Option<Vec<HistoryRecord>>,
    /// Wavelengths of all spectra of the scene and its samples, nm, increasing.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vforward, vextract"))]
    wavelengths_nm: Option<Vec<f64>>,
    /// The camera.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vforward, vextract"))]
    camera: Option<CameraRecord>,
    /// Spectra of the light: one for all sources; or one for each source that is not a sky; or, if there is
    /// one source, one for each picture.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 1), extend("x-writer" = "vforward, vextract"))]
    illuminants: Option<Vec<SpectrumRecord>>,
    /// True if the light is unknown: it is estimated with the reflectance, and there are no illuminants.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vextract, vestimate"))]
    illuminant_unknown: Option<bool>,
    /// True if daylight was assumed because no illuminant was stated: its colour is an unknown of the
    /// estimate.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vextract"))]
    daylight_assumed: Option<bool>,
    /// Spectrum of the sky; that of the first illuminant if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vforward, vextract"))]
    sky_illuminant: Option<SpectrumRecord>,
    /// A card of known reflectance in the place of one panel of a fold.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vforward, vestimate"))]
    reference_panel: Option<ReferencePanel>,
    /// Whether black card or the like lies behind the sheet, so that no light comes through it.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vestimate"))]
    backed: Option<bool>,
    /// Groups of facets of known reflectance, on a surface that is not a fold; all other facets are the
    /// sheet.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vforward, vestimate"))]
    materials: Option<Vec<Material>>,
}

impl Scene {
    /// The scene of a fold and its light, with the bounces solved.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if a number is not finite.
    pub fn new(id: &str, fold: &Fold, light: &Light, response: &Response) -> Result<Self> {
        Self::of_record(SceneRecord {
            format: FORMAT,
            id: id.to_owned(),
            geometry: GeometryRecord::Fold(fold.into()),
            facets: FacetsRecord::Grid(fold.into()),
            light: LightRecord::Sun(light.into()),
            response: response.into(),
            further: FurtherRecord::default(),
        })
    }

    /// The scene of any surface under `sources`, with the bounces of each solved.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if a number is not finite.
    pub fn of_surface(
        id: &str,
        surface: &Surface,
        sources: &[LightSource],
        responses: &[SurfaceResponse],
    ) -> Result<Self> {
        Self::of_record(SceneRecord {
            format: FORMAT,
            id: id.to_owned(),
            geometry: surface.into(),
            facets: surface.into(),
            light: LightRecord::Sources(sources.into()),
            response: responses.into(),
            further: FurtherRecord::default(),
        })
    }

    fn of_record(record: SceneRecord) -> Result<Self> {
        record.response.check()?;
        Ok(Self { fields: Fields::of(&record)? })
    }
}
