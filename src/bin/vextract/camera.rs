//! Which camera took a photograph.

use std::path::Path;

use vfold::camera::{StandIn, StandIns};
use vfold::image::Photograph;
use vfold::stream::StandInRecord;
use vfold::{Error, Result, spectrum};

/// A camera, and what it stands in for.
pub struct Camera {
    pub spec: String,
    pub stands_in: Option<StandInRecord>,
    /// What is to be said of it.
    pub said: Option<String>,
}

/// The camera that was named, or the one that the first photograph names, or one that stands in for that; none only if the photograph cannot
/// be read.
pub fn camera(named: Option<&str>, first: Option<&Photograph>) -> Result<Option<Camera>> {
    if let Some(camera) = named {
        return Ok(Some(Camera { spec: camera.to_owned(), stands_in: None, said: None }));
    }
    let Some(info) = first.map(Photograph::info) else { return Ok(None) };
    let (make, model) =
        (info.camera.make.as_deref().unwrap_or(""), info.camera.model.as_deref().unwrap_or(""));
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
        return Ok(Some(Camera { spec: camera, stands_in: None, said }));
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
    Ok(Some(Camera { spec: name, stands_in: Some(StandInRecord { camera: of, why, curve_error }), said }))
}

/// What is to be said of a photograph of which EXIF says that another camera took it than the one whose curves it is measured with.
pub fn other_than(camera: &str, path: &Path, photograph: &Photograph) -> Option<String> {
    let notes = &photograph.info().camera;
    let (make, model) = (notes.make.as_deref().unwrap_or(""), notes.model.as_deref().unwrap_or(""));
    spectrum::is_other_camera(camera, make, model).then(|| {
        let instead = match spectrum::camera_by_exif(make, model) {
            Some(known) => format!("give --camera {known}, or none"),
            None => "leave out --camera, or give the curves of that camera".to_owned(),
        };
        let (path, taken_by) = (path.display(), format!("{make} {model}").trim().to_owned());
        format!(
            "warning: EXIF of {path} says {taken_by}, and its colours are taken for those of {camera}: expect a wrong spectrum; {instead}"
        )
    })
}

fn warning(of: &str, stand_in: &StandIn) -> String {
    let StandIn { name, why, .. } = stand_in;
    let (why, percent) = (why.words(), 100.0 * why.expected_error());
    format!(
        "warning: nobody measured the curves of {of}: {name} stands in for it ({why}), whose curves are off by {percent:.1} % of \
         green's peak in the mean; photograph a colour chart (--save-camera), or name a camera or file (--camera)"
    )
}
