//! Photographs of one sheet as one model: they share the spectrum, the sheet's own unknowns and variations,
//! and the errors of a camera that took several of them; fold, light and lens are individual.

use nalgebra::{DMatrix, DVector};

use super::hypotheses::Hypothesis;
use super::model::{Ingredients, PhotographModel};
use super::number::Number;
use super::whitened::Photograph;
use crate::estimate::gaussian::Gaussian;
use crate::solve::posterior::{Evaluated, Linearised, Model};

/// One of the photographs within the joint model.
pub struct Member<'a> {
    /// The model of this photograph alone.
    pub model: PhotographModel<'a>,
    /// Index, among all numbers, of each of its own.
    pub places: Vec<usize>,
}

impl Member<'_> {
    /// Index, among all numbers, of the counterpart of the `n`-th of another model, if this one has it: lamps
    /// lack those of daylight.
    fn place_like(&self, other: &PhotographModel, n: usize) -> Option<usize> {
        let ([scene, sheet, camera, emission, _], own) = (other.layout(), self.model.layout());
        let at = match n {
            n if n < scene => n,
            n if n < sheet => {
                let Number { unknown, .. } = other.numbers[n - scene];
                own[0] + self.model.numbers.iter().position(|one| one.unknown == unknown)?
            }
            n if n < camera => own[1] + n - sheet,
            n if n < emission => own[2] + n - camera,
            n => own[3] + n - emission,
        };
        self.places.get(at).copied()
    }

    /// Its own numbers, selected from all.
    #[must_use]
    pub fn own(&self, w: &DVector<f64>) -> DVector<f64> {
        DVector::from_iterator(self.places.len(), self.places.iter().map(|place| w[*place]))
    }
}

/// All photographs of a sheet under one hypothesis and one Gaussian of albedos; the numbers of the spectrum
/// come first.
pub struct JointModel<'a> {
    /// The photographs, one or more.
    pub members: Vec<Member<'a>>,
    count: usize,
}

impl<'a> JointModel<'a> {
    /// The model; `None` if facets are not finite.
    #[must_use]
    pub fn new(
        photographs: &'a [Photograph<'a>],
        hypothesis: Hypothesis,
        gaussian: &'a Gaussian,
    ) -> Option<Self> {
        let mut members: Vec<Member<'a>> = Vec::with_capacity(photographs.len());
        let mut count = gaussian.basis().ncols();
        for (photograph, one) in photographs.iter().enumerate() {
            let (parts, whitening) = (one.parts, one.whitening(hypothesis.imperfection, hypothesis.day)?);
            let emission = hypothesis.emission.and_then(|place| one.emissions().get(place));
            let model =
                PhotographModel::new(parts, &one.sheet_models, (hypothesis, emission), gaussian, whitening);
            let same_camera =
                photographs[..photograph].iter().position(|other| other.parts.eye.is(&parts.eye));
            let [scene, sheet, camera, emission, end] = model.layout();
            let is_shared = |n: usize| match n {
                n if n < scene || n >= emission || (sheet..camera).contains(&n) => members.first(),
                n if n < sheet && model.numbers[n - scene].unknown.is_of_sheet() => members.first(),
                n if n >= camera => same_camera.map(|other| &members[other]),
                _ => None,
            };
            let place = |n: usize| match is_shared(n).and_then(|other| other.place_like(&model, n)) {
                Some(place) => place,
                None if n < scene => n,
                None => {
                    count += 1;
                    count - 1
                }
            };
            let places = (0..end).map(place).collect();
            members.push(Member { model, places });
        }
        Some(Self { members, count })
    }

    /// The first photograph: spectrum and sheet are common to all.
    pub fn first(&self) -> &Member<'a> {
        &self.members[0]
    }

    /// Transfers the point `w` of another model of the same photographs, as far as this one has the same
    /// numbers; the others are at their means. Of another camera, errors of the sensitivities are as nearly
    /// the same as its own can be.
    #[must_use]
    pub fn carried(&self, other: &JointModel, w: &DVector<f64>) -> DVector<f64> {
        let mut carried = DVector::zeros(self.count);
        for (member, from) in self.members.iter().zip(&other.members) {
            let [_, _, camera, emission, _] = from.model.layout();
            let is_same_camera = member.model.parts.eye.is(&from.model.parts.eye);
            let is_shared = |n: usize| is_same_camera || !(camera..emission).contains(&n);
            for (n, place) in from.places.iter().enumerate().filter(|(n, _)| is_shared(*n)) {
                if let Some(own) = member.place_like(&from.model, n) {
                    carried[own] = w[*place];
                }
            }
            if !is_same_camera {
                let [_, _, first, ..] = member.model.layout();
                let sizes = from.places[camera..emission].iter().map(|place| w[*place]);
                let sizes = member.model.parts.eye.sizes_of(&from.model.parts.eye, sizes);
                member.places[first..].iter().zip(sizes).for_each(|(place, size)| carried[*place] = size);
            }
        }
        carried
    }

    /// Residuals of each photograph.
    #[must_use]
    pub fn each(&self, residuals: &DVector<f64>) -> Vec<DVector<f64>> {
        let mut first = 0;
        let of = |member: &Member| {
            let count = member.model.parts.values.len();
            first += count;
            residuals.rows(first - count, count).into_owned()
        };
        self.members.iter().map(of).collect()
    }
}

impl<'a> Model for JointModel<'a> {
    type Second = ();
    type Ingredients = Vec<Evaluated<Ingredients<'a>>>;

    fn unknowns(&self) -> usize {
        self.count
    }

    fn evaluate(&self, w: &DVector<f64>) -> Evaluated<Self::Ingredients> {
        let ingredients: Vec<_> =
            self.members.iter().map(|member| member.model.evaluate(&member.own(w))).collect();
        let residuals = ingredients.iter().flat_map(|one| one.residuals.iter().copied()).collect::<Vec<_>>();
        Evaluated { residuals: DVector::from_vec(residuals), ingredients }
    }

    fn derivatives(&self, w: &DVector<f64>, at: Evaluated<Self::Ingredients>) -> Linearised<()> {
        let members = self.members.iter().zip(at.ingredients);
        let mut each: Vec<_> =
            members.map(|(member, at)| member.model.derivatives(&member.own(w), at)).collect();
        // its numbers are the only ones
        if each.len() == 1
            && let Some(only) = each.pop()
        {
            return only;
        }
        let values = at.residuals.len();
        let (mut jacobian, mut first) = (DMatrix::zeros(values, self.count), 0);
        for (member, one) in self.members.iter().zip(&each) {
            for (column, place) in one.jacobian.column_iter().zip(&member.places) {
                jacobian.column_mut(*place).rows_mut(first, column.len()).copy_from(&column);
            }
            first += one.residuals.len();
        }
        Linearised::new(at.residuals, jacobian, ())
    }
}
