//! Estimates of sheets whose spectra are known, with every setting that `vestimate` and the photograph have.

use std::path::Path;

use vfold::estimate::prior::Prior;
use vfold::estimate::{Estimate, map};
use vfold::paper::components::{FlatSheet, autocorrelation};
use vfold::paper::{khan, park, smooth};
use vfold::score::rmse;

use crate::common::timed_once;
use crate::point::Point;
use crate::samples::{Batch, Shot};
use crate::tools::shell;

const NOISES: [&str; 2] = ["0", "1e-3"];
/// Grids of facets on each panel.
const FACETS: [&str; 5] = ["1x1", "2x2", "4x4", "10x10", "20x20"];
/// Distance of wavelengths, in steps of the photograph's 5 nm.
const STEPS: [usize; 2] = [2, 4];
/// Noise that is assumed, relative to the true one.
const ASSUMED: [f64; 2] = [0.1, 10.0];
/// Weights of smoothness of the paper's estimator.
const SMOOTHNESS: [f64; 5] = [0.0, 1e-8, 1e-6, 1e-4, 1e-2];
/// Components that three channels allow the paper's rivals.
const COMPONENTS: usize = 3;

/// Prints a row an estimator and setting, for the ColorChecker and each further set.
pub fn measure(sets: &[&str]) {
    for set in std::iter::once("cc24").chain(sets.iter().copied()) {
        for noise in NOISES {
            let name = Path::new(set).file_stem().unwrap_or_default().to_string_lossy();
            let panel = format!("{name}: facet noise {noise}");
            eprintln!("{panel}");
            folded(&panel, set, noise);
            flat(&panel, set, noise);
        }
    }
}

/// Facets of sheets of a set; further flags for vkernel, and for the scene that they are thought to be of if
/// it is another one.
fn photograph(set: &str, noise: &str, flags: &str, believed: &str) -> Batch {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("samples.ndjson");
    let script = "photo() { vkernel $1 | vforward --reflectance \"$set\" --camera canon-5d-mark-ii \
        --noise-sd $noise $2; }
        { photo \"$flags\" \"$believed\" | head -n 1; photo \"$flags\" '' | tail -n +2; } >\"$path\"";
    let variables = [("set", set), ("noise", noise), ("flags", flags), ("believed", believed)];
    let made = shell(script).envs(variables).env("path", &path).status();
    assert!(made.unwrap().success());
    Batch::read(path.to_str().unwrap()).unwrap()
}

fn prior(batch: &Batch) -> Prior {
    Prior::built_in(batch.grid.wavelengths_nm()).unwrap()
}

fn folded(panel: &str, set: &str, noise: &str) {
    for facets in FACETS {
        let batch = photograph(set, noise, &format!("--facets {facets}"), "");
        let prior = prior(&batch);
        score(panel, "default; --facets", facets, &batch, 1, |shot| {
            map::estimate(&shot.data(&batch.scene).unwrap(), &prior, None).unwrap()
        });
    }
    for step in STEPS {
        let nm = (5 * step).to_string();
        let batch = photograph(set, noise, "", &format!("--wavelengths-nm 400:700:{nm}"));
        let prior = prior(&batch);
        score(panel, "default; wavelengths by", &format!("{nm} nm"), &batch, step, |shot| {
            map::estimate(&shot.data(&batch.scene).unwrap(), &prior, None).unwrap()
        });
    }
    let batch = photograph(set, noise, "", "");
    let prior = prior(&batch);
    // Without noise there is none that could be mistaken.
    let assumed = if noise == "0" { &[] } else { ASSUMED.as_slice() };
    for times in assumed {
        score(panel, "default; --noise-sd x true", &times.to_string(), &batch, 1, |shot| {
            map::estimate(&shot.clone().with_noise(*times).data(&batch.scene).unwrap(), &prior, None).unwrap()
        });
    }
    let grey = vec![0.5; batch.grid.len()];
    for weight in SMOOTHNESS {
        score(panel, "--prior smooth --smoothness", &format!("{weight:e}"), &batch, 1, |shot| {
            smooth::estimate(&shot.unweighted(&batch.scene).unwrap(), weight, &grey).unwrap()
        });
    }
}

/// The paper's rivals, on a flat sheet in the same light.
fn flat(panel: &str, set: &str, noise: &str) {
    let batch = photograph(set, noise, "--angle-deg 180 --facets 1x1", "");
    let basis = autocorrelation(&batch.chips().unwrap());
    let sheet = |shot: &Shot| FlatSheet::new(batch.scene.facets(), &shot.measured(), shot.exposure).unwrap();
    score(panel, "flat: park", "", &batch, 1, |shot| {
        park::estimate(&sheet(shot), &basis, COMPONENTS, 1e-4).unwrap()
    });
    score(panel, "flat: khan", "", &batch, 1, |shot| {
        khan::estimate(&sheet(shot), &basis, COMPONENTS, 0.0).unwrap()
    });
}

/// Prints median time and mean RMSE; estimates have every `step`-th waveband of the truth.
fn score(
    panel: &str,
    series: &str,
    setting: &str,
    batch: &Batch,
    step: usize,
    estimate: impl Fn(&Shot) -> Estimate,
) {
    let (mut times, mut sum) = (Vec::new(), 0.0);
    for shot in &batch.shots {
        let (ms, made) = timed_once(|| estimate(shot));
        times.push(ms);
        let truth: Vec<f64> = shot.truth.iter().step_by(step).copied().collect();
        sum += rmse(&truth, &made.reflectance);
    }
    times.sort_by(f64::total_cmp);
    let error = sum / batch.shots.len() as f64;
    Point::print(panel, series, setting, (times[times.len() / 2], error));
}
