//! From a photograph to its sample.

use std::path::Path;

use vfold::cli;
use vfold::geometry::Fold;
use vfold::image::{Homography, Photograph, measure, pixels_sharing_noise};
use vfold::stream::{ImageRecord, Sample};
use vfold::{Error, Result};

use super::Args;

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
    let sharing_noise = pixels_sharing_noise(&photograph, panels);
    let facets: Vec<_> = measure(&photograph, panels, &row_edges, grid.cols, args.regions.margin)?
        .into_iter()
        .map(|facet| facet.with_shared_noise(&sharing_noise))
        .collect();
    if args.common.verbose {
        let clipped: usize = facets.iter().map(|facet| facet.clipped).sum();
        let not_finite: usize = facets.iter().map(|facet| facet.not_finite).sum();
        let transfer = photograph.info().transfer_used.name();
        let text = format!("{transfer} curve, {clipped} clipped and {not_finite} non-finite pixels left out");
        cli::say("vextract", &format!("{}: {text}", path.display()));
    }
    if facets.iter().all(|facet| facet.mean.is_none()) {
        let remedy = "check --panel0, --panel1, --margin and the white level";
        return Err(Error::picture(path, "no facet has a pixel that can be used", remedy));
    }
    let mut sample = Sample::new(scene, &name(path))?;
    sample.set_photograph(
        &ImageRecord::new(path, photograph.info(), panels, args.regions.margin, &sharing_noise),
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

/// A sample is called after its photograph.
fn name(path: &Path) -> String {
    path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}
