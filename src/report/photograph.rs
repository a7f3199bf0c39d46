//! The photograph that was measured, and what was not stated on it.

use super::html::Html;
use super::tables::pairs;
use super::words::{digits, rounded, utc, with_sd};
use crate::error::Result;
use crate::image::camera_name;
use crate::stream::{HistoryRecord, Sample, Scene};

/// Name, date and checksum of the photograph, which identify it.
pub(super) fn file(sample: &Sample) -> Result<Option<Html>> {
    let text = |field: &str| sample.fields.text_at(&format!("image.{field}"));
    let Some(name) = text("file")? else { return Ok(None) };
    let mut rows = vec![("image.file".to_owned(), name)];
    let mut add =
        |what: &str, value: Option<String>| rows.extend(value.map(|value| (what.to_owned(), value)));
    add("taken, by the camera's clock", text("taken")?);
    let written = text("file_modified_s")?.and_then(|seconds| seconds.parse().ok());
    add("file last written", written.map(utc));
    add("SHA-256", text("sha256")?);
    let camera = camera_name(&text("make")?.unwrap_or_default(), &text("model")?.unwrap_or_default());
    add("camera", Some(camera).filter(|name| !name.is_empty()));
    add("image.stored_as", text("stored_as")?);
    Ok(Some(pairs("The photograph", rows)))
}

/// What the tools found or assumed in place of missing statements, and with what certainty.
pub(super) fn unstated(sample: &Sample, scene: &Scene) -> Result<Option<Html>> {
    let mut rows: Vec<[String; 3]> = Vec::new();
    for (field, what) in [
        ("image.detection_confidence", "corners of the panels"),
        ("calibration.detection_confidence", "corners of the colour chart"),
    ] {
        let sure = sample.fields.text_at(field)?.and_then(|text| text.parse::<f64>().ok());
        rows.extend(sure.map(|sure| {
            [what.to_owned(), "as drawn over the photograph".to_owned(), format!("{:.1} %", 100.0 * sure)]
        }));
    }
    rows.extend(angle(scene)?);
    rows.extend(panels(scene)?);
    rows.extend(camera(sample, scene)?);
    rows.extend(light(sample, scene)?);
    rows.extend(day(sample)?);
    let headings = ["what", "value used", "confidence or source"];
    let rows: Vec<_> = rows.into_iter().map(|row| row.map(Html::from).into()).collect();
    Ok((!rows.is_empty()).then(|| Html::table("Detected or assumed, not stated", &headings, rows)))
}

/// The angle, if derived from a photograph's corners.
fn angle(scene: &Scene) -> Result<Option<[String; 3]>> {
    let number = |field: &str| -> Result<Option<f64>> {
        Ok(scene.fields.text_at(&format!("geometry.{field}"))?.and_then(|text| text.parse().ok()))
    };
    let (Some(angle), Some(sd)) = (number("angle_deg")?, number("angle_sd_deg")?) else { return Ok(None) };
    let sure = "standard deviation from the corners' positions".to_owned();
    Ok(Some(["angle between the panels, degrees".to_owned(), with_sd(angle, sd), sure]))
}

/// The form of the panels, if derived from corners.
fn panels(scene: &Scene) -> Result<Option<[String; 3]>> {
    let is_by_corners = calls(scene, "vkernel")?
        .is_some_and(|arguments| has(&arguments, "--regions") && !has(&arguments, "--panel"));
    let panel =
        scene.fields.leaves("geometry").into_iter().find(|(name, _)| is_by_corners && name == "panel");
    let row = |(_, sides): (String, String)| {
        let sides: Vec<_> = sides.split(", ").map(rounded).collect();
        let what = "sides of a panel, along the crease x away from it".to_owned();
        [what, sides.join(" x "), "most probable given the corners".to_owned()]
    };
    Ok(panel.map(row))
}

/// The camera whose spectral sensitivities are used, if the photograph named the camera.
fn camera(sample: &Sample, scene: &Scene) -> Result<Option<[String; 3]>> {
    let is_by_photograph = calls(scene, "vextract")?.is_some_and(|arguments| !has(&arguments, "--camera"));
    let Some(name) = scene.fields.text_at("camera.name")?.filter(|_| is_by_photograph) else {
        return Ok(None);
    };
    let stand_in = scene.camera()?.stands_in;
    let sure = match stand_in {
        Some(one) => format!(
            "stands in for {}: {}; root mean square error of the sensitivities: {} of their peak",
            one.camera,
            one.why,
            digits(one.sensitivity_error, 0.0)
        ),
        None => {
            let model = sample.fields.text_at("image.model")?.unwrap_or_default();
            format!("measured sensitivities of the camera that the photograph names, {model}")
        }
    };
    Ok(Some(["camera".to_owned(), name, sure]))
}

/// The light, if not stated.
fn light(sample: &Sample, scene: &Scene) -> Result<Option<[String; 3]>> {
    let is_open = calls(scene, "vextract")?.is_some_and(|arguments| !has(&arguments, "--illuminant"));
    if !is_open || scene.is_light_unknown()? {
        return Ok(None);
    }
    let Some(name) = scene.illuminants()?.into_iter().next().map(|light| light.name) else { return Ok(None) };
    if !scene.is_daylight_assumed()? {
        return Ok(Some([
            "light".to_owned(),
            name,
            "computed from place and time in the photograph".to_owned(),
        ]));
    }
    let number = |field: &str| -> Result<Option<f64>> {
        Ok(sample
            .fields
            .text_at(&format!("estimate.fit.sun_cct_k.{field}"))?
            .and_then(|text| text.parse().ok()))
    };
    let is_shown = sample.fields.text_at("estimate.fit.sun_cct_k.supported")?.is_some_and(|is| is == "true");
    let sure =
        if is_shown { "assumed; its colour was fitted" } else { "assumed: the picture hardly shows it" };
    let value = match (number("value")?, number("sd")?) {
        (Some(value), Some(sd)) => format!("daylight of {} K", with_sd(value, sd)),
        _ => name,
    };
    Ok(Some(["light".to_owned(), value, sure.to_owned()]))
}

/// The kind of day.
fn day(sample: &Sample) -> Result<Option<[String; 3]>> {
    let text = |field: &str| sample.fields.text_at(&format!("estimate.day.{field}"));
    let (Some(kind), Some(probability)) = (text("kind")?, text("probability")?) else { return Ok(None) };
    let probability = probability.parse().unwrap_or(0.0);
    Ok(Some(["kind of day".to_owned(), kind, format!("probability {}", digits(probability, 0.0))]))
}

/// Arguments with which a tool made the scene; none if they were not recorded.
fn calls(scene: &Scene, tool: &str) -> Result<Option<Vec<String>>> {
    let last = |lines: Vec<HistoryRecord>| lines.into_iter().rfind(|line| line.tool == tool);
    Ok(last(scene.fields.history()?).map(|line| line.arguments))
}

/// Whether a flag is among arguments.
fn has(arguments: &[String], flag: &str) -> bool {
    arguments
        .iter()
        .any(|argument| argument == flag || argument.split_once('=').is_some_and(|(name, _)| name == flag))
}
