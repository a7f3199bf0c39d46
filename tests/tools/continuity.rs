//! From a computed picture of an ideal fold to one with all effects: estimates and error bars change little
//! by little.
//!
//! The picture that is exactly the one that was stated is one of its own: it tells more than any other, and
//! its estimate lies within the bars of the next.

use serde_json::Value;

use super::real_sheets::numbers;
use crate::common::Workdir;

const STEPS: usize = 20;

struct Estimate {
    reflectance: Vec<f64>,
    sd: Vec<f64>,
}

/// A sheet of which gloss, roughness and sky, what is off in angle, tilt and daylight are so large a part of
/// what is usual.
fn estimate(folder: &Workdir, sheet: &str, part: f64) -> Estimate {
    let [angle, tilt, sky] = [55.0 + 1.2 * part, 2.0 * part, 0.12 * part];
    let [daylight, specular_weight, roughness] = [6504.0 - 1204.0 * part, 0.4 * part, 15.0 * part];
    let render = format!(
        "vkernel --angle-deg {angle} --tilt-deg {tilt} --sky {sky} |
         vforward -q --reflectance '{sheet}' --illuminant daylight:{daylight} \
           --sky-illuminant daylight:11000 --specular-weight {specular_weight} --specular-roughness 0.42 \
           --body-roughness-deg {roughness} --exposure 0.7 --noise-sd 1e-3 --photon-noise 1e-2 --seed 1 \
           --render picture.tif --render-size 400x300"
    );
    let run = folder.sh(&render);
    assert_eq!(run.status, 0, "{}", run.stderr);
    let sample: Value = serde_json::from_str(run.stdout.lines().last().unwrap()).unwrap();
    let corners = |panel: &str| {
        let corner = |corner: &Value| format!("{},{}", corner[0], corner[1]);
        sample["regions"][panel].as_array().unwrap().iter().map(corner).collect::<Vec<_>>().join(" ")
    };
    let run = folder.sh(&format!(
        "vkernel --angle-deg 55 |
         vextract -q picture.tif --camera canon-5d-mark-ii --illuminant D65 --panel0 '{}' --panel1 '{}' |
         vestimate -q",
        corners("panel0"),
        corners("panel1")
    ));
    assert_eq!(run.status, 0, "{}", run.stderr);
    let sample: Value = serde_json::from_str(run.stdout.lines().last().unwrap()).unwrap();
    let of = |field: &str| numbers(&sample["estimate"][field]);
    Estimate { reflectance: of("reflectance"), sd: of("reflectance_sd") }
}

fn rms(off: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = off.len() as f64;
    (off.map(|off| off * off).sum::<f64>() / count).sqrt()
}

fn apart(a: &[f64], b: &[f64]) -> f64 {
    rms(a.iter().zip(b).map(|(a, b)| a - b))
}

/// Steps between neighbours, and the one in the middle.
fn steps(all: &[Estimate]) -> (Vec<f64>, f64) {
    let steps: Vec<f64> =
        all.windows(2).map(|pair| apart(&pair[0].reflectance, &pair[1].reflectance)).collect();
    let mut sorted = steps.clone();
    sorted.sort_by(f64::total_cmp);
    (steps, sorted[sorted.len() / 2])
}

#[test]
fn nothing_jumps_between_ideal_and_real() {
    let folder = Workdir::new();
    for sheet in ["cc24:foliage", "cc24:neutral-6-5"] {
        let all: Vec<_> = (0..=STEPS).map(|n| estimate(&folder, sheet, n as f64 / STEPS as f64)).collect();
        let [ideal, next, ..] = &all[..] else { unreachable!("{STEPS} steps") };
        let off = ideal.reflectance.iter().zip(&next.reflectance).zip(&next.sd);
        let off = rms(off.map(|((a, b), sd)| (a - b) / sd).collect::<Vec<_>>().into_iter());
        assert!(off < 2.0, "{sheet}: the ideal one is {off} standard deviations from the next");
        let (steps, middle) = steps(&all[1..]);
        let most = steps.iter().copied().fold(0.0, f64::max);
        println!(
            "{sheet}: ideal {off:.2} sd from the next; steps of at most {most:.4}, {middle:.4} in the middle"
        );
        for (step, one) in steps.iter().zip(&all[1..]) {
            // what is less than a tenth of its bars is no jump, however little the others are
            let least = 0.1 * rms(one.sd.iter().copied());
            assert!(*step < (3.0 * middle).max(least), "{sheet}: a step of {step} among steps of {middle}");
        }
        // bars change by no more than a quarter of themselves
        for pair in all[1..].windows(2) {
            let change = apart(&pair[0].sd, &pair[1].sd) / rms(pair[0].sd.iter().copied());
            assert!(change < 0.25, "{sheet}: error bars change by {change}");
        }
    }
}
