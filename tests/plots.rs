//! Drawings, as another program reads them: text that is text in SVG, the right colours in PNG.

// a test stops at the first surprise
#![allow(clippy::unwrap_used)]

mod common;

use common::Workdir;

const SAMPLE: &str = "vkernel --facets 2x2 | vforward --reflectance cc24:red --noise-sd 1e-3 | vestimate";

#[test]
fn a_spectrum_is_drawn_with_its_band_and_the_truth() {
    let folder = Workdir::new();
    let run = folder.sh(&format!("{SAMPLE} --plot red.svg >/dev/null; cat red.svg"));
    assert_eq!(run.status, 0, "{run:?}");
    for part in ["wavelength, nm", "reflectance", "cc24:red", "true (dashed)", "<polygon", "sans-serif"] {
        assert!(run.stdout.contains(part), "{part}");
    }
    let run = folder.sh(&format!(
        "{SAMPLE} --plot red.png >/dev/null; oiiotool red.png --colorcount:eps=.02,.02,.02 0,.447,.698:0,0,0:1,1,1"
    ));
    assert!(run.status == 0 && run.stderr.is_empty(), "{run:?}");
    let counts: Vec<usize> =
        run.stdout.lines().filter_map(|line| line.split_whitespace().next()?.parse().ok()).collect();
    assert!(counts[0] > 500 && counts[1] > 500 && counts[2] > 100_000, "blue, black, white: {counts:?}");
}

#[test]
fn other_endings_are_refused() {
    let run = Workdir::new().sh(&format!("{SAMPLE} --plot red.pdf"));
    assert_eq!(run.status, 2);
    assert!(
        run.stderr.contains("'red.pdf'") && run.stderr.contains("end the name in .svg or .png"),
        "{run:?}"
    );
}
