//! `examples/measure`: one command for one photograph.

use crate::common::Workdir;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");
const PANELS: [&str; 2] = ["332,462 345,77 122,12 104,442", "332,462 345,77 485,17 472,446"];

/// What it leaves beside the photograph.
fn left(folder: &Workdir) -> String {
    folder.sh("cd vfold-photo; ls; grep -c '\"level\":\"good\"' result.ndjson; wc -l < spectrum.csv").stdout
}

#[test]
fn what_is_told_is_not_asked() {
    let folder = Workdir::new();
    let run = folder.sh(&format!(
        "cp '{ROOT}/tests/data/photos/a_ideal_magenta_50.exr' photo.exr
        export ANGLE=50 CAMERA=canon-5d-mark-ii LIGHT=D65 PANEL0='{}' PANEL1='{}'
        '{ROOT}/examples/measure' photo.exr < /dev/null",
        PANELS[0], PANELS[1]
    ));
    assert_eq!(run.status, 0, "{run:?}");
    assert_eq!(
        run.stdout,
        "the spectrum: ./vfold-photo/spectrum.csv, the report: ./vfold-photo/report.html\n"
    );
    assert_eq!(left(&folder), "overlay.png\nreport.html\nresult.ndjson\nspectrum.csv\n1\n62\n");
}

#[test]
fn what_is_not_told_is_asked() {
    let folder = Workdir::new();
    let panels = PANELS.map(|panel| format!("[[{}]]", panel.replace(' ', "],[")));
    let run = folder.sh(&format!(
        "cp '{ROOT}/tests/data/photos/a_ideal_magenta_50.exr' photo.exr
        echo '{{\"panel0\": {}, \"panel1\": {}}}' > corners.json
        printf '%s\\n' '' canon-5d-mark-ii D65 corners.json | '{ROOT}/examples/measure' photo.exr",
        panels[0], panels[1]
    ));
    assert_eq!(run.status, 0, "{run:?}");
    assert!(run.stderr.contains("Angle between the panels, degrees [50]: "), "{}", run.stderr);
    assert_eq!(left(&folder), "overlay.png\npreview.png\nreport.html\nresult.ndjson\nspectrum.csv\n1\n62\n");
}
