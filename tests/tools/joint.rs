//! Several photographs of one sheet, estimated together.

use std::path::{Path, PathBuf};

use serde_json::Value;

use super::real_sheets::{Outcome, numbers, outcome, print_table, real_records};
use crate::common::{Ended, Workdir, left_out};

const SHARED: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/real");

fn samples(run: &Ended) -> Vec<Value> {
    let records = run.stdout.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
    records.filter(|record| record["kind"] == "sample").collect()
}

/// What comes of these photographs together, each record of them the same.
fn together(paths: &[PathBuf]) -> Outcome {
    let folder = Workdir::new();
    let name = |path: &Path| path.file_stem().unwrap().to_string_lossy().into_owned();
    let records: Vec<String> = paths.iter().map(|path| format!("{}.ndjson", name(path))).collect();
    let made: String =
        paths.iter().zip(&records).map(|(path, file)| real_records(path, file) + "\n").collect();
    let join = match paths.len() {
        1 => String::new(),
        _ => format!("--join={}", paths.iter().map(|path| name(path)).collect::<Vec<_>>().join(",")),
    };
    let run = folder.sh(&format!("{made}cat {} | vestimate -q {join}", records.join(" ")));
    assert!(run.status == 0, "{}", run.stderr);
    let samples = samples(&run);
    assert!(samples.len() == paths.len());
    let spectrum = |sample: &Value| numbers(&sample["estimate"]["reflectance"]);
    assert!(samples.iter().all(|sample| spectrum(sample) == spectrum(&samples[0])));
    let joined = samples[0]["estimate"]["joined"].as_array().map_or(0, Vec::len);
    assert!(joined == if paths.len() > 1 { paths.len() } else { 0 });
    let sidecar = serde_json::from_str::<Value>(&std::fs::read_to_string(&paths[0]).unwrap()).unwrap();
    let truth = numbers(&sidecar["reflectance"]);
    outcome(&PathBuf::from(records.join("+").replace(".ndjson", "")), &samples[0], &truth, <[f64]>::to_vec)
}

/// One painted sheet at two angles and from two sides: path traced, with all that real sheets and cameras
/// have. The truth is the reflectance with which it was traced.
///
/// What more photographs promise is smaller error bars, so these must shrink, and still hold: in the long run
/// 95 % of the wavelengths of such bars are within two of them, of a single sheet, whose errors are alike at
/// neighbouring wavelengths, fewer. The error itself is one draw, which may be a little larger than the mean
/// of those alone.
#[test]
fn error_bars_of_photographs_together_are_smaller_and_hold() {
    let paths = ["all_green_paint", "pairs/green_paint_72", "pairs/green_paint_side"]
        .map(|name| Path::new(SHARED).join(name).with_extension("json"));
    if let Some(path) = paths.iter().find(|path| !path.exists()) {
        return left_out(&format!("{}, which is not there", path.display()));
    }
    let [a, b, c] = paths;
    let sets = [
        vec![a.clone()],
        vec![b.clone()],
        vec![c.clone()],
        vec![a.clone(), b.clone()],
        vec![b.clone(), c.clone()],
        vec![a, b, c],
    ];
    let all: Vec<Outcome> = sets.iter().map(|set| together(set)).collect();
    print_table(&all);
    let alone = |of: fn(&Outcome) -> f64| all[..3].iter().map(of).sum::<f64>() / 3.0;
    for joint in &all[3..] {
        assert!(joint.rmse < 1.1 * alone(|one| one.rmse), "{}", joint.rmse);
        assert!(joint.within_two_sd > 0.85 && joint.bar < alone(|one| one.bar));
    }
}

/// Shell lines that photograph a glossy sheet at two angles, as `sheet-45.ndjson` and `sheet-72.ndjson`, and
/// another as `other-45.ndjson`.
const GLOSSY: &str = r#"
photograph() {
    vkernel --angle-deg $2 > scene.json
    vforward scene.json --reflectance $3 --specular-weight 0.6 --specular-roughness 0.4 --exposure $4 \
        --render $1.exr --render-size 320x240 -o $1.json 2>/dev/null
    oiiotool $1.exr -d uint16 -o $1.tif
    vextract $1.tif --regions $1.json --scene scene.json --camera canon-5d-mark-ii \
        --illuminant D65 -q -o $1.ndjson
}
photograph sheet-45 45 cc24:orange 0.5
photograph sheet-72 72 cc24:orange 0.5
photograph other-45 50 cc24:foliage 0.5
"#;

/// Standard deviations of gloss, exposure and, in the mean, reflectance.
fn deviations(sample: &Value) -> [f64; 3] {
    let estimate = &sample["estimate"];
    let [specular_weight, exposure] = ["specular_weight", "exposure"].map(|name| &estimate["fit"][name]);
    let sd = numbers(&estimate["reflectance_sd"]);
    let of = |one: &Value| one["sd"].as_f64().unwrap();
    [
        of(specular_weight),
        of(exposure) / exposure["value"].as_f64().unwrap(),
        sd.iter().sum::<f64>() / sd.len() as f64,
    ]
}

/// Gloss and exposure brighten a fold alike at one angle; at two they do not.
#[test]
fn two_angles_tell_gloss_and_exposure_apart() {
    let run = Workdir::new().sh(&format!(
        "{GLOSSY}\ncat sheet-45.ndjson sheet-72.ndjson > both.ndjson
        vestimate -q --fit auto both.ndjson
        vestimate -q --join both.ndjson"
    ));
    assert!(run.status == 0, "{}", run.stderr);
    let samples = samples(&run);
    let [one, other, both, again] = [0, 1, 2, 3].map(|n| deviations(&samples[n]));
    println!(
        "sd of gloss, exposure, reflectance: at 45 degrees {one:.4?}, at 72 {other:.4?}, together {both:.4?}"
    );
    assert!((0..3).all(|n| both[n] < one[n].min(other[n])));
    assert!([0, 2].iter().all(|n| (both[*n] - again[*n]).abs() < 1e-12));
}

/// A second picture promises more than the first alone, of which all real sheets have the plan, and one by
/// lamplight the most.
#[test]
fn a_plan_says_which_second_picture_helps_most() {
    let run = Workdir::new().sh("scene() { vkernel --angle-deg $1 --facets 8x2 | vforward --illuminant $2 \
            --reflectance 0.5 | head -n 1; }
        { scene 45 D65; scene 45 D65; scene 72 D65; scene 45 A; } > scenes.ndjson
        plan() { vestimate --plan --reflectance cc24:foliage \"$@\"; }
        plan --join scenes.ndjson
        head -n 1 scenes.ndjson | plan --fit auto
        head -n 1 scenes.ndjson | plan
        ! plan --join=a,b scenes.ndjson
        ! vkernel --panel1-depth 0.5 | plan --join");
    let plans: Vec<Value> = run.stdout.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let rmse: Vec<f64> = plans.iter().map(|plan| plan["expected_rmse"]["mean"].as_f64().unwrap()).collect();
    println!("expected RMSE: {rmse:.4?}");
    let [alone, again, other_angle, by_lamp, auto, ideal] = rmse[..] else { panic!("{}", run.stdout) };
    assert!(by_lamp < again.min(other_angle) && again.max(other_angle) < alone && ideal < 0.8 * alone);
    assert!((alone - auto).abs() < 1e-12);
    let beside = |n: usize| plans[n]["with_photograph"]["angle_deg"].as_f64();
    assert_eq!([0, 2, 4].map(beside), [None, Some(45.0), None]);
    assert!(
        run.stderr.contains("--join: --plan joins the first scene with each of the others"),
        "{}",
        run.stderr
    );
    assert!(run.stderr.contains("one panel is deeper than the other"), "{}", run.stderr);
}

/// Sheets that are rough and glossy, photographed at 45 degrees by daylight, again, at another angle and by
/// lamplight: what becomes of the error when a second photograph is beside the first. The sheets are
/// simulated by the model that estimates them.
#[test]
fn error_bars_hold_with_a_second_photograph() {
    let run = Workdir::new().sh(r#"seed=0
        photograph() {
            seed=$((seed + 1))
            vkernel --angle-deg $2 > scene.json
            vforward scene.json --reflectance cc24:$chip --specular-weight 0.4 --specular-roughness 0.4 \
                --body-roughness-deg 20 --illuminant $3 --noise-sd 2e-3 --seed $seed --exposure 0.5 \
                --render-size 480x360 --render $1.tif -q -o simulated.json
            vextract $1.tif --exact-corners --regions simulated.json --scene scene.json \
                --camera canon-5d-mark-ii --illuminant $3 -q -o $1.ndjson
        }
        for chip in dark-skin foliage blue-flower orange moderate-red yellow-green cyan neutral-5; do
            photograph one-day 45 D65
            photograph one-again 45 D65
            photograph one-angle 72 D65
            photograph one-lamp 45 A
            {
                vestimate -q --fit auto one-day.ndjson
                for second in again angle lamp; do
                    cat one-day.ndjson one-$second.ndjson | vestimate -q --join
                done
            } | vscore -q --truth cc24:$chip
        done"#);
    assert!(run.status == 0, "{}", run.stderr);
    let samples = samples(&run);
    let chips: Vec<&[Value]> = samples.chunks_exact(7).collect();
    assert!(chips.len() == 8);
    // alone, then pairs, of which both samples say the same
    let [alone, again, angle, lamp] = [0, 1, 3, 5].map(|n| {
        let mean = |of: &dyn Fn(&Value) -> f64| chips.iter().map(|chip| of(&chip[n])).sum::<f64>() / 8.0;
        let within = |sample: &Value| {
            let truth = numbers(&sample["truth"]["reflectance"]);
            let [found, sd] =
                ["reflectance", "reflectance_sd"].map(|name| numbers(&sample["estimate"][name]));
            let inside =
                (0..truth.len()).filter(|band| (found[*band] - truth[*band]).abs() < 2.0 * sd[*band]);
            inside.count() as f64 / truth.len() as f64
        };
        [mean(&|sample| sample["metrics"]["rmse"].as_f64().unwrap()), mean(&within)]
    });
    println!(
        "RMSE, share within two sd: alone {alone:.3?}, again {again:.3?}, at 72 degrees {angle:.3?}, \
         by lamplight {lamp:.3?}"
    );
    // that a second photograph brings the spectrum nearer, as plans promise, is not seen in eight sheets; a
    // sheet so glossy is none of the matt ones, which are rarer than they were taken to be
    assert!([alone, again, angle].iter().all(|[rmse, within]| *rmse < 0.04 && *within > 0.9));
    // photographs by day and by lamp have other unknowns, of which those of the sheet are the same
    assert!(lamp[0] < 0.045 && lamp[1] > 0.9);
}

/// Join and plans know the sun alone: a fold that the sky lights alone is no silent part of them.
#[test]
fn without_a_sun_photographs_are_not_joined() {
    let run = Workdir::new().sh("vkernel --angle-deg 50 --facets 4x4 --sky only > scene.json
        vforward scene.json --reflectance cc24:orange --render sheet.tif --render-size 320x240 -q \
            | tail -n 1 > corners.json
        vextract sheet.tif --scene scene.json --regions corners.json --camera canon-5d-mark-ii \
            --illuminant D65 -q > sheet.ndjson
        cat sheet.ndjson sheet.ndjson | vestimate -q --join");
    assert!(run.status != 0 && run.stderr.contains("light.sun"), "{run:?}");
}

/// The longer exposure clips the facets away from the crease, the shorter one is noisier at the crease.
#[test]
fn brackets_fill_what_clipped() {
    let run = Workdir::new().sh(&format!(
        "{GLOSSY}\nphotograph bright-45 45 cc24:orange 11
        cat bright-45.ndjson | tail -n 1 | python3 -c 'import json,sys; \
            f=json.load(sys.stdin)[\"facet_rgb\"]; print(sum(x is None for x in f))'
        cat sheet-45.ndjson bright-45.ndjson | vestimate -q --join=sheet-45,bright-45"
    ));
    assert!(run.status == 0, "{}", run.stderr);
    let clipped: usize = run.stdout.lines().next().unwrap().parse().unwrap();
    let records = run.stdout.lines().skip(1).map(|line| serde_json::from_str::<Value>(line).unwrap());
    let samples: Vec<Value> = records.filter(|record| record["kind"] == "sample").collect();
    let exposures: Vec<f64> =
        samples.iter().map(|one| one["estimate"]["exposure"].as_f64().unwrap()).collect();
    println!("{clipped} of 200 facets clipped; exposures {exposures:?}");
    assert!(clipped > 10);
    assert!((exposures[1] / exposures[0] / 22.0 - 1.0).abs() < 0.05);
}

#[test]
fn sheets_that_differ_are_not_taken_for_one() {
    let run = Workdir::new().sh(&format!(
        "{GLOSSY}\ncat sheet-45.ndjson other-45.ndjson | vestimate -q --join=sheet-45,other-45"
    ));
    assert!(run.status == 3, "{}", run.stderr);
    for sample in samples(&run) {
        let error = sample["error"].as_str().unwrap();
        assert!(error.contains("sheet-45, other-45 are not photographs of one sheet"), "{error}");
        assert!(sample["estimate"].is_null());
    }
}

#[test]
fn records_name_their_sheet() {
    let run = Workdir::new().sh(&format!(
        r#"{GLOSSY}
        cat sheet-45.ndjson sheet-72.ndjson other-45.ndjson > all.ndjson
        vestimate -q --join all.ndjson > by-id.ndjson
        sed 's/"kind":"sample"/"kind":"sample","sheet":"a"/' sheet-45.ndjson sheet-72.ndjson \
            | vestimate -q --join=sheet > by-field.ndjson
        cat by-id.ndjson by-field.ndjson
        ! vestimate -q --join=sheet-45,none all.ndjson -o failed.ndjson
        ! vestimate -q --join=sheet all.ndjson -o failed.ndjson
        ! ls failed.ndjson"#
    ));
    assert!(run.stderr.contains("--join: no record has the id none"), "{}", run.stderr);
    assert!(run.stderr.contains("missing in sheet-45, where --join needs it"), "{}", run.stderr);
    let samples = samples(&run);
    let joined = |n: usize| samples[n]["estimate"]["joined"].as_array().map_or(0, Vec::len);
    assert_eq!([0, 1, 2, 3, 4].map(joined), [2, 2, 0, 2, 2]);
    let ids: Vec<_> = samples.iter().map(|one| one["id"].as_str().unwrap()).collect();
    assert_eq!(ids, ["sheet-45", "sheet-72", "other-45", "sheet-45", "sheet-72"]);
}

/// Error bars are those of the noise, and of the error of the model, that were given.
#[test]
fn noise_that_was_given_counts() {
    let run = Workdir::new().sh(&format!(
        "{GLOSSY}
        cat sheet-45.ndjson sheet-72.ndjson > both.ndjson
        for flags in '' '--noise-sd 0.03' '--model-error 0.3'; \
            do vestimate -q --join $flags both.ndjson; done"
    ));
    let samples = samples(&run);
    let mean_sd = |n: usize| {
        let sd = numbers(&samples[2 * n]["estimate"]["reflectance_sd"]);
        sd.iter().sum::<f64>() / sd.len() as f64
    };
    let [usual, noisy, doubted] = [0, 1, 2].map(mean_sd);
    assert!(noisy > 1.1 * usual && doubted > 1.1 * usual, "{usual} {noisy} {doubted}");
}

/// However often a run was killed and wherever its file was cut; sheets that are there are not estimated
/// again, but for the first, and one of which a photograph is missing.
#[test]
fn joint_estimates_go_on() {
    let run = Workdir::new().sh(&format!(
        r#"{GLOSSY}
        cat sheet-45.ndjson other-45.ndjson sheet-72.ndjson > all.ndjson
        join() {{ vestimate -q --join "$@" -; }}
        join < all.ndjson > whole.ndjson
        for lines in 0 1 2 3 5 6; do
            {{ head -n $lines whole.ndjson; printf '{{"kind":"s'; }} > out.ndjson
            join --resume out.ndjson < all.ndjson
            cmp out.ndjson whole.ndjson
        done
        : > out.ndjson
        for tenths in 2 6 12; do
            vestimate -q --join --resume out.ndjson - < all.ndjson & tool=$!
            sleep $((tenths / 10)).$((tenths % 10))
            kill -9 $tool 2>/dev/null || :
            wait $tool 2>/dev/null || :
        done
        join --resume out.ndjson < all.ndjson
        cmp out.ndjson whole.ndjson
        sed '/"id":"other/s/"iterations":[0-9]*/"iterations":4711/' whole.ndjson > out.ndjson
        join --resume out.ndjson < all.ndjson
        grep -c '"iterations":4711' out.ndjson
        cat sheet-45.ndjson other-45.ndjson > fewer.ndjson
        head -n 2 whole.ndjson > out.ndjson
        join --resume out.ndjson < fewer.ndjson || echo $?"#
    ));
    assert_eq!((run.status, run.stdout.as_str()), (0, "1\n1\n"), "{run:?}");
    assert!(run.stderr.contains("out.ndjson:2: "), "{}", run.stderr);
}
