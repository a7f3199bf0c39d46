//! The scene's camera and illuminants.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Scene;
use super::fields::LARGEST;
use crate::camera::CameraResponse;
use crate::error::{Error, Result};
use crate::forward::{Lighting, OpenLight};
use crate::geometry::LightSource;
use crate::spectrum::WavelengthGrid;

/// A named spectrum on the scene's wavelengths.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema, PartialEq)]
pub struct SpectrumRecord {
    /// Built-in name or file.
    pub name: String,
    /// Relative power, a number a waveband.
    #[schemars(inner(range(min = 0)))]
    pub power: Vec<f64>,
    /// How it was found between samples, where it was: `sprague` or `linear`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub interpolation: Option<String>,
}

/// A camera on the scene's wavelengths.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema, PartialEq)]
pub struct CameraRecord {
    /// Built-in name or file.
    pub name: String,
    /// Names of the channels.
    pub channels: Vec<String>,
    /// Sensitivity to power, `[channel][waveband]`, in any unit.
    #[schemars(length(min = 1), inner(inner(range(min = 0))))]
    pub sensitivities: Vec<Vec<f64>>,
    /// How they were found between samples, where they were: `sprague` or `linear`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub interpolation: Option<String>,
}

/// What looks at a fold and in which light, all on one grid of wavelengths.
#[derive(Clone, Debug, PartialEq)]
pub struct Optics {
    /// The wavelengths.
    pub grid: WavelengthGrid,
    /// The camera.
    pub camera: CameraRecord,
    /// The sun, or whatever stands in its place: a picture under each.
    pub illuminants: Vec<SpectrumRecord>,
    /// The sky, if it has another spectrum.
    pub sky: Option<SpectrumRecord>,
}

impl Scene {
    /// The wavelengths of the scene.
    ///
    /// # Errors
    /// [`Error::Field`] if they are missing or do not increase.
    pub fn grid(&self) -> Result<WavelengthGrid> {
        let wavelengths_nm: Vec<f64> =
            self.fields.require("wavelengths_nm", "vforward and vextract add them")?;
        WavelengthGrid::new(wavelengths_nm).map_err(|e| Error::field("wavelengths_nm", e))
    }

    /// Sets what looks at the fold and in which light.
    ///
    /// # Errors
    /// As [`Fields::set`].
    pub fn set_optics(&mut self, optics: &Optics) -> Result<()> {
        self.fields.set("wavelengths_nm", optics.grid.wavelengths_nm())?;
        self.fields.set("camera", &optics.camera)?;
        self.fields.set("illuminants", &optics.illuminants)?;
        optics.sky.as_ref().map_or(Ok(()), |sky| self.fields.set("sky_illuminant", sky))
    }

    /// The camera.
    ///
    /// # Errors
    /// [`Error::Field`] if it is missing or not on the scene's wavelengths.
    pub fn camera(&self) -> Result<CameraRecord> {
        let camera: CameraRecord = self.fields.require("camera", "give --camera to vforward or vextract")?;
        let (bands, channels) = (self.grid()?.len(), camera.channels.len());
        if camera.sensitivities.len() != channels {
            return Err(Error::field("camera.channels", format!("{channels} names, not one a sensitivity")));
        }
        if camera.sensitivities.is_empty()
            || camera.sensitivities.iter().any(|channel| channel.len() != bands)
        {
            return Err(Error::field("camera.sensitivities", format!("needs {bands} numbers a channel")));
        }
        not_negative("camera.sensitivities", camera.sensitivities.iter().flatten())?;
        Ok(camera)
    }

    /// Whether a camera looks at the fold.
    #[must_use]
    pub fn has_camera(&self) -> bool {
        self.fields.text("camera").is_some()
    }

    /// Whether the colour of the sky is given.
    #[must_use]
    pub fn has_sky_illuminant(&self) -> bool {
        self.fields.has("sky_illuminant")
    }

    /// The lights on a fold as the camera responds to them.
    ///
    /// # Errors
    /// [`Error::Field`] if camera or illuminants are missing or not on the scene's wavelengths.
    pub fn lighting(&self) -> Result<Lighting> {
        let light = self.light()?;
        let sun = CameraResponse::of_pictures(self.illuminant_responses()?);
        let sky = self.sky_response(&sun)?;
        Ok(Lighting { light, sun, sky })
    }

    /// The camera's responses to the sources around a surface that is no fold. Of several illuminants each is that of a source, the
    /// skies aside, or, where there is one source, that of a picture.
    ///
    /// # Errors
    /// As [`Scene::lighting`]; [`Error::Field`] if there are more than one but not as many illuminants as sources.
    pub fn source_responses(&self) -> Result<Vec<CameraResponse>> {
        let sources = self.sources()?;
        let responses = self.lamp_responses(&sources)?;
        let sky = self.sky_response(&responses[0])?;
        let mut of_lamps = responses.iter().cycle();
        let of = |source: &LightSource| if source.is_sky() { Some(&sky) } else { of_lamps.next() };
        Ok(sources.iter().filter_map(of).cloned().collect())
    }

    /// One response for all sources, or one for each that is no sky.
    fn lamp_responses(&self, sources: &[LightSource]) -> Result<Vec<CameraResponse>> {
        let illuminants = self.illuminants()?;
        let pictures = self.illuminant_responses()?;
        let lamps = sources.iter().filter(|source| !source.is_sky()).count();
        if lamps <= 1 {
            return Ok(vec![CameraResponse::of_pictures(pictures)]);
        }
        if illuminants.len() > 1 && illuminants.len() != lamps {
            let problem = format!(
                "{} for {lamps} sources; give --illuminant once, or once a source",
                illuminants.len()
            );
            return Err(Error::field("illuminants", problem));
        }
        // Powers are relative: in which amounts the sources light the surface is said of the first one's strongest channel.
        let (grid, camera) = (self.grid()?, self.camera()?);
        let others = illuminants[1..]
            .iter()
            .map(|illuminant| pictures[0].to_other_light(&grid, &camera.sensitivities, &illuminant.power));
        std::iter::once(Ok(pictures[0].clone())).chain(others).collect()
    }

    /// The light as a chart beside the surface receives it.
    ///
    /// # Errors
    /// As [`Scene::lighting`].
    pub fn open_light(&self) -> Result<OpenLight> {
        if self.is_fold()? {
            return Ok((&self.lighting()?).into());
        }
        let responses = self.source_responses()?;
        Ok(OpenLight::new(&self.sources()?.into_iter().zip(responses).collect::<Vec<_>>()))
    }

    /// Pictures that are taken of a sample: one under each illuminant, or one under all.
    ///
    /// # Errors
    /// [`Error::Field`] if illuminants or sources are missing.
    pub fn pictures(&self) -> Result<usize> {
        let one = !self.is_fold()? && self.sources()?.iter().filter(|source| !source.is_sky()).count() > 1;
        Ok(if one { 1 } else { self.illuminants()?.len() })
    }

    fn illuminants(&self) -> Result<Vec<SpectrumRecord>> {
        let illuminants: Vec<SpectrumRecord> =
            self.fields.require("illuminants", "give --illuminant to vforward or vextract")?;
        if illuminants.is_empty() {
            return Err(Error::field("illuminants", "none; give --illuminant to vforward or vextract"));
        }
        Ok(illuminants)
    }

    /// The camera's response to each illuminant.
    fn illuminant_responses(&self) -> Result<Vec<CameraResponse>> {
        let (grid, camera) = (self.grid()?, self.camera()?);
        let response = |illuminant: &SpectrumRecord| {
            on_grid(&grid, "illuminants", illuminant)?;
            CameraResponse::new(&grid, &camera.sensitivities, &illuminant.power)
        };
        self.illuminants()?.iter().map(response).collect()
    }

    /// The camera's response to the sky, that to the `sun` if the sky has no spectrum of its own.
    fn sky_response(&self, sun: &CameraResponse) -> Result<CameraResponse> {
        let Some(spectrum) = self.fields.get::<SpectrumRecord>("sky_illuminant")? else {
            return Ok(sun.clone());
        };
        let grid = self.grid()?;
        on_grid(&grid, "sky_illuminant", &spectrum)?;
        sun.to_other_light(&grid, &self.camera()?.sensitivities, &spectrum.power)
    }
}

fn on_grid(grid: &WavelengthGrid, name: &str, spectrum: &SpectrumRecord) -> Result<()> {
    if spectrum.power.len() != grid.len() {
        let count = spectrum.power.len();
        return Err(Error::field(name, format!("{count} numbers for {} wavebands", grid.len())));
    }
    not_negative(name, &spectrum.power)
}

/// Checks that powers or sensitivities are possible ones.
fn not_negative<'a>(name: &str, values: impl IntoIterator<Item = &'a f64>) -> Result<()> {
    match values.into_iter().find(|value| !(0.0..=LARGEST).contains(*value)) {
        Some(value) => Err(Error::field(name, format!("{value:e} cannot be; it needs numbers from 0"))),
        None => Ok(()),
    }
}
