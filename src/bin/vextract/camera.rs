//! Which camera took a photograph.

use vfold::image::Photograph;
use vfold::{Error, Result, spectrum};

/// The camera that was named, or the one that the first photograph names; none only if that cannot be read.
pub fn camera(named: Option<&str>, first: Option<&Photograph>) -> Result<Option<String>> {
    if let Some(camera) = named {
        return Ok(Some(camera.to_owned()));
    }
    let Some(info) = first.map(Photograph::info) else { return Ok(None) };
    let (make, model) =
        (info.camera.make.as_deref().unwrap_or(""), info.camera.model.as_deref().unwrap_or(""));
    match spectrum::camera_by_exif(make, model) {
        Some(camera) => Ok(Some(camera)),
        None => Err(unknown(make, model)),
    }
}

fn unknown(make: &str, model: &str) -> Error {
    const REMEDY: &str =
        "name one (--list cameras), or give a CSV file or rawtoaces JSON of its sensitivities";
    if make.is_empty() && model.is_empty() {
        return Error::usage("--camera", "the photograph names no camera", REMEDY);
    }
    let problem = format!("the photograph names '{make} {model}', whose sensitivities are not known");
    Error::usage("--camera", problem, REMEDY)
}
