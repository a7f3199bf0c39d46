//! The page around the sections: what it looks like on screen and on paper.

use super::Gallery;
use super::html::Html;

/// System fonts, dark on white, one column; on paper a sample begins on a page of its own. Drawings stay legible on narrow screens, where they
/// scroll.
const STYLE: &str = "
:root { color-scheme: light; }
body { margin: 0; background: #fff; color: #1a1a1a; font: 16px/1.45 system-ui, sans-serif; }
main { max-width: 62rem; margin: 0 auto; padding: 1rem; }
h1, h2, h3 { line-height: 1.2; overflow-wrap: anywhere; }
h2 { margin-top: 2.5rem; padding-top: 1rem; border-top: 2px solid #1a1a1a; }
a { color: #00507d; overflow-wrap: anywhere; }
figure { margin: 1.2rem 0; break-inside: avoid; overflow-x: auto; }
figure svg, figure img { display: block; max-width: 100%; height: auto; }
figure svg { min-width: 34rem; }
figcaption { color: #444; font-size: .9rem; max-width: 48rem; }
.table { overflow-x: auto; margin: 1.2rem 0; }
table { border-collapse: collapse; font-size: .9rem; font-variant-numeric: tabular-nums; }
caption { text-align: left; font-weight: 600; padding: .3rem 0; }
th, td { text-align: left; vertical-align: top; padding: .2rem 1rem .2rem 0; border-bottom: 1px solid #ccc; }
th[scope=row] { font-weight: 400; }
th, td { overflow-wrap: break-word; max-width: 36rem; }
details { margin: 1rem 0; }
summary { cursor: pointer; font-weight: 600; }
nav ul { columns: 14rem; padding-left: 1.2rem; }
.verdict { border-left: 6px solid #009e73; padding: .2rem 0 .2rem .8rem; font-size: 1.1rem; }
.verdict.doubtful { border-color: #e69f00; }
.verdict.wrong { border-color: #d55e00; }
.doubt { border-left: 4px solid #d55e00; padding-left: .8rem; }
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
  figure svg { min-width: 0; }
  nav { display: none; }
}
";

/// The whole page.
pub(super) fn page(gallery: &Gallery, sections: Vec<Html>) -> String {
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
    main.extend(contents(gallery));
    main.extend(sections);
    let body = Html::element("body", &[], Html::element("main", &[], main));
    let html =
        Html::element("html", &[("lang", "en")], vec![Html::element("head", &[], head), body]).into_string();
    format!("<!DOCTYPE html>\n{html}\n")
}

/// Links to the samples, if there are several.
fn contents(gallery: &Gallery) -> Option<Html> {
    let link = |(number, shown): (usize, &super::Shown)| {
        let target = format!("#sample-{number}");
        Html::element("li", &[], Html::element("a", &[("href", &target)], shown.sample.id()))
    };
    let links: Vec<_> = gallery.in_order().enumerate().map(link).collect();
    (links.len() > 1)
        .then(|| Html::element("nav", &[("aria-label", "samples")], Html::element("ul", &[], links)))
}
