//! A fold of a known sheet beside those that are estimated.

use serde_json::Value;

use crate::common::{Ended, Workdir};

/// The ColorChecker in a light, and a grey fold in it, as `chips-LIGHT.ndjson` and `card-LIGHT.ndjson`.
fn computed(light: &str) -> String {
    format!(
        "vkernel | vforward -q --reflectance cc24 --illuminant {light} --noise-sd 1e-3 -o chips-{light}.ndjson
        vkernel | vforward -q --reflectance 0.5 --illuminant {light} --noise-sd 1e-3 \
            --seed 7 -o card-{light}.ndjson\n"
    )
}

fn samples(run: &Ended) -> Vec<Value> {
    assert_eq!(run.status, 0, "{run:?}");
    let records = run.stdout.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
    records.filter(|record| record["kind"] == "sample").collect()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

/// Mean RMSE, and share of true values within two standard deviations.
fn errors(all: &[Value], truths: &[Vec<f64>]) -> (f64, f64) {
    let (mut sum, mut held, mut count) = (0.0, 0, 0);
    for (sample, truth) in all.iter().zip(truths) {
        let [found, sd] = ["reflectance", "reflectance_sd"].map(|name| numbers(&sample["estimate"][name]));
        let off: Vec<f64> = found.iter().zip(truth).map(|(a, b)| (a - b).abs()).collect();
        sum += (off.iter().map(|off| off * off).sum::<f64>() / off.len() as f64).sqrt();
        held += off.iter().zip(&sd).filter(|(off, sd)| **off <= 2.0 * **sd).count();
        count += off.len();
    }
    (sum / all.len() as f64, held as f64 / count as f64)
}

fn own_truths(all: &[Value]) -> Vec<Vec<f64>> {
    all.iter().map(|sample| numbers(&sample["truth"]["reflectance"])).collect()
}

/// In light that is unknown nearly as near as in one that is stated; where it is stated, the exposure is
/// known.
#[test]
fn chips_are_nearer_beside_a_known_fold() {
    let run = |light: &str, flags: &str| {
        let made = computed(light);
        samples(
            &Workdir::new().sh(&format!("{made} vestimate -q --exposure free {flags} chips-{light}.ndjson")),
        )
    };
    let of = |all: &[Value]| errors(all, &own_truths(all));
    for light in ["D65", "FL11"] {
        let known = format!("--known-fold card-{light}.ndjson=0.5");
        let stated = of(&run(light, ""));
        let stated_beside = of(&run(light, &known));
        let unknown = of(&run(light, "--illuminant unknown"));
        let unknown_beside = of(&run(light, &format!("--illuminant unknown {known}")));
        println!(
            "{light}: stated {stated:.4?}, beside it {stated_beside:.4?}, unknown {unknown:.4?}, \
             beside it {unknown_beside:.4?}"
        );
        assert!(stated_beside.0 < 0.97 * stated.0 && stated_beside.1 > 0.9);
        // a fifth and more where D65 was not found between two candidates
        assert!(unknown_beside.0 < 0.9 * unknown.0 && unknown_beside.1 > 0.9);
        assert!(unknown_beside.0 < 1.2 * stated_beside.0);
    }
}

/// A daylight that is stated for another passes for it where sheets are unknown.
#[test]
fn a_light_that_is_stated_wrongly_is_named_by_a_known_fold() {
    let made = computed("D50") + &computed("D65");
    let run = Workdir::new().sh(&format!(
        "{made}
        for what in chips card; do
            {{ head -n 1 $what-D65.ndjson; tail -n +2 $what-D50.ndjson; }} > wrong-$what.ndjson
        done
        vestimate -q --known-fold wrong-card.ndjson=0.5 wrong-chips.ndjson
        vestimate -q --known-fold card-D50.ndjson=0.5 chips-D50.ndjson"
    ));
    let because = |sample: &Value| sample["estimate"]["verdict"]["because"].as_str().unwrap().to_owned();
    let named = |sample: &Value| because(sample).contains("by the known fold, daylight:5000 is");
    let all = samples(&run);
    let (wrong, right) = all.split_at(24);
    assert!(wrong.iter().all(named), "{:?}", wrong.iter().map(because).collect::<Vec<_>>());
    assert!(!right.iter().any(|sample| because(sample).contains("known fold")));
}

/// Rendered sheets with a glossy surface, whose light is unknown; the known sheet is folded, or lies flat and
/// shows the colour of the light alone.
#[test]
fn photographs_are_nearer_beside_a_known_fold() {
    let chips = ["orange", "foliage", "blue-flower", "moderate-red", "yellow-green", "neutral-5"];
    let names = chips.map(|chip| format!("cc24:{chip}")).join(" ");
    let run = Workdir::new().sh(&format!(
        "photograph() {{
            vforward $3.json --reflectance $2 --illuminant D50 \
                --specular-weight 0.5 --specular-roughness 0.4 --exposure 0.5 --render $1.exr \
                --render-size 320x240 -o $1.json 2> render.log
            vextract $1.exr --regions $1.json --scene $3.json --camera canon-5d-mark-ii \
                --illuminant unknown -q
        }}
        vkernel -o scene.json
        vkernel --angle-deg 180 -o flat.json
        photograph card 0.5 scene > card.ndjson
        photograph paper 0.5 flat > paper.ndjson
        for chip in {chips}; do photograph $chip cc24:$chip scene; done > sheets.ndjson
        vforward -q scene.json --reflectance {names}
        vestimate -q sheets.ndjson
        vestimate -q --known-fold card.ndjson=0.5 sheets.ndjson
        vestimate -q --known-fold paper.ndjson=0.5 sheets.ndjson",
        chips = chips.join(" ")
    ));
    let all = samples(&run);
    let (truths, estimates) = all.split_at(chips.len());
    let truths = own_truths(truths);
    let of_run = |n: usize| errors(&estimates[n * chips.len()..][..chips.len()], &truths);
    let [alone, beside, beside_flat] = [0, 1, 2].map(of_run);
    println!("alone {alone:.4?}, beside a known fold {beside:.4?}, a flat sheet {beside_flat:.4?}");
    assert!(beside.0 < 0.85 * alone.0 && beside.1 > 0.9, "{alone:?} {beside:?}");
    assert!(beside_flat.0 < 0.95 * alone.0 && beside_flat.1 > 0.9, "{alone:?} {beside_flat:?}");
}

/// What cannot be the known fold is refused in a line.
#[test]
fn what_cannot_be_the_known_fold_is_refused() {
    let folder = Workdir::new();
    let made = folder.sh(&format!(
        "{}{}
        vkernel | vforward -q --reflectance 0.5 --illuminant D65 --camera nikon-d5100 -o nikon.ndjson
        vkernel | vforward -q --reflectance 0.5 --illuminant D65 --wavelengths-nm 400:700:10 -o bands.ndjson
        vkernel | vforward -q --reflectance 0.5 --illuminant D65 --exposure 0.5 -o dark.ndjson
        head -n 1 card-D65.ndjson > scene.ndjson
        sed 's/\"facet_rgb\"/\"facets\"/' card-D65.ndjson > no-facets.ndjson
        printf 'nm,r\\n450,0.5\\n650,0.5\\n' > short.csv",
        computed("D65"),
        computed("A")
    ));
    assert_eq!(made.status, 0, "{made:?}");
    for (known, status, said) in [
        ("card-D65.ndjson", 2, "FILE=SPEC"),
        ("gone.ndjson=0.5", 1, "gone.ndjson"),
        ("card-D65.ndjson=cc24", 2, "is a set"),
        ("card-D65.ndjson=short.csv", 1, "its samples cover"),
        ("scene.ndjson=0.5", 1, "no scene followed by a sample"),
        ("chips-D65.ndjson=0.5", 1, "second sample"),
        ("no-facets.ndjson=0.5", 1, "facet_rgb"),
        ("nikon.ndjson=0.5", 2, "one camera"),
        ("bands.ndjson=0.5", 2, "wavelengths"),
        ("card-A.ndjson=0.5", 2, "in its light"),
        ("card-D65.ndjson=0.5 --prior smooth", 2, "needs a prior"),
        ("card-D65.ndjson=0.5 --join", 2, "--join"),
    ] {
        let run = folder.sh(&format!("vestimate chips-D65.ndjson --known-fold {known}"));
        assert_eq!(run.status, status, "{known}: {run:?}");
        assert!(run.stderr.contains(said) && run.stderr.lines().count() == 1, "{known}: {}", run.stderr);
        assert!(run.stdout.is_empty(), "{known}");
    }
    let run = folder.sh("vestimate -q chips-D65.ndjson --exposure free --known-fold dark.ndjson=0.5");
    assert!(run.status == 3 && run.stdout.contains("the known fold's is 0.5"), "{run:?}");
}
