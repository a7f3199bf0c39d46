//! Panels and charts that are detected rather than stated.

use std::fmt::Display;
use std::path::{Path, PathBuf};

use vfold::cli;
use vfold::image::{
    CornersBy, DetectedChart, DetectedFold, Detections, FoldSeen, Grid, Homography, LensEstimate, OtherFold,
    Photograph, Point, find_all, find_fold, find_fold_and_chart,
};
use vfold::scene::stated_fold;
use vfold::stream::{Output, Regions, Scene, detection_line, no_detection_line};
use vfold::{Error, Result};

use super::placing::Placed;
use super::{Args, balance, numbers, reading::Reading};

/// Prints the positions of fold, chart and white areas in each photograph, and draws them if `--overlay` is
/// present.
///
/// # Errors
/// As [`Reading::open`] for a single photograph; with several, an unreadable one is reported in its line.
pub fn print(args: &Args, images: &[PathBuf], reading: &Reading, out: &mut Output) -> Result<()> {
    out.expect(images.len());
    for path in images {
        let photograph = match reading.open(path) {
            Err(error) if images.len() > 1 && !error.is_out_of_files() => {
                out.text(&no_detection_line(path, &error.to_string())?)?;
                continue;
            }
            opened => opened?,
        };
        let lens = args.placing.lens(&photograph)?;
        let found = find_all(&photograph, &lens);
        if found.fold.is_ok() || found.chart.is_some() || !found.white_candidates.is_empty() {
            let Detections { fold, chart, white_candidates } = &found;
            draw(args, path, &photograph, (fold.as_ref().ok(), chart.as_ref(), white_candidates))?;
        }
        out.text(&line(path, &photograph, &found)?)?;
    }
    Ok(())
}

/// The line for a photograph with these detections.
///
/// # Errors
/// As [`detection_line`].
pub fn line(path: &Path, photograph: &Photograph, found: &Detections) -> Result<String> {
    let angle = found.fold.as_ref().ok().and_then(|fold| seen(photograph, fold.lens).angle(&fold.panels));
    detection_line(path, photograph, found, angle.as_ref())
}

/// Data on a fold's angle in a photograph other than its corners.
fn seen(photograph: &Photograph, lens: LensEstimate) -> FoldSeen {
    FoldSeen {
        size: [photograph.width(), photograph.height()],
        corners_by: CornersBy::Finding,
        lens,
        focal_35mm: photograph.info().camera.focal_35mm,
        depths: None,
    }
}

/// Detects the panels of a fold, and a chart unless a calibration target is stated, and adds them to
/// `regions`.
///
/// # Errors
/// [`Error::Picture`] if no fold is found, or its confidence is too low for measuring it without review.
pub fn find(
    args: &Args,
    path: &Path,
    photograph: &Photograph,
    regions: &mut Regions,
) -> Result<DetectedFold> {
    let lens = args.placing.lens(photograph)?;
    let (fold, chart) = if regions.chart.is_none() && regions.white.is_none() {
        find_fold_and_chart(photograph, &lens)
    } else {
        (find_fold(photograph, &lens), None)
    };
    let found = fold.map_err(|none| not_found(path, photograph, &none))?;
    if !found.is_sure() {
        draw(args, path, photograph, (Some(&found), None, &[]))?;
        return Err(unsure(path, photograph, found.confidence));
    }
    if !args.common.quiet {
        let line = format!("{}: corners found, {:.1} % sure", path.display(), 100.0 * found.confidence);
        cli::say("vextract", &line);
    }
    let angle = seen(photograph, found.lens).angle(&found.panels);
    regions.angle_deg = angle.map(|angle| angle.angle_deg);
    regions.angle_sd_deg = angle.map(|angle| angle.angle_sd_deg);
    regions.panels.extend(found.panels.into_iter().enumerate());
    if let Some(chart) = chart.filter(DetectedChart::is_sure) {
        regions.chart = Some(chart.corners);
        regions.chart_confidence = Some(chart.confidence);
    }
    Ok(found)
}

/// The fold that agrees better with the panels' corners than the scene's, if the scene's is a fold.
pub fn other_fold(
    photograph: &Photograph,
    scene: &Scene,
    (placed, corners_by): (&Placed, CornersBy),
) -> Result<Option<OtherFold>> {
    let Some(fold) = scene.fold_if_one()? else { return Ok(None) };
    let corners = |number: usize| {
        placed.grids.iter().find(|panel| panel.panel == Some(number)).map(|panel| *panel.outline.corners())
    };
    let (Some(panel0), Some(panel1)) = (corners(0), corners(1)) else { return Ok(None) };
    let seen = FoldSeen { corners_by, ..seen(photograph, placed.lens.unwrap_or(LensEstimate::UNKNOWN)) };
    Ok(seen.other_than(&[panel0, panel1], &stated_fold(&fold, scene.angle_sd_deg()?)))
}

/// Remedy if detection fails. A photograph whose colours are of no use is named as such before anybody marks
/// its corners.
fn remedy(photograph: &Photograph) -> String {
    let developed = numbers::developed(photograph.info()).map(|line| format!("; the picture{line}"));
    format!("mark the corners with --pick, or give --panel0 and --panel1{}", developed.unwrap_or_default())
}

/// A photograph without a fold, for this reason.
pub fn not_found(path: &Path, photograph: &Photograph, reason: &impl Display) -> Error {
    Error::picture(path, reason, remedy(photograph))
}

/// A fold that may be something else, or with a side that may be along another edge.
pub fn unsure(path: &Path, photograph: &Photograph, confidence: f64) -> Error {
    let remedy = format!(
        "look at it with --find --overlay FILE.png: if it is right, delete \"confidence\" from the output of \
         --find and give that as --regions, otherwise {}",
        remedy(photograph)
    );
    Error::picture(path, DetectedFold::unsure(confidence), remedy)
}

/// Draws fold, chart and white areas over their photograph, if requested.
fn draw(
    args: &Args,
    path: &Path,
    photograph: &Photograph,
    (fold, chart, white): (Option<&DetectedFold>, Option<&DetectedChart>, &[[Point; 4]]),
) -> Result<()> {
    let lens = fold.map_or(args.placing.lens(photograph)?, |fold| fold.lens).lens;
    let panel = |(number, corners)| {
        let outline = Homography::through(lens, corners)?;
        Ok(Grid::of_panel(number, outline, &[0.0, 1.0], &[0.0, 1.0]))
    };
    let panels = fold.into_iter().flat_map(|fold| fold.panels.into_iter().enumerate()).map(panel);
    let patches = |chart: &DetectedChart| {
        Ok(Grid::even(Homography::through(lens, chart.corners)?, DetectedChart::GRID))
    };
    let area = |corners: &[Point; 4]| Ok(Grid::even(Homography::through(lens, *corners)?, [1, 1]));
    let grids = panels.chain(chart.map(patches)).chain(white.iter().map(area)).collect::<Result<Vec<_>>>()?;
    args.pictures.overlay(path, photograph, &grids, &[], &balance::of_photograph(args, photograph))
}
