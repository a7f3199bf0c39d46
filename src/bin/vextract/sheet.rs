//! The picture of a white sheet by which photographs are divided, held to the rules of a photograph.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use vfold::Result;
use vfold::image::{CameraNotes, FlatField, Photograph};
use vfold::stream::Scene;

use super::reading::Reading;
use super::{camera, numbers};

/// Relative difference within which two of a camera's settings are equal.
const SAME_SETTING: f64 = 0.01;

/// A picture of a white sheet.
pub struct Sheet {
    pub path: PathBuf,
    flat_field: Arc<FlatField>,
}

impl Sheet {
    /// # Errors
    /// As [`Reading::open`] and [`Photograph::into_flat_field`].
    pub fn open(path: &Path, reading: &Reading) -> Result<Self> {
        let flat_field = Arc::new(reading.open(path)?.into_flat_field(path)?);
        Ok(Self { path: path.to_owned(), flat_field })
    }

    pub fn flat_field(&self) -> &FlatField {
        &self.flat_field
    }

    /// # Errors
    /// As [`Photograph::with_flat_field`].
    pub fn divide(&self, path: &Path, photograph: Photograph) -> Result<Photograph> {
        photograph.with_flat_field(self.flat_field.clone(), path)
    }

    /// Possible causes of a wrong spectrum that it shows by itself, one line each.
    pub fn warnings(&self, scene: &Scene) -> Vec<String> {
        let sheet = self.flat_field.photograph();
        let of_numbers = numbers::warnings(&self.path, sheet.info(), None, &[]);
        of_numbers.into_iter().chain(camera::other_than(scene, &self.path, sheet)).collect()
    }

    /// How it was taken otherwise than a photograph, one line each.
    pub fn differences(&self, path: &Path, photograph: &Photograph) -> Vec<String> {
        let (own, other) = (&self.flat_field.photograph().info().camera, &photograph.info().camera);
        let (sheet, photo) = (self.path.display(), path.display());
        let differing = |setting: fn(&CameraNotes) -> Option<f64>| {
            let (own, other) = (setting(own)?, setting(other)?);
            ((own / other - 1.0).abs() > SAME_SETTING).then_some((own, other))
        };
        let aperture = differing(|camera| camera.f_number).map(|(own, other)| {
            format!(
                "warning: {photo}: taken at f/{other}, but {sheet} at f/{own}: corners darken differently; \
                 take both with the same aperture"
            )
        });
        let focal = differing(|camera| camera.focal_mm).map(|(own, other)| {
            format!(
                "warning: {photo}: taken at a focal length of {other} mm, but {sheet} of {own} mm: the light \
                 of one is not that of the other; take both with the same framing"
            )
        });
        let [own, other] = [own, other].map(|camera| camera.orientation.exif());
        let orientation = (own != other).then(|| {
            format!(
                "{photo}: its orientation is {other}, that of {sheet} {own}: divided pixel by pixel as stored"
            )
        });
        [aperture, focal, orientation].into_iter().flatten().collect()
    }
}
