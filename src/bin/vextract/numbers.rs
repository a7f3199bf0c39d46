//! Messages on a photograph's numbers: their range, and whether they are a camera's own.

use std::path::Path;

use vfold::Error;
use vfold::error::counted;
use vfold::image::{FacetMeasurement, PhotographInfo, Processing};

/// Possible causes of a wrong spectrum, one line each.
pub fn warnings(
    path: &Path,
    info: &PhotographInfo,
    processing: Option<Processing>,
    facets: &[FacetMeasurement],
) -> Vec<String> {
    let lines = [clipped(info, facets), darkest(info), developed(info), processing.map(processed)];
    lines.into_iter().flatten().map(|line| format!("warning: {}{line}", path.display())).collect()
}

/// The error for a photograph without usable facets.
pub fn none_usable(path: &Path, info: &PhotographInfo, facets: &[FacetMeasurement]) -> Error {
    // facets of an unmarked panel have no pixels
    let seen = facets.iter().filter(|facet| facet.pixels > 0.0 || facet.clipped > 0).count();
    let clipped = facets.iter().filter(|facet| facet.clipped > 0).count();
    if 2 * clipped > seen {
        let where_to = ends(info).unwrap_or_else(|| "the white level".to_owned());
        let problem = format!("no facet can be used: its numbers are clipped at {where_to}");
        return Error::picture(path, problem, "expose it less, or check --white-level");
    }
    let remedy = "check the panels' corners and --margin";
    Error::picture(path, "no facet has a pixel that can be used", remedy)
}

/// Numbers that end below white, or so often at it that facets are excluded.
fn clipped(info: &PhotographInfo, facets: &[FacetMeasurement]) -> Option<String> {
    let (ends, percent) = (ends(info), 100.0 * clipped_part(facets));
    let left_out = facets.iter().filter(|facet| facet.clipped > 0 && facet.mean.is_none()).count();
    match ends {
        Some(ends) if percent > 0.0 => Some(format!(
            ": its numbers end at {ends}, below white: {percent:.1} % of the panels' pixels count \
             as clipped; expose it less"
        )),
        None if left_out > 0 => Some(format!(
            ": {} left out, because more than 2 % of their pixels are clipped; expose it less",
            counted(left_out, "facet")
        )),
        _ => None,
    }
}

/// `4095 in R, G and B`.
fn ends(info: &PhotographInfo) -> Option<String> {
    let channels = if info.ends_at.len() == 1 { &["grey"][..] } else { &["R", "G", "B"] };
    let mut by_level: Vec<(f64, Vec<&str>)> = Vec::new();
    for (channel, end) in channels.iter().zip(&info.ends_at) {
        let Some(end) = end else { continue };
        match by_level.iter_mut().find(|(level, _)| level.total_cmp(end).is_eq()) {
            Some((_, channels)) => channels.push(channel),
            None => by_level.push((*end, vec![channel])),
        }
    }
    let each: Vec<String> =
        by_level.iter().map(|(level, channels)| format!("{level} in {}", listed(channels))).collect();
    (!each.is_empty()).then(|| each.join(", "))
}

/// `R, G and B`.
fn listed(names: &[&str]) -> String {
    match names {
        [rest @ .., last] if !rest.is_empty() => format!("{} and {last}", rest.join(", ")),
        _ => names.concat(),
    }
}

fn clipped_part(facets: &[FacetMeasurement]) -> f64 {
    let clipped: usize = facets.iter().map(|facet| facet.clipped).sum();
    let left: f64 = facets.iter().map(|facet| facet.pixels).sum();
    if clipped == 0 { 0.0 } else { clipped as f64 / (clipped as f64 + left) }
}

fn darkest(info: &PhotographInfo) -> Option<String> {
    let digits = if info.darkest.iter().all(|stored| *stored >= 10.0) { 0 } else { 5 };
    let levels: Vec<String> = info.darkest.iter().map(|stored| format!("{stored:.digits$}")).collect();
    (!levels.is_empty()).then(|| {
        format!(
            ": its darkest pixels are the same in all channels ({}): black was probably not subtracted; \
             give --black-level auto",
            levels.join(", ")
        )
    })
}

/// What a picture that was developed for the eye is, after its name.
pub fn developed(info: &PhotographInfo) -> Option<String> {
    info.is_developed().then(|| {
        format!(
            " ({}) was developed for the eye, and neither white balance nor colour matrix is undone: \
             expect a wrong spectrum; give the RAW file, or --undo, or --transfer if its numbers are the \
             camera's own",
            info.format
        )
    })
}

fn processed(processing: Processing) -> String {
    let why = match processing {
        Processing::Curve => "its noise falls as brightness rises: a tone curve such as sRGB's was applied",
        Processing::Matrix => "noise in its channels is anticorrelated: a colour matrix mixed them",
        Processing::CurveOfFlatField => {
            "noise in the picture given with --white falls as brightness rises: a tone curve such as sRGB's \
             was applied to it"
        }
    };
    format!(
        ": {why}; expect a wrong spectrum; give the RAW file, or a linear TIFF in the camera's own colours"
    )
}
