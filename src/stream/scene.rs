//! A scene: a surface, its light and a camera. Its fields are in files of their own.

use super::fields::{BY_VKERNEL, Fields};
use crate::error::{Error, Result};

/// The stream's format, in every scene.
pub(super) const FORMAT: &str = "vfold/1";

/// A scene record.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Its fields, including unknown ones.
    pub fields: Fields,
}

impl Scene {
    /// A scene from its record.
    ///
    /// # Errors
    /// [`Error::Field`] if its format is that of another version.
    pub fn from_fields(fields: Fields) -> Result<Self> {
        match fields.get::<String>("format")? {
            Some(format) if format == FORMAT => Ok(Self { fields }),
            Some(format) => Err(Error::field(
                "format",
                format!("'{format}', but this version reads '{FORMAT}'; make the scene again with vkernel"),
            )),
            None => Err(Error::field("format", format!("missing; {BY_VKERNEL}"))),
        }
    }

    /// The scene's name.
    ///
    /// # Errors
    /// [`Error::Field`] if it has none.
    pub fn id(&self) -> Result<String> {
        self.fields.require("id", BY_VKERNEL)
    }

    /// Marks the sheet as one that is backed by black card or its like.
    ///
    /// # Errors
    /// As [`Fields::set`].
    pub fn set_backed(&mut self) -> Result<()> {
        self.fields.set("backed", true)
    }

    /// Whether the sheet is backed, so that no light comes through it from behind.
    ///
    /// # Errors
    /// [`Error::Field`] if that is neither true nor false.
    pub fn is_backed(&self) -> Result<bool> {
        Ok(self.fields.get("backed")?.unwrap_or(false))
    }
}
