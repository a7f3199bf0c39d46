//! The section on all samples: their number, scores, the worst ones, failures.

use super::html::Html;
use super::words::digits;
use super::{Gallery, SECTIONS_MAX};
use crate::error::{Result, counted};
use crate::score::{Statistics, Summary};

/// The section on all samples; none for a single sample with its own section.
pub(super) fn section(gallery: &Gallery, summary: &Summary) -> Result<Option<Html>> {
    if summary.samples() == 1 && gallery.seen() == 1 {
        return Ok(None);
    }
    let mut parts = vec![Html::element("h2", &[], "All samples"), counts(gallery, summary)];
    if summary.scored() > 0 {
        let row = |one: &Statistics| {
            let numbers = [one.mean, one.median, one.worst].map(|value| Html::from(digits(value, 0.0)));
            std::iter::once(Html::from(one.name.as_str())).chain(numbers).collect()
        };
        let headings = ["score", "mean", "median", "worst"];
        parts.push(Html::table("Scores", &headings, summary.statistics().iter().map(row)));
    }
    if summary.scored() > 1 {
        let batch = gallery.batch(summary)?;
        let words = "histograms of the scores, and the samples that score worst";
        let caption = "Distribution of the scores, and the worst samples by the first score.";
        parts.push(Html::figure(Html::drawing(&batch.svg()?, words), caption));
        let row = |(name, value): &(String, f64)| vec![name.as_str().into(), digits(*value, 0.0).into()];
        let score = batch.scores.first().map_or("", |(name, ..)| name.as_str());
        parts.push(Html::table("Worst samples", &["sample", score], batch.worst.iter().map(row)));
    }
    let (failures, _) = gallery.failures();
    if !failures.is_empty() {
        let row = |(name, error): &(String, String)| vec![name.as_str().into(), error.as_str().into()];
        parts.push(Html::table("Samples without a result", &["sample", "why"], failures.iter().map(row)));
    }
    Ok(Some(Html::element("section", &[("id", "all")], parts)))
}

fn counts(gallery: &Gallery, summary: &Summary) -> Html {
    let (_, failed) = gallery.failures();
    let (all, scored) = (counted(summary.samples(), "sample"), summary.scored());
    let mut text = format!("{all}, {scored} scored, {failed} without a result.");
    if gallery.seen() > SECTIONS_MAX {
        text.push_str(&format!(" The worst {SECTIONS_MAX} are shown below."));
    }
    Html::element("p", &[], text)
}
