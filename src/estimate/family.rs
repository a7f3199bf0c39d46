//! What a search asks of whatever is estimated from: a model of the same data for each hypothesis and each
//! Gaussian of spectra.

use nalgebra::{DMatrix, DVector};

use super::gaussian::Gaussian;
use super::prior::Prior;
use crate::solve::posterior::{Linearised, Model};

/// A model whose first numbers are those of a spectrum; the others are the scene's.
pub trait SpectrumModel: Model {
    /// The Gaussian of logits behind the numbers of the spectrum.
    fn gaussian(&self) -> &Gaussian;
    /// Derivatives by logit at a point: residual by waveband.
    fn by_logit(&self, w: &DVector<f64>, at: &Linearised<Self::Second>) -> DMatrix<f64>;
    /// What is reported of `w`: reflectance in every waveband, then whatever else is found.
    fn values(&self, w: &DVector<f64>) -> Vec<f64>;
    /// How far the values may be off at a maximum: the product of its transpose with it is their covariance.
    /// None if the model is not finite.
    fn spread(&self, w: &DVector<f64>, at: &Linearised<Self::Second>) -> Option<DMatrix<f64>>;
    /// Root mean square of what is left of the data, in units of its expected size.
    fn rms(&self, residuals: &DVector<f64>) -> f64;
    /// Logarithm of the factor by which units of noise make volumes of errors larger; models of a family that
    /// share their noise may leave it out.
    fn ln_whitening(&self) -> f64;
}

/// The models of some data.
pub trait Family {
    /// What is taken to be so.
    type Hypothesis: Copy + PartialEq;
    /// As that of its models.
    type Second;
    /// The model under a hypothesis.
    type Model<'m>: SpectrumModel<Second = Self::Second>
    where
        Self: 'm;

    /// The model for spectra of a Gaussian; none if it is not finite.
    fn model<'m>(&'m self, hypothesis: Self::Hypothesis, gaussian: &'m Gaussian) -> Option<Self::Model<'m>>;

    /// Logarithms of the shares that classes of spectra have under a hypothesis, times how often that is true
    /// of each as far as it depends on the class.
    fn ln_class_shares(&self, hypothesis: Self::Hypothesis, prior: &Prior) -> Vec<f64>;

    /// Whether there are channels enough to tell classes apart.
    fn tells_classes(&self) -> bool;

    /// The brightest datum, in units of its noise.
    fn peak(&self) -> f64;

    /// A maximum counts as found within this many standard deviations of it.
    fn tolerance(&self) -> f64;

    /// Whether there are dozens of hypotheses, many of which may be as probable as the first.
    fn has_many_hypotheses(&self) -> bool {
        false
    }
}

/// By how much error bars are wider than the noise makes them. Data further from the model than their noise:
/// the noise, or the scene, is not what it was said to be (R. T. Birge, *Physical Review* 40 (1932), p. 207).
pub fn widened(rms: f64) -> f64 {
    rms.max(1.0)
}
