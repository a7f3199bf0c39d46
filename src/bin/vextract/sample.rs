//! From a photograph to its sample.

use std::path::Path;

use vfold::cli;
use vfold::geometry::Fold;
use vfold::image::{FacetMeasurement, Homography, Photograph, measure};
use vfold::stream::{ImageRecord, Sample};
use vfold::{Error, Result};

use super::Args;
use super::pictures::{facet_grids, name};
use super::placing;

pub fn sample(
    args: &Args,
    scene: &str,
    fold: &Fold,
    panels: &[Homography],
    path: &Path,
    photograph: Result<Photograph>,
) -> Result<Sample> {
    let photograph = photograph?;
    let grid = fold.facets();
    let row_edges = fold.spacing().edges(grid.rows);
    let placed = args.placing.place(&photograph, panels)?;
    if let Some(refinement) = &placed.refinement {
        placing::report(refinement, &path.display().to_string(), args.common.verbose, args.common.quiet);
    }
    let facets = measure(&photograph, &placed.panels, &row_edges, grid.cols, args.regions.margin)?;
    args.pictures.overlay(path, &photograph, &facet_grids(&placed.panels, &row_edges, grid.cols), &facets)?;
    if args.common.verbose {
        let total = |pick: fn(&FacetMeasurement) -> usize| facets.iter().map(pick).sum::<usize>();
        let (clipped, not_finite) = (total(|facet| facet.clipped), total(|facet| facet.not_finite));
        let (outliers, unseen) =
            (total(|facet| facet.outliers), total(|facet| usize::from(facet.mean.is_none())));
        let transfer = photograph.info().transfer_used.name();
        let pixels =
            format!("{clipped} clipped, {not_finite} non-finite and {outliers} outlying pixels left out");
        let text = format!("{transfer} curve, {pixels}, {unseen} of {} facets not measured", facets.len());
        cli::say("vextract", &format!("{}: {text}", path.display()));
    }
    if facets.iter().all(|facet| facet.mean.is_none()) {
        let remedy = "check --panel0, --panel1, --margin and the white level";
        return Err(Error::picture(path, "no facet has a pixel that can be used", remedy));
    }
    let mut sample = Sample::new(scene, &name(path))?;
    sample.set_photograph(
        &ImageRecord::new(path, photograph.info(), &placed.panels, args.regions.margin)
            .with_placing(placed.distortion, placed.refinement.as_ref()),
        &facets,
        2 * grid.len(),
    )?;
    if let Some(exposure) = args.calibration.exposure {
        sample.fields.set("exposure", exposure)?;
    }
    Ok(sample)
}

/// A photograph that cannot be measured, among others that can.
pub fn failed(scene: &str, path: &Path, error: &Error) -> Result<Sample> {
    let mut sample = Sample::new(scene, &name(path))?;
    sample.set_error(error)?;
    Ok(sample)
}
