//! What cannot be told from the facets is refused, or its error bars say so.

use serde_json::Value;

use crate::common::Workdir;

/// What vestimate makes of the red patch, photographed and estimated with these flags.
fn estimated(photographed: &str, flags: &str) -> Value {
    let folder = Workdir::new();
    let line =
        format!("{photographed} > seen; vestimate -q {flags} < seen > out || [ $? = 3 ]; tail -n 1 out");
    let run = folder.sh(&line);
    assert!(run.status == 0 && run.said_otherwise().is_empty(), "{line}: {run:?}");
    assert!(!run.stdout.contains("NaN"), "{line}");
    serde_json::from_str(&run.stdout).unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

/// Largest error, largest error in units of its standard deviation, smallest and largest standard deviation.
fn errors(sample: &Value) -> [f64; 4] {
    let estimate = &sample["estimate"];
    let [found, truth, sd] =
        [&estimate["reflectance"], &sample["truth"]["reflectance"], &estimate["reflectance_sd"]].map(numbers);
    let off = || found.iter().zip(&truth).map(|(found, truth)| (found - truth).abs());
    let largest = |numbers: &mut dyn Iterator<Item = f64>| numbers.fold(0.0, f64::max);
    [
        largest(&mut off()),
        largest(&mut off().zip(&sd).map(|(off, sd)| off / sd)),
        sd.iter().copied().fold(f64::INFINITY, f64::min),
        largest(&mut sd.iter().copied()),
    ]
}

const FOLD: &str = "vkernel | vforward --reflectance cc24:red";
const SHEET: &str = "vkernel --angle-deg 180 --facets 1x1 | vforward --reflectance cc24:red";

#[test]
fn facets_that_no_sheet_has_are_refused() {
    let unexplained = "% of the light; check exposure, noise, angle";
    for (seen, flags, says) in [
        (format!("{FOLD} --exposure 10"), "--exposure 1", unexplained),
        (format!("{FOLD} --exposure 1e3 --noise-sd 1"), "--exposure 1", unexplained),
        (format!("{FOLD} --exposure 1e6"), "--exposure 1", unexplained),
        (format!("{FOLD} --exposure 1e6"), "--exposure 1 --prior smooth", unexplained),
        (format!("{FOLD} --exposure 1e-6"), "--exposure 1 --prior smooth", unexplained),
        (format!("{SHEET} --exposure 1e6"), "--exposure 1 --method park", unexplained),
        (format!("{SHEET} --exposure 1e6"), "--exposure 1 --method khan", unexplained),
        (format!("{FOLD} --noise-sd 10"), "--noise-sd 1e-3", unexplained),
        (format!("{FOLD} --exposure 1e-300"), "", "no light in any facet"),
        (format!("{FOLD} --exposure 1e300"), "", "cannot be the value of a facet"),
        ("vkernel | vforward --reflectance 0".to_owned(), "", "no light in any facet"),
        (SHEET.to_owned(), "--method khan --exposure free", "a flat sheet does not reveal it"),
    ] {
        let sample = estimated(&seen, flags);
        let error = sample["error"].as_str().unwrap_or("");
        assert!(error.contains(says), "{seen} | vestimate {flags}: '{error}', {}", sample["estimate"]);
    }
}

/// Everything is known but what the facets do not tell: most errors are within a few standard deviations.
#[test]
fn error_bars_hold_what_is_not_told() {
    for (seen, flags) in [
        (SHEET.to_owned(), ""),
        (SHEET.to_owned(), "--exposure free"),
        (format!("{SHEET} --noise-sd 1e-3"), "--fit exposure,tilt,sky"),
        ("vkernel --facets 1x1 | vforward --reflectance cc24:red".to_owned(), "--exposure free"),
        ("vkernel --angle-deg 0.1 --mesh facets | vforward --reflectance cc24:red".to_owned(), ""),
        (format!("{FOLD} --noise-sd 1"), ""),
        (format!("{FOLD} --noise-sd 1e6"), ""),
        (FOLD.to_owned(), "--noise-sd 0"),
        (FOLD.to_owned(), "--noise-sd 1e300"),
        (format!("{FOLD} --illuminant D65 --illuminant D65"), ""),
        (format!("{FOLD} --exposure 1.5"), "--exposure 1"),
        (format!("{FOLD} --exposure 4"), "--exposure 1"),
        ("vkernel | vforward --reflectance 1 --noise-sd 1e-3".to_owned(), ""),
        ("vkernel | vforward --reflectance 1e-3 --noise-sd 1e-3".to_owned(), ""),
    ] {
        let [_, off, _, widest] = errors(&estimated(&seen, flags));
        assert!(off < 6.0 && widest <= 0.5 + 1e-9, "{seen} | vestimate {flags}: {off} sd, up to {widest}");
    }
}

#[test]
fn an_estimate_without_data_is_wide() {
    for (seen, flags, least) in [
        (format!("{FOLD} --noise-sd 1e6"), "", 0.1),
        (FOLD.to_owned(), "--noise-sd 1e300", 0.1),
        (format!("{FOLD} --exposure 1.5"), "--exposure 1", 0.49),
        (format!("{FOLD} --exposure 4"), "--exposure 1", 0.49),
    ] {
        let [_, _, narrowest, _] = errors(&estimated(&seen, flags));
        assert!(narrowest > least, "{seen} | vestimate {flags}: {narrowest}");
    }
}

#[test]
fn brightness_is_no_precision() {
    for exposure in ["1e-9", "1", "1e9"] {
        for flags in ["", "--exposure free"] {
            let [largest, off, ..] = errors(&estimated(&format!("{FOLD} --exposure {exposure}"), flags));
            assert!(largest < 0.01 && off < 5.0, "{exposure} {flags}: {largest}, {off} sd");
        }
    }
}

/// What one or two channels see may be spectra of many kinds: the largest error of all patches, in standard
/// deviations a waveband.
#[test]
fn few_channels_are_no_precision() {
    let folder = Workdir::new();
    let tables = folder.sh(r"
        { echo wavelength,grey; for nm in $(seq 380 5 780); do echo $nm,1; done; } > one.csv
        { echo wavelength,short,long
          for nm in $(seq 380 5 780); do
              echo $nm,$((nm < 560 ? 9 : 1)),$((nm < 560 ? 1 : 8))
          done; } > two.csv");
    assert_eq!((tables.status, tables.stderr.as_str()), (0, ""));
    for camera in ["one.csv", "two.csv"] {
        for exposure in ["1", "free"] {
            let line = format!(
                "vkernel | vforward --camera {camera} --reflectance cc24 --noise-sd 1e-3 \
                    | vestimate -q --exposure {exposure}"
            );
            let run = folder.sh(&line);
            assert_eq!((run.status, run.stderr.as_str()), (0, ""), "{line}");
            let samples: Vec<Value> =
                run.stdout.lines().skip(1).map(|line| serde_json::from_str(line).unwrap()).collect();
            let off = samples.iter().map(|sample| errors(sample)[1]).fold(0.0, f64::max);
            assert!(samples.len() == 24 && off < 10.0, "{line}: {off}");
        }
    }
}
