//! `vfold-measure`: from photographs to reports, with nothing typed but what a picture does not tell.

use crate::common::{Ended, Workdir};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");
const PHOTO: &str = "tests/data/photos/a_ideal_magenta_50.exr";

/// A folder with so many photographs, `photo.exr` the first, and what running it there says.
fn run(names: &[&str], command: &str) -> (Workdir, Ended) {
    let folder = Workdir::new();
    for name in names {
        std::fs::copy(format!("{ROOT}/{PHOTO}"), folder.path().join(name)).unwrap();
    }
    let run = folder.sh(&format!("measure() {{ '{ROOT}/share/vfold-measure' \"$@\"; }}\n{command}"));
    (folder, run)
}

/// Of a photograph of a magenta sheet: how far the spectrum is off, root mean square.
fn rmse(folder: &Workdir, result: &str) -> f64 {
    let said = folder.sh(&format!("vscore {result} --truth cc24:magenta | tail -n 1"));
    let score: serde_json::Value = serde_json::from_str(&said.stdout).unwrap();
    score["rmse"]["mean"].as_f64().unwrap()
}

#[test]
fn what_is_found_is_not_asked() {
    let (folder, run) =
        run(&["photo.exr"], "measure --camera canon-5d-mark-ii --illuminant D65 photo.exr < /dev/null");
    assert_eq!(run.status, 0, "{run:?}");
    assert!(run.stdout.starts_with("./vfold-photo/report.html: good: "), "{run:?}");
    let files = folder.sh("ls vfold-photo; wc -l < vfold-photo/spectrum.csv").stdout;
    assert_eq!(
        files,
        "overlay.png\nregions.json\nreport.html\nresult.ndjson\nscene.json\nspectrum.csv\n62\n"
    );
    assert!(rmse(&folder, "vfold-photo/result.ndjson") < 0.03);
}

#[test]
fn a_camera_that_no_photograph_names_is_asked() {
    let (_, asked) = run(&["photo.exr"], "echo canon-5d-mark-ii | measure photo.exr");
    assert!(asked.status == 0 && asked.stderr.contains("Camera of photo.exr, one of"), "{asked:?}");
    let (_, told) = run(&["photo.exr"], "measure --yes photo.exr");
    assert!(told.status == 2 && told.stderr.contains("the photograph names no camera"), "{told:?}");
}

#[test]
fn several_photographs_have_one_page() {
    let (folder, run) = run(
        &["a.exr"],
        "oiiotool a.exr -o a.tif; echo none > c.exr
        measure --yes --camera canon-5d-mark-ii --illuminant D65 a.exr a.tif c.exr",
    );
    assert_eq!(run.status, 3, "{run:?}");
    assert!(run.stderr.contains("vfold-measure: 3 of 3, c.exr\n"), "{run:?}");
    assert!(run.stdout.ends_with("vfold-report.html: 2 of 3 photographs\n"), "{run:?}");
    assert_eq!(folder.sh("ls vfold-report.html vfold-*/report.html | wc -l").stdout.trim(), "3");
}

#[test]
fn a_wrong_call_is_refused() {
    for (call, why) in [
        ("", "usage: vfold-measure"),
        ("--lens x", "there is no such option"),
        ("--camera", "a value is missing"),
    ] {
        let (_, run) = run(&[], &format!("measure {call}"));
        assert!(run.status == 2 && run.stderr.contains(why), "{call}: {run:?}");
    }
}
