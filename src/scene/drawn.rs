//! Drawings of scenes and samples.

use super::{FoldSetting, Setting, SurfaceSetting, residuals};
use crate::camera::CameraResponse;
use crate::colorimetry::{Colorimeter, Observer, encode_srgb};
use crate::error::Result;
use crate::geometry::Panel;
use crate::plot::sheet::{Residuals, Sheet, SheetColours};
use crate::plot::surface::FacetLight;
use crate::response::ModeLight;
use crate::spectrum::Spectrum;
use crate::stream::{EstimateRecord, Sample, Scene, SpectrumRecord};

/// The drawing of an estimate of the sample, with colours under `illuminant` for `observer`. Without visible
/// panels, as for an external kernel, only the spectrum is drawn.
///
/// # Errors
/// [`crate::Error::Field`] if a part of the scene is missing or does not fit the others.
pub fn sheet(
    (sample, estimate): (&Sample, &EstimateRecord),
    scene: &Scene,
    illuminant: &Spectrum,
    observer: Observer,
) -> Result<Sheet> {
    let lit = estimate.lit(scene)?;
    let scene = lit.as_ref().unwrap_or(scene);
    let curve = sample.curve(estimate);
    let setting = Setting::of(scene)?;
    let panels: Vec<_> = setting.panels().into_iter().flatten().collect();
    let grid = scene.grid()?;
    let meter = Colorimeter::new(&grid, illuminant, observer).ok();
    let is_on_grid = |reflectance: &[f64]| reflectance.len() == grid.len();
    let meter = meter.filter(|_| is_on_grid(&curve.reflectance));
    let colours = meter.map(|meter| SheetColours {
        estimate: meter.srgb(&curve.reflectance),
        truth: curve.truth.as_ref().filter(|truth| is_on_grid(&truth.1)).map(|truth| meter.srgb(&truth.1)),
        folded: folded(&setting, &meter, &curve.reflectance).unwrap_or_default(),
    });
    let residuals = residuals(sample, estimate, scene).ok().flatten();
    let residuals = residuals.map(|facets| -> Result<_> {
        Ok(Residuals { channels: channels_of_pictures(scene, &setting)?, facets: facets.rows() })
    });
    Ok(Sheet { curve, colours, residuals: residuals.transpose()?, panels })
}

/// sRGB of the facets as the eye sees them, scaled so that the largest value is that of the flat sheet.
fn folded(setting: &Setting, meter: &Colorimeter, reflectance: &[f64]) -> Result<Vec<[f64; 3]>> {
    let eye = CameraResponse::from_weights(meter.screen_weights());
    let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(f64::MIN_POSITIVE, f64::max);
    let flat = eye.of_flat(reflectance);
    let facets = setting.model_seen_by(&eye)?.facet_rgb(reflectance);
    let scale = largest(&mut flat.into_iter()).min(1.0) / largest(&mut facets.iter().copied());
    Ok(facets.row_iter().map(|row| [0, 1, 2].map(|channel| encode_srgb(scale * row[channel]))).collect())
}

/// Names of the values of a facet: the channels, combined with the illuminants if there are several pictures.
fn channels_of_pictures(scene: &Scene, setting: &Setting) -> Result<Vec<String>> {
    let (channels, pictures) = (scene.camera()?.channels, setting.pictures()?);
    if pictures == 1 {
        return Ok(channels);
    }
    let under = |light: &SpectrumRecord| -> Vec<String> {
        channels.iter().map(|channel| format!("{channel}, {}", light.name)).collect()
    };
    Ok(scene.illuminants()?.iter().flat_map(under).collect())
}

impl FoldSetting {
    /// Row sums of the kernel and direct light of every facet, as accurate as the response.
    #[must_use]
    pub fn facet_light(&self) -> FacetLight {
        let Self { response, light, .. } = self;
        let facets = || (0..2).flat_map(|panel| (0..response.facets()).map(move |facet| (panel, facet)));
        let direct = |light| {
            let at = |(panel, facet)| response.irradiance(panel, facet, light, [0.0; 2]);
            facets().map(at).collect::<Vec<f64>>()
        };
        let (sun, sky) = (direct(ModeLight::Sun(light.panel_irradiance())), direct(ModeLight::Sky(1.0)));
        let irradiance = sun.iter().zip(&sky).map(|(sun, open)| sun + light.sky() * open);
        FacetLight {
            panels: self.fold.panels().into_iter().enumerate().collect(),
            irradiance: irradiance.collect(),
            row_sums: sky.iter().map(|open| 1.0 - open).collect(),
        }
    }
}

impl SurfaceSetting<'_> {
    /// The panels and the direct light on the facets, with these `row_sums` of the kernel.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if the scene is incomplete.
    pub fn facet_light(&self, row_sums: Vec<f64>) -> Result<FacetLight> {
        let responses = self.scene.responses()?;
        let direct = |facet| responses.iter().map(|response| response.irradiance(facet, 0.0)).sum();
        let panels: Vec<(usize, Panel)> = self.scene.shape()?.panels().into_iter().collect();
        Ok(FacetLight { panels, irradiance: (0..row_sums.len()).map(direct).collect(), row_sums })
    }
}
