//! The section of one sample: drawings, scores, and what the tools decided.

use super::html::Html;
use super::{Shown, View, overlay};
use crate::colorimetry::Observer;
use crate::error::Result;
use crate::stream::{EstimateRecord, Sample};

/// Fields that have a table or a drawing of their own, or are what all records have.
const TOLD: [&str; 6] = ["kind", "scene", "id", "metrics", "estimate", "truth"];

/// All that is known of a sample.
pub(super) fn section(number: usize, shown: &Shown, view: &View) -> Result<Html> {
    let sample = &shown.sample;
    let mut parts = vec![Html::element("h2", &[], sample.id())];
    let estimate = sample.estimate()?;
    let doubts = estimate.as_ref().map(EstimateRecord::doubts).unwrap_or_default();
    parts.extend(doubts.into_iter().map(|doubt| Html::element("p", &[("class", "doubt")], doubt)));
    parts.extend(estimate.and_then(|estimate| findings(&estimate)));
    parts.extend(drawings(shown, view)?);
    parts.extend(overlay::figure(shown, view)?);
    parts.extend(tables(sample));
    parts.extend(numbers(sample)?);
    let id = format!("sample-{number}");
    Ok(Html::element("section", &[("class", "sample"), ("id", &id)], parts))
}

/// What of the photograph is not ideal.
fn findings(estimate: &EstimateRecord) -> Option<Html> {
    let rows = estimate.findings.iter().map(|one| vec![one.what.as_str().into(), one.remedy.as_str().into()]);
    let headings = ["not ideal about the photograph, and allowed for", "what to do"];
    (!estimate.findings.is_empty()).then(|| Html::table("What the facets show", &headings, rows))
}

fn drawings(shown: &Shown, view: &View) -> Result<Vec<Html>> {
    let Some(sheet) = shown.sheet(view)? else { return Ok(Vec::new()) };
    let name = &sheet.curve.name;
    let observer = match view.observer {
        Observer::Cie1931_2deg => "2°",
        Observer::Cie1964_10deg => "10°",
    };
    let caption = format!(
        "Estimated reflectance with a band of two standard deviations to either side. Colours: under {} for the {observer} observer.",
        view.illuminant.name()
    );
    let words = format!("spectral reflectance of {name}, and what it looks like");
    let mut figures = vec![Html::figure(Html::drawing(&sheet.spectrum_svg()?, &words), &caption)];
    if let Some(svg) = sheet.residuals_svg()? {
        let words = format!("residuals of the facets of {name}");
        let caption = "What the estimate leaves of the facets: patternless where the model is right.";
        figures.push(Html::figure(Html::drawing(&svg, &words), caption));
    }
    Ok(figures)
}

fn tables(sample: &Sample) -> Vec<Html> {
    let leaves = |path| sample.fields.leaves(path);
    let (fit, estimate): (Vec<_>, Vec<_>) =
        leaves("estimate").into_iter().partition(|(name, _)| name.starts_with("fit."));
    let rest = leaves("")
        .into_iter()
        .filter(|(name, _)| !TOLD.contains(&name.split('.').next().unwrap_or_default()));
    let estimate = estimate.into_iter().filter(|(name, _)| !name.starts_with("findings")).collect();
    let tables = [
        ("Scores", leaves("metrics")),
        ("Fitted along with the spectrum", fit),
        ("Estimate", estimate),
        ("Measurement", rest.collect()),
    ];
    tables
        .into_iter()
        .filter(|(_, rows)| !rows.is_empty())
        .map(|(caption, rows)| pairs(caption, rows))
        .collect()
}

/// Names and values.
pub(super) fn pairs(caption: &str, rows: Vec<(String, String)>) -> Html {
    Html::table(
        caption,
        &["what", "value"],
        rows.into_iter().map(|(name, value)| vec![name.into(), value.into()]),
    )
}

/// The spectrum in numbers.
fn numbers(sample: &Sample) -> Result<Option<Html>> {
    let Some(estimate) = sample.estimate()? else { return Ok(None) };
    let truth = sample.truth()?.map(|truth| truth.reflectance);
    let columns = [Some(&estimate.reflectance), estimate.reflectance_sd.as_ref(), truth.as_ref()];
    let row = |(n, wavelength_nm): (usize, &f64)| {
        let cell = |column: Option<&Vec<f64>>| {
            column.and_then(|column| column.get(n)).map_or(String::new(), f64::to_string).into()
        };
        std::iter::once(wavelength_nm.to_string().into()).chain(columns.map(cell)).collect()
    };
    let headings = ["wavelength, nm", "reflectance", "standard deviation", "true reflectance"];
    let table = Html::table("Spectrum", &headings, estimate.wavelengths_nm.iter().enumerate().map(row));
    let summary = Html::element("summary", &[], "Spectrum in numbers");
    Ok(Some(Html::element("details", &[], vec![summary, table])))
}
