//! The camera of a scene.

use nalgebra::{DMatrix, DVector};

use crate::camera::Predictor;
use crate::error::Result;
use crate::estimate::photograph::eye::{Eye, errors, shares_of};
use crate::estimate::photograph::priors::Priors;
use crate::spectrum::{Outside, WavelengthGrid, daylight_vectors};
use crate::stream::{CameraRecord, Optics};

/// Possible errors of the camera's sensitivities, each a share of them.
pub fn relative_errors(Optics { grid, camera, .. }: &Optics, priors: &Priors) -> Vec<(usize, DVector<f64>)> {
    let priors = with_errors_of(camera, priors);
    shares_of(&camera.sensitivities, grid.wavelengths_nm(), &priors)
}

/// The priors on a camera: one that stands in for another has the measured errors of such cameras.
fn with_errors_of(camera: &CameraRecord, priors: &Priors) -> Priors {
    let measured = camera.stands_in.as_ref().map_or(0.0, |one| one.sensitivity_error);
    Priors { sensitivity_sd: measured.max(priors.sensitivity_sd), ..*priors }
}

/// The camera of a scene.
pub fn of(Optics { grid, camera, illuminants, sky }: &Optics, priors: &Priors) -> Result<Eye> {
    let wavelengths_nm = grid.wavelengths_nm().to_vec();
    let bands = wavelengths_nm.len();
    let widths = grid.trapezoid_weights_nm();
    let sensitivities = DMatrix::from_fn(bands, camera.sensitivities.len(), |band, channel| {
        camera.sensitivities[channel][band] * widths[band]
    });
    let sun = DVector::from_column_slice(&illuminants[0].power);
    let sky = sky.as_ref().map_or_else(|| sun.clone(), |sky| DVector::from_column_slice(&sky.power));
    let daylight = vectors(grid)?;
    let white = sensitivities.tr_mul(&sun);
    let is_predicted = camera.stands_in.as_ref().is_some_and(|one| one.is_predicted);
    let predicted =
        if is_predicted { of_predicted(&camera.sensitivities, grid, &widths)? } else { Vec::new() };
    let errors = if predicted.is_empty() {
        errors(&camera.sensitivities, &wavelengths_nm, &widths, &with_errors_of(camera, priors))
    } else {
        predicted
    };
    let is_stand_in = camera.stands_in.is_some();
    Ok(Eye {
        wavelengths_nm,
        widths_nm: widths,
        sensitivities,
        errors,
        is_stand_in,
        sun,
        sky,
        daylight,
        reference: white.imax(),
    })
}

/// Mean daylight and its two characteristic vectors: waveband by three.
pub fn vectors(grid: &WavelengthGrid) -> Result<DMatrix<f64>> {
    let [s0, s1, s2] = daylight_vectors()?.map(|vector| vector.on(grid, Outside::Refuse));
    Ok(DMatrix::from_columns(&[s0?, s1?, s2?].map(DVector::from_vec)))
}

/// Errors of predicted sensitivities: those found for cameras with known sensitivities; none in builds
/// without these.
fn of_predicted(
    sensitivities: &[Vec<f64>],
    grid: &WavelengthGrid,
    widths: &[f64],
) -> Result<Vec<(usize, DVector<f64>)>> {
    let peak = sensitivities.get(1).map_or(1.0, |green| green.iter().copied().fold(0.0, f64::max));
    let widths = DVector::from_column_slice(widths);
    let errors = Predictor::new(grid)?.errors().into_iter();
    Ok(errors.map(|(channel, error)| (channel, peak * error.component_mul(&widths))).collect())
}
