//! `vfold-measure`: from photographs to reports, with nothing typed but what a picture does not tell.

use crate::common::{Ended, Workdir};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");
const PHOTO: &str = "tests/data/photos/a_ideal_magenta_50.exr";
/// One in which the fold is not found surely enough.
const UNSURE: &str = "tests/data/photos/f_srgb_blue_flower_50.jpg";
const KNOWN: &str = "--camera canon-5d-mark-ii --illuminant D65";

/// `measure`, and the same at a terminal, where what comes by a pipe is typed.
const SETUP: &str = r#"
unset DISPLAY WAYLAND_DISPLAY BROWSER
measure() { "$ROOT/share/vfold-measure" "$@"; }
typing() {
    python3 -c '
import os, pty, sys
status = pty.spawn(sys.argv[1:], lambda terminal: os.read(terminal, 65536))
sys.exit(os.waitstatus_to_exitcode(status))' "$ROOT/share/vfold-measure" "$@" | tr -d '\r'
}
"#;

/// A folder with so many photographs, and what running it there says.
fn run(names: &[&str], command: &str) -> (Workdir, Ended) {
    let folder = Workdir::new();
    for name in names {
        std::fs::copy(format!("{ROOT}/{PHOTO}"), folder.path().join(name)).unwrap();
    }
    let run = again(&folder, command);
    (folder, run)
}

fn again(folder: &Workdir, command: &str) -> Ended {
    folder.sh(&format!("ROOT='{ROOT}'\n{SETUP}\n{command}"))
}

/// Of a photograph of a magenta sheet: how far the spectrum is off, root mean square.
fn rmse(folder: &Workdir, result: &str) -> f64 {
    let said = folder.sh(&format!("vscore {result} --truth cc24:magenta | tail -n 1"));
    let score: serde_json::Value = serde_json::from_str(&said.stdout).unwrap();
    score["rmse"]["mean"].as_f64().unwrap()
}

#[test]
fn what_is_found_is_not_asked() {
    let (folder, run) = run(&["photo.exr"], &format!("measure photo.exr {KNOWN} < /dev/null"));
    assert_eq!(run.status, 0, "{run:?}");
    assert!(run.stdout.starts_with("./vfold-photo/report.html: good: "), "{run:?}");
    let files = folder.sh("ls -A vfold-photo; wc -l < vfold-photo/spectrum.csv").stdout;
    assert_eq!(files, "overlay.png\nregions.json\nreport.html\nresult.ndjson\nspectrum.csv\n62\n");
    assert!(rmse(&folder, "vfold-photo/result.ndjson") < 0.03);
    // the command of the report makes the records again
    let pasted = folder.sh("sed -n '/<pre>/,/<\\/pre>/p' vfold-photo/report.html \
            | sed 's/.*<code>//; s/<\\/code>.*//; s/&quot;/\"/g' > command
        cat command; cd vfold-photo; sha256sum regions.json spectrum.csv report.html > before; \
            rm spectrum.csv report.html
        cd ..; sh command > /dev/null; cd vfold-photo; sha256sum --check --quiet before; rm before");
    assert_eq!((pasted.status, pasted.stderr.as_str()), (0, ""), "{pasted:?}");
    assert!(pasted.stdout.starts_with("vkernel --regions ./vfold-photo/regions.json |"), "{pasted:?}");
}

#[test]
fn a_camera_that_no_photograph_names_is_asked_at_a_terminal() {
    let (_, asked) = run(&["photo.exr"], "{ echo canon-5d-mk2; echo canon-5d-mark-ii; } | typing photo.exr");
    assert!(
        asked.status == 0 && asked.stdout.contains("Camera that took photo.exr (a name from"),
        "{asked:?}"
    );
    assert!(asked.stdout.contains("did you mean canon-5d-mark-ii"), "{asked:?}");
    assert!(asked.stdout.contains("vfold-photo/report.html: "), "{asked:?}");
    // Enter asks again, and a question mark shows what may be answered
    let (_, again) = run(&["photo.exr"], "{ echo; echo '?'; echo canon-5d-mark-ii; } | typing photo.exr");
    assert!(again.status == 0 && again.stdout.contains("\nnikon-d5100 "), "{again:?}");
    assert_eq!(again.stdout.matches("Camera that took ").count(), 3, "{again:?}");
    // elsewhere nobody would answer
    for unasked in ["measure --yes photo.exr", "sleep 20 | timeout 19 $ROOT/share/vfold-measure photo.exr"] {
        let (folder, told) = run(&["photo.exr"], unasked);
        assert!(told.status == 2 && told.stderr.contains("the photograph names no camera"), "{told:?}");
        assert_eq!(
            (told.stderr.lines().count(), folder.sh("ls").stdout.as_str()),
            (1, "photo.exr\n"),
            "{told:?}"
        );
    }
}

/// White paper or a card beside the sheet shows the exposure, once somebody says that it is white.
#[test]
fn what_may_be_white_is_asked_at_a_terminal() {
    let with_paper = "oiiotool photo.exr --fill:topleft=0.75,0.75,0.75:topright=0.8,0.8,0.8\
        :bottomleft=0.78,0.78,0.78:bottomright=0.8,0.8,0.8 80x80+530+370 -o paper.exr";
    let (folder, setup) = run(&["photo.exr"], with_paper);
    assert_eq!(setup.status, 0, "{setup:?}");
    let question = "px of paper.exr, drawn in ./vfold-paper/overlay.png: printing paper (p)";
    for (typed, questions, used) in
        [("", 1, ""), ("p", 1, "white_paper"), ("0.9", 1, "white card"), ("1.7\n0.9", 2, "white card")]
    {
        let ended = again(&folder, &format!("printf '{typed}\\n' | typing {KNOWN} paper.exr"));
        assert_eq!(ended.status, 0, "{typed}: {ended:?}");
        assert_eq!(ended.stdout.matches(question).count(), questions, "{typed}: {ended:?}");
        let record = folder.sh("tail -n 1 vfold-paper/result.ndjson").stdout;
        for exposure in ["white_paper", "white card"] {
            assert_eq!(record.contains(exposure), exposure == used, "{typed}: {exposure}");
        }
    }
    // nobody is asked what the command line or the corners state
    let known = "vkernel | vforward --reflectance cc24:magenta --camera canon-5d-mark-ii --illuminant D65 \
        > known.ndjson; cp vfold-paper/regions.json marked.json";
    assert_eq!(again(&folder, known).status, 0);
    for (call, used) in [
        ("measure --yes", ""),
        ("printf 'p\\n' | typing --known-fold known.ndjson=cc24:magenta", ""),
        ("typing --white-reflectance 0.9 --regions marked.json", "white card"),
    ] {
        let ended = again(&folder, &format!("{call} {KNOWN} paper.exr"));
        assert!(!ended.stdout.contains(question), "{call}: {ended:?}");
        let record = folder.sh("tail -n 1 vfold-paper/result.ndjson").stdout;
        assert_eq!(record.contains("white card"), used == "white card", "{call}");
    }
}

/// Of all photographs that name none, once.
#[test]
fn an_answer_holds_for_the_photographs_that_follow() {
    let (_, asked) = run(&["a.exr", "b.exr"], "echo canon-5d-mark-ii | typing a.exr b.exr");
    assert_eq!(asked.stdout.matches("Camera that took ").count(), 1, "{asked:?}");
    assert!(asked.stdout.contains("vfold-report.html: 2 of 2 photographs measured"), "{asked:?}");
}

#[test]
fn nobody_waits_for_a_page_that_nobody_sees() {
    let (folder, _) = run(&[], &format!("cp $ROOT/{UNSURE} photo.jpg"));
    for call in
        ["measure --yes photo.jpg", "measure photo.jpg < /dev/null", "timeout 60 true | typing photo.jpg"]
    {
        let ended = again(&folder, call);
        let said = format!("{}{}", ended.stdout, ended.stderr);
        assert_eq!(said.lines().count(), 1, "{call}: {ended:?}");
        for part in [
            "with only 9",
            "was developed for the eye",
            "vextract --pick 'photo.jpg' >corners.json",
            "--regions corners.json",
        ] {
            assert!(said.contains(part), "{call}: {ended:?}");
        }
    }
    // what that line says is the way
    let marked = again(
        &folder,
        "vextract --find photo.jpg | sed 's/\"confidence\":[0-9.]*,//' > corners.json
        measure --regions corners.json photo.jpg 2> said",
    );
    assert_eq!(marked.status, 0, "{marked:?}");
}

#[test]
fn several_photographs_have_one_page() {
    let (folder, run) = run(
        &["a.exr", "a & b.exr"],
        &format!(
            "oiiotool a.exr -o a.tif; echo none > c.exr; measure --yes {KNOWN} a.exr a.tif 'a & b.exr' c.exr"
        ),
    );
    assert_eq!(run.status, 3, "{run:?}");
    assert!(run.stderr.contains("vfold-measure: 4 of 4, c.exr\n"), "{run:?}");
    assert!(run.stdout.ends_with("vfold-report.html: 3 of 4 photographs measured\n"), "{run:?}");
    assert_eq!(folder.sh("ls vfold-report.html vfold-*/report.html | wc -l").stdout.trim(), "4");
    let page = folder.sh("cat vfold-report.html").stdout;
    let page = page.strip_prefix("<!DOCTYPE html>\n").unwrap();
    let page = roxmltree::Document::parse(page).unwrap();
    let links: Vec<_> = page.descendants().filter(|node| node.has_tag_name("a")).collect();
    let names: Vec<_> = links.iter().map(|link| link.text().unwrap()).collect();
    assert_eq!(names, ["a.exr", "a.tif", "a & b.exr"]);
    for link in links {
        let bytes = link.attribute("href").unwrap().split('/').map(|part| {
            let bytes = part.split('%').skip(1).map(|byte| u8::from_str_radix(byte, 16).unwrap());
            String::from_utf8(bytes.collect()).unwrap()
        });
        let file = bytes.collect::<Vec<_>>().join("/");
        assert!(folder.path().join(&file).is_file(), "{file}");
    }
    let rows: Vec<_> = page.descendants().filter(|node| node.has_tag_name("tr")).collect();
    assert_eq!(rows.len(), 5);
    let text = |node: roxmltree::Node| node.descendants().filter_map(|part| part.text()).collect::<String>();
    assert!(text(rows[1]).contains("good: "), "{}", text(rows[1]));
    assert!(text(rows[4]).contains("not measured: vextract: c.exr"), "{}", text(rows[4]));
}

#[test]
fn a_wrong_call_is_refused_before_anything_is_measured() {
    for (call, why, status) in [
        ("", "usage: vfold-measure", 2),
        ("--lens x", "there is no such option", 2),
        ("photo.exr --camera", "a value is missing", 2),
        ("none.exr photo.exr no.tif", "missing or unreadable: none.exr, no.tif\n", 1),
        (
            "photo.exr --regions no.json --known-fold no.ndjson=cc24:red",
            "unreadable: no.json, no.ndjson\n",
            1,
        ),
        ("photo.exr --camera canon-5d-mk2", "did you mean canon-5d-mark-ii", 2),
        ("photo.exr --camera=canon-5d-mark-ii --illuminant D66", "no illuminant is called 'D66'", 2),
        ("photo.exr --angle-deg 500", "500 is not an angle", 2),
        ("photo.exr --known-fold photo.exr", "write FILE=SPEC", 2),
        ("photo.exr --known-fold photo.exr=cc24:rod", "cc24:rod", 2),
        ("photo.exr --white-reflectance 1.7", "reflectance 1.7 is outside 0..1", 2),
        ("photo.exr --transfer gamma", "write auto, linear or srgb", 2),
        ("photo.exr --undo no.json", "unreadable: no.json\n", 1),
        ("photo.exr .", ". is a folder; name the files in it\n", 1),
    ] {
        let (folder, run) = run(&["photo.exr"], &format!("measure {call}"));
        assert!(run.status == status && run.stderr.contains(why), "{call}: {run:?}");
        assert!(call.is_empty() || run.stderr.lines().count() == 1, "{call}: {run:?}");
        assert!(call.is_empty() || run.stderr.starts_with("vfold-measure: "), "{call}: {run:?}");
        assert_eq!(folder.sh("ls").stdout, "photo.exr\n", "{call}");
    }
    let (_, help) = run(&[], "measure --help");
    assert!(help.status == 0 && help.stdout.starts_with("usage: vfold-measure"), "{help:?}");
    assert!(help.stdout.lines().all(|line| line.len() <= 80), "{help:?}");
}

#[test]
fn a_failed_run_leaves_the_old_report_whole() {
    let sums = "cd vfold-photo; ls -A; sha256sum -- *";
    let (folder, measured) =
        run(&["photo.exr"], &format!("measure {KNOWN} photo.exr; echo mine > vfold-photo/notes.txt"));
    assert_eq!(measured.status, 0, "{measured:?}");
    let before = folder.sh(sums).stdout;
    // facets can be measured, and the estimate fails
    let failed = again(&folder, &format!("measure {KNOWN} --known-fold photo.exr=cc24:red photo.exr"));
    assert!(failed.status == 1 && failed.stderr.lines().count() == 1, "{failed:?}");
    assert_eq!(folder.sh(sums).stdout, before);
    // no picture at all
    let failed =
        again(&folder, &format!("mv photo.exr kept; echo none > photo.exr; measure {KNOWN} photo.exr"));
    assert_eq!((failed.status, failed.stderr.lines().count()), (1, 1), "{failed:?}");
    assert_eq!(folder.sh(sums).stdout, before);
    // a run that was killed had kept them
    let failed = again(
        &folder,
        &format!(
            "cd vfold-photo; mkdir .older; cp -p [!n]* .older/; echo half > report.html; cd ..; \
                measure {KNOWN} photo.exr"
        ),
    );
    assert_eq!(failed.status, 1, "{failed:?}");
    assert_eq!(folder.sh(sums).stdout, before);
    // a first run that fails leaves nothing
    let failed = again(&folder, &format!("cp photo.exr other.exr; measure {KNOWN} other.exr"));
    assert_eq!(
        (failed.status, folder.sh("ls -d vfold-*").stdout.as_str()),
        (1, "vfold-photo\n"),
        "{failed:?}"
    );
}

#[test]
fn a_known_fold_corners_and_curve_are_handed_on() {
    let (folder, run) = run(
        &["photo.exr"],
        &format!(
            "vextract --find photo.exr > found.json
            vkernel --regions found.json | vextract photo.exr --regions found.json {KNOWN} > known.ndjson
            echo '{{\"image\":\"other.exr\"}}' | cat - found.json > list.json
            measure {KNOWN} --transfer linear --regions list.json \
                --known-fold known.ndjson=cc24:magenta photo.exr
            cmp found.json vfold-photo/regions.json"
        ),
    );
    assert_eq!(run.status, 0, "{run:?}");
    let history = folder.sh("head -n 1 vfold-photo/result.ndjson").stdout;
    let scene: serde_json::Value = serde_json::from_str(&history).unwrap();
    let arguments = |tool: usize| scene["history"][tool]["arguments"].as_array().unwrap();
    assert!(arguments(1).ends_with(&["--transfer".into(), "linear".into()]), "{scene}");
    assert_eq!(arguments(2)[2..], ["--known-fold", "known.ndjson=cc24:magenta"]);
}
