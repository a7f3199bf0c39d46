//! A photograph with what makes its residuals standard normal.

use std::cell::OnceCell;
use std::rc::Rc;

use nalgebra::DMatrix;

use super::day::Day;
use super::error::{ModelError, Whitening};
use super::imperfection::Discrepancy;
use super::parts::Parts;
use super::sheet_models::SheetModels;
use crate::estimate::emission::Emission;

/// A photograph with what does not depend on the class of spectra.
pub struct Photograph<'a> {
    /// What it is made of.
    pub parts: &'a Parts,
    /// The kinds of sheets as it shows them.
    pub sheet_models: Rc<SheetModels<'a>>,
    /// The values that errors are relative to.
    values: DMatrix<f64>,
    /// What makes residuals standard normal with each discrepancy on each kind of day, made when it is first
    /// asked for.
    whitenings: Rc<[[OnceCell<Option<Whitening>>; Day::ALL.len()]; 4]>,
    /// What its sheet may send out itself, made when it is first asked for.
    emissions: OnceCell<Vec<Emission>>,
}

/// Errors are relative to no less than that share of a channel's brightest value: what is darker is no part
/// of a fold in the sun.
const DARKEST: f64 = 0.1;

impl<'a> Photograph<'a> {
    /// Photographs of one sheet.
    #[must_use]
    pub fn all(of: &'a [Parts]) -> Vec<Self> {
        let photograph = |(parts, sheet_models): (&'a Parts, SheetModels<'a>)| {
            let values = parts.values.clone();
            let sheet_models = Rc::new(sheet_models);
            Self { parts, sheet_models, values, whitenings: Rc::default(), emissions: OnceCell::new() }
                .relative_to(parts.values.clone())
        };
        of.iter().zip(SheetModels::of(of)).map(photograph).collect()
    }

    /// The same with errors relative to these values: facet by channel.
    #[must_use]
    pub fn relative_to(self, mut values: DMatrix<f64>) -> Self {
        for mut channel in values.column_iter_mut() {
            let least = DARKEST * channel.max();
            channel.apply(|value| *value = value.max(least));
        }
        Self { values, whitenings: Rc::default(), ..self }
    }

    /// The same photograph taken to be in the light of other parts, which are the same otherwise.
    #[must_use]
    pub fn in_light_of(&self, parts: &'a Parts) -> Self {
        let Self { sheet_models, values, whitenings, .. } = self;
        let (sheet_models, whitenings) = (Rc::clone(sheet_models), Rc::clone(whitenings));
        Self { parts, sheet_models, values: values.clone(), whitenings, emissions: OnceCell::new() }
    }

    /// What its sheet may send out itself in the light that was stated, nothing first.
    pub fn emissions(&self) -> &[Emission] {
        let Parts { eye, stated, .. } = self.parts;
        self.emissions.get_or_init(|| Emission::all(&eye.wavelengths_nm, eye.sun.as_slice(), stated.backing))
    }

    /// What makes residuals standard normal; none if facets are not finite.
    pub fn whitening(&self, discrepancy: Discrepancy, day: Day) -> Option<&Whitening> {
        // where nothing is left unexplained the day makes no difference, nor does it matter what hides the
        // sun
        let day = match day {
            _ if discrepancy == Discrepancy::None => Day::Clear,
            Day::Shade => Day::Overcast,
            other => other,
        };
        let whitening = || {
            let error = ModelError::of(self.parts.stated.priors, day).scaled(discrepancy.size());
            error.whitening(&self.parts.places, &self.values, &self.parts.sd)
        };
        self.whitenings[discrepancy as usize][day as usize].get_or_init(whitening).as_ref()
    }
}
