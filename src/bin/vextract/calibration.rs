//! Calibration of a photograph's numbers.

use std::path::{Path, PathBuf};

use clap::Args;
use vfold::calibrate::Calibration;
use vfold::cli::Common;
use vfold::error::counted;
use vfold::forward::OpenLight;
use vfold::image::{FacetMeasurement, FlatField, Grid, Lens, Photograph};
use vfold::scene::Setting;
use vfold::spectrum::WavelengthGrid;
use vfold::stream::{CalibrationRecord, Corners, Regions, Scene, WhitePaperRecord};
use vfold::{Error, Result, cli};

use super::target::{Target, View};
use super::{facing, paper, white};

/// The usual chart, and its rows and columns.
const CHART: &str = "cc24";
const CHART_GRID: (usize, usize) = (4, 6);

#[derive(Args)]
#[command(next_help_heading = "Calibration")]
pub struct CalibrationArgs {
    /// Value of a perfect white diffuser facing the sun, in its strongest channel, above 0, if known
    #[arg(long, value_name = "X", conflicts_with_all = ["chart", "white_region"])]
    exposure: Option<f64>,
    /// Reflectances of the chart's patches, row by row
    #[arg(long, value_name = "SPEC", default_value = CHART, requires = "chart_place")]
    chart_reference: String,
    /// Rows and columns of patches of the chart
    #[arg(long, value_name = "ROWSxCOLS", default_value = "4x6", requires = "chart_place",
        value_parser = cli::pair::<usize>)]
    chart_grid: (usize, usize),
    /// Cosine of the angle between the sun and the chart's normal, above 0 to 1; 1: the chart faces the
    /// sun, unlike the panels
    #[arg(long, value_name = "X", default_value_t = 1.0, requires = "chart_place")]
    chart_cos: f64,
    /// Estimate the camera's sensitivities from the chart in IMAGE under --illuminant, write them and
    /// exit; use the file with --camera
    #[arg(long, value_name = "FILE.csv", requires = "chart_place",
        conflicts_with_all = ["overlay", "output", "resume", "save"])]
    pub save_camera: Option<PathBuf>,
    /// Reflectance of the white card; without it, the white region or picture is taken for white printing
    /// paper, which shows the exposure to 6 %
    #[arg(long, value_name = "SPEC", requires = "white_place")]
    white_reflectance: Option<String>,
    /// Cosine of the angle between the sun and the normal of card or paper, above 0 to 1
    #[arg(long, value_name = "X", default_value_t = 1.0, requires = "white_place")]
    white_cos: f64,
}

impl CalibrationArgs {
    /// The values of the flags, with spectra on the scene's wavelengths.
    ///
    /// # Errors
    /// [`Error::Usage`] if a number is out of range or the chart has other patches than its reference; as
    /// [`Common::reflectances`].
    pub fn resolved(&self, grid: &WavelengthGrid, common: &Common) -> Result<ResolvedCalibration> {
        if let Some(x) = self.exposure.filter(|x| !(*x > 0.0 && x.is_finite())) {
            return Err(Error::usage("--exposure", format!("{x} is out of range"), "give a number above 0"));
        }
        for (flag, cos) in [("--chart-cos", self.chart_cos), ("--white-cos", self.white_cos)] {
            if !(cos > 0.0 && cos <= 1.0) {
                let problem = format!("{cos} is out of range: the sun must shine on the target");
                return Err(Error::usage(flag, problem, "give a number above 0, at most 1"));
            }
        }
        let chart = common.reflectances(&self.chart_reference)?;
        let (rows, cols) = self.chart_grid;
        if rows.checked_mul(cols) != Some(chart.len()) {
            let (reference, patches) = (&self.chart_reference, counted(chart.len(), "patch"));
            let problem = format!("{rows}x{cols} does not match the {patches} of '{reference}'");
            return Err(Error::usage(
                "--chart-grid",
                problem,
                "give ROWSxCOLS of the chart, or --chart-reference",
            ));
        }
        let white = |reflectance: &String| {
            let card = common.one_reflectance("--white-reflectance", reflectance)?;
            Target::new(("white card", "--white-region"), (1, 1), self.white_cos, &[card], grid)
        };
        Ok(ResolvedCalibration {
            exposure: self.exposure,
            chart: Target::new(("chart", "--chart"), (rows, cols), self.chart_cos, &chart, grid)?,
            white: match &self.white_reflectance {
                Some(reflectance) => White::Card(white(reflectance)?),
                None => White::Paper(paper::target(self.white_cos, grid)),
            },
        })
    }

    /// Says which flags describe a card or chart that a photograph has not.
    pub fn unused(&self, has_white: bool, has_chart: bool) -> impl Iterator<Item = String> {
        const NO_WHITE: &str =
            "no white region is marked, and no picture of white by --white shows the exposure";
        const NO_CHART: &str = "no chart is marked";
        let flags = [
            ("--white-reflectance", self.white_reflectance.is_some() && !has_white, NO_WHITE),
            ("--white-cos", self.white_cos < 1.0 && !has_white, NO_WHITE),
            ("--chart-reference", self.chart_reference != CHART && !has_chart, NO_CHART),
            ("--chart-grid", self.chart_grid != CHART_GRID && !has_chart, NO_CHART),
            ("--chart-cos", self.chart_cos < 1.0 && !has_chart, NO_CHART),
        ];
        let unused = flags.into_iter().filter(|(_, is_unused, _)| *is_unused);
        unused.map(|(flag, _, why)| format!("{flag} is not used: {why}"))
    }
}

/// Means of calibrating a photograph.
pub struct ResolvedCalibration {
    pub exposure: Option<f64>,
    pub chart: Target,
    white: White,
}

/// What lies in the white region.
enum White {
    /// A card of known reflectance.
    Card(Target),
    /// Printing paper.
    Paper(Target),
}

impl ResolvedCalibration {
    /// Whether white is taken for printing paper.
    pub fn is_paper(&self) -> bool {
        matches!(self.white, White::Paper(_))
    }

    /// Drops a detected chart if a white card or the exposure was stated.
    pub fn forget_spare(&self, regions: &mut Regions) {
        if regions.chart_confidence.is_some() && (regions.white.is_some() || self.exposure.is_some()) {
            (regions.chart, regions.chart_confidence) = (None, None);
        }
    }

    /// The marked calibration target, if any.
    fn marked(&self, regions: &Regions) -> Result<Option<(&Target, Corners)>> {
        match (regions.chart, regions.white, self.exposure) {
            (None, None, _) => Ok(None),
            (Some(corners), None, None) => Ok(Some((&self.chart, corners))),
            (None, Some(corners), None) => {
                let (White::Card(target) | White::Paper(target)) = &self.white;
                Ok(Some((target, corners)))
            }
            _ => {
                let problem = "chart, white card and --exposure each set the exposure, and two are stated";
                Err(Error::usage("--regions", problem, "keep one of them"))
            }
        }
    }

    /// The patches of the marked target.
    ///
    /// # Errors
    /// As [`ResolvedCalibration::calibrate`].
    pub fn grid(&self, regions: &Regions, lens: Lens) -> Result<Option<Grid>> {
        self.marked(regions)?.map(|(target, corners)| target.grid(lens, corners)).transpose()
    }

    /// What white paper shows of the exposure, if some is marked.
    ///
    /// # Errors
    /// As [`ResolvedCalibration::calibrate`].
    pub fn paper(
        &self,
        scene: &Scene,
        regions: &Regions,
        lens: Lens,
        path: &Path,
        photograph: &Photograph,
    ) -> Result<Option<WhitePaperRecord>> {
        let (Some((target, corners)), White::Paper(_), Some(_)) =
            (self.marked(regions)?, &self.white, regions.white)
        else {
            return Ok(None);
        };
        let light = light(scene)?;
        paper::exposure(target, &View { path, photograph, light: &light, lens }, corners).map(Some)
    }

    /// Checks that what is marked as white can be, beside the measured `facets`.
    ///
    /// # Errors
    /// As [`white::is_white`] and [`Target::measure`].
    pub fn check_white(
        &self,
        scene: &Scene,
        regions: &Regions,
        lens: Lens,
        (path, photograph): (&Path, &Photograph),
        facets: &[FacetMeasurement],
    ) -> Result<()> {
        let (Some((target, corners)), Some(_)) = (self.marked(regions)?, regions.white) else {
            return Ok(());
        };
        let (setting, light) = (Setting::of(scene)?, light(scene)?);
        let model = setting.model()?;
        let perfect = model.facet_rgb(&vec![1.0; model.bands()]);
        let patch = target.measure(&View { path, photograph, light: &light, lens }, corners)?.swap_remove(0);
        white::is_white(path, &patch, &perfect, facets)
    }

    /// What the picture of a white sheet shows of the exposure, if nothing in the photograph does and both
    /// record the camera's settings.
    ///
    /// # Errors
    /// As [`paper::exposure_of_sheet`].
    pub fn sheet(
        &self,
        scene: &Scene,
        regions: &Regions,
        sheet: (&Path, &FlatField),
        photograph: &Photograph,
    ) -> Result<Option<WhitePaperRecord>> {
        if self.marked(regions)?.is_some() || self.exposure.is_some() || scene.is_light_unknown()? {
            return Ok(None);
        }
        let (White::Card(target) | White::Paper(target)) = &self.white;
        paper::exposure_of_sheet(target, &light(scene)?, sheet, photograph)
    }

    /// The calibration by the marked target, if it has a known reflectance.
    ///
    /// # Errors
    /// [`Error::Picture`] if chart or card are clipped, turned, or unlike their reference; [`Error::Usage`]
    /// if there are several targets.
    pub fn calibrate(
        &self,
        scene: &Scene,
        regions: &Regions,
        lens: Lens,
        path: &Path,
        photograph: &Photograph,
    ) -> Result<Option<(Calibration, CalibrationRecord)>> {
        let Some((target, corners)) = self.marked(regions)? else { return Ok(None) };
        if matches!(self.white, White::Paper(_)) && regions.white.is_some() {
            return Ok(None);
        }
        let light = light(scene)?;
        let setting = Setting::of(scene)?;
        if regions.chart_confidence.is_some()
            && let Some(turned_deg) = facing::turned_deg(&setting, regions, lens, target.cos())?
        {
            let problem = format!("the chart faces {turned_deg:.0}° or more away from the sun");
            let remedy = "give the output of --find as --regions, and state --chart-cos";
            return Err(Error::picture(path, problem, remedy));
        }
        let view = View { path, photograph, light: &light, lens };
        target.calibrate(&view, corners).map(Some)
    }
}

/// The light on a target.
fn light(scene: &Scene) -> Result<OpenLight> {
    if scene.is_light_unknown()? {
        let problem = "a chart or card cannot calibrate in unknown light";
        return Err(Error::usage("--illuminant", problem, "give the light, or leave chart and card out"));
    }
    Setting::of(scene)?.open_light()
}

/// Converts measured values to those of the scene's camera.
pub fn apply(calibration: &Calibration, facets: &mut [FacetMeasurement]) {
    for facet in facets {
        let Some(mean) = &mut facet.mean else { continue };
        for (channel, sd) in facet.standard_error.iter_mut().flatten().enumerate() {
            *sd = calibration.sd(channel, mean[channel], *sd);
        }
        for (channel, value) in mean.iter_mut().enumerate() {
            *value = calibration.value(channel, *value);
        }
    }
}
