//! The angle of a fold from a photograph alone: `--find` prints it, vkernel takes it, vestimate believes it
//! as far as it is known.

use serde_json::Value;

use crate::common::{Ended, Workdir};

const PHOTOS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/photos");
const ALL: &str = "vextract --find photo.exr > regions.json
    vkernel --regions regions.json | vextract -q photo.exr --regions regions.json --camera canon-5d-mark-ii \
        --illuminant D65 | vestimate -q";

/// A folder with a photograph of a fold of 50°.
fn with_photo() -> Workdir {
    let folder = Workdir::new();
    std::fs::copy(format!("{PHOTOS}/a_ideal_magenta_50.exr"), folder.path().join("photo.exr")).unwrap();
    folder
}

fn records(run: &Ended) -> Vec<Value> {
    assert_eq!((run.status, run.stderr.as_str()), (0, ""));
    run.stdout.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

#[test]
fn a_photograph_alone_gives_the_spectrum() {
    let [scene, sample] = <[Value; 2]>::try_from(records(&with_photo().sh(ALL))).unwrap();
    let geometry = &scene["geometry"];
    assert!((number(&geometry["angle_deg"]) - 50.0).abs() < 1.0, "{geometry}");
    assert!((0.01..1.0).contains(&number(&geometry["angle_sd_deg"])), "{geometry}");
    let sidecar = std::fs::read_to_string(format!("{PHOTOS}/a_ideal_magenta_50.json")).unwrap();
    let truth = serde_json::from_str::<Value>(&sidecar).unwrap()["reflectance"].take();
    let values = |list: &Value| list.as_array().unwrap().iter().map(number).collect::<Vec<_>>();
    let (truth, estimate) = (values(&truth), values(&sample["estimate"]["reflectance"]));
    let squares = truth.iter().zip(&estimate).map(|(truth, estimate)| (truth - estimate).powi(2));
    let rmse = (squares.sum::<f64>() / truth.len() as f64).sqrt();
    assert!(rmse < 0.03, "{rmse}");
}

/// The facets of an ideal fold tell the angle as exactly as the first of these deviations.
#[test]
fn the_estimate_moves_an_angle_as_far_as_its_deviation_allows() {
    let fitted = |sd: &str| {
        let run = with_photo().sh(&format!(
            "vextract --find photo.exr > found.json
            sed 's/\"angle_deg\":[0-9.]*,\"angle_sd_deg\":[0-9.]*/\"angle_deg\":50.5,\"angle_sd_deg\":{sd}/' \
                found.json > regions.json
            vkernel --regions regions.json |
            vextract -q photo.exr --regions found.json --camera canon-5d-mark-ii \
                --illuminant D65 | vestimate -q"
        ));
        number(&records(&run)[1]["estimate"]["fit"]["angle_deg"]["value"])
    };
    let [exact, vague] = ["0.05", "2"].map(fitted);
    assert!((vague - 50.0).abs() < 0.2 && (vague + 0.03..50.5).contains(&exact), "{exact} {vague}");
}

#[test]
fn an_angle_that_is_told_wins_and_is_compared() {
    let folder = with_photo();
    let angle = |flags: &str| {
        let run = folder.sh(&format!("vextract --find photo.exr | vkernel --regions - {flags}"));
        assert_eq!(run.status, 0, "{}", run.stderr);
        let scene: Value = serde_json::from_str(run.stdout.lines().next().unwrap()).unwrap();
        (scene["geometry"].clone(), run.stderr)
    };
    let (told, said) = angle("--angle-deg 50.2");
    assert!((number(&told["angle_deg"]) - 50.2).abs() < 1e-9 && told.get("angle_sd_deg").is_none(), "{told}");
    assert_eq!(said, "");
    let (_, said) = angle("--angle-deg 45");
    assert_eq!(said, "vkernel: -: the corners show 50.0 ± 0.3°; --angle-deg 45 is used instead\n");
    assert_eq!(angle("--angle-deg 45 -q").1, "");
    let (of_square, _) = angle("--panel 2x2");
    assert!((number(&of_square["angle_deg"]) - 50.0).abs() < 0.3, "{of_square}");
}

/// Who forgets the angle or the form of the panels, or measures another sheet's, hears of it.
#[test]
fn a_scene_of_another_fold_is_doubtful() {
    let marked = "--panel0 '332,462 345,77 122,12 104,442' --panel1 '332,462 345,77 485,17 472,446'";
    let verdict = |fold: &str, corners: &str| {
        let run = with_photo().sh(&format!(
            "vkernel {fold} --facets 6x6 | vextract -q photo.exr {corners} --camera canon-5d-mark-ii \
                --illuminant D65 | vestimate -q"
        ));
        let verdict = records(&run)[1]["estimate"]["verdict"].clone();
        ["level", "because"].map(|part| verdict[part].as_str().unwrap().to_owned())
    };
    for corners in ["", marked] {
        assert_eq!(verdict("--angle-deg 51", corners)[0], "good");
        for (fold, is) in [
            ("--angle-deg 42", "those of a fold with an angle of 50 ±"),
            ("--angle-deg 50 --panel 1x2", "those of panels 1.00 times as deep as wide"),
        ] {
            let [level, because] = verdict(fold, corners);
            let is = format!("the corners are not those of the stated fold, but {is}");
            assert!(level == "doubtful" && because.starts_with(&is), "{level} {because}");
        }
    }
}

/// Corners that somebody marked tell the angle, too, of panels whose form is known.
#[test]
fn corners_of_the_picker_tell_the_angle() {
    let run = |regions: &str, flags: &str| {
        Workdir::new().sh(&format!("echo '{regions}' > corners.json; vkernel --regions corners.json {flags}"))
    };
    let panels = concat!(
        r#""panel0": [[332, 462], [345, 77], [122, 12], [104, 442]], "#,
        r#""panel1": [[332, 462], [345, 77], [485, 17], [472, 446]]"#,
    );
    let sized = format!(r#"{{{panels}, "width": 640, "height": 480}}"#);
    let scene = &records(&run(&sized, "--panel 1x1"))[0];
    assert!((number(&scene["geometry"]["angle_deg"]) - 50.0).abs() < 1.5, "{}", scene["geometry"]);

    let refused = |regions: &str, flags: &str| {
        let run = run(regions, flags);
        assert_eq!(
            (run.status, run.stdout.as_str(), run.stderr.lines().count()),
            (1, "", 1),
            "{}",
            run.stderr
        );
        run.stderr
    };
    let sizeless = format!("{{{panels}}}");
    assert!(refused(&sizeless, "").contains("'width' and 'height' are missing"));
    assert_eq!(records(&run(&sizeless, "--angle-deg 50"))[0]["geometry"]["angle_deg"], 50.0);
    let half = r#"{"panel0": [[332, 462], [345, 77], [122, 12], [104, 442]], "width": 640, "height": 480}"#;
    assert!(refused(half, "").contains("panel1 has no corners"));
    let vague = sized.replace("{\"panel0", "{\"angle_deg\": 50, \"angle_sd_deg\": 8, \"panel0");
    assert!(refused(&vague, "").contains("the corners fix the angle only to 50 ± 8°; give the panels'"));
    assert!(refused(r#"{"found": false, "reason": "it is dark"}"#, "").contains("it is dark"));
    assert!(
        refused(&format!("[{sized}, {sized}]").replace("[{", "[{\"image\": \"a\", "), "").contains("image")
    );
    assert!(
        refused(&sized.replace("640", "640, \"confidence\": 0.5"), "")
            .contains("with only 50 % confidence (97 % needed)")
    );
    assert!(refused(&sized.replace("640", "640, \"angle_deg\": 0"), "").contains("field 'angle_deg': 0"));
}

/// Panels that are not square are found to be so, and the focal length that the camera wrote counts.
#[test]
fn the_form_of_the_panels_and_the_focal_length_are_taken() {
    let folder = Workdir::new();
    if !folder.can("oiiotool --version", "the focal length of a JPEG") {
        return;
    }
    let found = |focal_mm: u32| {
        let run = folder.sh(&format!(
            "vkernel --panel 1x0.85 --angle-deg 50 |
            vforward --reflectance cc24:orange --camera nikon-d5100 --render fold.exr --render-size 900x700 \
                --eye 0.2,1.0,2.4 --look-at 0,0,0.4 --field-of-view-deg 50 -q > sample.ndjson
            oiiotool fold.exr --mulc 3 --colorconvert linear sRGB -d uint8 --attrib Compression jpeg:98 \
                --attrib:type=uint16 Exif:FocalLengthIn35mmFilm {focal_mm} -o fold.jpg
            vextract --find fold.jpg | sed 's/\"confidence\":[0-9.]*,//' | vkernel --regions -"
        ));
        records(&run).remove(0)["geometry"].take()
    };
    let [unknown, right, wrong] = [0, 37, 41].map(found);
    for geometry in [&unknown, &right] {
        assert!((number(&geometry["angle_deg"]) - 50.0).abs() < 0.5, "{geometry}");
        assert!((number(&geometry["panel"][1]) - 0.85).abs() < 0.01, "{geometry}");
    }
    let [unknown, right, wrong] = [unknown, right, wrong].map(|geometry| number(&geometry["angle_deg"]));
    // the sides show the lens, so that corners leave little to the focal length
    assert!((unknown - right).abs() < 0.1 && (wrong - right).abs() > 0.03, "{unknown} {right} {wrong}");
}

/// One angle for two photographs would be that of neither.
#[test]
fn a_scene_is_of_one_photograph() {
    let run =
        with_photo().sh("cp photo.exr other.exr; vextract --find photo.exr other.exr | vkernel --regions -");
    assert_eq!(run.status, 1);
    assert!(run.stderr.contains("regions of 2 photographs, but one is needed"), "{}", run.stderr);
}
