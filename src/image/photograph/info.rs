//! Properties of a photograph other than its pixels.

use super::camera_notes::CameraNotes;
use super::file_stamp::FileStamp;
use crate::image::numbers::{Development, Transfer};

/// Properties of a photograph other than its pixels.
#[derive(Debug, Clone, PartialEq)]
pub struct PhotographInfo {
    /// The camera's notes, with coordinates of the upright picture.
    pub camera: CameraNotes,
    /// Width of the upright picture, px.
    pub width: usize,
    /// Height of the upright picture, px.
    pub height: usize,
    /// File format, depth and colours as stored: `TIFF, 16-bit, RGB`.
    pub format: String,
    /// The curve that was undone, [`Transfer::Linear`] or [`Transfer::Srgb`].
    pub transfer_used: Transfer,
    /// Whether that curve was stated by the user, not derived from the file or its depth.
    pub transfer_stated: bool,
    /// The stored number for no light, one for all channels or one for each.
    pub black_level: Vec<f64>,
    /// The stored number for 1, one for all channels or one for each.
    pub white_level: Vec<f64>,
    /// The stored number, below the white level, at and above which a channel is clipped; none for a channel
    /// that does not end early. Empty if none does.
    pub ends_at: Vec<Option<f64>>,
    /// The darkest stored numbers, one per channel, if they are equal in all and above the black level, as if
    /// black had not been subtracted. Empty otherwise.
    pub darkest: Vec<f64>,
    /// True if the channels of an RGB picture have the same numbers: a grey one saved as RGB.
    pub is_grey: bool,
    /// White balance and matrix that were undone, if any.
    pub undone: Option<Development>,
    /// What was read of a RAW file's sensor.
    pub sensor: Option<SensorInfo>,
    /// Size and time of the file, if it is a regular one.
    pub file: Option<FileStamp>,
}

/// The part of a sensor that forms a picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SensorInfo {
    /// Letters of the colour filters from the area's top left corner as stored, row by row: `RGGB`; none
    /// without filters.
    pub mosaic: Option<String>,
    /// Left column, top row, width and height of the area, px of the whole sensor as stored.
    pub area: [usize; 4],
}

impl PhotographInfo {
    /// Whether the picture appears to be developed for the eye, with nothing undone: it has the curve of
    /// sRGB, and either nobody stated that curve or the file names a camera, which does more than that.
    #[must_use]
    pub fn is_developed(&self) -> bool {
        let of_camera = self.camera.make.is_some() || self.camera.model.is_some();
        self.transfer_used == Transfer::Srgb && self.undone.is_none() && (of_camera || !self.transfer_stated)
    }

    /// Width and height of the picture as stored, px.
    pub(in crate::image) fn stored_size(&self) -> (usize, usize) {
        // turned back, sides change places where they did when turned upright
        self.camera.orientation.upright_size((self.width, self.height))
    }

    /// As [`CameraNotes::white_per_klx`], for numbers as the sensor counted them, because cameras brighten
    /// developed pictures.
    #[must_use]
    pub fn white_per_klx(&self) -> Option<f64> {
        let is_as_counted = self.transfer_used == Transfer::Linear && self.undone.is_none();
        self.camera.white_per_klx().filter(|_| is_as_counted)
    }

    /// For a linear picture of `stored_size` with numbers from 0 to 1, and the camera's notes.
    pub(in crate::image) fn new(camera: CameraNotes, stored_size: (usize, usize), format: String) -> Self {
        let (width, height) = camera.orientation.upright_size(stored_size);
        Self {
            camera,
            width,
            height,
            format,
            transfer_used: Transfer::Linear,
            transfer_stated: false,
            black_level: vec![0.0],
            white_level: vec![1.0],
            ends_at: Vec::new(),
            is_grey: false,
            darkest: Vec::new(),
            undone: None,
            sensor: None,
            file: None,
        }
    }
}
