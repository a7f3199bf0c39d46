//! The section on one sample: drawings, scores, and the tools' decisions.

use super::html::Html;
use super::tables::{folded, pairs};
use super::words::{digits, with_sd};
use super::{Gallery, Shown, View, colours, overlay, photograph};
use crate::error::Result;
use crate::estimate::unknowns::Unknown;
use crate::estimate::verdict::Level;
use crate::plot::sheet::Sheet;
use crate::stream::{CandidateRecord, EstimateRecord, FittedRecord, Sample};

/// Fields with their own table or drawing, or common to all records.
const SHOWN_ELSEWHERE: [&str; 6] = ["kind", "scene", "id", "metrics", "estimate", "truth"];
const SHOWN_OF_ESTIMATE: [&str; 6] = ["fit", "findings", "verdict", "reflectance", "reflectance_sd", "light"];

/// Everything on a sample: its verdict, spectrum and picture, then their basis; the rest is collapsed.
pub(super) fn section(number: usize, shown: &Shown, gallery: &Gallery, view: &View) -> Result<Html> {
    let sample = &shown.sample;
    let mut parts = vec![Html::element("h2", &[], sample.id())];
    let estimate = sample.estimate()?;
    parts.extend(estimate.iter().flat_map(judged));
    let sheet = estimate.as_ref().map(|estimate| shown.sheet(estimate, view)).transpose()?;
    parts.extend(sheet.as_ref().map(|sheet| spectrum(sheet, view)).transpose()?);
    if let Some(estimate) = &estimate {
        parts.extend(colours::section(estimate, &shown.scene, view)?);
    }
    parts.extend(overlay::figure(&sample.id(), gallery, view)?);
    parts.extend(estimate.as_ref().and_then(findings));
    parts.extend(photograph::unstated(sample, &shown.scene)?);
    parts.extend(photograph::file(sample)?);
    parts.extend(table("Scores", sample.fields.leaves("metrics")));
    parts.extend(estimate.as_ref().and_then(light));
    parts.extend(estimate.as_ref().and_then(fitted));
    parts.extend(estimate.as_ref().map(|estimate| numbers(estimate, sample)).transpose()?);
    if let Some(residuals) = sheet.as_ref().map(residuals).transpose()?.flatten() {
        parts.push(folded("Residuals of the facets", residuals));
    }
    let rest: Vec<Html> = rest(sample);
    if !rest.is_empty() {
        parts.push(folded("All numbers of the record", rest.into()));
    }
    let id = format!("sample-{number}");
    Ok(Html::element("section", &[("class", "sample"), ("id", &id)], parts))
}

/// The verdict, or the doubts on a record without one.
fn judged(estimate: &EstimateRecord) -> Vec<Html> {
    match &estimate.verdict {
        Some(verdict) => {
            let class = format!("verdict {}", Level::from(verdict.level).name());
            vec![Html::element("p", &[("class", &class)], with_level(&verdict.to_string()))]
        }
        None => {
            let doubt = |doubt| Html::element("p", &[("class", "doubt")], Html::from(doubt));
            estimate.doubts().into_iter().map(doubt).collect()
        }
    }
}

/// A verdict with its level, the first word, emphasised.
fn with_level(verdict: &str) -> Html {
    match verdict.split_once(':') {
        Some((level, why)) => vec![Html::element("strong", &[], level), format!(":{why}").into()].into(),
        None => verdict.into(),
    }
}

/// Deviations of the photograph from the ideal.
fn findings(estimate: &EstimateRecord) -> Option<Html> {
    let rows = estimate.findings.iter().map(|one| vec![one.what.as_str().into(), one.remedy.as_str().into()]);
    let headings = ["not ideal, and allowed for in the estimate", "what to do"];
    (!estimate.findings.is_empty()).then(|| Html::table("What the facets show", &headings, rows))
}

fn spectrum(sheet: &Sheet, view: &View) -> Result<Html> {
    let caption = format!(
        "Estimated reflectance with a band of two standard deviations on either side. \
         Colours under {} for the {} observer.",
        view.illuminant.name(),
        colours::observer(view.observer)
    );
    let words = format!("spectral reflectance of {}, and what it looks like", sheet.curve.name);
    Ok(Html::figure(Html::drawing(&sheet.spectrum_svg()?, &words), &caption))
}

fn residuals(sheet: &Sheet) -> Result<Option<Html>> {
    let Some(svg) = sheet.residuals_svg()? else { return Ok(None) };
    let words = format!("residuals of the facets of {}", sheet.curve.name);
    Ok(Some(Html::figure(
        Html::drawing(&svg, &words),
        "Measured minus estimated facets. The estimate is the mean of several spectra, each of which fits \
         more closely: a pattern matters, not the size.",
    )))
}

/// The candidates for the light, if not stated.
fn light(estimate: &EstimateRecord) -> Option<Html> {
    let light = estimate.light.as_ref()?;
    let row = |one: &CandidateRecord| vec![one.name.as_str().into(), digits(one.probability, 0.0).into()];
    let rows = light.candidates.iter().map(row);
    Some(Html::table("The light, estimated from the facets", &["light", "probability"], rows))
}

/// The fitted unknowns, each with its standard deviation, in its unit.
fn fitted(estimate: &EstimateRecord) -> Option<Html> {
    let row = |one: (&Unknown, &FittedRecord)| {
        let (unknown, FittedRecord { value, sd, supported }) = one;
        let unit = unknown.unit.map(|unit| format!(", {unit}")).unwrap_or_default();
        let by = if *supported { "the picture" } else { "its prior, as the picture does not show it" };
        vec![format!("{}{unit}", unknown.description).into(), with_sd(*value, *sd).into(), by.into()]
    };
    let rows: Vec<_> = estimate.fits().map(row).collect();
    let headings = ["what", "value ± standard deviation", "determined by"];
    (!rows.is_empty()).then(|| Html::table("Fitted together with the spectrum", &headings, rows))
}

/// Fields without their own drawing or table.
fn rest(sample: &Sample) -> Vec<Html> {
    let leaves = |path| sample.fields.leaves(path);
    let is_shown = |name: &str, shown: &[&str]| shown.contains(&name.split('.').next().unwrap_or_default());
    let estimate = leaves("estimate").into_iter().filter(|(name, _)| !is_shown(name, &SHOWN_OF_ESTIMATE));
    let rest = leaves("").into_iter().filter(|(name, _)| !is_shown(name, &SHOWN_ELSEWHERE));
    let tables = [table("Estimate", estimate.collect()), table("Measurement", rest.collect())];
    tables.into_iter().flatten().collect()
}

fn table(caption: &str, rows: Vec<(String, String)>) -> Option<Html> {
    (!rows.is_empty()).then(|| pairs(caption, rows))
}

/// The spectrum as numbers.
fn numbers(estimate: &EstimateRecord, sample: &Sample) -> Result<Html> {
    let truth = sample.truth()?.map(|truth| truth.reflectance);
    let row = |(n, wavelength_nm): (usize, &f64)| {
        let (value, sd) = (estimate.reflectance[n], estimate.reflectance_sd.as_ref().map(|sd| sd[n]));
        let truth = truth.as_ref().and_then(|truth| truth.get(n)).map(|truth| digits(*truth, 0.0));
        let value = sd.map_or_else(|| digits(value, 0.0), |sd| with_sd(value, sd));
        vec![wavelength_nm.to_string().into(), value.into(), truth.unwrap_or_default().into()]
    };
    let headings = ["wavelength, nm", "reflectance ± standard deviation", "true reflectance"];
    let table = Html::table("Spectrum", &headings, estimate.wavelengths_nm.iter().enumerate().map(row));
    Ok(folded("Spectrum in numbers", table))
}
