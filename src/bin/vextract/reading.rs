//! How photographs are read.

use std::path::{Path, PathBuf};

use clap::Args;
use vfold::image::{FlatField, Photograph, ReadOptions, Transfer};
use vfold::{Error, Result};

#[derive(Args)]
#[command(next_help_heading = "Reading photographs")]
pub struct ReadingArgs {
    /// Curve of the stored numbers; auto: sRGB for 8 bits, linear for the rest
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
}

impl ReadingArgs {
    pub fn open(&self, path: &Path) -> Result<Photograph> {
        let options = ReadOptions {
            transfer: self.transfer,
            black_level: self.black_level,
            white_level: self.white_level,
        };
        Photograph::open(path, &options)
    }

    pub fn flat_field(&self) -> Result<Option<FlatField>> {
        self.white.as_ref().map(|path| FlatField::new(self.open(path)?, path)).transpose()
    }
}

fn transfer(text: &str) -> std::result::Result<Transfer, String> {
    text.parse().map_err(|e: Error| e.to_string())
}
