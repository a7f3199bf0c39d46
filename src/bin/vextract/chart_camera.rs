//! `--save-camera`: a camera's sensitivities from the chart in a photograph.

use std::path::{Path, PathBuf};

use vfold::camera::ChartCamera;
use vfold::image::Photograph;
use vfold::spectrum::Outside;
use vfold::spectrum::formats::{Measured, check_ending, write};
use vfold::{Error, Result, cli};

use super::calibration::ResolvedCalibration;
use super::regions::ResolvedRegions;
use super::sheet::Sheet;
use super::{Args, light};

/// Writes the camera derived from a single photograph.
///
/// # Errors
/// [`Error::Usage`] if there are several photographs or no chart, [`Error::Picture`] if the chart is too
/// dark, clipped, turned or a different one.
pub fn save(
    args: &Args,
    file: &Path,
    images: &[PathBuf],
    first: Result<Photograph>,
    (regions, calibration): (&ResolvedRegions, &ResolvedCalibration),
    sheet: Option<&Sheet>,
) -> Result<()> {
    const FLAG: &str = "--save-camera";
    if images.len() > 1 {
        return Err(Error::usage(
            FLAG,
            format!("{} photographs", images.len()),
            "give the one with the chart",
        ));
    }
    if !file.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("csv")) {
        return Err(Error::usage(FLAG, format!("'{}' is not a .csv file", file.display()), "end it in .csv"));
    }
    check_ending(file)?;
    let path = &images[0];
    let photograph = match sheet {
        Some(sheet) => sheet.divide(path, first?)?,
        None => first?,
    };
    let (optics, assumed) = light::optics(&args.optics, path, Some(&photograph));
    optics.known_illuminants("sensitivities are computed from the light on the chart: state it")?;
    let illuminant =
        args.common.illuminant(optics.one_illuminant("name one: a photograph has one light")?)?;
    let grid = &optics.wavelengths_nm;
    let power = illuminant.on(grid, Outside::Refuse)?;
    let lens = args.placing.lens(&photograph)?.lens;
    let corners = regions.of_any(path, &photograph)?.chart;
    let corners = corners
        .ok_or_else(|| Error::usage(FLAG, "no chart is marked", "give --chart, or 'chart' in --regions"))?;
    let camera = calibration.chart.camera((path, &photograph), lens, corners, (grid, &power))?;
    let note = note(file, illuminant.name(), &camera);
    let channel = |((name, curve), sd): ((&str, Vec<f64>), Vec<f64>)| Measured {
        name: name.to_owned(),
        wavelengths_nm: grid.wavelengths_nm().to_vec(),
        reflectance: curve,
        reflectance_sd: Some(sd),
    };
    let channels: Vec<_> = ["R", "G", "B"]
        .into_iter()
        .zip(camera.sensitivities)
        .zip(camera.sensitivities_sd)
        .map(channel)
        .collect();
    write(file, &channels)?;
    let differences = sheet.iter().flat_map(|sheet| sheet.differences(path, &photograph));
    differences
        .chain(assumed)
        .chain([note])
        .filter(|_| !args.common.quiet)
        .for_each(|line| cli::say("vextract", &line));
    Ok(())
}

fn note(file: &Path, light: &str, camera: &ChartCamera) -> String {
    let all = camera.sensitivities_sd.iter().flatten();
    let sd = (all.clone().map(|sd| sd * sd).sum::<f64>() / all.count() as f64).sqrt();
    format!(
        "{}: sensitivities from the chart in {light}; the patches fit to {:.1} %, the mean standard \
         deviation is {:.1} % of green's peak; use the file with --camera",
        file.display(),
        100.0 * camera.residual,
        100.0 * sd
    )
}
