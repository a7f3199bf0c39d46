//! A photograph with the whitening of its residuals.

use std::sync::{Arc, OnceLock};

use nalgebra::DMatrix;

use super::day::Day;
use super::error::{ModelError, Whitening};
use super::imperfection::Imperfection;
use super::parts::Parts;
use super::sheet_models::SheetModels;
use crate::estimate::emission::Emission;

/// A photograph with everything that does not depend on the class of spectra.
pub struct Photograph<'a> {
    /// Its ingredients.
    pub parts: &'a Parts,
    /// The sheet models as they appear in it.
    pub sheet_models: Arc<SheetModels<'a>>,
    /// The values to which errors are relative.
    values: DMatrix<f64>,
    /// Whitening of the residuals for each size of model error on each kind of day, computed on first use.
    whitenings: Arc<[[OnceLock<Option<Whitening>>; Day::ALL.len()]; Imperfection::ALL.len()]>,
    /// Possible emissions of its sheet, computed on first use.
    emissions: OnceLock<Vec<Emission>>,
}

/// Lower bound of the values to which errors are relative, as a share of a channel's brightest value: nothing
/// darker belongs to a fold in the sun.
const DARKEST: f64 = 0.1;

/// Values, facet by channel, that are no darker than that.
fn bounded(mut values: DMatrix<f64>) -> DMatrix<f64> {
    for mut channel in values.column_iter_mut() {
        let least = DARKEST * channel.max();
        channel.apply(|value| *value = value.max(least));
    }
    values
}

impl<'a> Photograph<'a> {
    /// Photographs of one sheet.
    #[must_use]
    pub fn all(of: &'a [Parts]) -> Vec<Self> {
        let photograph = |(parts, sheet_models): (&'a Parts, SheetModels<'a>)| {
            let (sheet_models, values) = (Arc::new(sheet_models), bounded(parts.values.clone()));
            Self { parts, sheet_models, values, whitenings: Arc::default(), emissions: OnceLock::new() }
        };
        of.iter().zip(SheetModels::of(of)).map(photograph).collect()
    }

    /// The same with errors relative to these values: facet by channel.
    #[must_use]
    pub fn relative_to(self, values: DMatrix<f64>) -> Self {
        Self { values: bounded(values), whitenings: Arc::default(), ..self }
    }

    /// The same photograph assumed to be in the light of other parts, which are otherwise the same.
    #[must_use]
    pub fn in_light_of(&self, parts: &'a Parts) -> Self {
        let Self { sheet_models, values, whitenings, .. } = self;
        let (sheet_models, whitenings) = (Arc::clone(sheet_models), Arc::clone(whitenings));
        Self { parts, sheet_models, values: values.clone(), whitenings, emissions: OnceLock::new() }
    }

    /// Possible emissions of its sheet in the stated light, the first of which is none.
    pub fn emissions(&self) -> &[Emission] {
        let Parts { eye, stated, .. } = self.parts;
        self.emissions.get_or_init(|| Emission::all(&eye.wavelengths_nm, eye.sun.as_slice(), stated.backing))
    }

    /// The whitening of the residuals; `None` if facets are not finite.
    pub fn whitening(&self, imperfection: Imperfection, day: Day) -> Option<&Whitening> {
        // without a model error the day makes no difference, and it never matters what hides the sun
        let day = match day {
            _ if imperfection.is_ideal() => Day::Clear,
            Day::Shade => Day::Overcast,
            other => other,
        };
        let whitening = || {
            let error = ModelError::of(self.parts.stated.priors, day, imperfection.discrepancy());
            error.whitening(&self.parts.places, &self.values, &self.parts.sd)
        };
        self.whitenings[imperfection as usize][day as usize].get_or_init(whitening).as_ref()
    }
}
