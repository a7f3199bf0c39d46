//! What is fitted along with the spectrum, planned errors and traces, through the tools.

use std::collections::BTreeMap;

use serde_json::Value;

use crate::common::Workdir;

/// Samples of a pipeline.
fn samples(script: &str) -> Vec<Value> {
    let run = Workdir::new().sh(script);
    assert_eq!((run.status, run.stderr.as_str()), (0, ""), "{script}");
    let records = run.stdout.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
    records.filter(|record| record["kind"] == "sample").collect()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

/// Mean RMSE and CIEDE2000.
fn scores(samples: &[Value]) -> [f64; 2] {
    ["rmse", "ciede2000"]
        .map(|name| samples.iter().map(|s| number(&s["metrics"][name])).sum::<f64>() / samples.len() as f64)
}

/// Errors of a fitted number in units of its standard deviation.
fn errors(samples: &[Value], name: &str, truth: f64) -> Vec<f64> {
    let error = |sample: &Value| {
        let fitted = &sample["estimate"]["fit"][name];
        (number(&fitted["value"]) - truth) / number(&fitted["sd"])
    };
    samples.iter().map(error).collect()
}

/// The samples of the chart in one scene, put under the scene line of another one that is wrong.
fn mistaken(truth: &str, light: &str, believed: &str) -> String {
    format!(
        "vkernel {truth} | vforward --reflectance cc24 --noise-sd 1e-3 {light} | tail -n +2 > samples.ndjson
         vkernel {believed} | vforward --reflectance 0.5 | head -n 1 | cat - samples.ndjson > wrong.ndjson
         vestimate -q wrong.ndjson"
    )
}

#[test]
fn a_sky_and_a_tilt_that_nobody_knew_are_found() {
    let shot = mistaken("--tilt-deg 5 --sky 0.18", "--sky-illuminant daylight:10000", "");
    let ignored = scores(&samples(&format!("{shot} | vscore")));
    let fitted = samples(&format!("{shot} --fit tilt,sky | vscore"));
    let [rmse, delta_e] = scores(&fitted);
    assert!(ignored[0] > 0.05 && ignored[1] > 2.0, "{ignored:?}");
    assert!(rmse < 0.02 && delta_e < 0.5, "{rmse} {delta_e}");
    for (name, truth) in [("tilt_deg", 5.0), ("sky", 0.18), ("sky_cct_k", 10_000.0)] {
        let errors = errors(&fitted, name, truth);
        let rms = (errors.iter().map(|error| error * error).sum::<f64>() / errors.len() as f64).sqrt();
        assert!((0.4..1.6).contains(&rms), "{name}: {rms} of its standard deviation");
        assert!(fitted.iter().all(|sample| sample["estimate"]["fit"][name]["supported"] == true), "{name}");
    }
}

/// In a lamp's light the amount of a stray sky is found if its illuminant is stated.
#[test]
fn a_sky_beside_a_lamp_is_found() {
    let found = samples(
        "vkernel --sky 0.3 | vforward --reflectance cc24:orange cc24:blue --noise-sd 1e-3 --illuminant A \
            --sky-illuminant D65 | vestimate -q --fit sky",
    );
    let errors = errors(&found, "sky", 0.3);
    assert!(errors.len() == 2 && errors.iter().all(|error| error.abs() < 3.0), "{errors:?}");
}

/// In a photograph by a lamp's light no sky is modelled, so that none is reported.
#[test]
fn a_sky_beside_a_lamp_is_not_found_in_a_photograph() {
    let found = samples(
        "light='--illuminant A --sky-illuminant D65'
         vkernel --sky 0.3 -o scene.json
         vforward scene.json -q --reflectance cc24:orange --specular-weight 0.4 --photon-noise 0.007 $light \
             --render sheet.tif --render-size 180x135 | tail -n 1 > corners.json
         vextract -q sheet.tif --scene scene.json --camera canon-5d-mark-ii --regions corners.json $light |
             vestimate -q",
    );
    let fit = &found[0]["estimate"]["fit"];
    assert!(fit["specular_weight"].is_object() && fit["sky"].is_null(), "{fit}");
}

#[test]
fn a_wrong_angle_is_found() {
    let shot = mistaken("--angle-deg 47", "", "--angle-deg 45");
    let ignored = scores(&samples(&format!("{shot} | vscore")));
    let fitted = samples(&format!("{shot} --fit angle | vscore"));
    let [rmse, delta_e] = scores(&fitted);
    assert!(ignored[1] > 0.6, "{ignored:?}");
    assert!(rmse < 0.019 && delta_e < 0.45, "{rmse} {delta_e}");
    assert!(errors(&fitted, "angle_deg", 47.0).iter().all(|error| error.abs() < 3.0));
}

/// Without noise all five are found at once, as far as the fold between folds is interpolated.
#[test]
fn everything_at_once() {
    let shot = "vkernel --angle-deg 46.5 --tilt-deg -4 --sky 0.1 |
        vforward --reflectance cc24:orange cc24:neutral-6-5 --exposure 0.7 | tail -n +2 > samples.ndjson
        vkernel | vforward --reflectance 0.5 | head -n 1 | cat - samples.ndjson > wrong.ndjson
        vestimate -q wrong.ndjson --fit exposure,tilt,sky,angle";
    for sample in samples(shot) {
        let fit = &sample["estimate"]["fit"];
        for (name, truth, tolerance) in
            [("exposure", 0.7, 0.01), ("tilt_deg", -4.0, 0.01), ("sky", 0.1, 1e-3), ("angle_deg", 46.5, 0.02)]
        {
            let value = number(&fit[name]["value"]);
            assert!((value - truth).abs() < tolerance, "{}: {name} {value}", sample["id"]);
        }
    }
}

#[test]
fn no_sky_is_no_less_than_none() {
    let found =
        samples("vkernel | vforward --reflectance cc24 --noise-sd 1e-3 | vestimate -q --fit sky | vscore");
    let sky: Vec<f64> =
        found.iter().map(|sample| number(&sample["estimate"]["fit"]["sky"]["value"])).collect();
    assert!(sky.iter().all(|sky| (0.0..0.05).contains(sky)), "{sky:?}");
    assert!(sky.iter().filter(|sky| **sky > 0.0).count() < sky.len());
    assert!(errors(&found, "sky", 0.0).iter().all(|error| *error < 3.0));
    let [rmse, delta_e] = scores(&found);
    assert!(rmse < 0.018 && delta_e < 0.4, "{rmse} {delta_e}");
}

/// Two facets say nothing of an angle; and say so. Of the sky the classes of spectra say something.
#[test]
fn what_the_facets_do_not_tell_is_said() {
    let script =
        "vkernel --facets 1x1 | vforward --reflectance 0.5 --noise-sd 1e-3 | vestimate --fit sky,angle";
    let run = Workdir::new().sh(script);
    let sample: Value = serde_json::from_str(run.stdout.lines().last().unwrap()).unwrap();
    let fit: BTreeMap<String, Value> = serde_json::from_value(sample["estimate"]["fit"].clone()).unwrap();
    assert_eq!(fit["angle_deg"]["supported"], false);
    assert!(
        run.stderr.lines().any(|line| line.contains("angle_deg") && line.contains("0.5: ")),
        "{}",
        run.stderr
    );
    // what is known of an angle that was measured
    assert!((number(&fit["angle_deg"]["sd"]) - 0.8).abs() < 0.1);
}

/// The error to expect is what simulated estimates have.
#[test]
fn plans_are_honest() {
    for (angle_deg, card) in [(30, ""), (60, ""), (45, "--reference-panel cc24:magenta")] {
        let scene = format!("vkernel --angle-deg {angle_deg}");
        let run = Workdir::new().sh(&format!("{scene} | vestimate --plan --noise-sd 2e-3 {card}"));
        let plan: Value = serde_json::from_str(&run.stdout).unwrap();
        let planned = number(&plan["expected_rmse"]["mean"]);
        let [found, _] = scores(&samples(&format!(
            "{scene} | vforward --reflectance cc24 --noise-sd 2e-3 {card} | vestimate | vscore"
        )));
        let ratio = planned / found;
        assert!((1.0 / 1.5..1.5).contains(&ratio), "{angle_deg} {card}: {planned} planned, {found} found");
    }
}

#[test]
fn a_trace_has_a_line_an_iteration() {
    let folder = Workdir::new();
    let run = folder.sh("vkernel | vforward --reflectance 0.2 0.6 --noise-sd 1e-3 \
            | vestimate --trace trace.ndjson > found.ndjson
         cat trace.ndjson found.ndjson");
    let records: Vec<Value> = run.stdout.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    for sample in records.iter().filter(|record| record["kind"] == "sample") {
        let steps: Vec<&Value> = records.iter().filter(|record| record["sample"] == sample["id"]).collect();
        assert_eq!(steps.len() as u64, sample["estimate"]["iterations"].as_u64().unwrap());
        assert!(sample["trace"].is_null());
        // Within a run, at one noise, the cost falls.
        for pair in steps.windows(2).filter(|p| p[0]["run"] == p[1]["run"] && p[0]["noise"] == p[1]["noise"])
        {
            assert!(number(&pair[1]["cost"]) < number(&pair[0]["cost"]), "{pair:?}");
        }
    }
}

/// Blue light alone comes from the sky, which the scene does not say: no colour of daylight has that. Where
/// the sun's is open, too, both end on their bounds.
#[test]
fn a_sky_bluer_than_any_is_fitted_on_the_bound() {
    let run = Workdir::new().sh(r#"
        { echo nm,blue; for nm in $(seq 400 5 700); do echo $nm,$((nm < 470)); done; } > blue.csv
        vkernel --sky 0.4 --tilt-deg 10 -o scene.json
        simulate() { vforward scene.json --noise-sd 1e-3 -q --reflectance "$@"; }
        for chip in white cyan moderate-red; do
            {
                simulate cc24:$chip | head -n 1
                simulate cc24:$chip --sky-illuminant blue.csv | tail -n 1
            } > $chip.ndjson
            vestimate -q $chip.ndjson --fit sky
        done
        vestimate -q cyan.ndjson --fit sky,daylight"#);
    assert!(run.status == 0, "{}", run.stderr);
    let records = run.stdout.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
    let samples: Vec<Value> = records.filter(|record| record["kind"] == "sample").collect();
    assert_eq!(samples.len(), 4);
    for sample in &samples {
        let estimate = &sample["estimate"];
        assert_eq!(estimate["fit"]["sky_cct_k"]["value"].as_f64(), Some(1e5), "{estimate}");
        assert!(estimate["verdict"]["level"] != "good", "{}", estimate["verdict"]);
    }
    assert_eq!(samples[3]["estimate"]["fit"]["sun_cct_k"]["value"].as_f64(), Some(1e5), "{}", samples[3]);
}
