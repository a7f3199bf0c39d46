//! Reads photographs.

use std::path::{Path, PathBuf};

use clap::Args;
use vfold::files::sha256;
use vfold::image::{Photograph, PictureFile, ReadOptions, Transfer, is_for_the_eye};
use vfold::stream::read_development;
use vfold::{Error, Result};

use super::sheet::Sheet;

#[derive(Args)]
#[command(next_help_heading = "Reading photographs")]
pub struct ReadingArgs {
    /// Transfer curve of the stored numbers; auto: as the file states, else sRGB for 8 bits and linear
    /// for the rest
    #[arg(long, value_name = "auto|linear|srgb", default_value = "auto", value_parser = transfer)]
    transfer: Transfer,
    /// Stored number for no light; auto: the darkest, if it is the same in all channels and not 0
    /// [default: the RAW file's, else 0]
    #[arg(long, value_name = "X|auto", value_parser = black_level)]
    black_level: Option<BlackLevel>,
    /// Stored number for 1; pixels at or above it count as clipped [default: the RAW file's, else 255, 65535
    /// or, for floats, 1]
    #[arg(long, value_name = "X")]
    white_level: Option<f64>,
    /// Photograph of a white sheet with the same framing, to divide by: it corrects uneven light; its mean
    /// counts as 1. If both files record exposure time, aperture and sensitivity, and nothing else shows the
    /// exposure, the sheet does, as printing paper or --white-reflectance
    #[arg(long, value_name = "IMAGE")]
    white: Option<PathBuf>,
    /// Undo the camera's white balance and colour matrix, stated in this file, in an sRGB picture
    #[arg(long, value_name = "FILE.json")]
    undo: Option<String>,
}

/// The stored number for no light.
#[derive(Clone, Copy)]
enum BlackLevel {
    Stated(f64),
    /// From the darkest pixels.
    Darkest,
}

/// Options for reading photographs.
pub struct Reading {
    options: ReadOptions,
    black_level: Option<BlackLevel>,
}

/// A photograph to be measured, and its file's checksum; none for a pipe, which cannot be read again.
pub struct Opened {
    pub photograph: Photograph,
    pub sha256: Option<String>,
}

impl Reading {
    /// Opens a photograph to be measured. Its checksum is computed in parallel, as it may take as long as
    /// reading, but not before the file is known to be small enough.
    ///
    /// # Errors
    /// As [`Reading::open`].
    pub fn open_to_measure(&self, path: &Path) -> Result<Opened> {
        let file = file(path)?;
        let checksum = || path.is_file().then(|| sha256(path)).transpose();
        let (photograph, sha256) = rayon::join(|| self.read(file), checksum);
        Ok(Opened { photograph: photograph?, sha256: sha256? })
    }

    /// Opens a photograph.
    ///
    /// # Errors
    /// As [`Photograph::open`]; [`Error::Picture`] if it is a picture for the eye.
    pub fn open(&self, path: &Path) -> Result<Photograph> {
        self.read(file(path)?)
    }

    fn read(&self, file: PictureFile) -> Result<Photograph> {
        let photograph = Photograph::read(file, &self.options)?;
        match self.black_level {
            Some(BlackLevel::Darkest) => Ok(photograph.with_darkest_as_black()),
            _ => Ok(photograph),
        }
    }
}

/// The file of a photograph, unless it is a picture for the eye.
fn file(path: &Path) -> Result<PictureFile> {
    let mut file = PictureFile::open(path)?;
    if is_for_the_eye(&mut file) {
        let problem = "made by vfold for viewing, not for measuring";
        return Err(Error::picture(
            path,
            problem,
            "render it as .exr or .tif, or give the original photograph",
        ));
    }
    Ok(file)
}

impl ReadingArgs {
    /// # Errors
    /// If the camera's development cannot be read.
    pub fn reading(&self) -> Result<Reading> {
        let resolved = |level| match level {
            BlackLevel::Stated(stored) => Some(stored),
            BlackLevel::Darkest => None,
        };
        let options = ReadOptions {
            transfer: self.transfer,
            black_level: self.black_level.and_then(resolved),
            white_level: self.white_level,
            development: self.undo.as_deref().map(read_development).transpose()?,
        };
        Ok(Reading { options, black_level: self.black_level })
    }

    /// The picture of a white sheet, if stated.
    ///
    /// # Errors
    /// As [`Sheet::open`].
    pub fn sheet(&self, reading: &Reading) -> Result<Option<Sheet>> {
        self.white.as_ref().map(|path| Sheet::open(path, reading)).transpose()
    }
}

fn black_level(text: &str) -> std::result::Result<BlackLevel, String> {
    match text {
        "auto" => Ok(BlackLevel::Darkest),
        number => number.parse().map(BlackLevel::Stated).map_err(|_| "write a number, or auto".to_owned()),
    }
}

fn transfer(text: &str) -> std::result::Result<Transfer, String> {
    text.parse().map_err(|e: Error| e.to_string())
}
