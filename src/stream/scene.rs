//! The scene record: geometry, light, response, and the camera and illuminant that look at it.

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::fields::Fields;
use crate::camera::CameraResponse;
use crate::error::{Error, Result};
use crate::forward::Lighting;
use crate::geometry::{FacetGrid, Fold, Light, Spacing};
use crate::kernel::Method;
use crate::kernel::mesh::{Accuracy, KernelSource};
use crate::response::Response;
use crate::spectrum::WavelengthGrid;

/// The stream's format, in every scene.
const FORMAT: &str = "vfold/1";
/// Largest power or sensitivity that is read: sums and products of such numbers stay finite.
const LARGEST: f64 = 1e30;

/// A scene record.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Its fields, those that the tools do not know included.
    pub fields: Fields,
}

/// A named spectrum on the scene's wavelengths.
#[derive(Clone, Debug, Serialize, Deserialize, PartialEq)]
pub struct SpectrumRecord {
    /// Built-in name or file.
    pub name: String,
    /// Relative power a waveband.
    pub power: Vec<f64>,
    /// How it was found between samples, where it was: `sprague` or `linear`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub interpolation: Option<String>,
}

/// A camera on the scene's wavelengths.
#[derive(Clone, Debug, Serialize, Deserialize, PartialEq)]
pub struct CameraRecord {
    /// Built-in name or file.
    pub name: String,
    /// Names of the channels.
    pub channels: Vec<String>,
    /// Sensitivity, channel by waveband.
    pub sensitivities: Vec<Vec<f64>>,
    /// How they were found between samples, where they were: `sprague` or `linear`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
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

#[derive(Serialize, Deserialize)]
struct GeometryRecord {
    shape: String,
    angle_deg: f64,
    panel: [f64; 2],
    /// Where it differs from panel 0's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    panel1_depth: Option<f64>,
}

#[derive(Serialize, Deserialize)]
struct FacetsRecord {
    panels: usize,
    rows: usize,
    cols: usize,
    /// Uniform if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    spacing: Option<SpacingRecord>,
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum SpacingRecord {
    Uniform,
    Graded,
}

#[derive(Serialize, Deserialize)]
struct LightRecord {
    tilt_deg: f64,
    slant_deg: f64,
    sky: f64,
    #[serde(skip_deserializing)]
    panel_irradiance: [f64; 2],
}

impl Scene {
    /// The scene of a fold and its light, bounces solved.
    ///
    /// # Errors
    /// [`Error::Field`] if a number is not finite.
    pub fn new(id: &str, fold: &Fold, light: &Light, response: &Response) -> Result<Self> {
        let mut fields = Fields::of_kind("scene");
        fields.set("format", FORMAT)?;
        fields.set("id", id)?;
        let [depth0, depth1] = fold.depths();
        fields.set(
            "geometry",
            GeometryRecord {
                shape: "fold".to_owned(),
                angle_deg: fold.angle_deg(),
                panel: [fold.width(), depth0],
                panel1_depth: (!fold.is_symmetric()).then_some(depth1),
            },
        )?;
        let FacetGrid { rows, cols } = fold.facets();
        let spacing = match fold.spacing() {
            Spacing::Uniform => None,
            Spacing::Graded => Some(SpacingRecord::Graded),
        };
        fields.set("facets", FacetsRecord { panels: 2, rows, cols, spacing })?;
        let (tilt_deg, slant_deg, sky) = (light.tilt_deg(), light.slant_deg(), light.sky());
        fields.set(
            "light",
            LightRecord { tilt_deg, slant_deg, sky, panel_irradiance: light.panel_irradiance() },
        )?;
        let mut scene = Self { fields };
        scene.set_response(response)?;
        Ok(scene)
    }

    /// A scene from its record.
    ///
    /// # Errors
    /// [`Error::Field`] if its format is not this version's.
    pub fn from_fields(fields: Fields) -> Result<Self> {
        match fields.get::<String>("format")? {
            Some(format) if format == FORMAT => Ok(Self { fields }),
            Some(format) => Err(Error::field(
                "format",
                format!("'{format}' where this version reads '{FORMAT}'; make the scene again with vkernel"),
            )),
            None => Err(Error::field("format", "missing; make the scene with vkernel")),
        }
    }

    /// The scene's name.
    ///
    /// # Errors
    /// [`Error::Field`] if it has none.
    pub fn id(&self) -> Result<String> {
        self.fields.require("id", "make the scene with vkernel")
    }

    /// The fold and its facets.
    ///
    /// # Errors
    /// [`Error::Field`] if they are missing or not those of a fold.
    pub fn fold(&self) -> Result<Fold> {
        let geometry: GeometryRecord = self.fields.require("geometry", "make the scene with vkernel")?;
        if geometry.shape != "fold" {
            return Err(Error::field(
                "geometry.shape",
                format!("'{}' is not a shape this version knows", geometry.shape),
            ));
        }
        let facets: FacetsRecord = self.fields.require("facets", "make the scene with vkernel")?;
        let grid = FacetGrid { rows: facets.rows, cols: facets.cols };
        let [width, depth] = geometry.panel;
        let spacing = match facets.spacing {
            None | Some(SpacingRecord::Uniform) => Spacing::Uniform,
            Some(SpacingRecord::Graded) => Spacing::Graded,
        };
        Fold::new(geometry.angle_deg, width, depth, grid)
            .and_then(|fold| geometry.panel1_depth.map_or(Ok(fold), |depth| fold.with_panel1_depth(depth)))
            .map(|fold| fold.with_spacing(spacing))
            .map_err(|e| Error::field("geometry", e))
    }

    /// The sun and the sky.
    ///
    /// # Errors
    /// [`Error::Field`] if they are missing or leave a panel unlit.
    pub fn light(&self) -> Result<Light> {
        let light: LightRecord = self.fields.require("light", "make the scene with vkernel")?;
        Light::new(&self.fold()?, light.tilt_deg, light.slant_deg, light.sky)
            .map_err(|e| Error::field("light", e))
    }

    /// Says how good the response is and which mesh gave it.
    ///
    /// # Errors
    /// As [`Fields::set`].
    pub fn set_accuracy(&mut self, mesh: &str, tolerance: f64, accuracy: &Accuracy) -> Result<()> {
        let mut record = json!({
            "mesh": mesh,
            "tolerance": tolerance,
            "unknowns": accuracy.unknowns,
            "facet_mean_error": accuracy.facet_mean_error,
            "residual": accuracy.residual,
        });
        if let Some(source) = &accuracy.kernel {
            record["kernel"] = kernel_record(source);
        }
        self.fields.set("accuracy", record)
    }

    /// The mesh on which the bounces were solved, as `vkernel --mesh` names it.
    ///
    /// # Errors
    /// [`Error::Field`] if it is not there.
    pub fn mesh(&self) -> Result<String> {
        #[derive(Deserialize)]
        struct Solved {
            mesh: String,
        }
        let solved: Solved = self.fields.require("accuracy", "make the scene with vkernel")?;
        Ok(solved.mesh)
    }

    /// Relative error that the response was allowed.
    ///
    /// # Errors
    /// [`Error::Field`] if it is not there or not between 0 and 1.
    pub fn tolerance(&self) -> Result<f64> {
        #[derive(Deserialize)]
        struct Allowed {
            tolerance: f64,
        }
        let accuracy: Allowed = self.fields.require("accuracy", "make the scene with vkernel")?;
        match accuracy.tolerance {
            tolerance if tolerance > 0.0 && tolerance < 1.0 => Ok(tolerance),
            tolerance => {
                Err(Error::field("accuracy.tolerance", format!("{tolerance} is not between 0 and 1")))
            }
        }
    }

    /// Says that `count` of what the scene has need not be computed, and why, in place of what was said of it before.
    ///
    /// # Errors
    /// [`Error::Field`] if `skipped` is not a list.
    pub fn set_skipped(&mut self, what: &str, count: usize, why: &str) -> Result<()> {
        let before: Option<Vec<Value>> = self.fields.get("skipped")?;
        if before.is_none() && count == 0 {
            return Ok(());
        }
        let mut skipped = before.unwrap_or_default();
        skipped.retain(|entry| entry["what"] != what);
        if count > 0 {
            skipped.push(json!({ "what": what, "count": count, "why": why }));
        }
        self.fields.set("skipped", skipped)
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
        let bands = self.grid()?.len();
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
        self.fields.0.contains_key("camera")
    }

    /// Whether the colour of the sky is given.
    #[must_use]
    pub fn has_sky_illuminant(&self) -> bool {
        self.fields.0.get("sky_illuminant").is_some_and(|sky| !sky.is_null())
    }

    /// The lights as the camera responds to them.
    ///
    /// # Errors
    /// [`Error::Field`] if camera or illuminants are missing or not on the scene's wavelengths.
    pub fn lighting(&self) -> Result<Lighting> {
        let (grid, camera, light) = (self.grid()?, self.camera()?, self.light()?);
        let on_grid = |name: &str, spectrum: &SpectrumRecord| {
            if spectrum.power.len() != grid.len() {
                let count = spectrum.power.len();
                return Err(Error::field(name, format!("{count} numbers for {} wavebands", grid.len())));
            }
            not_negative(name, &spectrum.power)
        };
        let illuminants: Vec<SpectrumRecord> =
            self.fields.require("illuminants", "give --illuminant to vforward or vextract")?;
        if illuminants.is_empty() {
            return Err(Error::field("illuminants", "none; give --illuminant to vforward or vextract"));
        }
        let picture = |illuminant: &SpectrumRecord| {
            on_grid("illuminants", illuminant)?;
            CameraResponse::new(&grid, &camera.sensitivities, &illuminant.power)
        };
        let sun = CameraResponse::of_pictures(illuminants.iter().map(picture).collect::<Result<Vec<_>>>()?);
        let sky = match self.fields.get::<SpectrumRecord>("sky_illuminant")? {
            Some(spectrum) => {
                on_grid("sky_illuminant", &spectrum)?;
                sun.to_other_light(&grid, &camera.sensitivities, &spectrum.power)?
            }
            None => sun.clone(),
        };
        Ok(Lighting { light, sun, sky })
    }
}

/// The method that found the form factors, with what it was asked for and reached.
fn kernel_record(source: &KernelSource) -> Value {
    let method = source.method.to_string();
    let Method::MonteCarlo(estimate) = source.method else { return json!({ "method": method }) };
    json!({
        "method": method,
        "sampling": estimate.sampling().to_string(),
        "samples": estimate.samples(),
        "seed": estimate.seed(),
        "entry_sd": source.entry_sd,
    })
}

/// Checks that powers or sensitivities are possible ones.
fn not_negative<'a>(name: &str, values: impl IntoIterator<Item = &'a f64>) -> Result<()> {
    match values.into_iter().find(|value| !(0.0..=LARGEST).contains(*value)) {
        Some(value) => Err(Error::field(name, format!("{value:e} cannot be; it needs numbers from 0"))),
        None => Ok(()),
    }
}
