//! From a picture file to a photograph.

use std::path::Path;

use image::ImageFormat;

use super::decode::{Decoded, Picture, decode, name};
use super::picture_file::PictureFile;
use super::{eight_bits, raw, stated};
use crate::image::numbers::{ReadOptions, Scale, Transfer};
use crate::image::photograph::{Interleaved, Photograph, PhotographInfo};
use crate::{Error, Result};

impl Photograph {
    /// Reads a PNG, TIFF, JPEG or OpenEXR file: 8-bit, 16-bit or float, grey or RGB, with or without alpha;
    /// with the feature `raw` also a camera's RAW file.
    ///
    /// The content, not the name, determines the format; a picture named like a RAW file is refused. Where
    /// [`Transfer::Auto`] is requested, the file's statements on its numbers (ICC profile, EXIF colour space,
    /// PNG's chunks, OpenEXR's chromaticities) determine the curve, or else its depth: then numbers of eight
    /// bits in a deeper file are refused. Alpha is dropped, except that fully
    /// transparent pixels count as missing, and that colours stored multiplied by it are divided again. The
    /// picture is turned upright by its EXIF orientation. At most 2 GiB when decoded and 65536 px per side.
    ///
    /// # Errors
    /// [`Error::File`] if the file cannot be read, [`Error::Picture`] if it is no picture, damaged, cut
    /// short, empty or too large, has no colours whose development could be undone, or makes statements on
    /// its numbers that contradict each other or cannot be undone; [`Error::Usage`] if the white level is not
    /// above the black level.
    ///
    /// # Example
    /// ```
    /// use vfold::image::{Photograph, Pixel, ReadOptions, write_linear};
    /// let folder = tempfile::tempdir().unwrap();
    /// let path = folder.path().join("pixel.exr");
    /// write_linear(&path, 1, 1, &[0.25, 0.5, 2.0])?;
    /// let photograph = Photograph::open(&path, &ReadOptions::default())?;
    /// assert_eq!(photograph.pixel(0, 0), Pixel::Light([0.25, 0.5, 2.0]));
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn open(path: &Path, options: &ReadOptions) -> Result<Self> {
        Self::read(PictureFile::open(path)?, options)
    }

    /// Reads a file that is already open, as [`Photograph::open`] does.
    ///
    /// # Errors
    /// As [`Photograph::open`].
    pub fn read(mut file: PictureFile, options: &ReadOptions) -> Result<Self> {
        let (path, stamp) = (&file.path().to_owned(), file.stamp());
        let (decoded, undo) = (decode(&mut file)?, options.development.is_some());
        let no_colours = |what: &str| {
            let problem = format!("{what} has no white balance and matrix to undo");
            Error::picture(path, problem, "read it without --undo")
        };
        let photograph = match decoded {
            Decoded::Raw if undo => Err(no_colours("a RAW file")),
            Decoded::Raw => raw::open(path, file.into_bytes()?, options),
            Decoded::Picture(picture) if undo && !picture.pixels.color().has_color() => {
                Err(no_colours("a grey picture"))
            }
            Decoded::Picture(picture) => {
                let is_present = options.transfer != Transfer::Auto;
                let options = &ReadOptions { transfer: transfer(path, &picture, options)?, ..*options };
                Self::from_picture(path, *picture, options, is_present)
            }
        };
        Ok(photograph?.with_limits_detected().of_file(stamp))
    }

    fn from_picture(
        path: &Path,
        picture: Picture,
        options: &ReadOptions,
        transfer_stated: bool,
    ) -> Result<Self> {
        let Picture { format, pixels, camera, levels, .. } = picture;
        let color = pixels.color();
        let bits = u32::from(color.bits_per_pixel()) / u32::from(color.channel_count());
        let scale = Scale::new(options, bits)?;
        levels.map_or(Ok(()), |levels| levels.check(path, &scale, options))?;
        let stored_size = (pixels.width() as usize, pixels.height() as usize);
        let orientation = camera.orientation;
        let info = PhotographInfo {
            transfer_used: scale.transfer,
            transfer_stated,
            black_level: vec![scale.black],
            white_level: vec![scale.white],
            undone: options.development,
            ..PhotographInfo::new(camera, stored_size, describe(format, bits, color.has_color()))
        };
        let pixels = Interleaved::from_picture(pixels, orientation, scale, options.development)
            .map_err(|error| Error::Numeric(error.to_string()))?;
        Ok(Self::from_interleaved(pixels, info))
    }
}

/// The requested curve, or else the one that the file states, or else the one that its depth implies.
fn transfer(path: &Path, picture: &Picture, options: &ReadOptions) -> Result<Transfer> {
    if options.transfer != Transfer::Auto {
        return Ok(options.transfer);
    }
    if let Some(stated) = stated::curve(path, &picture.stated)? {
        return Ok(stated);
    }
    eight_bits::refuse(path, &picture.pixels)?;
    Ok(Transfer::Auto)
}

fn describe(format: ImageFormat, bits: u32, colour: bool) -> String {
    let samples = if bits == 32 { "float".to_owned() } else { format!("{bits}-bit") };
    format!("{}, {samples}, {}", name(format), if colour { "RGB" } else { "grey" })
}
