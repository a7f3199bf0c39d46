//! Light that the sheet of a photograph emits: it looks like one that does not, in light that is (1 + f /
//! albedo) times as strong.

use std::ops::AddAssign;

use nalgebra::{DMatrix, DVector};

use super::PhotographModel;
use crate::estimate::emission::{Fall, Sent, UNKNOWNS};
use crate::estimate::gaussian::logistic;
use crate::estimate::photograph::prediction::Terms;

/// Albedo below which emission is not distinguished from the reflection of more light: darker sheets hardly
/// light themselves.
const DARKEST: f64 = 0.01;

impl<'a> PhotographModel<'a> {
    /// The terms for an albedo, including emission. For light from behind f is proportional to the albedo's
    /// square.
    pub(super) fn terms(&self, w: &DVector<f64>, albedo: &[f64]) -> Terms {
        let mut terms = self.reflected_terms(albedo);
        if let Some((sent, power)) = self.sent(w) {
            let Terms { values, slopes } = &mut terms;
            for (n, (albedo, f)) in albedo.iter().zip(&sent.fraction).enumerate() {
                let (of_light, slope) = of_albedo(*albedo, *f, power);
                let change = slope * values.column(n);
                slopes.column_mut(n).scale_mut(of_light);
                slopes.column_mut(n).add_assign(&change);
                values.column_mut(n).scale_mut(of_light);
            }
        }
        terms
    }

    /// The emission of the sheet at `w`, and the power of the albedo to which it is proportional; `None`
    /// without any.
    fn sent(&self, w: &DVector<f64>) -> Option<(Sent, i32)> {
        let emission = self.emission?;
        Some((emission.at(self.of_emission(w)), emission.power_of_reflectance()))
    }

    /// The numbers of the emission.
    fn of_emission<'w>(&self, w: &'w DVector<f64>) -> &'w [f64] {
        let [.., emission, end] = self.layout();
        &w.as_slice()[emission..end]
    }

    /// The emission of the sheet at `w` as a fraction of white, and its derivatives by the numbers of the
    /// emission, then by the logit of the albedo: waveband by number. `None` without any.
    #[must_use]
    pub fn fraction_sent(&self, w: &DVector<f64>) -> Option<(DVector<f64>, DMatrix<f64>)> {
        let (Sent { mut fraction, slopes, .. }, power) = self.sent(w)?;
        let mut slopes = slopes.insert_column(UNKNOWNS, 0.0);
        for (band, z) in self.logit(w).iter().enumerate() {
            let albedo = logistic(*z);
            let of_albedo = albedo.powi(power);
            fraction[band] *= of_albedo;
            slopes.row_mut(band).scale_mut(of_albedo);
            slopes[(band, UNKNOWNS)] = f64::from(power) * (1.0 - albedo) * fraction[band];
        }
        Some((fraction, slopes))
    }

    /// The fall of logits towards the wavelengths that excite the sheet, if there is one.
    #[must_use]
    pub fn fall(&self, w: &DVector<f64>) -> Option<Fall<'a>> {
        self.emission?.fall(self.of_emission(w))
    }

    /// Derivatives of the terms by the numbers of the emission, node by waveband; `None` without emission.
    pub(super) fn terms_by_emission(
        &self,
        w: &DVector<f64>,
        albedo: &[f64],
        terms: &Terms,
    ) -> Option<Vec<DMatrix<f64>>> {
        let (sent, power) = self.sent(w)?;
        let reflected = self.reflected_terms(albedo).values;
        let fall = self.fall(w);
        let by = |(k, slopes): (usize, nalgebra::DVectorView<f64>)| match &fall {
            Some(Fall { place, sd, falling, .. }) if *place == k => {
                let change = |n: usize| albedo[n] * (1.0 - albedo[n]) * sd * falling[n];
                DMatrix::from_fn(reflected.nrows(), albedo.len(), |node, n| {
                    terms.slopes[(node, n)] * change(n)
                })
            }
            _ => DMatrix::from_fn(reflected.nrows(), albedo.len(), |node, n| {
                reflected[(node, n)] * slopes[n] * albedo[n].max(DARKEST).powi(power - 1)
            }),
        };
        Some(sent.slopes.column_iter().enumerate().map(by).collect())
    }
}

/// Factor by which light seems stronger to a sheet of an albedo that emits a fraction f of white times a
/// power of the albedo, and its derivative by albedo.
fn of_albedo(albedo: f64, f: f64, power: i32) -> (f64, f64) {
    let (from, power) = (albedo.max(DARKEST), power - 1);
    let slope = f64::from(power) * f * from.powi(power - 1);
    (1.0 + f * from.powi(power), if albedo > DARKEST { slope } else { 0.0 })
}
