//! Estimates through the tools against published figures and at the ends of the range of reflectances.

#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

mod common;

use common::Workdir;
use serde_json::Value;

/// Scores of every sample of a pipeline, by name: RMSE and CIEDE2000.
fn scores(script: &str) -> Vec<(String, f64, f64)> {
    let run = Workdir::new().sh(script);
    assert_eq!((run.status, run.stderr.as_str()), (0, ""), "{script}");
    let records = run.stdout.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
    let score = |record: Value| {
        let metric = |name: &str| record["metrics"][name].as_f64().unwrap();
        (record["id"].as_str().unwrap().to_owned(), metric("rmse"), metric("ciede2000"))
    };
    records.filter(|record| record["kind"] == "sample").map(score).collect()
}

/// Deeb et al., table 1, "Our Method" on the 24 patches: RMSE 0.017, CIEDE2000 0.29, one light.
#[test]
fn one_light_is_better_than_the_paper_on_its_chart() {
    for camera in ["canon-5d-mark-ii", "sigma-sd-merrill", "nikon-d5100"] {
        let scores =
            scores(&format!("vkernel | vforward --reflectance cc24 --camera {camera} | vestimate | vscore"));
        let mean =
            |pick: fn(&(String, f64, f64)) -> f64| scores.iter().map(pick).sum::<f64>() / scores.len() as f64;
        let (rmse, ciede2000) = (mean(|s| s.1), mean(|s| s.2));
        assert_eq!(scores.len(), 24);
        assert!(rmse < 0.011 && ciede2000 < 0.20, "{camera}: {rmse:.4} {ciede2000:.3}");
    }
}

/// The same with the paper's own estimator: eq. (36), smoothness, interior point.
#[test]
fn the_papers_estimator_reaches_the_papers_figures() {
    for camera in ["canon-5d-mark-ii", "sigma-sd-merrill"] {
        let scores = scores(&format!(
            "vkernel | vforward --reflectance cc24 --camera {camera} | vestimate --prior smooth --smoothness 1e-8 | vscore"
        ));
        let rmse = scores.iter().map(|s| s.1).sum::<f64>() / 24.0;
        let ciede2000 = scores.iter().map(|s| s.2).sum::<f64>() / 24.0;
        assert!(rmse < 0.017 && ciede2000 < 0.29, "{camera}: {rmse:.4} {ciede2000:.3}");
    }
}

#[test]
fn dark_and_bright_greys_are_recovered() {
    let greys = "0.003 0.01 0.1 0.5 0.9 0.97 1";
    for (name, rmse, _) in scores(&format!("vkernel | vforward --reflectance {greys} | vestimate | vscore")) {
        let tolerance = 0.02 * name.parse::<f64>().unwrap().max(0.05);
        assert!(rmse < tolerance, "{name}: RMSE {rmse}");
    }
}

/// Half a stop more light on a bright sheet: the gradient tells reflectance from exposure.
#[test]
fn an_unknown_exposure_is_found() {
    let shot = "vkernel | vforward --reflectance cc24:orange cc24:white --exposure 0.7";
    for how in ["free", "sum"] {
        for (name, rmse, ciede2000) in scores(&format!("{shot} | vestimate --exposure {how} | vscore")) {
            assert!(rmse < 0.02 && ciede2000 < 0.5, "{how}: {name}: {rmse:.4} {ciede2000:.3}");
        }
    }
}
