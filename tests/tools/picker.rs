//! `share/picker.html` in a real browser: corners clicked in a preview come out in px of the photograph, and the command that the
//! page shows measures it.
//!
//! tests/run installs Chromium and playwright-core and says where they are; without them the test says that it is left out.

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
    let truth = json!({"width": 3200, "height": 2400, "panel0": panel(0), "panel1": panel(1), "chart": enlarged(&CHART)});
    let folder = Workdir::new();
    let run = folder.sh(&format!(
        "echo '{truth}' > corners.json
        oiiotool {ROOT}/tests/data/photos/a_ideal_magenta_50.exr --resize:filter=box 3200x2400 -d half -o photo.exr
        vextract photo.exr --preview photo.png
        PICKER_NODE_MODULES='{modules}' node {ROOT}/tests/tools/picker/clicks.mjs {ROOT}/share/picker.html photo.png corners.json \
            \"${{PICKER_SCREENSHOT:-shot.png}}\""
    ));
    assert_eq!((run.status, run.stderr.as_str()), (0, ""));
    let said: Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!(said["problems"], json!([]));
    assert_eq!(said["prompts"][0], "Panel 0: click crease end 0 (corner 1 of 4).");
    assert_eq!(said["prompts"][1], "Panel 1: click outer end 1 (corner 3 of 4).");
    nudged_by_twelve_pixels(&said);
    let regions: Value = serde_json::from_str(said["regions"].as_str().unwrap()).unwrap();
    assert_eq!(
        (&regions["image"], &regions["width"], &regions["height"]),
        (&json!("photo.png"), &json!(3200), &json!(2400))
    );
    for region in ["panel0", "panel1", "chart"] {
        for k in 0..8 {
            let at = |of: &Value| of[region][k / 2][k % 2].as_f64().unwrap();
            // the mouse is placed to a pixel of the screen, which is three of the photograph
            assert!(
                (at(&regions) - at(&truth)).abs() < 4.0,
                "{region}: {} not {}",
                regions[region],
                truth[region]
            );
        }
    }
    measures(&folder, said["command"].as_str().unwrap());
    is_read(&folder, regions);
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

/// The page's command with the photograph's own name and angle; the chart is another matter.
fn measures(folder: &Workdir, command: &str) {
    let command = command.replace("photo.png", "photo.exr").replace("-deg 45", "-deg 50");
    let command: Vec<_> = command.lines().filter(|line| !line.contains("--chart")).collect();
    let command = command.join("\n").replace(" | vestimate", " --camera canon-5d-mark-ii --illuminant D65");
    finds_the_panel(folder, &command);
}

/// The page's file of regions, but for the chart.
fn is_read(folder: &Workdir, mut regions: Value) {
    regions["chart"] = Value::Null;
    finds_the_panel(
        folder,
        &format!(
            "echo '{regions}' > regions.json
            vkernel --angle-deg 50 | vextract photo.exr --regions regions.json --refine=30 --camera canon-5d-mark-ii --illuminant D65"
        ),
    );
}

fn finds_the_panel(folder: &Workdir, command: &str) {
    let run = folder.sh(command);
    assert_eq!((run.status, run.stderr.as_str()), (0, ""), "{command}");
    let sample: Value = serde_json::from_str(run.stdout.lines().last().unwrap()).unwrap();
    assert_eq!(sample["image"]["refined"]["sides_without_edge"], json!([]));
    let corners = [CREASE, OUTER[0]].concat();
    for k in 0..8 {
        let found = sample["image"]["panels"][0][k / 2][k % 2].as_f64().unwrap();
        assert!((found - ENLARGED * corners[k / 2][k % 2]).abs() < 1.5, "{}", sample["image"]["panels"]);
    }
}
