//! How a photograph was made, as far as can be determined.

use super::processing::Processing;
use crate::image::OtherFold;
use crate::image::photograph::{FileStamp, PhotographInfo};

/// How a photograph was made.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Making {
    /// Whether it appears to be developed for the eye, with nothing undone.
    pub is_developed: bool,
    /// Processing of its numbers that their noise reveals.
    pub processing: Option<Processing>,
    /// Names of the sides of panels along which no edge of the sheet lies.
    pub open_sides: Vec<String>,
    /// The fold whose corners they seem to be, if not those of the stated one.
    pub other_fold: Option<OtherFold>,
    /// Height of its darkest numbers above black, white being 1, if they are equal in all channels: black
    /// seems not to have been subtracted.
    pub unsubtracted_black: Option<f64>,
    /// Maker and model of the camera, both empty if the photograph does not name it.
    pub taken_by: (String, String),
    /// Size and time of its file.
    pub file: Option<FileStamp>,
}

impl Making {
    /// Collects what is known of a photograph.
    ///
    /// # Arguments
    /// - `processing`: from [`measure_panels`](crate::image::measure_panels).
    /// - `open_sides`: from [`open_sides`](crate::image::open_sides).
    /// - `other_fold`: from [`FoldSeen::other_than`](crate::image::FoldSeen::other_than).
    #[must_use]
    pub fn of(
        info: &PhotographInfo,
        processing: Option<Processing>,
        open_sides: Vec<String>,
        other_fold: Option<OtherFold>,
    ) -> Self {
        let above_black =
            |darkest: f64| (darkest - info.black_level[0]) / (info.white_level[0] - info.black_level[0]);
        Self {
            is_developed: info.is_developed(),
            processing,
            open_sides,
            other_fold,
            unsubtracted_black: info.darkest.first().copied().map(above_black),
            taken_by: info.camera.called(),
            file: info.file,
        }
    }
}
