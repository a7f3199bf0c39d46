//! Where the panels are in a photograph.

use std::path::{Path, PathBuf};

use clap::{ArgGroup, Args};
use vfold::image::{CHART_CORNERS, Homography, PANEL_CORNERS, Photograph, WHITE_CORNERS, parse_corners};
use vfold::stream::{Regions, RegionsFile};
use vfold::{Error, Result};

#[derive(Args)]
#[command(
    next_help_heading = "Regions",
    group = ArgGroup::new("chart_place").args(["chart", "regions"]).multiple(true),
    group = ArgGroup::new("white_place").args(["white_region", "regions"]).multiple(true)
)]
pub struct RegionArgs {
    /// Corners of panel 0
    #[arg(long, value_name = "x,y x,y x,y x,y", required_unless_present_any = ["generate", "list", "regions", "preview"], allow_hyphen_values = true)]
    panel0: Option<String>,
    /// Corners of panel 1 [default: only panel 0 is measured]
    #[arg(long, value_name = "x,y x,y x,y x,y", allow_hyphen_values = true)]
    panel1: Option<String>,
    /// Corners of a colour chart's block of patches, to calibrate with
    #[arg(long, value_name = "x,y x,y x,y x,y", allow_hyphen_values = true)]
    chart: Option<String>,
    /// Corners of a white card in the picture, to calibrate with
    #[arg(long, value_name = "x,y x,y x,y x,y", conflicts_with = "chart", allow_hyphen_values = true)]
    white_region: Option<String>,
    /// JSON file of corners, see below; the flags above win over it
    #[arg(long, value_name = "FILE")]
    regions: Option<PathBuf>,
    /// Stay this far from the panels' edges
    #[arg(long, value_name = "PX", default_value_t = 0.0, allow_negative_numbers = true)]
    pub margin: f64,
}

impl RegionArgs {
    /// What was given.
    ///
    /// # Errors
    /// [`Error::Usage`] if flags are not corners or the margin is no distance, or as [`RegionsFile::open`].
    pub fn given(&self) -> Result<GivenRegions> {
        if !(self.margin >= 0.0 && self.margin.is_finite()) {
            let problem = format!("{} is not a distance", self.margin);
            return Err(Error::usage("--margin", problem, "give pixels, 0 or more"));
        }
        let corners = |flag, text: &Option<String>, names| {
            text.as_ref().map(|text| parse_corners(flag, text, names)).transpose()
        };
        let flags = Regions {
            panel0: corners("--panel0", &self.panel0, &PANEL_CORNERS)?,
            panel1: corners("--panel1", &self.panel1, &PANEL_CORNERS)?,
            chart: corners("--chart", &self.chart, &CHART_CORNERS)?,
            white: corners("--white-region", &self.white_region, &WHITE_CORNERS)?,
            ..Regions::default()
        };
        let file = self.regions.as_deref().map(RegionsFile::open).transpose()?;
        if file.is_none() {
            panels(&flags)?;
        }
        Ok(GivenRegions { flags, file })
    }
}

/// Regions from the command line, and those from a file.
pub struct GivenRegions {
    flags: Regions,
    file: Option<RegionsFile>,
}

impl GivenRegions {
    /// Those of one photograph.
    ///
    /// # Errors
    /// As [`RegionsFile::of`].
    pub fn of(&self, path: &Path, photograph: &Photograph) -> Result<Regions> {
        let size = [photograph.width(), photograph.height()];
        match &self.file {
            Some(file) => Ok(self.flags.clone().or(file.of(path, size)?)),
            None => Ok(self.flags.clone()),
        }
    }
}

/// Where each panel lies.
///
/// # Errors
/// [`Error::Usage`] if there is no panel 0, or the panels are not side by side.
pub fn panels(regions: &Regions) -> Result<Vec<Homography>> {
    let Some(panel0) = regions.panel0 else {
        return Err(Error::usage("--regions", "there is no 'panel0' in it", "add it or give --panel0"));
    };
    let panels = [Some(panel0), regions.panel1];
    let panels: Vec<_> =
        panels.into_iter().flatten().map(Homography::from_unit_square).collect::<Result<_>>()?;
    if let [panel0, panel1] = panels.as_slice() {
        let (u, v) = panel0.to_panel(panel1.to_image(0.5, 0.5));
        if (0.0..=1.0).contains(&u) && (0.0..=1.0).contains(&v) {
            let problem = "the middle of panel 1 lies inside panel 0";
            return Err(Error::usage("--panel1", problem, "the panels meet at the crease and nowhere else"));
        }
    }
    Ok(panels)
}
