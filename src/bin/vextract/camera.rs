//! Determines the camera of a photograph.

use std::path::Path;

use vfold::image::{Photograph, camera_name};
use vfold::measure::{Camera, camera_of};
use vfold::stream::Scene;
use vfold::{Result, spectrum};

/// The stated camera, or else the [camera of](camera_of) the first photograph; none only if that cannot be
/// read.
pub fn camera(named: Option<&str>, first: Option<&Photograph>) -> Result<Option<Camera>> {
    match named {
        Some(named) => Ok(Some(Camera::named(named))),
        None => first.map(|photograph| camera_of(photograph.info())).transpose(),
    }
}

/// A warning for a photograph that according to EXIF was taken by another camera than the one whose
/// sensitivities are used.
pub fn other_than(scene: &Scene, path: &Path, photograph: &Photograph) -> Option<String> {
    // a warning of its own is for sensitivities of a stand-in
    let camera = scene.camera().ok().filter(|camera| camera.stands_in.is_none())?.name;
    let (make, model) = &photograph.info().camera.called();
    spectrum::is_other_camera(&camera, make, model).then(|| {
        let instead = match spectrum::camera_by_exif(make, model) {
            Some(known) => format!("give --camera {known}, or leave --camera out"),
            None => "leave --camera out, or give a file of that camera's sensitivities".to_owned(),
        };
        let (path, taken_by) = (path.display(), camera_name(make, model));
        format!(
            "warning: {path}: its EXIF names {taken_by}, but the sensitivities used are those of {camera}: \
             expect a wrong spectrum; {instead}"
        )
    })
}
