//! The page around the sections: its style on screen and on paper.

use super::Gallery;
use super::html::Html;
use crate::error::Result;
use crate::estimate::verdict::Level;

/// System fonts, one column, light or dark as the reader's system; on paper always light, with each sample on
/// a new page. Drawings, black on white, take on the colours of the page. On narrow screens their text grows,
/// or they scroll.
const STYLE: &str = include_str!("page.css");

/// The complete page.
///
/// # Errors
/// [`crate::Error::Field`] if a record is invalid.
pub(super) fn page(gallery: &Gallery, sections: Vec<Html>) -> Result<String> {
    let head = vec![
        Html::empty("meta", &[("charset", "utf-8")]),
        Html::empty("meta", &[("name", "viewport"), ("content", "width=device-width, initial-scale=1")]),
        Html::element("title", &[], "Spectral reflectance of folded sheets"),
        Html::style(STYLE),
    ];
    let version = env!("CARGO_PKG_VERSION");
    let mut main = vec![
        Html::element("h1", &[], "Spectral reflectance of folded sheets"),
        Html::element("p", &[], format!("Estimated from photographs or computed facets by vfold {version}.")),
    ];
    main.extend(contents(gallery)?);
    main.extend(sections);
    let body = Html::element("body", &[], Html::element("main", &[], main));
    let html =
        Html::element("html", &[("lang", "en")], vec![Html::element("head", &[], head), body]).into_string();
    Ok(format!("<!DOCTYPE html>\n{html}\n"))
}

/// Links to the samples with their verdicts, if there are several.
fn contents(gallery: &Gallery) -> Result<Option<Html>> {
    let link = |(number, shown): (usize, &super::Shown)| {
        let target = format!("#sample-{number}");
        let link = Html::element("a", &[("href", &target)], shown.sample.id());
        let verdict = shown.sample.estimate()?.and_then(|estimate| estimate.verdict);
        let level = verdict.map(|verdict| format!(": {}", Level::from(verdict.level).name()));
        Ok(Html::element("li", &[], vec![link, level.unwrap_or_default().into()]))
    };
    let links: Vec<_> = gallery.in_order().enumerate().map(link).collect::<Result<_>>()?;
    Ok((links.len() > 1)
        .then(|| Html::element("nav", &[("aria-label", "samples")], Html::element("ul", &[], links))))
}
