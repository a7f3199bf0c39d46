//! Which camera took a photograph.

use vfold::image::Photograph;
use vfold::{Error, Result, spectrum};

/// The camera that was named, or the one that the first photograph names; none only if that cannot be read.
pub fn camera<'a>(named: Option<&'a str>, first: Option<&Photograph>) -> Result<Option<&'a str>> {
    if let Some(camera) = named {
        return Ok(Some(camera));
    }
    let Some(info) = first.map(Photograph::info) else { return Ok(None) };
    let (make, model) = (info.make.as_deref().unwrap_or(""), info.model.as_deref().unwrap_or(""));
    match spectrum::camera_by_exif(make, model) {
        Some(camera) => Ok(Some(camera)),
        None => Err(Error::usage(
            "--camera",
            match (make, model) {
                ("", "") => "the photograph names no camera".to_owned(),
                _ => format!("the photograph names '{make} {model}', whose sensitivities are not known"),
            },
            "name one (--list cameras) or give a CSV file",
        )),
    }
}
