//! Park's and Khan's estimators against another solver's numbers; those of the paper are in
//! `tests/numbers/published`.

use serde_json::Value;

use crate::common::Workdir;

const FLAT: &str = "vkernel --angle-deg 180 --facets 1x1";

/// Records of the samples that a script prints.
fn samples(script: &str) -> Vec<Value> {
    let run = Workdir::new().sh(script);
    assert_eq!((run.status, run.stderr.as_str()), (0, ""), "{script}");
    let records = run.stdout.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
    records.filter(|record| record["kind"] == "sample").collect()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

/// Lawson and Hanson's least distance problem by SciPy: `tests/data/flat/make.py`. Orange, blue and magenta
/// lie on a bound.
#[test]
fn estimates_are_those_of_another_solver() {
    let cases: Value = serde_json::from_str(include_str!("../data/flat/flat_sheets.json")).unwrap();
    for case in cases.as_array().unwrap() {
        let lights = case["lights"].as_array().unwrap().iter().map(|light| light.as_str().unwrap());
        let lights: String = lights.map(|light| format!(" --illuminant {light}")).collect();
        let exposure = if case["exposure_known"] == true { "" } else { "--exposure sum" };
        let method = case["method"].as_str().unwrap();
        for (patch, want) in case["spectra"].as_object().unwrap() {
            let see = format!("vforward --camera sigma-sd-merrill --reflectance cc24:{patch}{lights}");
            let [found] = samples(&format!("{FLAT} | {see} | vestimate --method {method} {exposure}"))
                .try_into()
                .unwrap();
            let what = format!("{method} {patch}{lights} {exposure}");
            assert_eq!(found["estimate"]["termination"]["reason"], "converged", "{what}");
            let off = numbers(&found["estimate"]["reflectance"])
                .iter()
                .zip(numbers(want))
                .map(|(got, want)| (got - want).abs())
                .fold(0.0, f64::max);
            assert!(off < 3e-6, "{what}: off by {off:e}");
        }
    }
}

/// As many components as values, and none of the bounds met: colours are met exactly.
#[test]
fn khan_meets_the_colours() {
    let sheet = samples(&format!(
        "{FLAT} | vforward --reflectance cc24:purple --illuminant A --illuminant D65 \
            | vestimate --method khan"
    ));
    assert!(sheet[0]["estimate"]["residual_rms"].as_f64().unwrap() < 1e-9, "{}", sheet[0]["estimate"]);
    assert_eq!(sheet[0]["estimate"]["prior"], "munsell");
}

/// A fold under two lights is two folds of half the channels each; one more light never hurts.
#[test]
fn lights_add_up() {
    let see = |lights: &str| format!("vkernel --facets 3x3 | vforward --reflectance cc24:green {lights}");
    let facets = |lights: &str| samples(&see(lights))[0]["facet_rgb"].clone();
    let values = |picture: &Value| picture.as_array().unwrap().iter().flat_map(numbers).collect::<Vec<_>>();
    let both = facets("--illuminant D65 --illuminant A");
    for (picture, light) in ["D65", "A"].into_iter().enumerate() {
        let alone = values(&facets(&format!("--illuminant {light}")));
        let off = values(&both[picture]).iter().zip(&alone).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(alone.len() == 54 && off < 1e-14, "{light}: off by {off:e}");
    }
    let rmse = |lights: &str| {
        let scored = samples(&format!("{} --noise-sd 1e-3 | vestimate | vscore", see(lights)));
        scored[0]["metrics"]["rmse"].as_f64().unwrap()
    };
    assert!(rmse("--illuminant D65 --illuminant A") < rmse("--illuminant D65"));
}
