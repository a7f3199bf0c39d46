//! The page around the sections: what it looks like on screen and on paper.

use super::Gallery;
use super::html::Html;
use crate::error::Result;
use crate::estimate::verdict::Level;

/// System fonts, one column, light or dark as the reader's system is; on paper always light, and a sample begins on a page of its own. Drawings,
/// which are black on white, are drawn in the colours of the page. On narrow screens their letters grow, or they scroll.
const STYLE: &str = "
:root { color-scheme: light dark; --paper: #fff; --ink: #1a1a1a; --faint: #555; --line: #ccc; --link: #00507d; --block: #f3f3f3; }
body { margin: 0; background: var(--paper); color: var(--ink); font: 16px/1.45 system-ui, sans-serif; }
main { max-width: 62rem; margin: 0 auto; padding: 1rem; }
h1, h2, h3 { line-height: 1.2; overflow-wrap: anywhere; }
h1 { font-size: 1.6rem; }
h2 { margin-top: 2.5rem; padding-top: 1rem; border-top: 2px solid var(--ink); }
a { color: var(--link); overflow-wrap: anywhere; }
figure { margin: 1.2rem 0; break-inside: avoid; overflow-x: auto; }
figure svg, figure img { display: block; max-width: 100%; height: auto; }
figure svg { min-width: 34rem; }
figure img { width: auto; max-height: 22rem; }
figcaption { color: var(--faint); font-size: .9rem; max-width: 48rem; margin-top: .3rem; }
.table { overflow-x: auto; margin: 1.2rem 0; }
table { border-collapse: collapse; font-size: .9rem; font-variant-numeric: tabular-nums; }
caption { text-align: left; font-weight: 600; padding: .3rem 0; }
th, td { text-align: left; vertical-align: top; padding: .2rem 1rem .2rem 0; border-bottom: 1px solid var(--line); }
th[scope=row] { font-weight: 400; }
th, td { overflow-wrap: anywhere; min-width: 4.5rem; max-width: 36rem; }
pre { overflow-x: auto; padding: .8rem; background: var(--block); font-size: .85rem; }
details { margin: 1rem 0; }
summary { cursor: pointer; font-weight: 600; }
.colour { display: flex; flex-wrap: wrap; gap: 0 1.5rem; align-items: flex-start; }
.colour figure { margin: 1.5rem 0 0; overflow: visible; }
.colour .table { min-width: 0; }
.swatch { display: block; width: 7rem; height: 5rem; border: 1px solid var(--line); print-color-adjust: exact; }
.swatch.small { display: inline-block; width: 2.5rem; height: 1.2rem; vertical-align: middle; }
.verdict { border-left: 6px solid #009e73; padding: .2rem 0 .2rem .8rem; font-size: 1.1rem; }
.verdict.doubtful { border-color: #e69f00; }
.verdict.wrong { border-color: #d55e00; }
.doubt { border-left: 4px solid #d55e00; padding-left: .8rem; }
@media screen and (prefers-color-scheme: dark) {
  :root { --paper: #16181a; --ink: #e8e8e8; --faint: #aaa; --line: #444; --link: #7cc4f0; --block: #23262a; }
  figure svg > rect:first-of-type { fill: var(--paper); }
  figure svg text[fill='#000000'] { fill: var(--ink); }
  figure svg text:not([fill='#000000']) { fill: var(--faint); }
  figure svg :not(rect)[stroke='#000000'] { stroke: var(--ink); }
  figure svg [stroke='#0072B2'] { stroke: #4fb0ec; }
  figure svg [fill='#0072B2'] { fill: #4fb0ec; }
}
@media (max-width: 30rem) {
  th, td { padding-right: .6rem; }
  .colour { display: block; }
  section.sample > figure svg { min-width: 0; }
  section.sample > figure svg text { font-size: 17px; }
  section.sample > figure svg text[transform] { font-size: 13px; }
}
@media print {
  body { font-size: 10.5pt; }
  main { max-width: none; padding: 0; }
  section.sample { break-before: page; }
  section.sample:first-of-type { break-before: auto; }
  section.sample > figure { margin: .4rem 0; }
  section.sample > figure img, section.sample > figure svg { max-height: 8.5cm; width: auto; }
  section.sample h2 { margin-top: 0; border: 0; }
  tr { break-inside: avoid; }
  .table, figure { overflow: visible; }
  pre { white-space: pre-wrap; }
  figure svg { min-width: 0; }
  nav { display: none; }
}
";

/// The whole page.
///
/// # Errors
/// [`crate::Error::Field`] if a record is not what the tools write.
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
