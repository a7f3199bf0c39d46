//! Which camera took a photograph.

use crate::camera::{StandIn, StandIns};
use crate::error::{Error, Result};
use crate::image::PhotographInfo;
use crate::spectrum;
use crate::stream::StandInRecord;

/// A camera, and what it stands in for.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// Built-in name or file.
    pub spec: String,
    /// The camera that took the photograph, if nobody measured that one's curves.
    pub stands_in: Option<StandInRecord>,
    /// What is to be said of it.
    pub said: Option<String>,
}

/// The camera that a photograph names, or one that stands in for it.
///
/// # Errors
/// [`Error::Usage`] if the photograph names no camera.
pub fn camera_of(info: &PhotographInfo) -> Result<Camera> {
    let (make, model) = &info.camera.called();
    if let Some(camera) = spectrum::camera_by_exif(make, model) {
        let same = spectrum::measured_cameras().any(|one| one.name() == camera && one.has_same_sensor(model));
        let said = match &spectrum::other_measurements(&camera)[..] {
            _ if same => Some(format!("{make} {model}: curves of {camera}, whose sensor is the same")),
            [] => None,
            others => {
                let others = others.join(", ");
                Some(format!(
                    "{make} {model}: curves of {camera}; another measurement is {others} (--camera)"
                ))
            }
        };
        return Ok(Camera { spec: camera, stands_in: None, said });
    }
    if model.is_empty() {
        const REMEDY: &str =
            "name one (--list cameras), or give a CSV file or rawtoaces JSON of its sensitivities";
        return Err(Error::usage("--camera", "the photograph names no camera", REMEDY));
    }
    let stand_in = StandIns::new()?.for_camera(make, info.camera.xyz_to_camera.as_ref())?;
    let of = format!("{make} {model}").trim().to_owned();
    let said = Some(warning(&of, &stand_in));
    let StandIn { name, why, .. } = stand_in;
    let (why, curve_error) = (why.words().to_owned(), why.expected_error());
    Ok(Camera { spec: name, stands_in: Some(StandInRecord { camera: of, why, curve_error }), said })
}

fn warning(of: &str, stand_in: &StandIn) -> String {
    let StandIn { name, why, .. } = stand_in;
    let (why, percent) = (why.words(), 100.0 * why.expected_error());
    format!(
        "warning: nobody measured the curves of {of}: {name} stands in for it ({why}), whose curves are off by {percent:.1} % of \
         green's peak in the mean; photograph a colour chart (--save-camera), or name a camera or file (--camera)"
    )
}
