//! R. Deeb, D. Muselet, M. Hébert, A. Trémeau, *Applied Optics* 57 (2018), p. 4918, table 1: mean RMSE and
//! CIEDE2000 of the ColorChecker's 24 patches. Its camera's curves are not published, nor its three lights
//! named: ours are like them.

use serde_json::Value;

use crate::common::Workdir;

const PARK: f64 = 0.024;
const KHAN: f64 = 0.018;
const FOLD: [f64; 2] = [0.017, 0.29];

/// Mean RMSE and CIEDE2000 of the patches.
fn scores(scene: &str, sight: &str, method: &str) -> [f64; 2] {
    let see = format!("vforward --reflectance cc24 {sight}");
    let run = Workdir::new().sh(&format!("{scene} | {see} | vestimate {method} | vscore | tail -n 1"));
    assert_eq!((run.status, run.stderr.as_str()), (0, ""));
    let summary: Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!(summary["scored"], 24, "{summary}");
    ["rmse", "ciede2000"].map(|name| summary[name]["mean"].as_f64().unwrap())
}

#[test]
fn rivals_under_three_lights_are_as_good_as_published_and_beaten_by_a_fold_under_one() {
    let camera = "--camera sigma-sd-merrill";
    let lamps = format!("{camera} --illuminant A --illuminant D65 --illuminant FL11");
    let fold = scores("vkernel", camera, "");
    for (method, published) in [("park", PARK), ("khan", KHAN)] {
        let flat = scores("vkernel --angle-deg 180 --facets 1x1", &lamps, &format!("--method {method}"));
        assert!((flat[0] / published - 1.0).abs() < 0.2, "{method}: {flat:?}, published {published}");
        assert!(fold[0] < 0.5 * flat[0] && fold[1] < 0.6 * flat[1], "{method}: {flat:?} {fold:?}");
    }
}

/// Eq. (36), smoothness, interior point; the light goes through all its bounces.
#[test]
fn the_papers_estimator_reaches_its_figures() {
    for camera in ["canon-5d-mark-ii", "sigma-sd-merrill"] {
        let ours = scores("vkernel", &format!("--camera {camera}"), "--prior smooth --smoothness 1e-8");
        assert!(ours[0] < FOLD[0] && ours[1] < FOLD[1], "{camera}: {ours:?}, published {FOLD:?}");
    }
}

/// The figures of README's table, with room for what other processors round.
#[test]
fn one_light_is_better_than_published() {
    for camera in ["canon-5d-mark-ii", "sigma-sd-merrill", "nikon-d5100"] {
        let ours = scores("vkernel", &format!("--camera {camera}"), "");
        assert!(ours[0] < 0.5 * FOLD[0] && ours[1] < 0.5 * FOLD[1], "{camera}: {ours:?}, published {FOLD:?}");
    }
}
