//! Which measured camera stands in for one that nobody measured.
//!
//! By its colour matrix the camera whose matrix is nearest; without one, of the same maker's cameras the one nearest to all others of that
//! maker; without any of the maker, the one nearest to all. `benches/cameras.rs` leaves each camera out in turn and prints how far off they are.

use nalgebra::{Matrix3, Matrix3xX, Vector3};

use super::CameraResponse;
use super::measured::{KnownCurves, curve_error, known_curves};
use crate::colorimetry::{Colorimeter, Observer};
use crate::error::{Error, Result};
use crate::spectrum::{Outside, WavelengthGrid, illuminant, reflectances};

/// Rows of a matrix from XYZ to a camera's R, G and B, as the tag `ColorMatrix` of DNG has it for D65.
pub type ColourMatrix = [[f64; 3]; 3];

/// A camera in the place of another.
#[derive(Clone, Debug, PartialEq)]
pub struct StandIn {
    /// Its name.
    pub name: String,
    /// Why this one.
    pub why: Why,
    /// Its place among the known.
    at: usize,
}

/// Why a camera stands in for another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Why {
    /// Its colour matrix is nearest.
    Matrix,
    /// Of the maker's cameras it is the most usual.
    Maker,
    /// Of all cameras it is the most usual.
    Any,
}

impl Why {
    /// How far off the curves are in the mean, root mean square where green's peak is 1: measured by leaving each camera out in turn.
    #[must_use]
    pub fn expected_error(self) -> f64 {
        match self {
            Self::Matrix => 0.035,
            Self::Maker => 0.042,
            Self::Any => 0.063,
        }
    }

    /// In words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Matrix => "the nearest colour matrix",
            Self::Maker => "the most usual of its maker",
            Self::Any => "the most usual of all makers",
        }
    }
}

/// How far off stand-ins are for one camera, and the mean of all others.
#[derive(Clone, Debug)]
pub struct LeftOut {
    /// The camera that is left out.
    pub camera: String,
    /// The camera taken for it by its matrix, by its maker, and without either, with its error.
    pub stand_ins: [(StandIn, f64); 3],
    /// Error of the mean of all others.
    pub mean_error: f64,
}

/// All that can stand in.
#[derive(Clone, Debug)]
pub struct StandIns {
    known: Vec<KnownCurves>,
    /// Distances between their curves.
    distances: Vec<Vec<f64>>,
}

/// Colour matrices of the cameras that can stand in.
struct Matrices {
    /// From white-balanced XYZ to white-balanced RGB.
    all: Vec<Matrix3<f64>>,
    white_xyz: Vector3<f64>,
}

impl StandIns {
    /// The measured cameras.
    ///
    /// # Errors
    /// Only if the embedded tables are damaged.
    pub fn new() -> Result<Self> {
        let known = known_curves(&WavelengthGrid::default())?;
        let row = |a: &KnownCurves| known.iter().map(|b| curve_error(&a.curves, &b.curves)).collect();
        Ok(Self { distances: known.iter().map(row).collect(), known })
    }

    /// The camera that stands in for one by `make`, as it writes that into its pictures, with this colour matrix if its pictures have one.
    ///
    /// # Errors
    /// Only if the embedded tables are damaged.
    ///
    /// # Example
    /// ```
    /// use vfold::camera::{StandIns, Why};
    /// let stand_in = StandIns::new()?.for_camera("NIKON CORPORATION", None)?;
    /// assert!(stand_in.name.starts_with("nikon-") && stand_in.why == Why::Maker);
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn for_camera(&self, make: &str, matrix: Option<&ColourMatrix>) -> Result<StandIn> {
        let all: Vec<usize> = (0..self.known.len()).collect();
        if let Some(matrix) = matrix {
            let matrices = Matrices::of(&self.known)?;
            if let Some(matrix) = matrices.white_balanced(matrix) {
                return Ok(self.by_matrix(&matrices.all, &matrix, &all));
            }
        }
        Ok(self.by_maker(make, &all))
    }

    /// Each camera left out in turn.
    ///
    /// # Errors
    /// Only if the embedded tables are damaged.
    pub fn left_out(&self) -> Result<Vec<LeftOut>> {
        let matrices = Matrices::of(&self.known)?.all;
        let left_out = |at: usize| {
            let others: Vec<usize> = (0..self.known.len()).filter(|other| *other != at).collect();
            let stand_ins = [
                self.by_matrix(&matrices, &matrices[at], &others),
                self.by_maker(self.known[at].camera.maker, &others),
                self.by_maker("", &others),
            ];
            LeftOut {
                camera: self.known[at].camera.name(),
                stand_ins: stand_ins.map(|stand_in| {
                    let error = self.distances[at][stand_in.at];
                    (stand_in, error)
                }),
                mean_error: curve_error(&self.known[at].curves, &self.mean(&others)),
            }
        };
        Ok((0..self.known.len()).map(left_out).collect())
    }

    fn by_matrix(&self, matrices: &[Matrix3<f64>], matrix: &Matrix3<f64>, among: &[usize]) -> StandIn {
        self.least(among, Why::Matrix, |at| (matrices[at] - matrix).norm())
    }

    fn by_maker(&self, make: &str, among: &[usize]) -> StandIn {
        let of_maker = |at: &usize| self.known[*at].camera.is_made_by(make);
        let same: Vec<usize> = among.iter().copied().filter(of_maker).collect();
        let (group, why) = if same.is_empty() { (among, Why::Any) } else { (same.as_slice(), Why::Maker) };
        self.least(group, why, |at| group.iter().map(|other| self.distances[at][*other]).sum())
    }

    fn least(&self, among: &[usize], why: Why, size: impl Fn(usize) -> f64) -> StandIn {
        let at = among.iter().copied().min_by(|a, b| size(*a).total_cmp(&size(*b))).unwrap_or(0);
        StandIn { name: self.known[at].camera.name(), why, at }
    }

    fn mean(&self, among: &[usize]) -> [Vec<f64>; 3] {
        let bands = self.known[0].curves[0].len();
        let mean = |channel: usize, band: usize| {
            among.iter().map(|at| self.known[*at].curves[channel][band]).sum::<f64>() / among.len() as f64
        };
        [0, 1, 2].map(|channel| (0..bands).map(|band| mean(channel, band)).collect())
    }
}

impl Matrices {
    /// As the Munsell chips under D65 have them.
    fn of(known: &[KnownCurves]) -> Result<Self> {
        let grid = WavelengthGrid::default();
        let daylight = illuminant("D65")?;
        let power = daylight.on(&grid, Outside::Refuse)?;
        let eye = Colorimeter::new(&grid, &daylight, Observer::Cie1931_2deg)?;
        let white_xyz = Vector3::from(eye.xyz(&vec![1.0; grid.len()]));
        let chips = reflectances("munsell")?;
        let chips = chips.iter().map(|chip| chip.on(&grid, Outside::Refuse)).collect::<Result<Vec<_>>>()?;
        let xyz = chips.iter().map(|chip| Vector3::from(eye.xyz(chip)).component_div(&white_xyz));
        let xyz = Matrix3xX::from_columns(&xyz.collect::<Vec<_>>());
        let matrix = |known: &KnownCurves| {
            let response = CameraResponse::new(&grid, &known.curves, &power)?;
            let white = Vector3::from_vec(response.white());
            let rgb =
                chips.iter().map(|chip| Vector3::from_vec(response.of_flat(chip)).component_div(&white));
            let rgb = Matrix3xX::from_columns(&rgb.collect::<Vec<_>>());
            let squares = (&xyz * xyz.transpose()).try_inverse();
            let squares =
                squares.ok_or_else(|| Error::Fault("the chips' colours lie in a plane".to_owned()))?;
            Ok(white_to_white(rgb * xyz.transpose() * squares))
        };
        Ok(Self { all: known.iter().map(matrix).collect::<Result<_>>()?, white_xyz })
    }

    /// A matrix that takes the white of D65 to white; none if it takes that to nothing.
    fn white_balanced(&self, rows: &ColourMatrix) -> Option<Matrix3<f64>> {
        let matrix = Matrix3::from_fn(|row, column| rows[row][column] * self.white_xyz[column]);
        let whites = matrix.column_sum();
        let matrix = white_to_white(matrix);
        (whites.iter().all(|white| *white > 0.0) && matrix.iter().all(|number| number.is_finite()))
            .then_some(matrix)
    }
}

/// The matrix with rows whose sum is 1.
fn white_to_white(matrix: Matrix3<f64>) -> Matrix3<f64> {
    Matrix3::from_diagonal(&matrix.column_sum().map(f64::recip)) * matrix
}
