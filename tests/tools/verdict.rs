//! What vestimate thinks of its estimates: of README's own photograph as it is, and told what is not so. The
//! table is printed with `cargo test --test tools verdict -- --nocapture`.

use serde_json::Value;

use crate::common::Workdir;

const PHOTO: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/photos/a_ideal_magenta_50.exr");
const JPEG: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/photos/f_srgb_blue_flower_50.jpg");
const CORNERS: [&str; 2] = ["332,462 345,77 122,12 104,442", "332,462 345,77 485,17 472,446"];
const JPEG_CORNERS: [&str; 2] =
    ["301.7,395.3 289.6,54.6 167.5,60.2 183.6,458.9", "301.7,395.3 289.6,54.6 501.4,48.4 512.1,439.1"];

/// What is told of a photograph.
#[derive(Clone, Copy)]
struct StatedScene {
    photo: &'static str,
    angle_deg: f64,
    camera: &'static str,
    light: &'static str,
    corners: [&'static str; 2],
    truth: &'static str,
    /// More flags of vestimate.
    flags: &'static str,
}

const AS_IT_IS: StatedScene = StatedScene {
    photo: PHOTO,
    angle_deg: 50.0,
    camera: "canon-5d-mark-ii",
    light: "D65",
    corners: CORNERS,
    truth: "cc24:magenta",
    flags: "",
};

/// What came of it.
#[derive(Debug)]
struct Judged {
    rmse: f64,
    within_two_sd: f64,
    level: String,
    because: String,
    said: String,
}

fn judged(what: &str, told: StatedScene) -> Judged {
    let StatedScene { photo, angle_deg, camera, light, corners: [panel0, panel1], truth, flags } = told;
    let run = Workdir::new().sh(&format!(
        "vkernel --angle-deg {angle_deg} | vextract -q '{photo}' --camera {camera} \
            --illuminant {light} --refine \\
            --panel0 '{panel0}' --panel1 '{panel1}' | vestimate {flags} | vscore --truth '{truth}'"
    ));
    if run.stderr.contains("% of the light; check exposure, noise, angle, corners") {
        let (level, because) = ("refused".to_owned(), run.stderr);
        return Judged { rmse: f64::NAN, within_two_sd: 0.0, level, because, said: String::new() };
    }
    assert_eq!(run.status, 0, "{what}: {}", run.stderr);
    let sample: Value = serde_json::from_str(run.stdout.lines().nth(1).unwrap()).unwrap();
    let numbers = |value: &Value| -> Vec<f64> {
        value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
    };
    let estimate = &sample["estimate"];
    let [found, sd] = ["reflectance", "reflectance_sd"].map(|name| numbers(&estimate[name]));
    let truth = numbers(&sample["truth"]["reflectance"]);
    let within = found
        .iter()
        .zip(&sd)
        .zip(&truth)
        .filter(|((found, sd), truth)| (*found - *truth).abs() <= 2.0 * **sd);
    let text = |name: &str| estimate["verdict"][name].as_str().unwrap_or_default().to_owned();
    let judged = Judged {
        rmse: sample["metrics"]["rmse"].as_f64().unwrap(),
        within_two_sd: within.count() as f64 / truth.len() as f64,
        level: text("level"),
        because: text("because"),
        said: run.stderr,
    };
    let Judged { rmse, within_two_sd, level, because, .. } = &judged;
    println!("| {what} | {rmse:.4} | {:.0} % | {level}: {because} |", 100.0 * within_two_sd);
    judged
}

/// The angle is 50°, and the truth the reflectance with which the picture was rendered. Whatever angle is
/// stated, the spectrum must be as good as `tests/tools/photographs.rs` demands of this picture at its angle
/// (`a`, with the exposure known), and the verdict must name the angle that the facets show.
#[test]
fn a_wrong_angle_is_found_out() {
    println!("| told | RMSE | within two sd | said |");
    for angle_deg in [45.0, 47.0, 48.0, 49.0, 49.5, 50.0, 50.5, 51.0, 52.0, 53.0, 55.0] {
        let one = judged(&format!("{angle_deg}° for 50°"), StatedScene { angle_deg, ..AS_IT_IS });
        assert!(one.rmse < 0.015 && one.within_two_sd > 0.9, "{angle_deg}: {one:?}");
        let off = f64::abs(angle_deg - 50.0);
        // 2.8° are more than in 39 of 40 photographs
        assert_eq!(one.level, if off > 2.8 { "doubtful" } else { "good" }, "{angle_deg}: {one:?}");
        let is_said = [&one.said, &one.because].into_iter().any(|text| {
            // between folds that are 4° apart one is known to a twentieth of a degree
            ["49.9", "50.0", "50.1"]
                .iter()
                .any(|found| text.contains(&format!("the fold's angle is {found}")))
        });
        assert_eq!(is_said, off > 0.4, "{angle_deg}: {one:?}");
    }
}

/// Who wants the scene believed as it is told hears that the facets tell another.
#[test]
fn a_wrong_angle_that_is_to_be_believed_is_doubtful() {
    for angle_deg in [48.0, 51.0] {
        let one = judged(
            &format!("{angle_deg}°, --fit none"),
            StatedScene { angle_deg, flags: "--fit none", ..AS_IT_IS },
        );
        assert_eq!(one.level, "doubtful", "{one:?}");
        let found = "the estimate does not allow for that";
        assert!(one.because.contains("the fold's angle is") && one.because.contains(found), "{one:?}");
    }
    for flags in ["--fit none", "--fit angle"] {
        let one = judged(&format!("50°, {flags}"), StatedScene { flags, ..AS_IT_IS });
        assert_eq!(one.level, "good", "{one:?}");
    }
    let one = judged("48°, --fit angle", StatedScene { angle_deg: 48.0, flags: "--fit angle", ..AS_IT_IS });
    assert!(!one.because.contains("does not allow for"), "what is fitted is allowed for: {one:?}");
}

/// Facets rarely show that another light or camera is stated than the photograph's: the verdict names what it
/// rests on.
#[test]
fn what_facets_do_not_confirm_is_named() {
    let light = judged("D50 for D65", StatedScene { light: "D50", ..AS_IT_IS });
    assert!(light.level == "good" && light.because.contains("the light D50"), "{light:?}");
    let camera =
        judged("nikon-d5100 for canon-5d-mark-ii", StatedScene { camera: "nikon-d5100", ..AS_IT_IS });
    // sensitivities of another camera may show in the facets: then one is named that is more probable
    assert!(camera.level == "doubtful" && camera.because.contains("nikon-d5100 you stated"), "{camera:?}");
    let run = Workdir::new().sh("for camera in nikon-d5100 canon-5d-mark-ii; do
            vkernel --facets 4x4 | vforward -q --reflectance cc24:red --camera $camera | vestimate | tail -n 1
        done");
    let said: Vec<bool> =
        run.stdout.lines().map(|sample| sample.contains("scaled to the same peak")).collect();
    assert_eq!(said, [true, false], "{run:?}");
}

#[test]
fn a_picture_that_was_developed_is_wrong() {
    let told = StatedScene {
        photo: JPEG,
        camera: "nikon-d5100",
        corners: JPEG_CORNERS,
        truth: "cc24:blue-flower",
        ..AS_IT_IS
    };
    let one = judged("JPEG, nothing undone", told);
    assert!(one.level == "wrong" && one.because.contains("developed"), "{one:?}");
}

/// An estimate from wrong corners is no good one, unless its error bars still hold the truth: in the long run
/// 95 % of the wavelengths are within two of honest bars; 80 % allows for the errors of one sheet, which are
/// alike at neighbouring wavelengths.
#[test]
fn corners_far_from_the_panels_do_no_harm_unnoticed() {
    let outside = ["332,462 345,77 82,2 64,452", "332,462 345,77 525,7 512,456"];
    let inside = ["332,462 345,77 182,32 164,422", "332,462 345,77 425,37 412,426"];
    for (what, corners) in [("outer corners 40 px outside", outside), ("outer corners 60 px inside", inside)]
    {
        let one = judged(what, StatedScene { corners, ..AS_IT_IS });
        assert!(one.level != "good" || one.within_two_sd > 0.8, "{what}: {one:?}");
    }
}

/// Computed facets are explained by the scene that made them, and not by another. Noise that is as stated may
/// look unlikely by chance: two of the 24 patches may.
#[test]
fn computed_facets_are_judged_by_chance() {
    let folder = Workdir::new();
    let verdicts = |script: &str| -> Vec<Value> {
        let run = folder.sh(script);
        assert_eq!(run.status, 0, "{run:?}");
        let records = run.stdout.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
        records
            .filter(|record| record["kind"] == "sample")
            .map(|one| one["estimate"]["verdict"].clone())
            .collect()
    };
    let right = verdicts("vkernel --angle-deg 45 | vforward --reflectance cc24 --noise-sd 1e-3 | vestimate");
    let good = right.iter().filter(|verdict| verdict["level"] == "good").count();
    assert!(good >= 22, "{good} of {}", right.len());
    let wrong = verdicts(
        "vkernel --angle-deg 45 | vforward --reflectance cc24:red cc24:white --noise-sd 1e-4 > samples.ndjson
        { vkernel --angle-deg 55 | vforward --reflectance 0.5 | head -n 1; tail -n 2 samples.ndjson; } \
            | vestimate -q",
    );
    assert!(
        wrong.iter().all(|verdict| verdict["level"] != "good" && verdict["remedy"].is_string()),
        "{wrong:?}"
    );
    // a method that does not know how far off it is does not judge
    assert_eq!(verdicts("vestimate samples.ndjson --prior smooth"), [Value::Null, Value::Null]);
}
