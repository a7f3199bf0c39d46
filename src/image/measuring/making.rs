//! How a photograph was made, as far as it shows.

use super::processing::Processing;
use crate::image::OtherFold;
use crate::image::photograph::{FileStamp, PhotographInfo};

/// How a photograph was made.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Making {
    /// Whether it was developed for the eye, it seems, and nothing of that was undone.
    pub is_developed: bool,
    /// What was done to its numbers, if their noise shows it.
    pub processing: Option<Processing>,
    /// Sides of the panels along which no edge of the sheet lies, in words.
    pub open_sides: Vec<String>,
    /// The fold that the corners are rather those of than of the stated one, if they are not those of that.
    pub other_fold: Option<OtherFold>,
    /// How far its darkest numbers are above black, white being 1, if they are alike in all channels: black
    /// was not subtracted, it seems.
    pub unsubtracted_black: Option<f64>,
    /// Maker and model of the camera, both empty where the photograph does not say so.
    pub taken_by: (String, String),
    /// Size and time of its file.
    pub file: Option<FileStamp>,
}

impl Making {
    /// That of a photograph of which this is known.
    ///
    /// # Arguments
    /// - `processing`: as [`measure_panels`](crate::image::measure_panels) finds it.
    /// - `open_sides`: as [`open_sides`](crate::image::open_sides) finds them.
    /// - `other_fold`: as [`FoldSeen::other_than`](crate::image::FoldSeen::other_than) finds it.
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
