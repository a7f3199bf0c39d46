//! Pictures of the measured facets.

use std::path::{Path, PathBuf};

use clap::Args;
use vfold::files::{is_pattern, keep_complete, named};
use vfold::image::{Balance, FacetMeasurement, Grid, Photograph, PixelRun, write_overlay, write_preview};
use vfold::{Error, Result};

#[derive(Args)]
pub struct PictureArgs {
    /// Draw panels, facets and excluded pixels (red) over the photograph; {} stands for the name of the
    /// IMAGE
    #[arg(long, value_name = "FILE.png")]
    overlay: Option<PathBuf>,
    /// Write a small picture for finding corners with share/picker.html, and exit; {} as above
    #[arg(long, value_name = "FILE.png", conflicts_with_all = ["overlay", "save_camera", "output", "resume",
        "save"])]
    preview: Option<PathBuf>,
}

impl PictureArgs {
    /// # Errors
    /// [`Error::Usage`] if several photographs would be drawn into one file, or one into none.
    pub fn check(&self, images: &[PathBuf]) -> Result<()> {
        for (flag, file) in [("--overlay", &self.overlay), ("--preview", &self.preview)] {
            if file.as_deref() == Some(Path::new("-")) {
                let problem = "standard output is for records, and a picture needs a file";
                return Err(Error::usage(flag, problem, "name it, as in overlay.png"));
            }
            let shared = file.as_deref().is_some_and(|file| !is_pattern(file));
            if shared && images.len() > 1 {
                let problem = format!("{} photographs would be drawn into one picture", images.len());
                return Err(Error::usage(flag, problem, "put {} in its name, as in overlay-{}.png"));
            }
        }
        Ok(())
    }

    /// Whether previews are requested.
    pub fn is_preview(&self) -> bool {
        self.preview.is_some()
    }

    /// Writes previews if requested; returns whether they are.
    ///
    /// # Errors
    /// As `open` and [`write_preview`].
    pub fn preview(
        &self,
        images: &[PathBuf],
        open: impl Fn(&Path) -> Result<Photograph>,
        balance: impl Fn(&Photograph) -> Balance,
    ) -> Result<bool> {
        let Some(file) = &self.preview else { return Ok(false) };
        for image in images {
            let photograph = open(image)?;
            write_preview(&named(file, &name(image)), &photograph, image, &balance(&photograph))?;
            keep_one_of_many(file)?;
        }
        Ok(true)
    }

    /// Draws the overlay if requested.
    ///
    /// # Errors
    /// As [`write_overlay`].
    pub fn overlay(
        &self,
        image: &Path,
        photograph: &Photograph,
        grids: &[Grid],
        facets: &[FacetMeasurement],
        balance: &Balance,
    ) -> Result<()> {
        let Some(file) = &self.overlay else { return Ok(()) };
        let left_out: Vec<PixelRun> = facets.iter().flat_map(|facet| facet.left_out.clone()).collect();
        write_overlay(&named(file, &name(image)), photograph, grids, &left_out, balance)?;
        keep_one_of_many(file)
    }
}

/// Lets pictures appear one by one if their name is a pattern. They may be more than a process can hold open,
/// and with --resume the records that they belong to are written one by one, too.
fn keep_one_of_many(file: &Path) -> Result<()> {
    if is_pattern(file) { keep_complete() } else { Ok(()) }
}

/// The name of a sample and its drawings, from its photograph.
pub fn name(image: &Path) -> String {
    image.file_stem().unwrap_or(image.as_os_str()).to_string_lossy().into_owned()
}
