//! The scene record: what it is called, how well it is solved, and what was skipped. Its parts have files of their own.

use serde::Deserialize;
use serde_json::{Value, json};

use super::fields::Fields;
use super::surface::Surface;
use crate::error::{Error, Result};
use crate::geometry::{Fold, Light, LightSource};
use crate::kernel::Method;
use crate::kernel::mesh::{Accuracy, KernelSource};
use crate::response::{Response, SurfaceResponse};

/// The stream's format, in every scene.
const FORMAT: &str = "vfold/1";

/// Work that a scene did not need.
#[derive(Clone, Debug, Deserialize, PartialEq)]
pub struct SkippedRecord {
    /// What was not computed.
    pub what: String,
    /// How many of it.
    pub count: u64,
    /// Why not.
    pub why: String,
}

/// A scene record.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Its fields, those that the tools do not know included.
    pub fields: Fields,
}

impl Scene {
    /// The scene of a fold and its light, bounces solved.
    ///
    /// # Errors
    /// [`Error::Field`] if a number is not finite.
    pub fn new(id: &str, fold: &Fold, light: &Light, response: &Response) -> Result<Self> {
        let mut scene = Self::named(id)?;
        scene.set_fold(fold)?;
        scene.set_light(light)?;
        scene.set_response(response)?;
        Ok(scene)
    }

    /// The scene of any surface under `sources`, the bounces of each solved.
    ///
    /// # Errors
    /// [`Error::Field`] if a number is not finite.
    pub fn of_surface(
        id: &str,
        surface: &Surface,
        sources: &[LightSource],
        responses: &[SurfaceResponse],
    ) -> Result<Self> {
        let mut scene = Self::named(id)?;
        scene.set_surface(surface)?;
        scene.set_sources(sources)?;
        scene.set_responses(responses)?;
        Ok(scene)
    }

    fn named(id: &str) -> Result<Self> {
        let mut fields = Fields::of_kind("scene");
        fields.set("format", FORMAT)?;
        fields.set("id", id)?;
        Ok(Self { fields })
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

    /// Number of unknowns with which the bounces were solved.
    ///
    /// # Errors
    /// [`Error::Field`] if it is not there.
    pub fn unknowns(&self) -> Result<usize> {
        #[derive(Deserialize)]
        struct Solved {
            unknowns: usize,
        }
        let solved: Solved = self.fields.require("accuracy", "make the scene with vkernel")?;
        Ok(solved.unknowns)
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

    /// The work that the scene did not need.
    ///
    /// # Errors
    /// [`Error::Field`] if `skipped` is not a list of it.
    pub fn skipped(&self) -> Result<Vec<SkippedRecord>> {
        Ok(self.fields.get("skipped")?.unwrap_or_default())
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
