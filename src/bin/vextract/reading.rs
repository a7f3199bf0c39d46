//! How photographs are read.

use std::path::{Path, PathBuf};

use clap::Args;
use vfold::image::{FlatField, Photograph, PictureFile, ReadOptions, Transfer, is_preview};
use vfold::stream::read_development;
use vfold::{Error, Result};

#[derive(Args)]
#[command(next_help_heading = "Reading photographs")]
pub struct ReadingArgs {
    /// Curve of the stored numbers; auto: what the file says, or else sRGB for 8 bits and linear for the rest
    #[arg(long, value_name = "auto|linear|srgb", default_value = "auto", value_parser = transfer)]
    transfer: Transfer,
    /// Stored number that means no light
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    black_level: Option<f64>,
    /// Stored number that means 1, from which on pixels are clipped
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    white_level: Option<f64>,
    /// Photograph of a white sheet, framed alike, to divide by: undoes uneven light; its mean counts as 1
    #[arg(long, value_name = "IMAGE")]
    white: Option<PathBuf>,
    /// Undo the white balance and the matrix with which the camera made an sRGB picture
    #[arg(long, value_name = "FILE.json")]
    undo: Option<String>,
}

/// Opens a photograph.
///
/// # Errors
/// As [`Photograph::open`]; [`Error::Picture`] if it is a preview or an overlay, in which nothing can be measured.
pub fn open(path: &Path, options: &ReadOptions) -> Result<Photograph> {
    let mut file = PictureFile::open(path)?;
    if is_preview(&mut file) {
        let problem = "this is a picture for the eye that vextract made of a photograph";
        return Err(Error::picture(path, problem, "give the photograph itself"));
    }
    Photograph::read(file, options)
}

impl ReadingArgs {
    /// # Errors
    /// If what the camera did cannot be read.
    pub fn options(&self) -> Result<ReadOptions> {
        Ok(ReadOptions {
            transfer: self.transfer,
            black_level: self.black_level,
            white_level: self.white_level,
            development: self.undo.as_deref().map(read_development).transpose()?,
        })
    }

    /// # Errors
    /// As [`Photograph::open`] and [`Photograph::into_flat_field`].
    pub fn flat_field(&self, options: &ReadOptions) -> Result<Option<FlatField>> {
        self.white.as_ref().map(|path| Photograph::open(path, options)?.into_flat_field(path)).transpose()
    }
}

fn transfer(text: &str) -> std::result::Result<Transfer, String> {
    text.parse().map_err(|e: Error| e.to_string())
}
