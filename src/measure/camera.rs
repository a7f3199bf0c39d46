//! Determines the camera of a photograph.

use crate::camera::{ColourMatrix, PREDICTED_ERROR, Predictor, StandIn, StandIns};
use crate::error::{Error, Result};
use crate::image::{PhotographInfo, camera_name};
use crate::spectrum::{self, Sensitivities, Spectrum, WavelengthGrid};
use crate::stream::StandInRecord;

/// A camera, and the one for which it stands in.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// Built-in name or file; for predicted sensitivities, their name.
    pub spec: String,
    /// Its sensitivities, if they are predicted.
    pub predicted: Option<Sensitivities>,
    /// The camera that took the photograph, if its sensitivities were not measured.
    pub stands_in: Option<StandInRecord>,
    /// A note on it for the user.
    pub note: Option<String>,
}

impl Camera {
    /// A camera named by the user.
    #[must_use]
    pub fn named(spec: &str) -> Self {
        Self { spec: spec.to_owned(), predicted: None, stands_in: None, note: None }
    }

    /// Its sensitivities: the predicted ones, or those that `read` returns for its name.
    ///
    /// # Errors
    /// As `read`.
    pub fn sensitivities(&self, read: impl FnOnce(&str) -> Result<Sensitivities>) -> Result<Sensitivities> {
        self.predicted.clone().map_or_else(|| read(&self.spec), Ok)
    }
}

/// The camera named in a photograph, or a stand-in for it.
///
/// # Errors
/// [`Error::Usage`] if the photograph names no camera.
pub fn camera_of(info: &PhotographInfo) -> Result<Camera> {
    let (make, model) = &info.camera.called();
    let of = camera_name(make, model);
    if let Some(camera) = spectrum::camera_by_exif(make, model) {
        let same = spectrum::measured_cameras().any(|one| one.name() == camera && one.has_same_sensor(model));
        let note = match &spectrum::other_measurements(&camera)[..] {
            _ if same => Some(format!("{of}: using the sensitivities of {camera}, whose sensor is the same")),
            [] => None,
            others => {
                let others = others.join(" or ");
                Some(format!(
                    "{of}: using the sensitivities {camera}; for the other measurement give --camera {others}"
                ))
            }
        };
        return Ok(Camera { note, ..Camera::named(&camera) });
    }
    if model.is_empty() {
        const REMEDY: &str =
            "name one (vextract --list cameras), or give a CSV file or rawtoaces JSON of its sensitivities";
        return Err(Error::usage("--camera", "the photograph names no camera", REMEDY));
    }
    let predicted = info.camera.xyz_to_camera.map(|matrix| predicted(make, &of, &matrix)).transpose()?;
    if let Some(camera) = predicted.flatten() {
        return Ok(camera);
    }
    let stand_in = StandIns::new()?.for_camera(make);
    let note = Some(warning(&of, &stand_in));
    let StandIn { name, why, .. } = stand_in;
    let (why, sensitivity_error) = (why.words().to_owned(), why.expected_error());
    let stands_in = Some(StandInRecord { camera: of, why, sensitivity_error, is_predicted: false });
    Ok(Camera { stands_in, note, ..Camera::named(&name) })
}

/// A camera by `make`, called `of`, with sensitivities predicted from its colour matrix; none if the matrix
/// is not a camera's.
fn predicted(make: &str, of: &str, matrix: &ColourMatrix) -> Result<Option<Camera>> {
    let grid = WavelengthGrid::uniform(380.0, 780.0, 5.0)?;
    let Some(sensitivities) = Predictor::new(&grid)?.predict(make, matrix) else { return Ok(None) };
    let name = format!("{of} (predicted)");
    let channel = |(name, curve)| Spectrum::new(name, grid.wavelengths_nm().to_vec(), curve);
    let channels = ["R", "G", "B"].into_iter().zip(sensitivities).map(channel).collect::<Result<_>>()?;
    let percent = 100.0 * PREDICTED_ERROR;
    let note = format!(
        "warning: the sensitivities of {of} have not been measured: they are predicted from its colour \
         matrix, with a mean error of {percent:.1} % of green's peak; photograph a colour chart \
         (--save-camera), or name a camera or file (--camera)"
    );
    let stands_in = StandInRecord {
        camera: of.to_owned(),
        why: "predicted from its colour matrix".to_owned(),
        sensitivity_error: PREDICTED_ERROR,
        is_predicted: true,
    };
    Ok(Some(Camera {
        predicted: Some(Sensitivities::new(&name, channels)?),
        spec: name,
        stands_in: Some(stands_in),
        note: Some(note),
    }))
}

fn warning(of: &str, stand_in: &StandIn) -> String {
    let StandIn { name, why, .. } = stand_in;
    let (why, percent) = (why.words(), 100.0 * why.expected_error());
    format!(
        "warning: the sensitivities of {of} have not been measured: {name} stands in ({why}), \
         with a mean error of {percent:.1} % of green's peak; \
         photograph a colour chart (--save-camera), or name a camera or file (--camera)"
    )
}
