//! Positions of the panels in a photograph.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use clap::{ArgGroup, Args};
use vfold::image::{CHART_CORNERS, DetectedFold, PANEL_CORNERS, Photograph, WHITE_CORNERS, parse_corners};
use vfold::stream::{Corners, Regions, RegionsFile};
use vfold::{Error, Result};

use super::finding;

#[derive(Args)]
#[command(
    next_help_heading = "Regions",
    group = ArgGroup::new("chart_place").args(["chart", "regions"]).multiple(true),
    group = ArgGroup::new("white_place").args(["white_region", "regions", "white"]).multiple(true)
)]
pub struct RegionArgs {
    /// Corners of panel 0, px; facets of panels without corners are null [default: detected, if no panel
    /// has corners]
    #[arg(long, value_name = "x,y x,y x,y x,y", allow_hyphen_values = true)]
    panel0: Option<String>,
    /// Corners of panel 1, px
    #[arg(long, value_name = "x,y x,y x,y x,y", allow_hyphen_values = true)]
    panel1: Option<String>,
    /// Corners of panel N, px, numbered from 0 as in the scene; repeat for each panel
    #[arg(long, value_name = "N=x,y x,y x,y x,y", allow_hyphen_values = true, value_parser = numbered)]
    panel: Vec<(usize, String)>,
    /// Corners of a colour chart's block of patches, px, for calibration [default: detected, if no corners
    /// are stated]
    #[arg(long, value_name = "x,y x,y x,y x,y", allow_hyphen_values = true)]
    chart: Option<String>,
    /// Corners of a white card in the picture, px, for calibration
    #[arg(long, value_name = "x,y x,y x,y x,y", conflicts_with = "chart", allow_hyphen_values = true)]
    white_region: Option<String>,
    /// JSON file of corners (see below), - for standard input; the flags above override it
    #[arg(long, value_name = "FILE")]
    regions: Option<PathBuf>,
    /// Keep this distance from the panels' edges, px
    #[arg(long, value_name = "PX", default_value_t = 0.0)]
    pub margin: f64,
}

impl RegionArgs {
    /// Whether the file of corners is standard input.
    pub fn is_stdin(&self) -> bool {
        self.regions.as_deref().is_some_and(|path| path.as_os_str() == "-")
    }

    /// The stated regions.
    ///
    /// # Errors
    /// [`Error::Usage`] if flags are not corners or the margin is not a distance, or as
    /// [`RegionsFile::open`].
    pub fn resolved(&self) -> Result<ResolvedRegions> {
        if !(self.margin >= 0.0 && self.margin.is_finite()) {
            let problem = format!("{} is not a distance", self.margin);
            return Err(Error::usage("--margin", problem, "give pixels, 0 or more"));
        }
        let corners = |flag, text: &Option<String>, names| {
            text.as_ref().map(|text| parse_corners(flag, text, names)).transpose()
        };
        let flags = Regions {
            panels: self.panels()?,
            chart: corners("--chart", &self.chart, &CHART_CORNERS)?,
            white: corners("--white-region", &self.white_region, &WHITE_CORNERS)?,
            ..Regions::default()
        };
        let file = self.regions.as_deref().map(RegionsFile::open).transpose()?;
        Ok(ResolvedRegions { flags, file })
    }

    fn panels(&self) -> Result<BTreeMap<usize, Corners>> {
        let named = [("--panel0", 0, &self.panel0), ("--panel1", 1, &self.panel1)];
        let named = named.into_iter().filter_map(|(flag, number, text)| Some((flag, number, text.as_ref()?)));
        let mut panels = BTreeMap::new();
        for (flag, number, text) in
            named.chain(self.panel.iter().map(|(number, text)| ("--panel", *number, text)))
        {
            if panels.insert(number, parse_corners(flag, text, &PANEL_CORNERS)?).is_some() {
                return Err(Error::usage(flag, format!("panel {number} is stated twice"), "keep one"));
            }
        }
        Ok(panels)
    }
}

/// Refuses panels from a file that were not detected, or with low confidence.
fn check_detected(path: &Path, photograph: &Photograph, regions: &Regions) -> Result<()> {
    if let Some(reason) = &regions.missing {
        return Err(finding::not_found(path, photograph, reason));
    }
    let unsure = regions.confidence.filter(|confidence| *confidence < DetectedFold::SURE);
    unsure.map_or(Ok(()), |confidence| Err(finding::unsure(path, photograph, confidence)))
}

/// Parses `2=x,y x,y x,y x,y`.
fn numbered(text: &str) -> std::result::Result<(usize, String), String> {
    let parts = text
        .split_once('=')
        .and_then(|(number, corners)| Some((number.trim().parse().ok()?, corners.to_owned())));
    parts.ok_or_else(|| "write N=\"x,y x,y x,y x,y\", N the panel's number from 0".to_owned())
}

/// Regions from the command line, and those from a file.
pub struct ResolvedRegions {
    flags: Regions,
    file: Option<RegionsFile>,
}

impl ResolvedRegions {
    /// Those of one photograph.
    ///
    /// # Errors
    /// As [`RegionsFile::of`]; [`Error::Picture`] for panels that were not detected, or with low confidence.
    pub fn of(&self, path: &Path, photograph: &Photograph) -> Result<Regions> {
        let regions = self.of_any(path, photograph)?;
        if self.flags.panels.is_empty() {
            check_detected(path, photograph, &regions)?;
        }
        Ok(regions)
    }

    /// The same if no panels are needed.
    ///
    /// # Errors
    /// As [`RegionsFile::of`].
    pub fn of_any(&self, path: &Path, photograph: &Photograph) -> Result<Regions> {
        let size = [photograph.width(), photograph.height()];
        let of_file = self.file.as_ref().map(|file| file.of(path, size)).transpose()?;
        Ok(self.flags.clone().or(of_file.unwrap_or_default()))
    }
}
