//! Estimates through the tools at the ends of the range of reflectances, and what is said of their errors;
//! published figures are in `tests/numbers/published`.

#[path = "../../benches/common/many_spectra.rs"]
mod many_spectra;

use std::fs;

use serde_json::Value;
use vfold::estimate::classes;
use vfold::estimate::prior::classes_of;
use vfold::spectrum::{Outside, WavelengthGrid, reflectances};

use crate::common::Workdir;
use many_spectra::many_spectra;

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

#[test]
fn dark_and_bright_greys_are_recovered() {
    let greys = "0.003 0.01 0.1 0.5 0.9 0.97 1";
    for (name, rmse, _) in scores(&format!("vkernel | vforward --reflectance {greys} | vestimate | vscore")) {
        let tolerance = 0.02 * name.parse::<f64>().unwrap().max(0.05);
        assert!(rmse < tolerance, "{name}: RMSE {rmse}");
    }
}

#[test]
fn no_spectrum_takes_many_times_the_steps_of_most() {
    let folder = Workdir::new();
    fs::write(folder.path().join("spectra.csv"), many_spectra(199)).unwrap();
    for noise in ["0", "1e-3"] {
        let line = format!("vkernel | vforward --reflectance spectra.csv --noise-sd {noise} | vestimate");
        let run = folder.sh(&line);
        assert_eq!(run.status, 0, "{line}: {}", run.stderr);
        let records = run.stdout.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
        let estimates: Vec<Value> = records.map(|record| record["estimate"].clone()).collect();
        // an edge within 3 nm, which no class has, is not explained to a millionth, and that is said
        let far = estimates.iter().filter(|estimate| estimate["residual_rms"].as_f64() > Some(5.0)).count();
        assert!(far <= 1 && run.stderr.lines().count() == far, "{line}: {}", run.stderr);
        let mut steps: Vec<u64> =
            estimates.iter().filter_map(|estimate| estimate["iterations"].as_u64()).collect();
        steps.sort_unstable();
        let [median, most] = [steps[steps.len() / 2], steps[steps.len() - 1]];
        println!("noise {noise}: {} spectra, median {median} steps, at most {most}", steps.len());
        assert!(steps.len() == 199 && most <= 10 * median, "{noise}: {median}, {most}");
    }
}

/// Without noise some spectrum explains the facets: however improbable, the camera is the stated one.
#[test]
fn a_steep_edge_is_no_error_of_the_camera() {
    let edges = r#"awk 'BEGIN {
        print "nm,edge,steeper"
        for (nm = 400; nm <= 700; nm += 5)
            printf "%d,%.6f,%.6f\n", nm, 0.03 + 0.714 / (1 + exp((nm - 656.6) / 10.8)),
                0.03 + 0.474 / (1 + exp((nm - 632.6) / 4))
    }' > edges.csv"#;
    let scores = scores(&format!("{edges}\nvkernel | vforward --reflectance edges.csv | vestimate | vscore"));
    assert!(scores.len() == 2 && scores.iter().all(|(_, rmse, _)| *rmse < 0.03), "{scores:?}");
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

/// Estimates of the chart's patches, with their standard deviations and the truth.
fn estimates(script: &str) -> Vec<[Vec<f64>; 3]> {
    let run = Workdir::new().sh(script);
    assert_eq!((run.status, run.stderr.as_str()), (0, ""), "{script}");
    let records = run.stdout.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
    let spectrum = |value: &Value| value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect();
    records
        .filter(|record| record["kind"] == "sample")
        .map(|record| {
            let estimate = &record["estimate"];
            assert_eq!(estimate["termination"]["reason"], "converged", "{}", record["id"]);
            [&estimate["reflectance"], &estimate["reflectance_sd"], &record["truth"]["reflectance"]]
                .map(spectrum)
        })
        .collect()
}

/// Gaussian errors: 68 % within one standard deviation, 95 % within two.
#[test]
fn error_bars_hold_what_they_say() {
    for noise in ["1e-3", "1e-2"] {
        let [one, two] =
            held(&format!("vkernel | vforward --reflectance cc24 --noise-sd {noise} | vestimate"));
        assert!((0.6..0.85).contains(&one) && (0.9..0.99).contains(&two), "{noise}: {one:.3} {two:.3}");
    }
}

#[test]
fn error_bars_are_wide_if_the_noise_is_ten_times_what_was_said() {
    let [one, two] =
        held("vkernel | vforward --reflectance cc24 --noise-sd 1e-2 | vestimate -q --noise-sd 1e-3");
    assert!(one > 0.6 && two > 0.9, "{one:.3} {two:.3}");
}

/// Share of true values within one and two standard deviations.
fn held(script: &str) -> [f64; 2] {
    let found = estimates(script);
    let off = found.iter().flat_map(|[reflectance, sd, truth]| {
        reflectance.iter().zip(sd).zip(truth).map(|((r, sd), truth)| ((r - truth) / sd).abs())
    });
    let off: Vec<f64> = off.collect();
    [1.0, 2.0].map(|limit| off.iter().filter(|off| **off < limit).count() as f64 / off.len() as f64)
}

#[test]
fn twenty_starts_end_in_one_place() {
    let starts = "0.02 0.05 0.1 0.2 0.3 0.4 0.5 0.6 0.7 0.8 0.9 0.95 0.98 cc24:red cc24:green cc24:blue \
                  cc24:yellow cc24:white cc24:black munsell:5R6/12";
    let patches = "cc24:dark-skin cc24:orange cc24:cyan cc24:white cc24:black";
    for noise in ["0", "1e-3"] {
        let shot = format!("vkernel | vforward --reflectance {patches} --noise-sd {noise}");
        let reference = estimates(&format!("{shot} | vestimate"));
        let others = estimates(&format!(
            "{shot} > s.ndjson; for start in {starts}; do vestimate --start $start s.ndjson; done"
        ));
        assert_eq!(others.len(), 20 * reference.len());
        for (n, [other, ..]) in others.iter().enumerate() {
            let [one, sd, _] = &reference[n % reference.len()];
            let apart = one.iter().zip(other).zip(sd).map(|((a, b), sd)| ((a - b) / sd).abs());
            let apart = apart.fold(0.0, f64::max);
            assert!(apart < 0.02, "noise {noise}, estimate {n}: {apart} standard deviations apart");
        }
    }
}

/// Facets that do not say how noisy they are: hundreds of them hold a dozen numbers, the rest is noise.
#[test]
fn the_noise_is_told_from_the_facets() {
    let shot = "vkernel | vforward --reflectance cc24:green --noise-sd 2e-3";
    let [told] = estimates(&format!("{shot} | vestimate")).try_into().unwrap();
    let [guessed] =
        estimates(&format!("{shot} | sed 's/\"facet_sd\"/\"not_said\"/' | vestimate")).try_into().unwrap();
    for (told, guessed) in told[1].iter().zip(&guessed[1]) {
        assert!((guessed / told - 1.0).abs() < 0.2, "{told} {guessed}");
    }
}

/// The built-in classes are those that the method finds, and tell greens from reds.
#[test]
fn classes_of_the_munsell_chips_are_as_made() {
    let grid = WavelengthGrid::uniform(400.0, 700.0, 5.0).unwrap();
    let chips = reflectances("munsell").unwrap();
    let spectra: Vec<_> = chips.iter().map(|chip| chip.on(&grid, Outside::Refuse).unwrap()).collect();
    let classes = classes::of_munsell();
    // Rounding of the last bit may move a chip between two classes.
    let found = classes_of(grid.wavelengths_nm(), &spectra);
    let moved = classes.iter().zip(&found).filter(|(a, b)| a != b).count();
    assert_eq!(classes.len(), 1269);
    assert!(moved <= 3, "{moved} chips in other classes");
    let class = |name: &str| classes[chips.iter().position(|chip| chip.name() == name).unwrap()];
    assert_ne!(class("munsell:5R5/10"), class("munsell:5G5/8"));
}
