//! A fold from a photograph.

use std::path::Path;

use vfold::image::{DetectedFold, FoldAngle};
use vfold::stream::{NoAngle, Regions, RegionsFile};
use vfold::{Error, Result, cli};

use super::Args;

/// Default width and depth of panels.
pub const PANEL: (f64, f64) = (1.0, 1.0);

/// A fold derived from regions.
#[derive(Clone, Copy)]
pub struct Seen {
    pub angle_deg: f64,
    /// Standard deviation of the angle, degrees, if known.
    pub angle_sd_deg: Option<f64>,
    /// Width and depth of the panels.
    pub panel: (f64, f64),
}

/// Largest standard deviation of a usable angle, degrees: `vestimate` corrects a stated angle by at most 6°.
const MOST_SD_DEG: f64 = 3.0;
/// Angles further apart than this, in standard deviations, do not belong to one fold.
const APART: f64 = 3.0;

/// The fold in the regions of a single photograph.
///
/// # Errors
/// [`Error::Regions`] if there is none, or its confidence is low, or its angle is not stated.
pub fn seen(args: &Args, path: &Path) -> Result<Seen> {
    let name = path.display().to_string();
    let file = RegionsFile::open(path)?;
    let regions = file.only()?;
    check_detected(&name, regions)?;
    let by_flags = depths_by_flags(args);
    let stated = stated(regions).filter(|_| by_flags.is_none());
    match (stated.map_or_else(|| by_corners(regions, by_flags), Ok), args.angle_deg) {
        (Ok(seen), Some(angle_deg)) => {
            warn_if_apart(args, &name, &seen, angle_deg);
            Ok(seen)
        }
        (Ok(seen), None) => check_certain(&name, seen),
        (Err(_), Some(angle_deg)) => Ok(Seen { angle_deg, angle_sd_deg: None, panel: panel(regions) }),
        (Err(problem), None) => {
            let remedy = "give --angle-deg, or the output of vextract --find";
            Err(Error::regions(&name, problem.to_string(), remedy))
        }
    }
}

/// Refuses regions of a photograph in which no fold was detected, or with low confidence.
fn check_detected(name: &str, regions: &Regions) -> Result<()> {
    let mark = "mark its corners with vextract --pick";
    if let Some(reason) = &regions.missing {
        return Err(Error::regions(name, reason, mark));
    }
    match regions.confidence {
        Some(confidence) if confidence < DetectedFold::SURE => {
            let remedy = format!(
                "look at it with vextract --find --overlay FILE.png: if it is right, \
                 delete \"confidence\" from these regions, otherwise {mark}"
            );
            Err(Error::regions(name, DetectedFold::unsure(confidence), remedy))
        }
        _ => Ok(()),
    }
}

/// Depths of both panels relative to their width, if stated by flags.
fn depths_by_flags(args: &Args) -> Option<[f64; 2]> {
    let (width, depth) = args.panel.or(args.panel1_depth.map(|_| PANEL))?;
    Some([depth / width, args.panel1_depth.unwrap_or(depth) / width])
}

/// The values stated along with the corners.
fn stated(regions: &Regions) -> Option<Seen> {
    let angle_deg = regions.angle_deg?;
    Some(Seen { angle_deg, angle_sd_deg: regions.angle_sd_deg, panel: panel(regions) })
}

fn panel(regions: &Regions) -> (f64, f64) {
    regions.panel.map_or((1.0, 1.0), |[width, depth]| (width, depth))
}

/// The fold derived from the corners, for panels of these depths if known.
fn by_corners(regions: &Regions, by_flags: Option<[f64; 2]>) -> std::result::Result<Seen, NoAngle> {
    let depths = by_flags.or_else(|| regions.panel.map(|[width, depth]| [depth / width; 2]));
    let FoldAngle { angle_deg, angle_sd_deg, depths } = regions.angle_by_corners(depths)?;
    Ok(Seen { angle_deg, angle_sd_deg: Some(angle_sd_deg), panel: (1.0, depths[0]) })
}

/// Warns if the stated angle differs from that of the photograph.
fn warn_if_apart(args: &Args, name: &str, seen: &Seen, stated_deg: f64) {
    let Seen { angle_deg, angle_sd_deg: Some(sd_deg), .. } = *seen else { return };
    if (stated_deg - angle_deg).abs() > APART * sd_deg && !args.common.quiet {
        let line = format!(
            "{name}: the corners show {angle_deg:.1} ± {sd_deg:.1}°; --angle-deg {stated_deg} is used instead"
        );
        cli::say("vkernel", &line);
    }
}

/// Refuses an angle that the corners do not determine.
fn check_certain(name: &str, seen: Seen) -> Result<Seen> {
    match seen.angle_sd_deg {
        Some(sd_deg) if sd_deg > MOST_SD_DEG => {
            let problem = format!("the corners fix the angle only to {:.0} ± {sd_deg:.0}°", seen.angle_deg);
            let remedy = "give the panels' proportions, such as --panel 1x1, or --angle-deg";
            Err(Error::regions(name, problem, remedy))
        }
        _ => Ok(seen),
    }
}
