//! How often error bars hold the truth, on sets that the prior was not made of, through cameras and in lights
//! that are not those of the examples. The table is printed
//! (`cargo test --test tools coverage -- --nocapture`).

use std::fs;

use serde_json::Value;

use crate::common::{Workdir, is_there};

const DATA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data");
/// Sets of `../shared/data/reflectance`.
const SETS: [&str; 6] = [
    "colorchecker24_iso17321",
    "colorchecker_sg140",
    "aces190",
    "vrhel_dupont_paint120",
    "vrhel_nature79",
    "vrhel_objects_nocloth129",
];
/// Cameras that are not built in, each with a light; they take turns.
const SETTINGS: [(&str, &str); 4] =
    [("nikon_d700", "A"), ("sony_ilce_7m4", "D50"), ("fujifilm_x_t3", "FL11"), ("canon_eos_r5", "LED-V1")];
const NOISES: [&str; 3] = ["0", "1e-3", "1e-2"];
/// Shares of true values within one and two standard deviations: of every set, and of all of them. Paints,
/// which are like the chips, have bars that are too wide at the largest noise, so that those of sets unlike
/// any class are wide enough.
const OF_A_SET: [(f64, f64); 2] = [(0.6, 0.84), (0.86, 0.987)];
const OF_ALL: [(f64, f64); 2] = [(0.6, 0.8), (0.88, 0.97)];

/// Shares within one and two standard deviations of all wavebands, of 400 to 420 nm and of 680 to 700 nm, and
/// the mean RMSE.
struct Row {
    shares: [[f64; 2]; 3],
    rmse: f64,
}

#[test]
fn bars_hold_on_sets_that_the_prior_was_not_made_of() {
    if !is_there(DATA) {
        return;
    }
    let mut all = Vec::new();
    for (n, set) in SETS.iter().enumerate() {
        for (m, noise) in NOISES.iter().enumerate() {
            let (camera, light) = SETTINGS[(n + m) % SETTINGS.len()];
            let exposure = ["1", "free"][(n / 2 + m) % 2];
            let row = row(set, noise, (camera, light), exposure);
            let told = format!("{set:25} noise {noise:4} {camera:13} {light:6} exposure {exposure:4}");
            let shares = row.shares.map(|[one, two]| format!("{:3.0} {:3.0}", 100.0 * one, 100.0 * two));
            println!("{told} RMSE {:.4}  {} | {} | {}", row.rmse, shares[0], shares[1], shares[2]);
            for (share, (least, most)) in row.shares[0].iter().zip(OF_A_SET) {
                assert!((least..=most).contains(share), "{told}: {share:.3}");
            }
            all.push(row);
        }
    }
    for (part, name) in ["all", "400 to 420 nm", "680 to 700 nm"].iter().enumerate() {
        let mean = [0, 1].map(|k| all.iter().map(|row| row.shares[part][k]).sum::<f64>() / all.len() as f64);
        println!("{name}: {:.3} {:.3}", mean[0], mean[1]);
        for (share, (least, most)) in mean.iter().zip(OF_ALL) {
            assert!((least..=most).contains(share), "{name}: {share:.3}");
        }
    }
}

fn row(set: &str, noise: &str, (camera, light): (&str, &str), exposure: &str) -> Row {
    let folder = Workdir::new();
    fs::write(folder.path().join("set.csv"), of_sheets(set)).unwrap();
    let run = folder.sh(&format!(
        "vkernel | vforward --reflectance set.csv --noise-sd {noise} --camera {DATA}/cameras/{camera}.csv \
            --illuminant {light} |
             vestimate -q --exposure {exposure}"
    ));
    assert_eq!(run.status, 0, "{set}: {}", run.stderr);
    let records = run.stdout.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
    let samples: Vec<Value> = records.filter(|record| record["kind"] == "sample").collect();
    let numbers = |value: &Value| -> Vec<f64> {
        value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
    };
    let (mut held, mut counts, mut rmse) = ([[0.0; 2]; 3], [0.0; 3], 0.0);
    for sample in &samples {
        let estimate = &sample["estimate"];
        let [nm, found, sd, truth] = [
            &estimate["wavelengths_nm"],
            &estimate["reflectance"],
            &estimate["reflectance_sd"],
            &sample["truth"]["reflectance"],
        ]
        .map(numbers);
        let off: Vec<f64> = found.iter().zip(&truth).map(|(found, truth)| (found - truth).abs()).collect();
        rmse += (off.iter().map(|off| off * off).sum::<f64>() / off.len() as f64).sqrt();
        for (band, off) in off.iter().enumerate() {
            for (part, counted) in [true, nm[band] <= 420.0, nm[band] >= 680.0].iter().enumerate() {
                if *counted {
                    counts[part] += 1.0;
                    held[part][0] += f64::from(u8::from(*off < sd[band]));
                    held[part][1] += f64::from(u8::from(*off < 2.0 * sd[band]));
                }
            }
        }
    }
    let mut shares = held;
    for (share, count) in shares.iter_mut().zip(counts) {
        share.iter_mut().for_each(|share| *share /= count);
    }
    Row { shares, rmse: rmse / samples.len() as f64 }
}

/// A set without what is above 1 (it fluoresces, or was scaled wrongly).
fn of_sheets(set: &str) -> String {
    let text = fs::read_to_string(format!("{DATA}/reflectance/{set}.csv")).unwrap();
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    let is_sheet = |column: usize| {
        column == 0 || rows[1..].iter().all(|row| row[column].parse::<f64>().is_ok_and(|value| value <= 1.0))
    };
    let kept: Vec<usize> = (0..rows[0].len()).filter(|column| is_sheet(*column)).collect();
    let line = |row: &Vec<&str>| kept.iter().map(|column| row[*column]).collect::<Vec<_>>().join(",") + "\n";
    rows.iter().map(line).collect()
}
