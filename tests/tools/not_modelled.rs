//! Photographs of folds that are taken for ideal ones, whatever they are: vestimate says so where that
//! explains nothing.

use crate::common::{Ended, Workdir};

/// A photograph of a sheet, one panel of which is shorter; its scene with another angle, and its record in
/// that.
const SHORT: &str = r#"
    vkernel --angle-deg 50 --panel1-depth 0.7 --facets 6x3 -o scene.json
    vforward scene.json --reflectance cc24:orange --exposure 0.5 --noise-sd 1e-3 --render p.tif \
        --render-size 320x240 -q -o simulated.ndjson
    vkernel --angle-deg 75 --panel1-depth 0.7 --facets 6x3 -o told.json
    vextract p.tif --regions simulated.ndjson --scene told.json --camera canon-5d-mark-ii \
        --illuminant D65 -o short.ndjson"#;

fn assert_said(run: &Ended, words: &[&str]) {
    assert!(words.iter().all(|words| run.stderr.contains(words)), "{run:?}");
}

#[test]
fn a_panel_that_is_shorter_is_said() {
    let folder = Workdir::new();
    let run = folder.sh(&format!("{SHORT}\nvestimate short.ndjson | grep -o '\"level\":\"[a-z]*\"'"));
    assert_eq!(run.stdout, "\"level\":\"wrong\"\n");
    assert_said(
        &run,
        &["this is not an ideal fold. Real-sheet effects cannot be modelled here (one panel \
           is deeper than the other)"],
    );
    let quiet = folder.sh("vestimate -q short.ndjson | grep -c bihemispherical_albedo");
    assert_eq!((quiet.stdout.as_str(), quiet.stderr.as_str()), ("0\n", ""));
}

#[test]
fn only_folds_of_one_sheet_are_joined() {
    let folder = Workdir::new();
    let run = folder.sh(&format!(
        "{SHORT}
        sed 's/\"id\":\"p\"/\"id\":\"p-again\"/' short.ndjson > again.ndjson
        cat short.ndjson again.ndjson | vestimate --join=p,p-again > joined.ndjson || echo $?
        grep -c 'only photographs of folds are estimated together' joined.ndjson"
    ));
    assert_eq!(run.stdout, "3\n2\n");
    assert_said(&run, &["2 of 2 failed", "one panel is deeper than the other"]);
}
