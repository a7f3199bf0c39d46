//! How a camera develops its numbers into a picture for the eye, and the inverse.

use nalgebra::{Matrix3, Vector3};

use crate::{Error, Result};

/// Rows of three numbers.
type Rows = [[f64; 3]; 3];

/// White balance, then a matrix to linear sRGB.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Development {
    white_balance_gains: [f64; 3],
    camera_to_linear_srgb: Rows,
    linear_srgb_to_balanced: Matrix3<f64>,
}

/// A matrix is singular if its determinant is this small relative to the product of its rows' lengths.
const SINGULAR: f64 = 1e-6;

impl Development {
    /// The development with these gains and this matrix.
    ///
    /// # Arguments
    /// - `white_balance_gains`: factors of camera red, green and blue, above 0.
    /// - `camera_to_linear_srgb`: rows are linear sRGB red, green and blue, columns the camera's balanced
    ///   channels.
    ///
    /// # Errors
    /// [`Error::Numeric`] if a number is not finite, a gain is not above 0 or the matrix has no inverse.
    ///
    /// # Example
    /// ```
    /// use vfold::image::Development;
    /// let swap = [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    /// let development = Development::new([2.0, 1.0, 1.0], swap)?;
    /// assert_eq!(development.camera_rgb([0.5, 0.25, 0.125]), Some([0.125, 0.5, 0.125]));
    /// assert!(Development::new([2.0, 1.0, 1.0], [[1.0; 3]; 3]).is_err());
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn new(white_balance_gains: [f64; 3], camera_to_linear_srgb: Rows) -> Result<Self> {
        if let Some(gain) = white_balance_gains.iter().find(|gain| !(**gain > 0.0 && gain.is_finite())) {
            return Err(Error::Numeric(format!("the white balance gain {gain} is not a number above 0")));
        }
        let inverse = inverse(&camera_to_linear_srgb)
            .ok_or_else(|| Error::Numeric("the camera's matrix cannot be inverted".to_owned()))?;
        Ok(Self { white_balance_gains, camera_to_linear_srgb, linear_srgb_to_balanced: inverse })
    }

    /// Camera RGB of linear sRGB; none if a balanced channel had reached 1 before the matrix, where cameras
    /// clip.
    #[must_use]
    #[inline]
    pub fn camera_rgb(&self, linear_srgb: [f64; 3]) -> Option<[f64; 3]> {
        let balanced = self.linear_srgb_to_balanced * Vector3::from(linear_srgb);
        let gains = self.white_balance_gains;
        balanced
            .iter()
            .all(|balanced| *balanced < 1.0)
            .then(|| [0, 1, 2].map(|channel| balanced[channel] / gains[channel]))
    }

    /// Standard errors of camera RGB, for independent errors of the numbers of linear sRGB as large as
    /// `of_number` returns.
    pub(in crate::image) fn errors(&self, camera_rgb: [f64; 3], of_number: impl Fn(f64) -> f64) -> [f64; 3] {
        let gains = self.white_balance_gains;
        let balanced = Vector3::from_fn(|channel, _| gains[channel] * camera_rgb[channel]);
        let linear_srgb = Matrix3::from(self.camera_to_linear_srgb).transpose() * balanced;
        let errors = linear_srgb.map(of_number);
        [0, 1, 2].map(|channel| {
            let row = self.linear_srgb_to_balanced.row(channel).transpose();
            row.component_mul(&errors).norm() / gains[channel]
        })
    }

    /// The gains of camera red, green and blue.
    #[must_use]
    pub fn white_balance_gains(&self) -> [f64; 3] {
        self.white_balance_gains
    }

    /// The matrix from balanced camera RGB to linear sRGB.
    #[must_use]
    pub fn camera_to_linear_srgb(&self) -> Rows {
        self.camera_to_linear_srgb
    }
}

fn inverse(rows: &Rows) -> Option<Matrix3<f64>> {
    let matrix = Matrix3::from(*rows).transpose();
    let determinant = matrix.determinant();
    let size = matrix.row_iter().map(|row| row.norm()).product::<f64>();
    (determinant.abs() > SINGULAR * size && determinant.is_finite()).then(|| matrix.try_inverse())?
}

#[cfg(test)]
mod tests {
    use super::*;

    const MATRIX: Rows = [[1.7, -0.6, -0.1], [-0.15, 1.65, -0.5], [0.05, -0.55, 1.5]];

    /// NumPy 2: `np.linalg.solve(M, [.2, .3, .4])/[2, 1, 1.5]`.
    #[test]
    fn undoing_agrees_with_numpy() {
        let development = Development::new([2.0, 1.0, 1.5], MATRIX).unwrap();
        let got = development.camera_rgb([0.2, 0.3, 0.4]).unwrap();
        let want = [0.12603591160220995, 0.31837016574585636, 0.25];
        assert!(got.iter().zip(want).all(|(got, want)| (got - want).abs() < 1e-14), "{got:?}");
    }

    /// NumPy 2: `np.sqrt((np.linalg.inv(M)**2) @ (.01 * np.array([.2, .3, .4]))**2)/[2, 1, 1.5]`.
    #[test]
    fn errors_agree_with_numpy() {
        let development = Development::new([2.0, 1.0, 1.5], MATRIX).unwrap();
        let camera_rgb = development.camera_rgb([0.2, 0.3, 0.4]).unwrap();
        let got = development.errors(camera_rgb, |light| 0.01 * light);
        let want = [0.0007693732819249438, 0.0023257605615795555, 0.0020615528128088306];
        assert!(got.iter().zip(want).all(|(got, want)| (got - want).abs() < 1e-14), "{got:?}");
    }

    #[test]
    fn what_the_camera_cut_before_its_matrix_is_not_made_up() {
        let development = Development::new([2.0, 1.0, 1.5], MATRIX).unwrap();
        // balanced (0.2, 1, 0.9) is no longer clipped in sRGB (-0.35, 1.17, 0.81) as a float
        assert_eq!(development.camera_rgb([-0.35, 1.17, 0.81]), None);
    }

    #[test]
    fn only_a_real_development_can_be_undone() {
        let flat = [[1.0, 2.0, 3.0], [2.0, 4.0, 6.0], [0.0, 0.0, 1.0]];
        for (gains, matrix) in [
            ([0.0, 1.0, 1.0], MATRIX),
            ([1.0, -1.0, 1.0], MATRIX),
            ([1.0, f64::NAN, 1.0], MATRIX),
            ([1.0; 3], flat),
            ([1.0; 3], [[f64::INFINITY; 3]; 3]),
            ([1.0; 3], [[0.0; 3]; 3]),
        ] {
            assert!(Development::new(gains, matrix).is_err(), "{gains:?} {matrix:?}");
        }
    }
}
