//! A light that nobody states.

use std::fs;

use serde_json::Value;

use crate::common::Workdir;

const PHOTO: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/photos/a_ideal_magenta_50.exr");
const PANELS: &str = "--panel0 '332,462 345,77 122,12 104,442' --panel1 '332,462 345,77 485,17 472,446'";

fn records(lines: &str) -> Vec<Value> {
    lines.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

fn rms(a: &[f64], b: &[f64]) -> f64 {
    let squares: f64 = a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum();
    (squares / a.len() as f64).sqrt()
}

/// What an earlier run stated, or assumed, of the light is not what a later one states.
#[test]
fn a_scene_that_is_lit_anew_keeps_nothing_of_its_old_light() {
    let run = Workdir::new().sh(&format!(
        "vkernel --angle-deg 50 -o fold.json
        extract() {{
            vextract -q '{PHOTO}' --camera canon-5d-mark-ii {PANELS} --no-history \"$@\" | head -n 1
        }}
        vforward -q fold.json --reflectance 0.5 --illuminant sun:40deg --sky-illuminant sky --no-history |
            head -n 1 > blue.json
        extract --scene fold.json --illuminant unknown > unknown.json
        extract --scene fold.json > assumed.json
        for scene in fold blue unknown assumed; do extract --scene $scene.json --illuminant A; done"
    ));
    let scenes: Vec<&str> = run.stdout.lines().collect();
    assert!(run.status == 0 && scenes.len() == 4, "{run:?}");
    let fields = |scene: &str| serde_json::from_str::<Value>(scene).unwrap();
    scenes[1..].iter().for_each(|scene| assert_eq!(fields(scene), fields(scenes[0])));
}

/// Facets of computed sheets, and of a photograph: they end where they would if the light had been stated.
#[test]
fn one_candidate_is_a_light_that_is_stated() {
    let run = Workdir::new().sh(&format!(
        "vkernel | vforward -q --reflectance cc24:red cc24:foliage --illuminant FL11 \
            --noise-sd 1e-3 -o computed.ndjson
        vkernel --angle-deg 50 -o scene.json
        vextract -q '{PHOTO}' --scene scene.json --camera canon-5d-mark-ii \
            --illuminant FL11 {PANELS} -o photo.ndjson
        for light in '' '--illuminant unknown --illuminants FL11'; do
            vestimate -q computed.ndjson --exposure free $light
            for fit in auto exposure none; do vestimate -q photo.ndjson --fit $fit $light; done
        done"
    ));
    assert_eq!(run.status, 0, "{run:?}");
    let all = records(&run.stdout);
    let samples: Vec<&Value> = all.iter().filter(|record| record["kind"] == "sample").collect();
    let (stated, found) = samples.split_at(5);
    for (stated, found) in stated.iter().zip(found).map(|(a, b)| (&a["estimate"], &b["estimate"])) {
        for name in ["reflectance", "reflectance_sd"] {
            assert!(rms(&numbers(&stated[name]), &numbers(&found[name])) < 1e-9, "{name}");
        }
        assert!(
            stated["light"].is_null()
                && (found["light"]["candidates"][0]["probability"].as_f64().unwrap() - 1.0).abs() < 1e-9,
            "{found}"
        );
    }
}

/// Nearer than with another light told, by far, and no further than its bars say.
#[test]
fn a_sheet_is_found_in_a_light_that_is_unknown() {
    let run = Workdir::new().sh("vkernel | vforward -q --reflectance cc24 --illuminant A --noise-sd 1e-3 \
        | vestimate -q --exposure free --illuminant unknown");
    assert_eq!(run.status, 0, "{run:?}");
    let (mut squares, mut held, mut count) = (0.0, 0, 0);
    for sample in records(&run.stdout).iter().skip(1) {
        let (truth, estimate) = (numbers(&sample["truth"]["reflectance"]), &sample["estimate"]);
        let (found, sd) = (numbers(&estimate["reflectance"]), numbers(&estimate["reflectance_sd"]));
        for n in 0..truth.len() {
            squares += (found[n] - truth[n]).powi(2);
            held += usize::from((found[n] - truth[n]).abs() <= 2.0 * sd[n]);
            count += 1;
        }
    }
    let (rmse, within) = ((squares / f64::from(count)).sqrt(), held as f64 / f64::from(count));
    // told daylight, 0.13
    assert!(rmse < 0.05 && within > 0.85, "{rmse} {within}");
}

/// Facets that tell candidates apart are tried in lights between them: a white sheet in D65, which lies
/// between 6250 and 6667 K, fits neither.
#[test]
fn a_light_between_two_candidates_is_found() {
    let run = Workdir::new()
        .sh("vkernel | vforward -q --reflectance 0.9 --noise-sd 1e-3 | vestimate -q --illuminant unknown");
    assert_eq!(run.status, 0, "{run:?}");
    let estimate = &records(&run.stdout)[1]["estimate"];
    let off: Vec<f64> = numbers(&estimate["reflectance"]).iter().map(|r| r - 0.9).collect();
    assert!(rms(&off, &vec![0.0; off.len()]) < 0.03, "{off:?}");
    for candidate in estimate["light"]["candidates"].as_array().unwrap() {
        let cct_k = candidate["cct_k"].as_f64().unwrap_or(0.0);
        assert!((6300.0..6650.0).contains(&cct_k), "{candidate}");
    }
}

/// A brightened sheet is found in daylight that nobody states; a bluer day would look much alike.
#[test]
fn a_brightened_sheet_is_named_in_a_light_that_is_unknown() {
    let run =
        Workdir::new().sh("printf 'nm,f\n400,0.05\n435,0.25\n480,0.08\n520,0.01\n560,0\n700,0\n' > f.csv
        vkernel | vforward -q --reflectance 0.8 --fluorescence f.csv --noise-sd 1e-3 \
            | vestimate -q --illuminant unknown
        vkernel | vforward -q --reflectance 0.8 --noise-sd 1e-3 | vestimate -q --illuminant unknown");
    assert_eq!(run.status, 0, "{run:?}");
    let all = records(&run.stdout);
    let [brightened, plain] = [1, 3].map(|n| &all[n]["estimate"]["fluorescence"]);
    let [probability, peak_nm] = ["probability", "peak_nm"].map(|name| brightened[name].as_f64().unwrap());
    assert!(probability > 0.9 && (420.0..450.0).contains(&peak_nm), "{brightened}");
    assert!(plain.is_null(), "{plain}");
}

#[test]
fn probabilities_add_up_to_one() {
    let run = Workdir::new().sh(&format!(
        "vkernel --angle-deg 50 | vextract -q '{PHOTO}' --camera canon-5d-mark-ii \
            --illuminant unknown {PANELS} | vestimate -q
        vkernel | vforward -q --reflectance 0.5 --illuminant LED-B3 --noise-sd 1e-2 \
            | vestimate -q --illuminant unknown --save light.power=light.npy"
    ));
    assert_eq!(run.status, 0, "{run:?}");
    for sample in records(&run.stdout).iter().filter(|record| record["kind"] == "sample") {
        let light = &sample["estimate"]["light"];
        let probabilities: Vec<f64> = light["candidates"]
            .as_array()
            .unwrap()
            .iter()
            .map(|candidate| candidate["probability"].as_f64().unwrap())
            .collect();
        // those below one in a thousand are not named
        let sum: f64 = probabilities.iter().sum();
        assert!((0.95..1.0 + 1e-9).contains(&sum), "{sum}");
        assert!(probabilities.is_sorted_by(|a, b| a >= b), "{probabilities:?}");
        let power = numbers(&light["power"]);
        assert!((power.iter().sum::<f64>() / power.len() as f64 - 1.0).abs() < 1e-9);
        let because = sample["estimate"]["verdict"]["because"].as_str().unwrap();
        assert!(!because.contains("the light D65"), "{because}");
    }
}

/// What needs a light says so in a line.
#[test]
fn what_needs_a_light_refuses_one_that_is_unknown() {
    let folder = Workdir::new();
    let made = folder.sh(&format!(
        "vkernel --angle-deg 50 -o scene.json
        vextract -q '{PHOTO}' --scene scene.json --camera canon-5d-mark-ii \
            --illuminant unknown {PANELS} -o photo.ndjson"
    ));
    assert_eq!(made.status, 0, "{made:?}");
    for (line, said) in [
        (
            "vforward --reflectance 0.5 --illuminant unknown scene.json",
            "vforward computes what a camera sees",
        ),
        ("vestimate photo.ndjson --prior smooth", "an unknown light is found only"),
        ("vestimate photo.ndjson --join", "an unknown light is found only"),
        ("vestimate photo.ndjson --illuminant D65", "stated to vextract or vforward"),
        ("vestimate --plan scene.json --illuminant unknown", "cannot be used with --plan"),
        ("vestimate --plan photo.ndjson --illuminant D65", "--illuminant: the scene already has a camera"),
        ("vestimate --plan photo.ndjson --camera nikon-d5100", "--camera: the scene already has a camera"),
    ] {
        let run = folder.sh(line);
        assert_ne!(run.status, 0, "{line}");
        assert!(run.stderr.contains(said) && run.stderr.lines().count() == 1, "{line}: {}", run.stderr);
    }
    let scene = fs::read_to_string(folder.path().join("photo.ndjson")).unwrap();
    assert!(!scene.contains("illuminants") && scene.contains("illuminant_unknown"));
}

/// Computed sheets and a photograph, in light that is told rightly and wrongly: another light is named where
/// it is wrong alone.
#[test]
fn a_light_that_is_told_wrongly_is_doubted() {
    let run = Workdir::new().sh(&format!(
        "vkernel | vforward -q --reflectance cc24 --illuminant A --noise-sd 1e-3 -o right.ndjson
        vkernel | vforward -q --reflectance 0.5 --illuminant D65 -o daylight.ndjson
        {{ head -n 1 daylight.ndjson; tail -n +2 right.ndjson; }} > wrong.ndjson
        vkernel --angle-deg 50 -o scene.json
        for light in D65 A; do
            vextract -q '{PHOTO}' --scene scene.json --camera canon-5d-mark-ii \
                --illuminant $light {PANELS} -o photo-$light.ndjson
        done
        for records in right.ndjson wrong.ndjson photo-D65.ndjson photo-A.ndjson; do
            vestimate -q --exposure free $records | grep -c 'times as probable as' || true
        done"
    ));
    assert_eq!(run.status, 0, "{run:?}");
    let named: Vec<usize> = run.stdout.lines().map(|line| line.parse().unwrap()).collect();
    let [right, wrong, photo_right, photo_wrong] = named[..] else { panic!("{named:?}") };
    assert!(right <= 1 && wrong >= 12, "{named:?}");
    assert_eq!((photo_right, photo_wrong), (0, 1), "{named:?}");
}
