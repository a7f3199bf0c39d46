//! Makes the sample of a photograph.

use std::collections::BTreeMap;
use std::path::Path;

use vfold::calibrate::Calibration;
use vfold::cli;
use vfold::geometry::Panel;
use vfold::image::{
    CornersBy, FacetMeasurement, Grid, Lens, MeasuredPanels, Photograph, measure_panels, open_sides,
};
use vfold::scene::MarkedPanels;
use vfold::stream::{CalibrationRecord, ImageRecord, Regions, Sample, Scene};
use vfold::surfaces::Sight;
use vfold::{Error, Result};

use super::calibration::{ResolvedCalibration, apply};
use super::pictures::name;
use super::reading::{Opened, Reading};
use super::regions::ResolvedRegions;
use super::sheet::Sheet;
use super::{Args, balance, camera, finding, numbers, placing, white};

/// Common settings of all photographs in a run.
pub struct Setup<'a> {
    pub args: &'a Args,
    pub reading: Reading,
    pub scene: &'a Scene,
    pub id: String,
    pub panels: BTreeMap<usize, Panel>,
    pub facet_count: usize,
    /// For a surface whose panels may hide each other.
    pub sight: Option<Sight>,
    pub regions: ResolvedRegions,
    pub calibration: ResolvedCalibration,
    pub sheet: Option<Sheet>,
}

impl Setup<'_> {
    pub fn sample(&self, path: &Path, opened: Result<Opened>) -> Result<Sample> {
        let Opened { photograph, sha256 } = opened?;
        let photograph = match &self.sheet {
            Some(sheet) => sheet.divide(path, photograph)?,
            None => photograph,
        };
        self.check_colours(path, &photograph)?;
        let args = self.args;
        let mut regions = self.regions.of(path, &photograph)?;
        let stated = !regions.panels.is_empty() || self.scene.fold_if_one()?.is_none();
        let found = if stated { None } else { Some(finding::find(args, path, &photograph, &mut regions)?) };
        let confidence = found.map_or(regions.confidence, |found| Some(found.confidence));
        self.calibration.forget_spare(&mut regions);
        let panels = MarkedPanels::new(&self.panels, &regions.panels)?;
        let placed = args.placing.place(&photograph, &panels, found.map(|found| found.lens))?;
        let corners_by = if confidence.is_some() { CornersBy::Finding } else { CornersBy::Hand };
        let other_fold = finding::other_fold(&photograph, self.scene, (&placed, corners_by))?;
        let margin = args.regions.margin;
        let MeasuredPanels { facets: mut measured, pixels_sharing_noise, processing } =
            measure_panels(&photograph, &placed.grids, margin)?;
        if let Some(sight) = &self.sight {
            let hidden = panels.hidden(sight, &placed.grids, placed.lens());
            let of_hidden = measured.iter_mut().zip(hidden).filter(|(_, hidden)| *hidden);
            of_hidden.for_each(|(facet, _)| *facet = FacetMeasurement::unseen());
        }
        let mut facets = panels.in_scene(measured, self.facet_count);
        let mut grids = placed.grids.clone();
        grids.extend(self.calibration.grid(&regions, placed.lens())?);
        regions.white.map_or(Ok(()), |corners| white::check_off_panels(path, corners, &regions.panels))?;
        let balance = balance::of_scene(self.scene, &photograph);
        args.pictures.overlay(path, &photograph, &grids, &facets, &balance)?;
        if facets.iter().all(|facet| facet.mean.is_none()) {
            return Err(numbers::none_usable(path, photograph.info(), &facets));
        }
        let paper = match &self.sheet {
            Some(sheet) => {
                let flat_field = (sheet.path.as_path(), sheet.flat_field());
                self.calibration.sheet(self.scene, &regions, flat_field, &photograph)?
            }
            None => None,
        };
        let paper = match paper {
            Some(paper) => Some(paper),
            None => self.calibration.paper(self.scene, &regions, placed.lens(), path, &photograph)?,
        };
        let calibrated = self.calibrated(&regions, placed.lens(), path, &photograph)?;
        self.calibration.check_white(self.scene, &regions, placed.lens(), (path, &photograph), &facets)?;
        let mut sample = Sample::new(&self.id, &name(path))?;
        if let Some(exposure) = self.calibration.exposure {
            sample.fields.set("exposure", exposure)?;
        }
        if let Some(paper) = &paper {
            sample.set_white_paper(paper)?;
            if !self.args.common.quiet {
                let line = if self.calibration.is_paper() {
                    let remedy = "if it is a card, give --white-reflectance; \
                                  if it is turned from the sun, --white-cos";
                    format!("{}: taken for {paper}; {remedy}", path.display())
                } else {
                    format!("{}: {paper}", path.display())
                };
                cli::say("vextract", &line);
            }
        }
        if !args.common.quiet {
            let has_white = paper.is_some() || regions.white.is_some();
            let unused = args.calibration.unused(has_white, regions.chart.is_some());
            unused.for_each(|line| cli::say("vextract", &format!("{}: {line}", path.display())));
        }
        if let Some((calibration, record)) = &calibrated {
            apply(calibration, &mut facets);
            sample.set_calibration(record)?;
        }
        let image = ImageRecord::new(path, photograph.info(), &placed.grids, margin, &pixels_sharing_noise)
            .with_checksum(sha256)
            .with_processing(processing)
            .with_open_sides(self.open_sides(&photograph, &placed.grids)?)
            .with_other_fold(other_fold)
            .with_placing(placed.lens.map(|known| known.lens), placed.refinement.as_ref())
            .with_confidence(confidence);
        sample.set_photograph(&image, &facets)?;
        if let Some(refinement) = &placed.refinement {
            let quiet = args.common.quiet || !args.placing.asks_for_edges();
            placing::report(refinement, &path.display().to_string(), args.common.verbose, quiet);
        }
        if !args.common.quiet {
            numbers::warnings(path, photograph.info(), processing, &facets)
                .into_iter()
                .chain(self.sheet.iter().flat_map(|sheet| sheet.differences(path, &photograph)))
                .for_each(|line| cli::say("vextract", &line));
        }
        if let Some(line) = camera::other_than(self.scene, path, &photograph) {
            cli::say("vextract", &line);
        }
        let shown = paper.map(|paper| paper.to_string());
        let shown = shown.or(calibrated.map(|(_, record)| record.to_string()));
        self.say(path, &photograph, &facets, shown.as_deref());
        Ok(sample)
    }

    /// The calibration by the marked target. A detected chart is dropped with a message where a stated one
    /// would cause an error.
    fn calibrated(
        &self,
        regions: &Regions,
        lens: Lens,
        path: &Path,
        photograph: &Photograph,
    ) -> Result<Option<(Calibration, CalibrationRecord)>> {
        let calibrated = self.calibration.calibrate(self.scene, regions, lens, path, photograph);
        let Some(confidence) = regions.chart_confidence else { return calibrated };
        if !self.args.common.quiet {
            let name = format!("{}: ", path.display());
            let found = format!("{name}chart found, {:.1} % sure", 100.0 * confidence);
            let line = match &calibrated {
                Err(error) => {
                    let why = error.to_string();
                    format!("{found}, but not used: {}", why.strip_prefix(&name).unwrap_or(&why))
                }
                Ok(_) => format!("{found}: it calibrates the photograph"),
            };
            cli::say("vextract", &line);
        }
        Ok(calibrated
            .ok()
            .flatten()
            .map(|(calibration, record)| (calibration, record.with_confidence(Some(confidence)))))
    }

    /// Sides along which no edge of the sheet lies; on surfaces other than a fold, panels continue on more
    /// than one side.
    fn open_sides(&self, photograph: &Photograph, panels: &[Grid]) -> Result<Vec<String>> {
        let is_fold = self.scene.fold_if_one()?.is_some();
        Ok(if is_fold { open_sides(photograph, panels) } else { Vec::new() })
    }

    /// A photograph's sample, or the sample with an error of one that cannot be measured among several.
    ///
    /// # Errors
    /// If the machine has run out of open files, which is not the photograph's fault.
    pub fn sample_or_error(&self, path: &Path, opened: Result<Opened>) -> Result<Sample> {
        self.sample(path, opened).or_else(|error| {
            if error.is_out_of_files() {
                return Err(error);
            }
            let mut sample = Sample::new(&self.id, &name(path))?;
            sample.set_error(&error)?;
            Ok(sample)
        })
    }

    /// A grey picture requires a camera with one channel.
    fn check_colours(&self, path: &Path, photograph: &Photograph) -> Result<()> {
        // none if no camera is stated and the first photograph, which would name it, is unreadable
        let Ok(camera) = self.scene.camera() else { return Ok(()) };
        let Some(problem) = photograph.unlike_camera(camera.channels.len()) else { return Ok(()) };
        Err(Error::picture(path, problem, "give the camera that took it (--camera), or the original picture"))
    }

    fn say(
        &self,
        path: &Path,
        photograph: &Photograph,
        facets: &[FacetMeasurement],
        calibration: Option<&str>,
    ) {
        if !self.args.common.verbose {
            return;
        }
        let total = |pick: fn(&FacetMeasurement) -> usize| facets.iter().map(pick).sum::<usize>();
        let (clipped, not_finite) = (total(|facet| facet.clipped), total(|facet| facet.not_finite));
        let (outliers, unseen) =
            (total(|facet| facet.outliers), total(|facet| usize::from(facet.mean.is_none())));
        let transfer = photograph.info().transfer_used.name();
        let pixels =
            format!("pixels left out: {clipped} clipped, {not_finite} non-finite, {outliers} outlying");
        let mut text =
            format!("{transfer} curve, {pixels}; {unseen} of {} facets not measured", facets.len());
        if let Some(calibration) = calibration {
            text += &format!("; {calibration}");
        }
        cli::say("vextract", &format!("{}: {text}", path.display()));
    }
}
