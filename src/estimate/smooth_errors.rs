//! Errors of a spectrum that are shared by neighbouring wavebands.

use nalgebra::DMatrix;

/// Range in nm over which errors of an instrument, a light or a camera are alike.
const ALIKE_NM: f64 = 60.0;

/// Independent errors, one per row, smooth over wavelength, whose total is `sd` in every waveband; `None`
/// without wavelengths.
///
/// # Arguments
/// - `wavelengths_nm`: increasing; `sd`: standard deviation, one per wavelength.
#[must_use]
pub fn smooth_errors(wavelengths_nm: &[f64], sd: &[f64]) -> Option<DMatrix<f64>> {
    let (first, last) = (wavelengths_nm.first()?, wavelengths_nm.last()?);
    let count = ((last - first) / ALIKE_NM).ceil() as usize + 1;
    let bump = |n: usize, nm: f64| (-((nm - first) / ALIKE_NM - n as f64).powi(2)).exp();
    let all = |nm: f64| (0..count).map(|n| bump(n, nm).powi(2)).sum::<f64>().sqrt();
    Some(DMatrix::from_fn(count, sd.len(), |n, band| {
        let nm = wavelengths_nm[band];
        sd[band] * bump(n, nm) / all(nm)
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_add_up_and_neighbours_share_them() {
        let wavelengths_nm: Vec<f64> = (0..61).map(|n| 400.0 + 5.0 * f64::from(n)).collect();
        let sd: Vec<f64> = (0..61).map(|n| 0.01 + 1e-4 * f64::from(n)).collect();
        let errors = smooth_errors(&wavelengths_nm, &sd).unwrap();
        for (column, sd) in errors.column_iter().zip(&sd) {
            assert!((column.norm() - sd).abs() < 1e-15);
        }
        let correlation = |a: usize, b: usize| errors.column(a).dot(&errors.column(b)) / (sd[a] * sd[b]);
        assert!(correlation(20, 21) > 0.99 && correlation(0, 60) < 0.01);
    }
}
