//! What a search requires of its data: a model of them for each hypothesis and each Gaussian of spectra.

use nalgebra::{DMatrix, DVector};

use super::gaussian::Gaussian;
use super::prior::Prior;
use crate::solve::posterior::{Evaluated, Linearised, Model};

/// A model whose first numbers describe a spectrum and whose others describe the scene.
pub trait SpectrumModel: Model {
    /// The Gaussian of logits behind the numbers of the spectrum.
    fn gaussian(&self) -> &Gaussian;
    /// Derivatives by logit at a point: residual by waveband.
    fn by_logit(&self, at: &Linearised<Self::Second>) -> DMatrix<f64>;
    /// The reported values at `w`, where it was evaluated: reflectance per waveband, then everything else
    /// that is estimated.
    fn values(&self, w: &DVector<f64>, at: &Evaluated<Self::Ingredients>) -> Vec<f64>;
    /// Square root of the covariance of the values at a mode: its transpose times itself is the covariance.
    /// `None` if the model is not finite.
    fn spread(&self, w: &DVector<f64>, at: &Linearised<Self::Second>) -> Option<DMatrix<f64>>;
    /// Root mean square of the residuals, relative to their expected size.
    fn rms(&self, residuals: &DVector<f64>) -> f64;
    /// Log determinant of the whitening of errors; it may be omitted in a family whose models share their
    /// noise.
    fn ln_whitening(&self) -> f64;
}

/// Number of channels that distinguish classes of spectra, lights, and light that the sheet itself emits:
/// fewer have several modes, none of which need be that of most evidence.
pub const TELLING_CHANNELS: usize = 3;

/// The models of some data.
pub trait Family {
    /// The assumptions of a model.
    type Hypothesis: Copy + PartialEq;
    /// As in its models.
    type Second;
    /// The model under a hypothesis.
    type Model<'m>: SpectrumModel<Second = Self::Second>
    where
        Self: 'm;

    /// The model for spectra with this Gaussian; `None` if it is not finite.
    fn model<'m>(&'m self, hypothesis: Self::Hypothesis, gaussian: &'m Gaussian) -> Option<Self::Model<'m>>;

    /// Log probabilities of the classes of spectra under a hypothesis, plus that of the hypothesis as far as
    /// it depends on the class.
    fn ln_class_shares(&self, hypothesis: Self::Hypothesis, prior: &Prior) -> Vec<f64>;

    /// Number of channels, counted over all lights.
    fn channels(&self) -> usize;

    /// True if there are enough channels to distinguish classes.
    fn tells_classes(&self) -> bool {
        self.channels() >= TELLING_CHANNELS
    }

    /// The brightest datum, in units of its noise.
    fn peak(&self) -> f64;

    /// A mode counts as found within this many standard deviations.
    fn tolerance(&self) -> f64;

    /// True if there are dozens of hypotheses, many of which may be as probable as the first.
    fn has_many_hypotheses(&self) -> bool {
        false
    }
}

/// Factor by which error bars are widened if data are further from the model than their noise: then the noise
/// or the scene is not as stated (R. T. Birge, *Physical Review* 40 (1932), p. 207).
pub fn widened(rms: f64) -> f64 {
    rms.max(1.0)
}
