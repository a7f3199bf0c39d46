//! Photographs in which there is no fold, or not the one that was stated: never "good".

use std::path::Path;

use serde_json::Value;

use crate::common::{Workdir, is_there};

/// A simulated photograph, noise of 20000 electrons at white, `$1`: flags of vkernel; `$2`: flags of
/// vforward, the sheet among them. Leaves sheet.tif and corners.json, the true corners.
const TAKE: &str = "take() { vkernel --angle-deg 45 $1 | vforward -q $2 --illuminant sun:40deg \
    --exposure 0.85 --photon-noise 0.007 \\
    --seed 1 --render sheet.tif --render-size 180x135 | tail -n 1 > corners.json; }
measure() { vkernel --angle-deg 45 | vextract -q sheet.tif --camera canon-5d-mark-ii --illuminant sun:40deg \
    --regions corners.json; }";

/// The estimate's record after a script that ends with it.
fn estimate(script: &str) -> Value {
    let run = Workdir::new().sh(&format!("{TAKE}\n{script}"));
    assert_eq!(run.status, 0, "{run:?}");
    let sample: Value = serde_json::from_str(run.stdout.lines().last().unwrap()).unwrap();
    sample["estimate"].clone()
}

/// The verdict: its level, and why.
fn verdict(script: &str) -> (String, String) {
    let verdict = &estimate(script)["verdict"];
    let text = |name: &str| verdict[name].as_str().unwrap().to_owned();
    (text("level"), text("because"))
}

#[test]
fn folds_are_good() {
    for sheet in ["magenta", "orange", "neutral-8", "foliage"] {
        for flags in ["", "--exposure 0.85"] {
            let (level, because) =
                verdict(&format!("take '' '--reflectance cc24:{sheet}'; measure | vestimate {flags}"));
            assert_eq!(level, "good", "{sheet} {flags}: {because}");
        }
    }
}

/// Panels that light reaches once: a flat sheet, or a ridge.
#[test]
fn without_bounces_there_is_no_fold() {
    for sheet in ["magenta", "orange", "neutral-8", "foliage"] {
        let found =
            verdict(&format!("take '' '--bounces 0 --reflectance cc24:{sheet}'; measure | vestimate"));
        assert_eq!(found.0, "wrong", "{sheet}: {}", found.1);
        let stated =
            format!("take '' '--bounces 0 --reflectance cc24:{sheet}'; measure | vestimate --exposure 0.85");
        assert_ne!(verdict(&stated).0, "good", "{sheet}, its exposure stated");
    }
}

/// A sky that is alike all round and so bright is found, and doubted: it is none that there is.
#[test]
fn a_sky_all_round_is_not_good() {
    for sheet in ["magenta", "foliage"] {
        let (level, because) =
            verdict(&format!("take '--sky 5' '--reflectance cc24:{sheet}'; measure | vestimate -q"));
        assert!(level != "good", "{sheet}: {level}: {because}");
    }
}

#[test]
fn an_exposure_is_a_fraction_of_the_white_level() {
    let stated = |exposure: &str| {
        verdict(&format!(
            "take '' '--reflectance cc24:magenta'; measure | vestimate -q --exposure {exposure}"
        ))
    };
    for exposure in ["100", "255", "0.05"] {
        let (level, because) = stated(exposure);
        assert!(
            level == "wrong" && because.contains("the white level of the picture"),
            "{exposure}: {because}"
        );
    }
    let (level, because) = stated("0.4");
    assert!(level == "doubtful" && because.contains("an exposure of 0.8"), "{level}: {because}");
    assert_eq!(stated("0.85").0, "good");
}

#[test]
fn two_sheets_are_no_fold_of_one() {
    let sheets = "--panel-reflectance 0=cc24:magenta --panel-reflectance 1=cc24:blue-flower";
    let (level, because) = verdict(&format!("take '' '{sheets}'; measure | vestimate -q"));
    assert_ne!(level, "good", "{because}");
}

/// Where only a part of the panels is marked, the sheet goes on beyond the corners.
#[test]
fn panels_are_marked_whole() {
    let half = "python3 - <<'END'
import json
regions = json.load(open('corners.json'))['regions']
middle = lambda a, b, t: [p + t * (q - p) for p, q in zip(a, b)]
for name in ('panel0', 'panel1'):
    a, b, c, d = regions[name]
    regions[name] = [middle(a, b, 0.25), middle(a, b, 0.75), middle(d, c, 0.75), middle(d, c, 0.25)]
json.dump(regions, open('corners.json', 'w'))
END";
    for sheet in ["magenta", "yellow", "neutral-8"] {
        let found = verdict(&format!("take '' '--reflectance cc24:{sheet}'\n{half}\nmeasure | vestimate -q"));
        assert_ne!(found.0, "good", "{sheet}: {}", found.1);
    }
}

/// What a photograph tells of a spectrum rests on light and camera as stated.
#[test]
fn error_bars_hold_light_and_camera() {
    let estimate = estimate("take '' '--reflectance cc24:orange'; measure | vestimate --exposure 0.85");
    let [found, sd] = ["reflectance", "reflectance_sd"].map(|name| estimate[name].as_array().unwrap());
    for (found, sd) in found.iter().zip(sd) {
        assert!(sd.as_f64().unwrap() >= 0.0199 * found.as_f64().unwrap(), "{found} ± {sd}");
    }
}

/// Numbers that a scene has and people do not err by are doubts, not allowed for.
#[test]
fn what_is_unusual_is_not_only_allowed_for() {
    let sun = verdict("take '--tilt-deg 16' '--reflectance cc24:orange'; measure | vestimate -q");
    assert!(sun.0 != "good" && sun.1.contains("sun"), "{sun:?}");
}

/// Files that are answered wrongly by nothing that their makers say: `../shared/faults`.
#[test]
fn given_faults_are_not_good() {
    const FAULTS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/faults");
    if !is_there(FAULTS) {
        return;
    }
    let folder = Path::new(FAULTS);
    let whole = "--panel0 '101.015,124.200 97.598,28.207 47.875,15.032 50.980,119.772' \
        --panel1 '101.015,124.200 97.598,28.207 127.973,10.800 132.125,116.336'";
    let middle = "--panel0 '100.160,100.202 98.452,52.205 48.651,41.217 50.204,93.587' \
        --panel1 '100.160,100.202 98.452,52.205 129.011,37.184 131.087,89.952'";
    for (file, corners, camera, flags) in [
        ("flat-sheet.tif", whole, "canon-5d-mark-ii", ""),
        ("exposure-in-percent.tif", whole, "canon-5d-mark-ii", "--exposure 100"),
        ("srgb-curve-16-bit.tif", whole, "canon-5d-mark-ii", ""),
        ("white-balanced-matrix.tif", whole, "canon-5d-mark-ii", ""),
        ("black-level.tif", whole, "canon-5d-mark-ii", ""),
        ("exif-says-another-camera.tif", whole, "nikon-d850", ""),
        ("half-the-panels-marked.tif", middle, "canon-5d-mark-ii", ""),
    ] {
        let (level, because) = verdict(&format!(
            "vkernel --angle-deg 45 | vextract -q '{}' --camera {camera} --illuminant sun:40deg {corners} \
                | vestimate -q {flags}",
            folder.join(file).display()
        ));
        assert_ne!(level, "good", "{file}: {because}");
    }
    // a sky half as bright as the sun, of its colour, is found
    let found = estimate(&format!(
        "vkernel --angle-deg 45 | vextract -q '{}' --camera canon-5d-mark-ii \
            --illuminant sun:40deg {whole} | vestimate -q",
        folder.join("white-sky.tif").display()
    ));
    let sky = found["fit"]["even_sky"]["value"].as_f64().unwrap();
    assert!((sky - 0.5).abs() < 0.05, "a sky of {sky}");
}
