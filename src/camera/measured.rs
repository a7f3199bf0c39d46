//! The measured cameras on one grid and scale.

use crate::error::Result;
use crate::spectrum::{MeasuredCamera, Outside, WavelengthGrid, measured_cameras, measured_sensitivities};

/// A camera and its sensitivities R, G and B on a grid, normalised to green's peak.
#[derive(Clone, Debug)]
pub struct KnownSensitivities {
    /// The camera.
    pub camera: MeasuredCamera,
    /// One number per waveband each.
    pub sensitivities: [Vec<f64>; 3],
}

/// All 52 on `grid`; beyond 380..780 nm they are zero.
///
/// # Errors
/// Only if the embedded tables are damaged.
pub fn known_sensitivities(grid: &WavelengthGrid) -> Result<Vec<KnownSensitivities>> {
    let known = |(camera, channels): (MeasuredCamera, [crate::spectrum::Spectrum; 3])| {
        let [r, g, b] = &channels;
        let on_grid = |channel: &crate::spectrum::Spectrum| channel.on(grid, Outside::Zero);
        Ok(KnownSensitivities {
            camera,
            sensitivities: on_one_scale([on_grid(r)?, on_grid(g)?, on_grid(b)?]),
        })
    };
    measured_cameras().zip(measured_sensitivities()?).map(known).collect()
}

/// The sensitivities normalised to green's peak.
#[must_use]
pub fn on_one_scale(sensitivities: [Vec<f64>; 3]) -> [Vec<f64>; 3] {
    let peak = sensitivities[1].iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    sensitivities.map(|curve| curve.into_iter().map(|value| value / peak).collect())
}

/// Root mean square difference between the sensitivities of two cameras, both normalised to green's peak.
///
/// # Example
/// ```
/// use vfold::camera::{sensitivity_error, known_sensitivities};
/// let known = known_sensitivities(&vfold::spectrum::WavelengthGrid::default())?;
/// let at = |name: &str| known.iter().position(|known| known.camera.name() == name).unwrap();
/// let (a, b) = (&known[at("sony-ilce-7m3")].sensitivities, &known[at("sony-ilce-7rm3")].sensitivities);
/// assert!(sensitivity_error(a, b) < 0.02); // sensors of one maker
/// # Ok::<(), vfold::Error>(())
/// ```
#[must_use]
pub fn sensitivity_error(a: &[Vec<f64>; 3], b: &[Vec<f64>; 3]) -> f64 {
    let squares: Vec<f64> =
        a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| (a - b).powi(2)).collect();
    (squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt()
}
