//! A card of known reflectance in place of one panel of a fold.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Scene;
use super::fields::finite;
use crate::error::{Error, Result};

/// A card of known reflectance in the place of one panel, at the wavelengths of the scene.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema, PartialEq)]
pub struct ReferencePanel {
    /// The panel whose place the card takes, 0 or 1; the other panel is the sheet.
    #[serde(default = "panel_1")]
    #[schemars(range(min = 0, max = 1))]
    pub panel: usize,
    /// Built-in name or file.
    name: String,
    /// Reflectance, one per waveband.
    #[schemars(inner(range(min = 0, max = 1)))]
    pub reflectance: Vec<f64>,
}

fn panel_1() -> usize {
    1
}

impl ReferencePanel {
    /// A card on `panel`, 0 or 1, with its reflectance in every waveband.
    #[must_use]
    pub fn new(panel: usize, name: &str, reflectance: Vec<f64>) -> Self {
        Self { panel, name: name.to_owned(), reflectance }
    }
}

impl Scene {
    /// Declares a panel to be a card of known reflectance.
    ///
    /// # Errors
    /// [`Error::Field`] if a number is not finite.
    pub fn set_reference_panel(&mut self, card: &ReferencePanel) -> Result<()> {
        finite("reference_panel", &card.reflectance)?;
        self.fields.set("reference_panel", card)
    }

    /// The card, if a panel is one.
    ///
    /// # Errors
    /// [`Error::Field`] if it is on a panel that does not exist, or its reflectance is not on the scene's
    /// wavelengths.
    pub fn reference_panel(&self) -> Result<Option<ReferencePanel>> {
        let Some(card) = self.fields.get::<ReferencePanel>("reference_panel")? else { return Ok(None) };
        if card.panel > 1 {
            return Err(Error::field("reference_panel.panel", format!("{} is neither 0 nor 1", card.panel)));
        }
        if card.reflectance.len() != self.grid()?.len()
            || !card.reflectance.iter().all(|r| (0.0..=1.0).contains(r))
        {
            return Err(Error::field(
                "reference_panel.reflectance",
                "needs one number from 0 to 1 per waveband",
            ));
        }
        Ok(Some(card))
    }
}
