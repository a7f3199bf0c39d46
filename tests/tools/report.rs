//! `vscore --report`: one file that needs no other, says what the records say, and is harmless whatever
//! samples are called.

use roxmltree::Document;
use serde_json::Value;

use crate::common::Workdir;

const ONE: &str =
    "vkernel --facets 4x4 | vforward --reflectance cc24:red --noise-sd 1e-3 | vestimate --fit exposure,tilt";
const BATCH: &str = "vkernel --facets 3x3 | vforward --reflectance cc24 --noise-sd 1e-3 | vestimate";
/// What the first score is called.
const RMSE: &str = "RMSE of the reflectance";
/// Attributes by which a page asks for something.
const ASKING: [&str; 7] = ["src", "href", "srcset", "poster", "data", "action", "background"];

/// The page, which is XML but for its first line.
fn body(page: &str) -> &str {
    page.strip_prefix("<!DOCTYPE html>\n").unwrap()
}

fn report(folder: &Workdir, script: &str) -> String {
    let run = folder.sh(&format!("{script} --report out.html >records.ndjson; cat out.html"));
    assert_eq!((run.status, run.stderr.as_str()), (0, ""));
    run.stdout
}

fn records(folder: &Workdir) -> Vec<Value> {
    folder.sh("cat records.ndjson").stdout.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

/// Whether a number is shown with four digits that count.
fn four_digits(shown: &str, told: f64) -> bool {
    (shown.parse::<f64>().unwrap() - told).abs() <= 5.1e-4 * told.abs()
}

/// The table of this caption, row by row.
fn table(page: &Document, caption: &str) -> Vec<Vec<String>> {
    let text = |node: roxmltree::Node| {
        node.descendants().filter(roxmltree::Node::is_text).filter_map(|part| part.text()).collect::<String>()
    };
    let is_it = |node: &roxmltree::Node| node.has_tag_name("caption") && text(*node) == caption;
    let found = page.descendants().find(is_it).unwrap().parent().unwrap();
    let rows = found.descendants().filter(|node| node.has_tag_name("tr"));
    rows.map(|row| row.children().map(text).collect()).collect()
}

#[test]
fn a_page_asks_for_nothing_and_is_described() {
    let page = report(&Workdir::new(), &format!("{ONE} | vscore"));
    let page = Document::parse(body(&page)).unwrap();
    let elements = || page.descendants().filter(roxmltree::Node::is_element);
    assert!(
        !elements().any(|node| matches!(node.tag_name().name(), "script" | "link" | "iframe" | "object"))
    );
    for node in elements() {
        for asking in node.attributes().filter(|attribute| ASKING.contains(&attribute.name())) {
            assert!(
                asking.value().starts_with("data:image/") || asking.value().starts_with('#'),
                "{asking:?}"
            );
        }
        assert!(node.attributes().all(|attribute| !attribute.name().starts_with("on")));
        let needed = match node.tag_name().name() {
            "img" => "alt",
            "svg" => "aria-label",
            "th" => "scope",
            "html" => "lang",
            _ => continue,
        };
        assert!(node.attribute(needed).is_some_and(|text| !text.is_empty()), "{needed}: {node:?}");
    }
    let style = elements().find(|node| node.has_tag_name("style")).unwrap().text().unwrap();
    assert!(!style.contains("url(") && !style.contains("@import"));
    let ids: Vec<_> = elements().filter_map(|node| node.attribute("id")).collect();
    let links = elements().filter_map(|node| node.attribute("href")?.strip_prefix('#'));
    links.for_each(|link| assert!(ids.contains(&link), "{link}"));
}

#[test]
fn what_was_found_is_said_with_how_sure_it_is() {
    let folder = Workdir::new();
    let photo = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/photos/a_ideal_magenta_50.exr");
    let page = report(
        &folder,
        &format!(
            "vkernel --angle-deg 50 | vextract '{photo}' -q --camera canon-5d-mark-ii --illuminant D65 \
                | vestimate -q | vscore"
        ),
    );
    let page = Document::parse(body(&page)).unwrap();
    let sure = 100.0 * records(&folder)[1]["image"]["detection_confidence"].as_f64().unwrap();
    let found = &table(&page, "Detected or assumed, not stated")[1..];
    assert_eq!(
        found[0],
        [
            "corners of the panels".to_owned(),
            "as drawn over the photograph".to_owned(),
            format!("{sure:.1} %")
        ]
    );
    // angle, camera and light were stated
    assert!(found[1..].iter().all(|row| row[0] == "kind of day"), "{found:?}");
}

#[test]
fn numbers_are_those_of_the_record() {
    let folder = Workdir::new();
    let page = report(&folder, &format!("{ONE} | vscore"));
    let page = Document::parse(body(&page)).unwrap();
    let records = records(&folder);
    let sample = &records[1];
    let same = |shown: &str, told: &Value| four_digits(shown, told.as_f64().unwrap());
    for row in &table(&page, "Scores")[1..] {
        let field = match row[0].as_str() {
            RMSE => "rmse",
            "colour difference, CIEDE2000" => "ciede2000",
            other => other,
        };
        assert!(same(&row[1], &sample["metrics"][field]), "{row:?}");
    }
    // a value is shown to four digits, its standard deviation to as many decimals
    let near = |shown: &str, told: &[&Value]| {
        let off = 5e-4 * told[0].as_f64().unwrap().abs().max(0.1);
        for (shown, told) in shown.split(" ±\u{a0}").zip(told) {
            let (shown, told) = (shown.parse::<f64>().unwrap(), told.as_f64().unwrap());
            assert!((shown - told).abs() <= off, "{shown} {told}");
        }
    };
    let spectrum = table(&page, "Spectrum");
    let estimate = &sample["estimate"];
    for (n, row) in spectrum[1..].iter().enumerate() {
        assert!(same(&row[0], &estimate["wavelengths_nm"][n]), "{row:?}");
        near(&row[1], &[&estimate["reflectance"][n], &estimate["reflectance_sd"][n]]);
        near(&row[2], &[&sample["truth"]["reflectance"][n]]);
    }
    assert_eq!(spectrum.len(), 62);
    let fitted = table(&page, "Fitted together with the spectrum");
    for (name, words) in [
        ("exposure", "xposure"),
        ("tilt_deg", "Angle of the sun off the bisecting plane of the fold, degrees"),
    ] {
        let row = fitted.iter().find(|row| row[0].contains(words)).unwrap();
        near(&row[1], &["value", "sd"].map(|part| &estimate["fit"][name][part]));
    }
    let command = page.descendants().find(|node| node.has_tag_name("code")).unwrap().text().unwrap();
    assert_eq!(
        command,
        "vkernel --facets 4x4 |\n  vforward --reflectance cc24:red --noise-sd 1e-3 |\n  \
         vestimate --fit exposure,tilt |\n  vscore --report out.html"
    );
    let colours = table(&page, "Colour under D65, 10° observer, with standard deviations (upper bounds)");
    assert_eq!(colours.iter().map(Vec::len).collect::<Vec<_>>(), [4; 4], "{colours:?}");
    let rms = sample["estimate"]["residual_rms"].as_f64().unwrap();
    // what is drawn is left of the mean over classes of spectra, the record's number is that of the likeliest
    let drawn = page.descendants().find_map(|node| {
        let (_, text) = node.text()?.split_once("rms ")?;
        text.split_once(" standard deviations")?.0.parse::<f64>().ok()
    });
    assert!((rms - 0.05..2.5 * rms).contains(&drawn.unwrap()), "{drawn:?} {rms}");
}

#[test]
fn of_many_samples_the_worst_are_shown() {
    let folder = Workdir::new();
    let page = report(&folder, &format!("{{ {BATCH}; {BATCH}; }} | vscore"));
    let page = Document::parse(body(&page)).unwrap();
    let records = records(&folder);
    let mut rmse: Vec<f64> = records.iter().filter_map(|record| record["metrics"]["rmse"].as_f64()).collect();
    assert_eq!(rmse.len(), 48);
    rmse.sort_by(|a, b| b.total_cmp(a));
    let worst = table(&page, "Worst samples");
    assert_eq!(worst.len(), 11);
    assert!(worst[1..].iter().zip(&rmse).all(|(row, rmse)| four_digits(&row[1], *rmse)), "{worst:?}");
    let sections = page.descendants().filter(|node| node.attribute("class") == Some("sample"));
    let mut of_sections: Vec<String> = sections
        .map(|section| {
            let cells = section.descendants().filter(|node| node.has_tag_name("tr"));
            let texts = cells.filter_map(|row| Some([row.first_child()?.text()?, row.last_child()?.text()?]));
            texts.into_iter().find(|[name, _]| *name == RMSE).unwrap()[1].to_owned()
        })
        .collect();
    of_sections.sort_by(|a, b| b.parse::<f64>().unwrap().total_cmp(&a.parse().unwrap()));
    assert_eq!(of_sections.len(), 24);
    assert!(of_sections.iter().zip(&rmse).all(|(shown, rmse)| four_digits(shown, *rmse)), "{of_sections:?}");
    let mean = records.last().unwrap()["rmse"]["mean"].as_f64().unwrap();
    assert!(four_digits(&table(&page, "Scores")[1][1], mean));
}

#[test]
fn hostile_names_are_text() {
    let folder = Workdir::new();
    let id = r#"</title></svg><script>alert(1)</script><img src=x onerror=alert(2)>&\"'\u0000\u001b\n]]>-->"#;
    let page = report(
        &folder,
        &format!(
            "{ONE} >one; cat >id <<'END'\n{id}\nEND\nID=\"$(cat id)\" python3 -c '
import json, os, sys
for line in open(\"one\"):
    record = json.loads(line)
    record[\"id\"] = record[\"scene\"] = json.loads(chr(34) + os.environ[\"ID\"] + chr(34))
    print(json.dumps(record))' | vscore --plot out.svg"
        ),
    );
    let page = Document::parse(body(&page)).unwrap();
    for name in ["script", "object"] {
        assert!(!page.descendants().any(|node| node.has_tag_name(name)));
    }
    let heading = page.descendants().filter(|node| node.has_tag_name("h2")).find_map(|node| node.text());
    assert!(heading.is_some());
    assert!(page.descendants().any(|node| {
        node.has_tag_name("h2") && node.text().is_some_and(|text| text.contains("<script>alert(1)</script>"))
    }));
    let drawn = folder.sh("cat out.svg").stdout;
    let drawn = Document::parse(&drawn).unwrap();
    assert!(!drawn.descendants().any(|node| node.has_tag_name("script") || node.has_tag_name("img")));
}

#[test]
fn a_report_is_whole_or_absent() {
    let folder = Workdir::new();
    let run = folder.sh(&format!(
        "{ONE} >one; vscore one --report there.html --overlay missing.png >/dev/null || echo $?; ls"
    ));
    assert!(run.stdout.starts_with("1\n") && !run.stdout.contains("html"), "{run:?}");
    assert!(run.stderr.contains("missing.png"), "{run:?}");
    let run = folder.sh(
        "vscore one --report nowhere/out.html >/dev/null || echo $?; vscore one --report out.pdf || echo $?",
    );
    assert_eq!(run.stdout, "1\n2\n");
    assert!(run.stderr.contains("end the name in .html"), "{run:?}");
}

/// A photograph of an unknown sheet: the page has all but scores, with the picture that vextract drew.
#[test]
fn a_photograph_needs_no_truth() {
    let folder = Workdir::new();
    let photo = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/photos/a_ideal_magenta_50.exr");
    let page = report(
        &folder,
        &format!(
            "vkernel --angle-deg 50 | vextract {photo} --overlay over-{{}}.png --camera canon-5d-mark-ii \
            --illuminant D65 --panel0 '332.1,462.5 345.3,77.1 121.9,11.9 103.9,442.2' \
            --panel1 '332.1,462.5 345.3,77.1 484.9,16.7 472.0,453.4' |
            vestimate --quiet | vscore --overlay over-{{}}.png"
        ),
    );
    let page = Document::parse(body(&page)).unwrap();
    let picture = page.descendants().find(|node| node.has_tag_name("img")).unwrap();
    assert!(picture.attribute("src").unwrap().starts_with("data:image/jpeg;base64,/9j/"));
    assert!(picture.attribute("alt").unwrap().contains("a_ideal_magenta_50"));
    assert_eq!(table(&page, "Measurement").iter().find(|row| row[0] == "width, px").unwrap()[1], "640");
    assert!(table(&page, "Spectrum")[1][2].is_empty());
    // what to think of it, its spectrum and its colour come first, then the photograph; the rest is folded
    // away
    let section = page.descendants().find(|node| node.attribute("class") == Some("sample")).unwrap();
    let parts: Vec<_> = section.children().filter(roxmltree::Node::is_element).collect();
    let names: Vec<&str> = parts.iter().map(|part| part.tag_name().name()).collect();
    assert_eq!(names[..5], ["h2", "p", "figure", "div", "figure"], "{names:?}");
    assert_eq!(parts[1].attribute("class"), Some("verdict good"));
    assert_eq!(parts[3].attribute("class"), Some("colour"));
    assert!(parts[4].descendants().any(|node| node.has_tag_name("img")));
    assert_eq!(names.last(), Some(&"details"));
}

/// What the pictures of a page show, by its samples; each picture is one colour.
fn pictures(folder: &Workdir, flags: &str) -> String {
    let run = folder.sh(&format!(
        "vscore three.ndjson --report out.html {flags} > /dev/null
        python3 - <<'END'
import base64, io, re
from PIL import Image
for section in open('out.html').read().split('<section class=\"sample\"')[1:]:
    picture = re.search('data:image/jpeg;base64,([^\"]*)', section)
    red, _, blue = Image.open(io.BytesIO(base64.b64decode(picture[1]))).getpixel((5, 5)) \
        if picture else (0, 0, 0)
    print(re.search('<h2>([^<]*)', section)[1], 'red' if red > 200 else 'blue' if blue > 200 else '-')
END"
    ));
    assert_eq!((run.status, run.stderr.as_str()), (0, ""), "{flags}");
    run.stdout
}

/// Three samples, and pictures of one colour each.
const THREE: &str = "
vkernel --facets 2x2 | vforward --reflectance cc24:red cc24:blue cc24:white |
    vestimate | sed 's/\"id\":\"cc24:/\"id\":\"/' > three.ndjson
head -n 2 three.ndjson > one.ndjson
python3 -c 'from PIL import Image
for name, colour in [(\"red\", (255, 0, 0)), (\"over-red\", (255, 0, 0)), (\"blue\", (0, 0, 255)), \
    (\"over-blue\", (0, 0, 255)), (\"over-white\", (0, 0, 0))]:
    Image.new(\"RGB\", (40, 30), colour).save(name + \".png\")'
mkdir folder; cp blue.png folder; cp red.png 'folder/{}.png'";

#[test]
fn pictures_are_those_of_the_command_line() {
    let folder = Workdir::new();
    if !folder.can("python3 -c 'import PIL'", "pictures in reports") {
        return;
    }
    folder.sh(THREE);
    assert_eq!(pictures(&folder, ""), "red -\nblue -\nwhite -\n");
    assert_eq!(pictures(&folder, "--overlay over-{}.png"), "red red\nblue blue\nwhite -\n");
    assert_eq!(
        pictures(&folder, "--overlay folder/blue.png --overlay red.png"),
        "red red\nblue blue\nwhite -\n"
    );
    assert_eq!(pictures(&folder, "--overlay over-{}.png --overlay red.png"), "red red\nblue blue\nwhite -\n");
    let refused = |flags: &str, status: i32, says: &str| {
        let run = folder.sh(&format!("vscore {flags} > /dev/null"));
        assert!(
            run.status == status && run.stderr.lines().count() == 1 && run.stderr.contains(says),
            "{flags}: {run:?}"
        );
    };
    refused(
        "three.ndjson --report out.html --overlay over-red.png",
        2,
        "no sample has the name of over-red.png",
    );
    // one of one may be called anything
    let drawn = folder.sh("vscore one.ndjson --report one.html --overlay over-blue.png > /dev/null; \
        grep -c 'src=' one.html");
    assert_eq!(drawn.stdout, "1\n");
    folder.sh("rm over-white.png");
    refused("three.ndjson --report out.html --overlay over-{}.png", 1, "over-white.png");
}

/// Nothing that a stream says makes a report read a file, be it named in a history or by a sample's name; a
/// pipe is not waited for.
#[test]
fn a_stream_names_no_pictures() {
    let folder = Workdir::new();
    folder.sh("vkernel --facets 2x2 | vforward --reflectance cc24:red | vestimate > one
        mkdir folder; mkfifo folder/waits.png waits
        said='{\"tool\":\"vextract\",\"version\":\"0.1.0\",\"arguments\":[\"--overlay\",\
            \"waits\",\"--overlay=waits\"]}'
        sed \"1s/\\\"history\\\":\\[/&$said,/\" one > foreign.ndjson
        sed 's/\"id\":\"cc24:red\"/\"id\":\"..\\/folder\\/waits\"/' one > away.ndjson");
    let run = folder.sh("timeout 20 vscore foreign.ndjson --report out.html | grep -c waits; \
        grep -c waits out.html; grep -c '<img' out.html || :");
    assert_eq!((run.stdout.as_str(), run.stderr.as_str()), ("1\n1\n0\n", ""));
    let refused = |line: &str, says: &str| {
        let run = folder.sh(&format!("timeout 20 {line} > /dev/null"));
        assert!(
            run.status == 1 && run.stderr.lines().count() == 1 && run.stderr.contains(says),
            "{line}: {run:?}"
        );
    };
    refused("vscore away.ndjson --report out.html --overlay folder/{}.png", "leads to another folder");
    refused("vscore away.ndjson --report out.html --overlay waits", "not a regular file");
}
