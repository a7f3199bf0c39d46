//! The facets as a model of standard normal numbers, first those of the spectrum, then those of the scene's
//! unknowns.

use std::ops::AddAssign;

use nalgebra::{DMatrix, DVector};

use super::data::{Curvature, FacetData, FittedExposure, LinearisedFacets, Predicted, SecondDerivatives};
use super::emission::{Emission, Fall, Sent};
use super::family::{Family, SpectrumModel, widened};
use super::gaussian::{Gaussian, logistic, mean_slope};
use super::prior::Prior;
use crate::solve::dense::{add_rows, product_with_transposed};
use crate::solve::posterior::{Evaluated, Linearised, Model};

/// Reflectance at which the spread of spectra is half of what their logits imply: the surface of a dark sheet
/// reflects some light of all wavelengths, whatever is beneath. Between 0.003 and 0.01 the value matters less
/// to the coverage of error bars than the choice of test set.
const SURFACE: f64 = 0.006;
/// A mode counts as found within this many standard deviations.
const TOLERANCE: f64 = 1e-3;

/// Converts derivatives by logits and unknowns to derivatives by whitened logits and unknowns.
fn whitened(jacobian: &DMatrix<f64>, gaussian: &Gaussian) -> DMatrix<f64> {
    let (bands, coordinates) = gaussian.basis().shape();
    let (rows, unknowns) = (jacobian.nrows(), jacobian.ncols() - bands);
    let mut all = DMatrix::zeros(rows, coordinates + unknowns);
    let of_spectrum = &mut all.as_mut_slice()[..rows * coordinates];
    add_rows(of_spectrum, 0..rows, (jacobian, &gaussian.basis().transpose()), 0..bands);
    all.columns_mut(coordinates, unknowns).copy_from(&jacobian.columns(bands, unknowns));
    all
}

/// The facets as a model of the whitened logit of reflectance, followed by the scene's unknowns.
pub struct Facets<'a> {
    pub data: &'a FacetData<'a>,
    pub gaussian: &'a Gaussian,
}

/// Ingredients of second derivatives by logit.
pub struct Second {
    pub reflectance: Vec<f64>,
    /// Derivatives of the model by logit, then by the scene's unknowns.
    jacobian: DMatrix<f64>,
    pub exposure: FittedExposure,
    pub by_reflectance: SecondDerivatives,
}

impl Facets<'_> {
    /// Starting point at a reflectance, with the scene at its prior mode.
    pub fn set_out_from(&self, reflectance: &[f64]) -> DVector<f64> {
        self.gaussian.nearest(reflectance).resize_vertically(self.unknowns(), 0.0)
    }

    /// The reflectance at `w`.
    pub fn reflectance_at(&self, w: &DVector<f64>) -> Vec<f64> {
        self.split(w).0.iter().map(|z| logistic(*z)).collect()
    }

    /// Logits and the unknowns of scene and emission at `w`.
    pub fn split(&self, w: &DVector<f64>) -> (DVector<f64>, DVector<f64>) {
        let coordinates = self.gaussian.basis().ncols();
        let mut logit = self.gaussian.logit_at(&w.rows(0, coordinates).into_owned());
        let unknowns = w.rows(coordinates, w.len() - coordinates).into_owned();
        if let Some((_, Fall { amount, falling, .. })) = self.fall(&unknowns) {
            logit.axpy(amount, falling, 1.0);
        }
        (logit, unknowns)
    }

    /// The emission of the sheet; `None` if it is not considered.
    fn sent(&self, reflectance: &[f64], unknowns: &DVector<f64>) -> Option<Sent> {
        let emission = self.data.emission()?;
        let mut sent = emission.at(&unknowns.as_slice()[self.data.scene().unknowns().len()..]);
        for (band, r) in reflectance.iter().enumerate() {
            let with_reflectance = r.powi(emission.power_of_reflectance());
            sent.fraction[band] *= with_reflectance;
            sent.slopes.row_mut(band).scale_mut(with_reflectance);
        }
        Some(sent)
    }

    /// The fall of logits towards the exciting wavelengths, and its index among the unknowns.
    fn fall(&self, unknowns: &DVector<f64>) -> Option<(usize, Fall<'_>)> {
        let scene = self.data.scene().unknowns().len();
        let fall = self.data.emission()?.fall(&unknowns.as_slice()[scene..])?;
        Some((scene + fall.place, fall))
    }
}

/// A point of the data's model, and what that predicts there.
pub struct Point {
    reflectance: Vec<f64>,
    unknowns: DVector<f64>,
    predicted: Predicted,
}

impl SpectrumModel for Facets<'_> {
    fn gaussian(&self) -> &Gaussian {
        self.gaussian
    }

    fn by_logit(&self, at: &Linearised<Second>) -> DMatrix<f64> {
        at.second.jacobian.columns(0, self.gaussian.mean().len()).into_owned()
    }

    /// Reflectances, unknowns of the scene in their own units, exposure and, if emission is considered, the
    /// emission as a fraction of white.
    fn values(&self, _: &DVector<f64>, at: &Evaluated<Point>) -> Vec<f64> {
        let Point { reflectance, unknowns, predicted } = &at.ingredients;
        let of_scene =
            self.data.scene().unknowns().iter().zip(unknowns).map(|(expected, w)| expected.at(*w).0);
        let sent =
            self.sent(reflectance, unknowns).into_iter().flat_map(|sent| Vec::from(sent.fraction.data));
        reflectance.iter().copied().chain(of_scene).chain([predicted.exposure]).chain(sent).collect()
    }

    fn spread(&self, w: &DVector<f64>, at: &Linearised<Second>) -> Option<DMatrix<f64>> {
        let (logit, unknowns) = self.split(w);
        let (bands, coordinates) = self.gaussian.basis().shape();
        let exposure = &at.second.exposure;
        let scene = self.data.scene().unknowns().len();
        let reflectance: Vec<f64> = logit.iter().map(|z| logistic(*z)).collect();
        let sent = self.sent(&reflectance, &unknowns);
        let place_of_exposure = bands + scene;
        let point = place_of_exposure + 1 + sent.as_ref().map_or(0, |sent| sent.fraction.len());
        // Derivatives of the values by the whitened numbers: value by number.
        let mut slopes = DMatrix::zeros(point, at.jacobian.ncols());
        slopes.view_mut((0, 0), (bands, coordinates)).copy_from(self.gaussian.basis());
        for (n, (expected, w)) in self.data.scene().unknowns().iter().zip(&unknowns).enumerate() {
            slopes[(bands + n, coordinates + n)] = expected.at(*w).1;
        }
        let of_exposure = DMatrix::from_row_slice(1, exposure.slopes.len(), exposure.slopes.as_slice());
        if let Some((place, Fall { sd, falling, .. })) = self.fall(&unknowns) {
            slopes.view_mut((0, coordinates + place), (bands, 1)).copy_from(&(sd * falling));
        }
        if let Some(sent) = sent {
            let first = place_of_exposure + 1;
            slopes.view_mut((first, coordinates + scene), sent.slopes.shape()).copy_from(&sent.slopes);
            let mut by_spectrum = slopes.view_mut((first, 0), (bands, coordinates));
            by_spectrum.copy_from(self.gaussian.basis());
            let power = f64::from(self.data.emission().map_or(0, Emission::power_of_reflectance));
            for (band, r) in reflectance.iter().enumerate() {
                by_spectrum.row_mut(band).scale_mut(power * sent.fraction[band] * (1.0 - r));
            }
        }
        slopes.row_mut(place_of_exposure).copy_from(&whitened(&of_exposure, self.gaussian).row(0));
        // The covariance is S(I + JᵀJ)⁻¹Sᵀ, where S are these derivatives.
        let spread = at.information()?.l_dirty().solve_lower_triangular(&slopes.transpose())?;
        let rows = spread.nrows();
        let mut spread = spread.insert_row(rows, 0.0);
        spread[(rows, place_of_exposure)] = exposure.sd;
        spread *= widened(self.rms(&at.residuals));
        for (mut column, z) in spread.column_iter_mut().zip(&logit) {
            let sd = column.norm();
            let mean = 0.5 * (logistic(z - sd) + logistic(z + sd));
            column *= mean_slope(*z, sd) * mean / (mean + SURFACE);
        }
        Some(spread)
    }

    fn rms(&self, residuals: &DVector<f64>) -> f64 {
        self.data.rms(residuals)
    }

    fn ln_whitening(&self) -> f64 {
        self.data.ln_whitening
    }
}

/// All facets of a sample share one scene, and the emission of the sheet is fixed: there is only one
/// hypothesis.
impl Family for FacetData<'_> {
    type Hypothesis = ();
    type Second = Second;
    type Model<'m>
        = Facets<'m>
    where
        Self: 'm;

    fn model<'m>(&'m self, (): (), gaussian: &'m Gaussian) -> Option<Facets<'m>> {
        Some(Facets { data: self, gaussian })
    }

    fn ln_class_shares(&self, (): (), prior: &Prior) -> Vec<f64> {
        let of_all = prior.ln_shares(1.0);
        match self.emission() {
            None => of_all,
            Some(emission) => emission.ln_class_shares(of_all, prior),
        }
    }

    fn channels(&self) -> usize {
        self.channels()
    }

    fn peak(&self) -> f64 {
        self.peak
    }

    fn tolerance(&self) -> f64 {
        TOLERANCE
    }
}

impl Model for Facets<'_> {
    type Second = Second;
    type Ingredients = Point;

    fn unknowns(&self) -> usize {
        self.gaussian.basis().ncols() + self.data.unknowns()
    }

    fn evaluate(&self, w: &DVector<f64>) -> Evaluated<Point> {
        let (logit, unknowns) = self.split(w);
        let reflectance: Vec<f64> = logit.iter().map(|z| logistic(*z)).collect();
        let Evaluated { residuals, ingredients: predicted } =
            self.data.residuals(&reflectance, unknowns.as_slice());
        Evaluated { residuals, ingredients: Point { reflectance, unknowns, predicted } }
    }

    fn derivatives(&self, _: &DVector<f64>, at: Evaluated<Point>) -> Linearised<Second> {
        let Evaluated { residuals, ingredients: Point { reflectance, unknowns, predicted } } = at;
        let LinearisedFacets { residuals, mut jacobian, mut exposure, second } = self.data.derivatives(
            &reflectance,
            unknowns.as_slice(),
            Evaluated { residuals, ingredients: predicted },
        );
        for (band, r) in reflectance.iter().enumerate() {
            jacobian.column_mut(band).scale_mut(r * (1.0 - r));
            exposure.slopes[band] *= r * (1.0 - r);
        }
        if let Some((place, Fall { sd, falling, .. })) = self.fall(&unknowns) {
            let bands = reflectance.len();
            let column = sd * jacobian.columns(0, bands) * falling;
            jacobian.column_mut(bands + place).copy_from(&column);
            exposure.slopes[bands + place] = sd * exposure.slopes.rows(0, bands).dot(falling);
        }
        let whitened = whitened(&jacobian, self.gaussian);
        Linearised::new(
            residuals,
            whitened,
            Second { reflectance, jacobian, exposure, by_reflectance: second },
        )
    }

    fn curvature(&self, at: &Second, multipliers: &DVector<f64>) -> Option<DMatrix<f64>> {
        let Curvature { slopes, reflectance, mut mixed, unknowns } =
            self.data.curvature(&at.by_reflectance, multipliers);
        let basis = self.gaussian.basis();
        let transposed = basis.transpose();
        let (mut weighted, mut by_logit) = (transposed.clone(), DVector::zeros(basis.nrows()));
        // Chain rule with dr/dz = r(1 − r) and d²r/dz² = r(1 − r)(1 − 2r); wavebands do not mix.
        for (band, r) in at.reflectance.iter().enumerate() {
            let change = r * (1.0 - r);
            by_logit[band] = change * (change * reflectance[band] + (1.0 - 2.0 * r) * slopes[band]);
            weighted.column_mut(band).scale_mut(by_logit[band]);
            mixed.row_mut(band).scale_mut(change);
        }
        let (coordinates, count) = (basis.ncols(), unknowns.nrows());
        let mut all = product_with_transposed(&transposed, &weighted).resize(
            coordinates + count,
            coordinates + count,
            0.0,
        );
        let mut unknowns = unknowns;
        if let Some((place, Fall { sd, falling, .. })) = self.fall(&DVector::zeros(count)) {
            // the fall moves logits like a coordinate of the spectrum
            let by_fall = sd * mixed.tr_mul(falling);
            unknowns.row_mut(place).add_assign(&by_fall.transpose());
            unknowns.column_mut(place).add_assign(&by_fall);
            let of_logit = sd * falling.component_mul(&by_logit);
            unknowns[(place, place)] += sd * of_logit.dot(falling);
            mixed.column_mut(place).add_assign(&of_logit);
        }
        let mixed = basis.tr_mul(&mixed);
        all.view_mut((0, coordinates), mixed.shape()).copy_from(&mixed);
        all.view_mut((coordinates, 0), (count, coordinates)).tr_copy_from(&mixed);
        all.view_mut((coordinates, coordinates), (count, count)).copy_from(&unknowns);
        Some(all)
    }
}
