//! Cameras that nobody measured: how far off stand-ins are, and what one photograph of a chart gives.

use vfold::camera::{
    CameraResponse, ChartCamera, ChartPatch, KnownSensitivities, PREDICTED_ERROR, Predictor, StandIns, Why,
    known_sensitivities, sensitivity_error,
};
use vfold::forward::noise::Noise;
use vfold::spectrum::{Outside, WavelengthGrid, illuminant, reflectances};

/// `benches/cameras.rs` prints the table of which these are the means.
#[test]
fn stand_ins_are_as_far_off_as_is_said() {
    let left_out = StandIns::new().unwrap().left_out();
    assert_eq!(left_out.len(), 52);
    let mean = |pick: &dyn Fn(&vfold::camera::LeftOut) -> f64| left_out.iter().map(pick).sum::<f64>() / 52.0;
    let [maker, any] = [0, 1].map(|k: usize| mean(&|row| row.stand_ins[k].1));
    let of_all = mean(&|row| row.mean_error);
    println!("stand-ins: by maker {maker:.4}, by neither {any:.4}; mean of all {of_all:.4}");
    for (why, measured) in [(Why::Maker, maker), (Why::Any, any)] {
        assert!((why.expected_error() - measured).abs() < 0.0015, "{why:?}: {measured}");
    }
    let predicted = Predictor::new(&WavelengthGrid::default()).unwrap().left_out();
    let errors = predicted.iter().map(|one| sensitivity_error(&one.predicted, &one.measured));
    let predicted = errors.sum::<f64>() / predicted.len() as f64;
    println!("predicted: {predicted:.4}");
    assert!((PREDICTED_ERROR - predicted).abs() < 0.0015, "{predicted}");
    assert!(predicted < maker && maker < of_all);
}

/// The errors that an estimate allows for are as large as those that cameras have.
#[test]
fn errors_of_predicted_curves_hold_what_they_are_off_by() {
    let predictor = Predictor::new(&WavelengthGrid::default()).unwrap();
    let (left_out, errors) = (predictor.left_out(), predictor.errors());
    let all =
        left_out.iter().map(|one| sensitivity_error(&one.predicted, &one.measured).powi(2)).sum::<f64>();
    let bands = left_out[0].measured[0].len() as f64;
    let kept = errors.iter().map(|(_, error)| error.norm_squared()).sum::<f64>() / (3.0 * bands);
    let share = kept / (all / left_out.len() as f64);
    assert!((0.9..=1.0 + 1e-9).contains(&share), "{share}");
}

/// A matrix of no camera predicts nothing.
#[test]
fn a_matrix_that_is_no_cameras_predicts_nothing() {
    let predictor = Predictor::new(&WavelengthGrid::default()).unwrap();
    let unit = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    assert_eq!(predictor.predict("Nikon", &unit.map(|row| row.map(|number| 9.0 - 20.0 * number))), None);
    assert_eq!(predictor.predict("Nikon", &[[f64::NAN; 3]; 3]), None);
}

/// A simulated photograph of the chart in the sun by each camera, which the prior does not know; patches are
/// off by 2 %, and the frame has noise. Means over the cameras.
#[test]
fn a_chart_makes_a_camera() {
    let grid = WavelengthGrid::default();
    let (errors, held) = chart_errors(&grid, 0.02);
    let mean = errors.iter().sum::<f64>() / errors.len() as f64;
    let share = held.iter().sum::<f64>() / held.len() as f64;
    println!(
        "a camera of a chart: {mean:.4} in the mean, {share:.3} of the curves within two standard deviations"
    );
    assert!(mean < 0.03, "{mean}");
    assert!(share > 0.9, "{share}");
}

/// Error of each camera's curves, and the share of wavebands within two standard deviations.
fn chart_errors(grid: &WavelengthGrid, patch_sd: f64) -> (Vec<f64>, Vec<f64>) {
    let known = known_sensitivities(grid).unwrap();
    let power = illuminant("sun:40deg").unwrap().on(grid, Outside::Refuse).unwrap();
    let chart = reflectances("cc24").unwrap();
    let chart: Vec<Vec<f64>> = chart.iter().map(|patch| patch.on(grid, Outside::Refuse).unwrap()).collect();
    let one = |at: usize| {
        let truth = &known[at].sensitivities;
        let response = CameraResponse::new(grid, truth, &power).unwrap();
        let patch = |(n, reflectance): (usize, &Vec<f64>)| {
            let mut factors = [1.0; 3];
            Noise { sd: patch_sd, photon: 0.0 }.add(&mut factors, 2013, (100 * at + n) as u64);
            let measured = std::array::from_fn(|k| 0.8 * response.of_flat(reflectance)[k] * factors[k]);
            ChartPatch { reflectance: reflectance.clone(), measured, standard_error: [1e-4; 3] }
        };
        let patches: Vec<_> = chart.iter().enumerate().map(patch).collect();
        let others: Vec<KnownSensitivities> =
            known.iter().enumerate().filter(|(k, _)| *k != at).map(|(_, k)| k.clone()).collect();
        let camera = ChartCamera::by_prior_of(&others, grid, &power, &patches).unwrap();
        let found = camera
            .sensitivities
            .iter()
            .flatten()
            .zip(truth.iter().flatten())
            .zip(camera.sensitivities_sd.iter().flatten());
        let within = found.filter(|((found, truth), sd)| (*found - *truth).abs() <= 2.0 * *sd).count();
        (sensitivity_error(&camera.sensitivities, truth), within as f64 / (3 * grid.len()) as f64)
    };
    (0..known.len()).map(one).unzip()
}
