//! The scene's camera and illuminants.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Scene;
use super::fields::LARGEST;
use crate::error::{Error, Result, counted};
use crate::spectrum::{
    ASSUMED_LIGHT, Interpolation, Outside, Sensitivities, Spectrum, WavelengthGrid, illuminant,
};

/// A named spectrum at the wavelengths of the scene.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema, PartialEq)]
pub struct SpectrumRecord {
    /// Built-in name or file.
    pub name: String,
    /// Relative power, one per waveband.
    #[schemars(inner(range(min = 0)))]
    pub power: Vec<f64>,
    /// How values were computed from those of its source, if they are not the same: `sprague` or `linear`
    /// interpolation, or the `average` of a light over wavebands.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub interpolation: Option<String>,
}

/// A camera, at the wavelengths of the scene.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema, PartialEq)]
pub struct CameraRecord {
    /// Built-in name or file.
    pub name: String,
    /// Names of the channels.
    pub channels: Vec<String>,
    /// Sensitivity to power, `[channel][waveband]`, in any unit.
    #[schemars(length(min = 1), inner(inner(range(min = 0))))]
    pub sensitivities: Vec<Vec<f64>>,
    /// How values were computed from those of their source, if they are not the same: `sprague` or `linear`
    /// interpolation, or the `average` of a light over wavebands.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub interpolation: Option<String>,
    /// The camera for which it stands in, if another camera took the photograph.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stands_in: Option<StandInRecord>,
}

/// The camera that took a photograph, if its sensitivities have not been measured and others are used
/// instead.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema, PartialEq)]
pub struct StandInRecord {
    /// Maker and model, as the photograph names them.
    pub camera: String,
    /// Why these sensitivities are used instead.
    pub why: String,
    /// Error of the sensitivities used instead, as a mean over such cases: root mean square, relative to the
    /// peak of green.
    #[schemars(range(min = 0))]
    #[serde(alias = "curve_error")]
    pub sensitivity_error: f64,
    /// Whether the sensitivities used instead are predicted from its colour matrix, rather than those of
    /// another camera.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub is_predicted: bool,
}

/// Camera and illuminants, all on one wavelength grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Optics {
    /// The wavelengths.
    pub grid: WavelengthGrid,
    /// The camera.
    pub camera: CameraRecord,
    /// The sun, or its replacement: one per picture. Empty if the light is unknown.
    pub illuminants: Vec<SpectrumRecord>,
    /// The sky, if it has a different spectrum.
    pub sky: Option<SpectrumRecord>,
}

impl Optics {
    /// Spectra on the wavelengths of a `grid`. A camera's sensitivity is zero where it was not measured.
    ///
    /// # Errors
    /// [`Error::Spectrum`] if a light does not cover the wavelengths.
    pub fn new(
        grid: WavelengthGrid,
        camera: &Sensitivities,
        illuminants: &[Spectrum],
        sky: Option<&Spectrum>,
    ) -> Result<Self> {
        let name = |interpolation: Interpolation| interpolation.name().to_owned();
        let light = |spectrum: &Spectrum| {
            let power = spectrum.on(&grid, Outside::Refuse)?;
            let interpolation = spectrum.interpolation(&grid).map(name);
            Ok(SpectrumRecord { name: spectrum.name().to_owned(), power, interpolation })
        };
        let channels = || camera.channels.iter();
        Ok(Self {
            camera: CameraRecord {
                name: camera.name.clone(),
                channels: channels().map(|channel| channel.name().to_owned()).collect(),
                sensitivities: channels().map(|one| one.on(&grid, Outside::Zero)).collect::<Result<_>>()?,
                interpolation: channels().find_map(|channel| channel.interpolation(&grid)).map(name),
                stands_in: None,
            },
            illuminants: illuminants.iter().map(light).collect::<Result<_>>()?,
            sky: sky.map(light).transpose()?,
            grid,
        })
    }
}

/// The fields of a scene that say what its light is.
const OF_LIGHT: [&str; 4] = ["illuminants", "sky_illuminant", "daylight_assumed", "illuminant_unknown"];

impl Scene {
    /// Camera and illuminants of the scene.
    ///
    /// # Errors
    /// As [`Scene::camera`] and [`Scene::illuminants`].
    pub fn optics(&self) -> Result<Optics> {
        Ok(Optics {
            grid: self.grid()?,
            camera: self.camera()?,
            illuminants: self.illuminants()?,
            sky: self.sky_illuminant()?,
        })
    }

    /// The wavelengths of the scene.
    ///
    /// # Errors
    /// [`Error::Field`] if they are missing or do not increase.
    pub fn grid(&self) -> Result<WavelengthGrid> {
        let wavelengths_nm: Vec<f64> =
            self.fields.require("wavelengths_nm", "vforward and vextract add them")?;
        WavelengthGrid::new(wavelengths_nm).map_err(|e| Error::field("wavelengths_nm", e))
    }

    /// Sets camera and illuminants in place of what the scene says of them.
    ///
    /// # Errors
    /// As [`Fields::set`](super::Fields::set).
    pub fn set_optics(&mut self, optics: &Optics) -> Result<()> {
        self.fields.set("wavelengths_nm", optics.grid.wavelengths_nm())?;
        self.fields.set("camera", &optics.camera)?;
        if optics.illuminants.is_empty() {
            return self.forget_light();
        }
        self.remove_light();
        self.fields.set("illuminants", &optics.illuminants)?;
        optics.sky.as_ref().map_or(Ok(()), |sky| self.fields.set("sky_illuminant", sky))
    }

    /// Removes the scene's statements on its light.
    ///
    /// # Errors
    /// As [`Fields::set`](super::Fields::set).
    pub fn forget_light(&mut self) -> Result<()> {
        self.remove_light();
        self.fields.set("illuminant_unknown", true)
    }

    fn remove_light(&mut self) {
        OF_LIGHT.iter().for_each(|name| self.fields.remove(name));
    }

    /// Whether the light is unknown.
    ///
    /// # Errors
    /// [`Error::Field`] if that is neither true nor false.
    pub fn is_light_unknown(&self) -> Result<bool> {
        Ok(self.fields.get("illuminant_unknown")?.unwrap_or(false))
    }

    /// The same scene in this light.
    ///
    /// # Errors
    /// As [`Fields::set`](super::Fields::set).
    pub fn in_light(&self, light: SpectrumRecord) -> Result<Self> {
        let mut lit = self.clone();
        lit.fields.remove("illuminant_unknown");
        lit.fields.set("illuminants", [light])?;
        Ok(lit)
    }

    /// The same scene in the daylight assumed by default.
    ///
    /// # Errors
    /// [`Error::Spectrum`] if it does not cover the wavelengths.
    pub fn in_assumed_light(&self, grid: &WavelengthGrid) -> Result<Self> {
        let power = illuminant(ASSUMED_LIGHT)?.on(grid, Outside::Refuse)?;
        let mut lit =
            self.in_light(SpectrumRecord { name: ASSUMED_LIGHT.to_owned(), power, interpolation: None })?;
        lit.set_daylight_assumed()?;
        Ok(lit)
    }

    /// Marks the illuminant as assumed.
    ///
    /// # Errors
    /// As [`Fields::set`](super::Fields::set).
    pub fn set_daylight_assumed(&mut self) -> Result<()> {
        self.fields.set("daylight_assumed", true)
    }

    /// Whether the illuminant is daylight assumed by default.
    ///
    /// # Errors
    /// [`Error::Field`] if that is neither true nor false.
    pub fn is_daylight_assumed(&self) -> Result<bool> {
        Ok(self.fields.get("daylight_assumed")?.unwrap_or(false))
    }

    /// The camera.
    ///
    /// # Errors
    /// [`Error::Field`] if it is missing or not on the scene's wavelengths.
    pub fn camera(&self) -> Result<CameraRecord> {
        let camera: CameraRecord = self.fields.require("camera", "give --camera to vforward or vextract")?;
        let (bands, channels) = (self.grid()?.len(), camera.channels.len());
        if camera.sensitivities.len() != channels {
            return Err(Error::field(
                "camera.channels",
                format!("{}, not one per sensitivity", counted(channels, "name")),
            ));
        }
        if camera.sensitivities.is_empty()
            || camera.sensitivities.iter().any(|channel| channel.len() != bands)
        {
            return Err(Error::field("camera.sensitivities", format!("needs {bands} numbers per channel")));
        }
        not_negative("camera.sensitivities", camera.sensitivities.iter().flatten())?;
        Ok(camera)
    }

    /// Whether the scene has a camera.
    #[must_use]
    pub fn has_camera(&self) -> bool {
        self.fields.text("camera").is_some()
    }

    /// The illuminants, at least one.
    ///
    /// # Errors
    /// [`Error::Field`] if they are missing, unknown or not on the scene's wavelengths.
    pub fn illuminants(&self) -> Result<Vec<SpectrumRecord>> {
        if self.is_light_unknown()? {
            let problem =
                "unknown, but needed here; state it with vextract --illuminant, or let vestimate find it";
            return Err(Error::field("illuminants", problem));
        }
        let illuminants: Vec<SpectrumRecord> =
            self.fields.require("illuminants", "give --illuminant to vforward or vextract")?;
        if illuminants.is_empty() {
            return Err(Error::field("illuminants", "none; give --illuminant to vforward or vextract"));
        }
        let grid = self.grid()?;
        illuminants.iter().try_for_each(|illuminant| on_grid(&grid, "illuminants", illuminant))?;
        Ok(illuminants)
    }

    /// The spectrum of the sky, if different from the sun's.
    ///
    /// # Errors
    /// [`Error::Field`] if it is not on the scene's wavelengths.
    pub fn sky_illuminant(&self) -> Result<Option<SpectrumRecord>> {
        let sky: Option<SpectrumRecord> = self.fields.get("sky_illuminant")?;
        sky.iter().try_for_each(|sky| on_grid(&self.grid()?, "sky_illuminant", sky))?;
        Ok(sky)
    }
}

fn on_grid(grid: &WavelengthGrid, name: &str, spectrum: &SpectrumRecord) -> Result<()> {
    if spectrum.power.len() != grid.len() {
        let numbers = counted(spectrum.power.len(), "number");
        return Err(Error::field(name, format!("{numbers} for {} wavebands", grid.len())));
    }
    not_negative(name, &spectrum.power)
}

/// Checks the range of powers or sensitivities.
fn not_negative<'a>(name: &str, values: impl IntoIterator<Item = &'a f64>) -> Result<()> {
    match values.into_iter().find(|value| !(0.0..=LARGEST).contains(*value)) {
        Some(value) => Err(Error::field(name, format!("{value:e} is out of range; give numbers from 0"))),
        None => Ok(()),
    }
}
