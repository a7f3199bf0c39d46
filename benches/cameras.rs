//! What stands in for a camera that nobody measured, each of the measured ones left out in turn:
//! sensitivities predicted from its published colour matrix, from the matrix that follows from its own
//! sensitivities, the camera of the nearest published matrix, one of its maker, one of any, and the mean of
//! all. Errors are root mean squares of the sensitivities over 400 to 700 nm, relative to the peak of green.
//!
//! `cargo bench --features raw --bench cameras` prints the table of `benches/results/cameras.md`.

#![allow(clippy::print_stdout, reason = "a measurement for the reader of a terminal")]

use nalgebra::{Matrix3xX, Vector3};
use vfold::Result;
use vfold::camera::{
    CameraResponse, ColourMatrix, KnownSensitivities, LeftOut, Predictor, StandIns, known_sensitivities,
    sensitivity_error,
};
use vfold::colorimetry::{Colorimeter, Observer};
use vfold::spectrum::{Outside, WavelengthGrid, illuminant, reflectances};

fn main() -> Result<()> {
    let grid = WavelengthGrid::default();
    let known = known_sensitivities(&grid)?;
    let published = Predictor::new(&grid)?;
    let computed = Predictor::by_matrices(&grid, &computed_matrices(&grid, &known)?)?;
    let nearest = |name: &str| {
        let nearest = published.nearest_to(name)?;
        let sensitivities =
            |name: &str| known.iter().find(|one| one.camera.name() == name).map(|one| &one.sensitivities);
        Some(sensitivity_error(sensitivities(name)?, sensitivities(&nearest.name())?))
    };
    println!(
        "| camera left out | predicted | by computed matrix | nearest matrix | of its maker | error | \
         of any maker | error | mean of all |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    let mut columns: [Vec<f64>; 6] = Default::default();
    for LeftOut { camera, stand_ins: [(maker, of_maker), (any, of_any)], mean_error } in
        StandIns::new()?.left_out()
    {
        let errors = [
            predicted_error(&published, &camera),
            predicted_error(&computed, &camera),
            nearest(&camera),
            Some(of_maker),
            Some(of_any),
            Some(mean_error),
        ];
        columns.iter_mut().zip(errors).for_each(|(column, error)| column.extend(error));
        let [predicted, by_computed, by_nearest, ..] =
            errors.map(|error| error.map_or_else(String::new, |error| format!("{error:.4}")));
        println!(
            "| {camera} | {predicted} | {by_computed} | {by_nearest} | {} | {of_maker:.4} | {} | \
             {of_any:.4} | {mean_error:.4} |",
            maker.name, any.name
        );
    }
    let [a, b, c, d, e, f] = columns.map(|column| column.iter().sum::<f64>() / column.len() as f64);
    println!(
        "| **mean** | **{a:.4}** | **{b:.4}** | **{c:.4}** | | **{d:.4}** | | **{e:.4}** | **{f:.4}** |"
    );
    Ok(())
}

/// Error of a camera's sensitivities as the others predict them; none if its matrix is not known.
fn predicted_error(predictor: &Predictor, camera: &str) -> Option<f64> {
    let left_out = predictor.left_out().into_iter().find(|one| one.camera.name() == camera)?;
    Some(sensitivity_error(&left_out.predicted, &left_out.measured))
}

/// Of every camera the matrix that takes the Munsell chips' XYZ under D65 nearest to what it sees of them.
fn computed_matrices(
    grid: &WavelengthGrid,
    known: &[KnownSensitivities],
) -> Result<Vec<(String, ColourMatrix)>> {
    let daylight = illuminant("D65")?;
    let power = daylight.on(grid, Outside::Refuse)?;
    let eye = Colorimeter::new(grid, &daylight, Observer::Cie1931_2deg)?;
    let chips = reflectances("munsell")?;
    let chips = chips.iter().map(|chip| chip.on(grid, Outside::Refuse)).collect::<Result<Vec<_>>>()?;
    let xyz =
        Matrix3xX::from_columns(&chips.iter().map(|chip| Vector3::from(eye.xyz(chip))).collect::<Vec<_>>());
    let inverse = (&xyz * xyz.transpose()).try_inverse().unwrap_or_default();
    let matrix = |known: &KnownSensitivities| {
        let response = CameraResponse::new(grid, &known.sensitivities, &power)?;
        let rgb: Vec<_> = chips.iter().map(|chip| Vector3::from_vec(response.of_flat(chip))).collect();
        let matrix = Matrix3xX::from_columns(&rgb) * xyz.transpose() * inverse;
        Ok((known.camera.name(), [0, 1, 2].map(|row| [0, 1, 2].map(|column| matrix[(row, column)]))))
    };
    known.iter().map(matrix).collect()
}
