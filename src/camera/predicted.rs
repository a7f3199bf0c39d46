//! Sensitivities of an unmeasured camera, predicted from the colour matrix of its RAW files.
//!
//! A. E. Hoerl, R. W. Kennard, "Ridge regression: biased estimation for nonorthogonal problems",
//! *Technometrics* 12 (1970), p. 55: from matrices to sensitivities, trained on the measured cameras whose
//! matrices are published (`share/make-camera-matrices.py`), with an offset common to cameras of one maker.
//! It is trained on published matrices rather than matrices computed from the sensitivities, which differ
//! from them by more than cameras do. The matrix under illuminant A, if present, does not improve the
//! prediction. `benches/cameras.rs` leaves each camera out in turn.

use nalgebra::{DMatrix, DVector};

use super::measured::{KnownSensitivities, known_sensitivities, on_one_scale};
use crate::colorimetry::{Colorimeter, Observer};
use crate::error::{Error, Result};
use crate::solve::Eigen;
use crate::spectrum::{MeasuredCamera, WavelengthGrid, illuminant};

/// Matrices of cameras that rawler knows, under its licence, which binds builds that read RAW files anyway;
/// other builds predict no camera.
#[cfg(feature = "raw")]
const MATRICES: &str = include_str!("../../share/camera-matrices.csv");
#[cfg(not(feature = "raw"))]
const MATRICES: &str = "";
/// Variance of sensitivities around a linear function of the matrix, and of the makers' offsets, in units of
/// the effect of one standard deviation of a matrix entry. With a third to three times either, errors are
/// equal to a twentieth.
const RIDGE: f64 = 1.0;
const MAKERS_APART: f64 = 1.0;
/// Largest root mean square distance of a matrix from those of the cameras, in standard deviations of its
/// nine entries; beyond that it is no camera's.
const FARTHEST: f64 = 4.0;
/// Number of error components kept per channel, in order of variance: these contain nineteen parts in twenty.
const ERRORS: usize = 5;

/// Expected error of predicted sensitivities, root mean square relative to green's peak, from leaving each
/// camera out in turn.
pub const PREDICTED_ERROR: f64 = 0.030;

/// Rows of a matrix from XYZ to a camera's R, G and B, as in DNG's tag `ColorMatrix` for D65.
pub type ColourMatrix = [[f64; 3]; 3];

/// A matrix relative to green's response to white: nine numbers, rows of the matrix times the white of D65.
type Features = DVector<f64>;

/// A measured camera with a published matrix.
struct Example {
    camera: MeasuredCamera,
    features: Features,
    /// Sensitivities R, G and B, concatenated and normalised to green's peak.
    sensitivities: DVector<f64>,
}

/// Predicts sensitivities.
pub struct Predictor {
    examples: Vec<Example>,
    white_xyz: [f64; 3],
    bands: usize,
}

/// A camera that was left out, and its prediction from the others.
#[derive(Clone, Debug)]
pub struct PredictedLeftOut {
    /// The camera.
    pub camera: MeasuredCamera,
    /// Its predicted sensitivities.
    pub predicted: [Vec<f64>; 3],
    /// Its measured sensitivities.
    pub measured: [Vec<f64>; 3],
}

/// The regression on a set of cameras.
struct Ridge<'a> {
    examples: Vec<&'a Example>,
    mean: Features,
    sd: Features,
    mean_sensitivities: DVector<f64>,
    /// Camera by concatenated sensitivities.
    coefficients: DMatrix<f64>,
}

impl Predictor {
    /// For sensitivities on `grid`, from the published matrices.
    ///
    /// # Errors
    /// Only if the embedded tables are damaged.
    pub fn new(grid: &WavelengthGrid) -> Result<Self> {
        let published = |line: &str| {
            let (name, numbers) = line.split_once(',')?;
            let numbers: Option<Vec<f64>> = numbers.split(',').map(|number| number.parse().ok()).collect();
            let numbers: [f64; 9] = numbers?.try_into().ok()?;
            Some((name.to_owned(), [0, 3, 6].map(|row| [numbers[row], numbers[row + 1], numbers[row + 2]])))
        };
        let published: Option<Vec<_>> = MATRICES.lines().skip(1).map(published).collect();
        Self::by_matrices(grid, &published.ok_or_else(damaged)?)
    }

    /// The same from these matrices of measured cameras, with their [names](MeasuredCamera::name).
    ///
    /// # Errors
    /// [`Error::Fault`] if a camera was not measured, or a matrix is not a camera's.
    pub fn by_matrices(grid: &WavelengthGrid, matrices: &[(String, ColourMatrix)]) -> Result<Self> {
        let eye = Colorimeter::new(grid, &illuminant("D65")?, Observer::Cie1931_2deg)?;
        let white_xyz = eye.xyz(&vec![1.0; grid.len()]);
        let known = known_sensitivities(grid)?;
        let example = |(name, matrix): &(String, ColourMatrix)| {
            let KnownSensitivities { camera, sensitivities } =
                known.iter().find(|known| known.camera.name() == *name)?;
            let features = features(matrix, white_xyz)?;
            Some(Example {
                camera: *camera,
                features,
                sensitivities: DVector::from_vec(sensitivities.concat()),
            })
        };
        let examples: Option<Vec<_>> = matrices.iter().map(example).collect();
        Ok(Self { examples: examples.ok_or_else(damaged)?, white_xyz, bands: grid.len() })
    }

    /// Sensitivities R, G and B, normalised to green's peak, of a camera by `make`, as written in its
    /// pictures, with this colour matrix; none if the matrix is not a camera's, and in builds that do not
    /// read RAW files.
    ///
    /// # Example
    /// ```
    /// use vfold::camera::Predictor;
    /// use vfold::spectrum::WavelengthGrid;
    /// # if cfg!(not(feature = "raw")) { return Ok::<(), vfold::Error>(()); }
    /// let grid = WavelengthGrid::default();
    /// let matrix = [[0.902, -0.289, -0.0715], [-0.4535, 1.2436, 0.2348], [-0.0934, 0.1919, 0.7086]];
    /// let [_, green, _] = Predictor::new(&grid)?.predict("NIKON CORPORATION", &matrix).unwrap();
    /// let peak = green.iter().position(|value| *value == 1.0).unwrap();
    /// assert!((510.0..550.0).contains(&grid.wavelengths_nm()[peak]));
    /// # Ok::<(), vfold::Error>(())
    /// ```
    #[must_use]
    pub fn predict(&self, make: &str, matrix: &ColourMatrix) -> Option<[Vec<f64>; 3]> {
        let features = features(matrix, self.white_xyz)?;
        let ridge = Ridge::of(self.examples.iter().collect())?;
        let is_camera = ridge.scaled(&features).norm() <= FARTHEST * (features.len() as f64).sqrt();
        is_camera.then(|| self.sensitivities(&ridge, &features, |camera| camera.is_made_by(make)))
    }

    /// The prediction of each camera from the others.
    #[must_use]
    pub fn left_out(&self) -> Vec<PredictedLeftOut> {
        let left_out = |one: &Example| {
            let others = self.examples.iter().filter(|other| other.camera != one.camera).collect();
            let is_same_maker = |camera: &MeasuredCamera| camera.is_made_by(one.camera.maker);
            Some(PredictedLeftOut {
                camera: one.camera,
                predicted: self.sensitivities(&Ridge::of(others)?, &one.features, is_same_maker),
                measured: self.channels(&one.sensitivities),
            })
        };
        self.examples.iter().filter_map(left_out).collect()
    }

    /// The camera with the matrix nearest to that of a camera, which would stand in for it without a
    /// regression. None if its matrix is unknown.
    #[must_use]
    pub fn nearest_to(&self, camera: &str) -> Option<MeasuredCamera> {
        let one = self.examples.iter().find(|one| one.camera.name() == camera)?;
        let others = self.examples.iter().filter(|other| other.camera != one.camera);
        let off = |other: &&Example| (&other.features - &one.features).norm();
        others.min_by(|a, b| off(a).total_cmp(&off(b))).map(|other| other.camera)
    }

    /// Errors of predicted sensitivities relative to green's peak: error components of each channel by
    /// waveband, each scaled to one standard deviation, from cameras left out in turn. Empty in builds that
    /// do not read RAW files.
    #[must_use]
    pub fn errors(&self) -> Vec<(usize, DVector<f64>)> {
        let left_out = self.left_out();
        if left_out.is_empty() {
            return Vec::new();
        }
        let of_channel = |channel: usize| {
            let off = |one: &PredictedLeftOut| {
                let pair = one.predicted[channel].iter().zip(&one.measured[channel]);
                DVector::from_iterator(self.bands, pair.map(|(a, b)| a - b))
            };
            let off = DMatrix::from_columns(&left_out.iter().map(off).collect::<Vec<_>>());
            let Eigen { values, vectors } =
                Eigen::of_symmetric(&off * off.transpose() / left_out.len() as f64);
            let mut order: Vec<usize> = (0..values.len()).collect();
            order.sort_by(|a, b| values[*b].total_cmp(&values[*a]));
            let error = move |n: usize| (channel, values[n].max(0.0).sqrt() * vectors.column(n));
            order.into_iter().take(ERRORS).map(error)
        };
        (0..3).flat_map(of_channel).collect()
    }

    fn sensitivities(
        &self,
        ridge: &Ridge,
        features: &Features,
        is_same_maker: impl Fn(&MeasuredCamera) -> bool,
    ) -> [Vec<f64>; 3] {
        let sensitivities = ridge.at(features, is_same_maker).map(|value| value.max(0.0));
        on_one_scale(self.channels(&sensitivities))
    }

    fn channels(&self, sensitivities: &DVector<f64>) -> [Vec<f64>; 3] {
        [0, 1, 2]
            .map(|channel| sensitivities.rows(channel * self.bands, self.bands).iter().copied().collect())
    }
}

impl<'a> Ridge<'a> {
    /// None without cameras.
    fn of(examples: Vec<&'a Example>) -> Option<Self> {
        let rows: Vec<_> = examples.iter().map(|one| one.features.clone()).collect();
        if rows.is_empty() {
            return None;
        }
        let all = DMatrix::from_columns(&rows);
        let (mean, sd) = (all.column_mean(), all.column_variance().map(f64::sqrt));
        let sensitivities =
            DMatrix::from_columns(&examples.iter().map(|one| one.sensitivities.clone()).collect::<Vec<_>>());
        let mean_sensitivities = sensitivities.column_mean();
        let mut ridge = Self { examples, mean, sd, mean_sensitivities, coefficients: DMatrix::zeros(0, 0) };
        let alike =
            |one: &&Example| ridge.likeness(&one.features, |camera| camera.is_made_by(one.camera.maker));
        let alike = DMatrix::from_columns(&ridge.examples.iter().map(alike).collect::<Vec<_>>());
        let count = alike.nrows();
        let mut apart = sensitivities.transpose();
        apart.row_iter_mut().for_each(|mut row| row -= ridge.mean_sensitivities.transpose());
        ridge.coefficients = (alike + RIDGE * DMatrix::identity(count, count)).cholesky()?.solve(&apart);
        Some(ridge)
    }

    fn scaled(&self, features: &Features) -> Features {
        (features - &self.mean).component_div(&self.sd)
    }

    /// Prior covariances of a camera's sensitivities with those of each example.
    fn likeness(&self, features: &Features, is_same_maker: impl Fn(&MeasuredCamera) -> bool) -> DVector<f64> {
        let own = self.scaled(features);
        let likeness = |other: &&Example| {
            let of_maker = if is_same_maker(&other.camera) { MAKERS_APART } else { 0.0 };
            own.dot(&self.scaled(&other.features)) + of_maker
        };
        DVector::from_iterator(self.examples.len(), self.examples.iter().map(likeness))
    }

    fn at(&self, features: &Features, is_same_maker: impl Fn(&MeasuredCamera) -> bool) -> DVector<f64> {
        &self.mean_sensitivities + self.coefficients.tr_mul(&self.likeness(features, is_same_maker))
    }
}

fn damaged() -> Error {
    Error::Fault("share/camera-matrices.csv has what is no measured camera's matrix".to_owned())
}

/// None if green does not respond to white.
fn features(matrix: &ColourMatrix, white_xyz: [f64; 3]) -> Option<Features> {
    let numbers =
        matrix.iter().flat_map(|row| row.iter().zip(white_xyz).map(|(number, white)| number * white));
    let numbers = DVector::from_iterator(9, numbers);
    let green = numbers.rows(3, 3).sum();
    (green > 0.0 && numbers.iter().all(|number| number.is_finite())).then(|| numbers / green)
}
