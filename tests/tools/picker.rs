//! `share/picker.html` in a real browser: corners clicked in a preview come out in px of the photograph, and
//! the command that the page shows measures it.
//!
//! tests/run installs Chromium and playwright-core and says where they are; without them the test says that
//! it is left out.

use serde_json::{Value, json};

use crate::common::{Workdir, left_out};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");
/// The corners of `tests/data/photos/a_ideal_magenta_50.json`, and four more.
const CREASE: [[f64; 2]; 2] = [[332.146066, 462.514984], [345.327272, 77.0551203]];
const OUTER: [[[f64; 2]; 2]; 2] = [
    [[121.901018, 11.9388027], [103.862631, 442.247314]],
    [[484.922004, 16.7053859], [472.044496, 453.387535]],
];
const CHART: [[f64; 2]; 4] = [[530.0, 60.0], [620.0, 60.0], [620.0, 120.0], [530.0, 120.0]];
/// The photograph is enlarged by this much: its preview is half as large.
const ENLARGED: f64 = 5.0;

#[test]
fn clicks_in_a_preview_measure_the_photograph() {
    let Ok(modules) = std::env::var("PICKER_NODE_MODULES") else {
        left_out("share/picker.html in a browser, which tests/run installs");
        return;
    };
    let enlarged = |corners: &[[f64; 2]]| -> Vec<[f64; 2]> {
        corners.iter().map(|corner| corner.map(|x| ENLARGED * x)).collect()
    };
    let panel = |k: usize| enlarged(&[CREASE, OUTER[k]].concat());
    let truth = json!({
        "width": 3200,
        "height": 2400,
        "panel0": panel(0),
        "panel1": panel(1),
        "chart": enlarged(&CHART),
    });
    let folder = Workdir::new();
    let run = folder.sh(&format!(
        "echo '{truth}' > corners.json
        oiiotool {ROOT}/tests/data/photos/a_ideal_magenta_50.exr \
            --resize:filter=box 3200x2400 -d half -o photo.exr
        vextract photo.exr --preview photo.png
        oiiotool photo.png --eraseattrib '.*' -o plain.png
        PICKER_NODE_MODULES='{modules}' node {ROOT}/tests/tools/picker/clicks.mjs {ROOT}/share/picker.html \
            photo.png corners.json \"${{PICKER_SCREENSHOT:-shot.png}}\""
    ));
    assert_eq!((run.status, run.stderr.as_str()), (0, ""));
    let said: Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!(said["problems"], json!([]));
    assert_eq!(said["fields"], json!(["photo.exr", "3200", "2400"]));
    assert_eq!(said["prompts"][0], "Panel 0: click crease end 0 (corner 1 of 4).");
    assert_eq!(said["prompts"][1], "Panel 1: click outer end 1 (corner 3 of 4).");
    nudged_by_twelve_pixels(&said);
    let regions = |of: &Value| -> Value { serde_json::from_str(of.as_str().unwrap()).unwrap() };
    let marked = regions(&said["regions"]);
    assert_eq!(
        (&marked["image"], &marked["width"], &marked["height"]),
        (&json!("photo.exr"), &json!(3200), &json!(2400))
    );
    are_near(&marked, &truth, &["panel0", "panel1", "chart"], 4.0);
    assert_eq!(regions(&said["loaded"]), marked);
    let [a, b, c, d] = [0, 1, 2, 3].map(|k| &truth["panel0"][k]);
    let [_, _, e, f] = [0, 1, 2, 3].map(|k| &truth["panel1"][k]);
    let turned = json!({"panel0": [b, a, d, c], "panel1": [b, a, f, e]});
    // a pixel of a telephone is eight of the photograph
    are_near(&regions(&said["turned"]), &turned, &["panel0", "panel1"], 10.0);
    assert!(said["withChart"].as_str().unwrap().contains("--chart \""), "{said}");
    measures(&folder, said["command"].as_str().unwrap());
    is_read(&folder, marked);
    measures_two(&folder, &said["list"]);
    names_its_files(&folder, &said["odd"]);
}

/// The page of `--pick` begins with the fold that is found, and what it sends is what `--regions` reads.
#[test]
fn a_person_puts_right_what_was_found() {
    let Ok(modules) = std::env::var("PICKER_NODE_MODULES") else {
        left_out("the page of vextract --pick in a browser, which tests/run installs");
        return;
    };
    let folder = Workdir::new();
    let panel = |k: usize| [CREASE, OUTER[k]].concat();
    let truth = json!({"width": 640, "height": 480, "panel0": panel(0), "panel1": panel(1)});
    let run = folder.sh(&format!(
        "echo '{truth}' > corners.json
        white=topleft=0.75,0.75,0.75:topright=0.8,0.8,0.8:bottomleft=0.78,0.78,0.78:bottomright=0.8,0.8,0.8
        oiiotool {ROOT}/tests/data/photos/a_ideal_magenta_50.exr --fill:$white 80x80+530+370 -o photo.exr
        : > said
        vextract --pick photo.exr > picked.json 2>> said &
        until grep -q http said; do sleep 0.1; done
        PICKER_NODE_MODULES='{modules}' node {ROOT}/tests/tools/picker/served.mjs \
            \"$(grep -o 'http://[^ ]*' said)\" \"${{PICKED_SCREENSHOT:-shot.png}}\" corners.json
        wait $!"
    ));
    assert_eq!((run.status, run.stderr.as_str()), (0, ""));
    let said: Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!(said["problems"], json!([]));
    assert!(said["greeting"].as_str().unwrap().contains("% confidence"), "{said}");
    let panels = ["panel0", "panel1"];
    let [found, again] = [&said["found"], &said["again"]];
    are_near(found, &truth, &panels, 1.0);
    are_near(again, found, &panels, 0.02);
    let moved = |axis: usize| {
        let at = |of: &Value| of["panel0"][2][axis].as_f64().unwrap();
        at(&said["dragged"]) - at(found)
    };
    assert!(moved(0) > 5.0 && moved(1) > 5.0, "{said}");
    assert_eq!((&said["found"]["white"], &said["hidden"]), (&Value::Null, &json!(true)));
    let is_on_card = |corner: &Value| {
        let [x, y] = [0, 1].map(|axis| corner[axis].as_f64().unwrap());
        (530.0..610.0).contains(&x) && (370.0..450.0).contains(&y)
    };
    assert!(said["white"].as_array().unwrap().iter().all(is_on_card), "{said}");
    let picked: Value = serde_json::from_str(&folder.sh("cat picked.json").stdout).unwrap();
    assert_eq!(picked, *again);
    assert_eq!(picked["image"], "photo.exr");
    let run = folder.sh("vkernel --angle-deg 50 | vextract -q photo.exr --regions picked.json \
        --camera canon-5d-mark-ii --illuminant D65");
    assert_eq!((run.status, run.stderr.as_str()), (0, ""));
}

/// Corners within so many px.
fn are_near(found: &Value, truth: &Value, regions: &[&str], px: f64) {
    for region in regions {
        for k in 0..8 {
            let at = |of: &Value| of[region][k / 2][k % 2].as_f64().unwrap();
            assert!((at(found) - at(truth)).abs() < px, "{region}: {} not {}", found[region], truth[region]);
        }
    }
}

/// The lists of the page are those of the tools; a name that they do not know would be a command that fails.
#[test]
fn names_are_those_of_the_tools() {
    let page = std::fs::read_to_string(format!("{ROOT}/share/picker.html")).unwrap();
    for (what, list) in
        [("cameras", "<datalist id=\"cameras\">"), ("illuminants", "<datalist id=\"lights\">")]
    {
        let (_, rest) = page.split_once(list).unwrap();
        let (options, _) = rest.split_once("</datalist>").unwrap();
        let listed: Vec<&str> =
            options.split("<option>").skip(1).map(|option| option.split('<').next().unwrap()).collect();
        let known = Workdir::new().sh(&format!("vextract --list {what}")).stdout;
        let known: Vec<&str> = known.lines().filter_map(|line| line.split_whitespace().next()).collect();
        let known: Vec<&str> =
            known.into_iter().filter(|name| !name.contains(':') && *name != "2856K").collect();
        assert_eq!(listed, known, "share/picker.html, {what}");
    }
}

/// Arrow keys moved the chart's second corner by 10 + 1 + 1 px to the right and 0.1 down.
fn nudged_by_twelve_pixels(said: &Value) {
    let at = |label: &Value| -> Vec<f64> {
        let (_, place) = label.as_str().unwrap().rsplit_once(": ").unwrap();
        place.trim_end_matches(" px").split(", ").map(|x| x.parse().unwrap()).collect()
    };
    let (before, after) = (at(&said["before"]), at(&said["after"]));
    assert!(
        (after[0] - before[0] - 12.0).abs() < 0.02 && (after[1] - before[1] - 0.1).abs() < 0.02,
        "{said}"
    );
}

/// The page's command, as it is pasted.
fn measures(folder: &Workdir, command: &str) {
    let run = folder.sh(&format!("{command}\ncat result.ndjson"));
    assert_eq!(run.status, 0, "{command}: {}", run.stderr);
    is_the_panel(&run.stdout);
    let written = folder.sh("ls overlay.png spectrum.csv");
    assert_eq!(written.status, 0, "{written:?}");
}

/// The command and the regions of two pictures.
fn measures_two(folder: &Workdir, list: &Value) {
    let (regions, command) = (list["regions"].as_str().unwrap(), list["command"].as_str().unwrap());
    std::fs::write(folder.path().join("regions.json"), regions).unwrap();
    let run = folder.sh(&format!(
        "ln -s photo.exr second.exr\n{command}\nwc -l < result.ndjson; head -n 2 result.ndjson"
    ));
    assert_eq!(run.status, 0, "{command}: {}", run.stderr);
    let (count, records) = run.stdout.split_once('\n').unwrap();
    assert_eq!(count.trim(), "3");
    is_the_panel(records);
}

/// Commands as a shell takes them: each names the file that was opened, and runs nothing else.
fn names_its_files(folder: &Workdir, odd: &Value) {
    const TOOLS: &str =
        "vkernel() { :; }\nvextract() { cat \"$1\" > read; printf %s \"$1\"; }\nvestimate() { cat; }\n";
    assert_eq!(odd.as_array().unwrap().len(), 9);
    for named in odd.as_array().unwrap() {
        let (name, command) = (named[0].as_str().unwrap(), named[1].as_str().unwrap());
        let run = folder.sh(&format!("rm -f read\n{TOOLS}{command}\ncmp read plain.png; cat result.ndjson"));
        let found = run.stdout.strip_prefix("./").unwrap_or(&run.stdout);
        assert_eq!((found, run.stderr.as_str()), (name, ""), "{command}");
        assert!(!run.stdout.starts_with('-') && !folder.path().join("pwned").exists(), "{command}");
    }
}

/// The page's file of regions, but for the chart.
fn is_read(folder: &Workdir, mut regions: Value) {
    regions["chart"] = Value::Null;
    finds_the_panel(
        folder,
        &format!(
            "echo '{regions}' > regions.json
            vkernel --angle-deg 50 | vextract photo.exr --regions regions.json --refine=30 \
                --camera canon-5d-mark-ii --illuminant D65"
        ),
    );
}

fn finds_the_panel(folder: &Workdir, command: &str) {
    let run = folder.sh(command);
    assert_eq!((run.status, run.stderr.as_str()), (0, ""), "{command}");
    is_the_panel(&run.stdout);
}

fn is_the_panel(records: &str) {
    let sample: Value = serde_json::from_str(records.lines().last().unwrap()).unwrap();
    assert_eq!(sample["image"]["refined"]["sides_without_edge"], json!([]));
    let corners = [CREASE, OUTER[0]].concat();
    for k in 0..8 {
        let found = sample["image"]["panels"][0][k / 2][k % 2].as_f64().unwrap();
        assert!((found - ENLARGED * corners[k / 2][k % 2]).abs() < 1.5, "{}", sample["image"]["panels"]);
    }
}
