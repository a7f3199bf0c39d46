//! Where a photograph's numbers end and begin, and whether they are a camera's own: what the file does not
//! say, its pixels show.

use serde_json::Value;

use crate::common::{Ended, Workdir};

/// Takes `photo.exr`, an orange sheet with the noise of 20000 electrons at 1 and a little of reading them;
/// where it is goes to `corners.json`.
const TAKEN: &str = "vkernel --angle-deg 45 -o scene.json
    vforward scene.json --reflectance cc24:orange --camera canon-5d-mark-ii --illuminant D65 \
        --photon-noise 7.07e-3 --noise-sd 3e-4 --seed 1 --render photo.exr --render-size 480x360 -q \
        | tail -n 1 > corners.json";

fn taken() -> Workdir {
    let folder = Workdir::new();
    let run = folder.sh(TAKEN);
    assert_eq!((run.status, run.stderr.as_str()), (0, ""));
    folder
}

/// What vextract makes of `picture`, which a line makes first.
fn extract(folder: &Workdir, make: &str, picture: &str, flags: &str) -> Ended {
    folder.sh(&format!(
        "{make}
        vextract {picture} --regions corners.json --scene scene.json --camera canon-5d-mark-ii \
            --illuminant D65 {flags} -o sample.ndjson"
    ))
}

fn sample(folder: &Workdir) -> Value {
    let run = folder.sh("tail -n 1 sample.ndjson");
    serde_json::from_str(&run.stdout).unwrap()
}

/// Values and standard deviations of the facets, if they are seen.
fn facets(folder: &Workdir) -> Vec<Option<[Vec<f64>; 2]>> {
    let sample = sample(folder);
    let numbers = |value: &Value| -> Option<Vec<f64>> {
        value.as_array().map(|all| all.iter().map(|number| number.as_f64().unwrap()).collect())
    };
    let rows = |name: &str| sample[name].as_array().unwrap().clone();
    let each = rows("facet_rgb").into_iter().zip(rows("facet_sd"));
    each.map(|(rgb, sd)| Some([numbers(&rgb)?, numbers(&sd)?])).collect()
}

fn verdict(folder: &Workdir) -> (String, String) {
    let run = folder.sh("vestimate -q sample.ndjson | tail -n 1");
    let record: Value = serde_json::from_str(&run.stdout).unwrap();
    let text = |name: &str| record["estimate"]["verdict"][name].as_str().unwrap().to_owned();
    (text("level"), text("because"))
}

/// A level that a fifth of the facets reach in green, and the greatest of all.
fn level(facets: &[Option<[Vec<f64>; 2]>]) -> f64 {
    let mut green: Vec<f64> = facets.iter().flatten().map(|[rgb, _]| rgb[1]).collect();
    green.sort_by(f64::total_cmp);
    green[green.len() * 4 / 5]
}

#[test]
fn numbers_that_end_below_white_are_clipped_there() {
    let folder = taken();
    let run = extract(&folder, "", "photo.exr", "");
    assert_eq!((run.status, run.stderr.as_str()), (0, ""), "nothing is said of a picture that does not end");
    let whole = facets(&folder);
    let level = level(&whole);
    // one number in all channels, in twelve bits of sixteen
    let (all, of_all) = (
        format!("--mulc {} --clamp:max=1 --mulc {}", 1.0 / level, 4095.0 / 65535.0),
        level * 65535.0 / 4095.0,
    );
    // floats cut at 1
    let floats = format!("--mulc {} --clamp:max=1", 1.0 / level);
    // green alone
    let green = format!("--clamp:max=10,{level},10");
    for (what, change, file, unit, says) in [
        ("12 bits", &all, "-d uint16 -o cut.tif", of_all, "numbers end at 4095 in"),
        ("floats", &floats, "-o cut.exr", level, "numbers end at 1 in"),
        ("green", &green, "-d uint16 -o cut.tif", 1.0, " in G, below white"),
    ] {
        let picture = file.split_whitespace().last().unwrap();
        let run = extract(&folder, &format!("oiiotool photo.exr {change} {file}"), picture, "");
        assert!(run.status == 0 && run.stderr.contains(says), "{what}: {run:?}");
        let cut = facets(&folder);
        let seen = cut.iter().flatten().count();
        assert!((60..180).contains(&seen), "{what}: {seen} facets");
        for (cut, whole) in
            cut.iter().zip(&whole).filter_map(|(cut, whole)| Some((cut.as_ref()?, whole.as_ref()?)))
        {
            let off =
                (0..3).map(|k| (cut[0][k] * unit - whole[0][k]).abs() / whole[1][k]).fold(0.0, f64::max);
            assert!(off < 3.0, "{what}: off by {off} standard deviations: {cut:?} {whole:?}");
        }
        let ends = &sample(&folder)["image"]["ends_at"];
        assert!(ends[1].is_f64(), "{what}: {ends}");
    }
    // all of the sheet
    let run = extract(
        &folder,
        "oiiotool photo.exr --mulc 50 --clamp:max=1 --mulc 0.0625 -d uint16 -o cut.tif",
        "cut.tif",
        "",
    );
    assert!(run.status == 1 && run.stderr.contains("its numbers are clipped at 4096 in R, G"), "{run:?}");
}

#[test]
fn a_black_level_that_was_not_subtracted_shows() {
    let folder = taken();
    assert_eq!(extract(&folder, "", "photo.exr", "").status, 0);
    let right = facets(&folder);
    // of twelve bits: 128 of 4095
    for (what, add, stored) in [("1 %", 0.01, 655.35), ("128 of 4095", 128.0 / 4095.0, 2048.5)] {
        let make = format!("oiiotool photo.exr --addc {add} -d uint16 -o black.tif");
        let run = extract(&folder, &make, "black.tif", "");
        assert!(run.status == 0 && run.stderr.contains("--black-level auto"), "{what}: {run:?}");
        let (level, because) = verdict(&folder);
        assert!(level != "good" && because.contains("black was probably not"), "{what}: {level}: {because}");
        let run = extract(&folder, "", "black.tif", "--black-level auto");
        assert_eq!((run.status, run.stderr.as_str()), (0, ""), "{what}");
        let black = sample(&folder)["image"]["black_level"].clone();
        assert!((0..3).all(|k| (black[k].as_f64().unwrap() - stored).abs() < 2.0), "{what}: {black}");
        for (got, right) in facets(&folder).iter().zip(&right) {
            let ([got, _], [right, sd]) = (got.as_ref().unwrap(), right.as_ref().unwrap());
            // white is 1 - black above black
            let off = (0..3).map(|k| (got[k] * (1.0 - add) - right[k]).abs() / sd[k]).fold(0.0, f64::max);
            assert!(off < 1.0, "{what}: off by {off} standard deviations");
        }
    }
    // surroundings that are dark but have a colour
    let run =
        extract(&folder, "oiiotool photo.exr --addc 0.008,0.02,0.012 -d uint16 -o dark.tif", "dark.tif", "");
    assert_eq!((run.status, run.stderr.as_str()), (0, ""));
}

/// Makes `sheet.exr`, white in light that falls off, with the noise of 20000 electrons at 1; then
/// `uneven.exr`, the photograph in that light.
const SHEET: &str = "oiiotool --pattern noise:type=gaussian:mean=0:stddev=7.07e-3 480x360 3 -o noise.exr
    corners=topleft=.45,.9,.7:topright=.36,.72,.56:bottomleft=.4,.8,.62:bottomright=.3,.6,.46
    oiiotool --pattern fill:$corners 480x360 3 -o light.exr
    oiiotool light.exr --powc .5 noise.exr --mul light.exr --add -o sheet.exr
    oiiotool light.exr --mulc 2,1,1.3 photo.exr --mul -o uneven.exr";

#[test]
fn noise_tells_a_curve_and_a_matrix() {
    let folder = taken();
    assert_eq!(folder.sh(SHEET).status, 0);
    for (what, change, says, word) in [
        ("the power of sRGB", "--powc 0.41667", "curve such as sRGB's", "curve"),
        (
            "a matrix",
            "--mulc 2,1,1.5 --ccmatrix 1.7,-0.15,0.05,-0.6,1.65,-0.55,-0.1,-0.5,1.5 --mulc 0.5",
            "matrix mixed them",
            "matrix",
        ),
    ] {
        for flags in ["", "--white sheet.exr"] {
            let make = format!("oiiotool photo.exr {change} -d uint16 -o done.tif");
            let run = extract(&folder, &make, "done.tif", flags);
            assert!(run.status == 0 && run.stderr.contains(says), "{what}, {flags}: {run:?}");
            let (level, because) = verdict(&folder);
            assert!(level == "wrong" && because.contains(word), "{what}, {flags}: {level}: {because}");
        }
    }
}

/// The picture of a white sheet is one by the same camera, in the camera's own numbers.
#[test]
fn a_white_sheet_is_held_to_the_rules_of_a_photograph() {
    const CANON: &str = "--attrib Make Canon --attrib Model 'Canon EOS 5D Mark II'";
    const APERTURE: &str = "--attrib:type=float FNumber";
    let folder = taken();
    let make = format!("{SHEET}; oiiotool uneven.exr {CANON} {APERTURE} 8 -d uint16 -o u.tif");
    let run = extract(&folder, &make, "u.tif", "--white sheet.exr");
    assert_eq!((run.status, run.stderr.as_str()), (0, ""));
    assert_ne!(verdict(&folder).0, "wrong");
    let run = extract(&folder, "oiiotool sheet.exr --powc 0.41667 -o s.exr", "u.tif", "--white s.exr");
    assert!(run.status == 0 && run.stderr.contains("noise in the picture given with --white"), "{run:?}");
    let (level, because) = verdict(&folder);
    assert!(level == "wrong" && because.contains("given with --white"), "{level}: {because}");
    for (change, says) in [
        ("--colorconvert linear sRGB -d uint8 -o s.jpg", "(JPEG, 8-bit, RGB) was developed for the eye"),
        ("--ch G -d uint16 -o s.tif", "the picture is in colour, the flat field grey"),
        ("--ch G,G,G -d uint16 -o s.tif", "the picture is in colour, the flat field grey"),
        (
            "--attrib Model B -d uint16 -o s.tif",
            "the picture was taken by Canon EOS 5D Mark II, the flat field by B",
        ),
    ] {
        let sheet = change.split_whitespace().last().unwrap();
        let run =
            extract(&folder, &format!("oiiotool sheet.exr {change}"), "u.tif", &format!("--white {sheet}"));
        assert!(run.status == 1 && run.stderr.contains(says), "{change}: {run:?}");
    }
    let make = &format!("oiiotool sheet.exr {CANON} {APERTURE} 4 -d uint16 -o s.tif");
    let run = extract(&folder, make, "u.tif", "--white s.tif");
    assert!(run.status == 0 && run.stderr.contains("taken at f/8, but s.tif at f/4"), "{run:?}");
}

#[test]
fn eight_bits_are_for_the_eye_unless_somebody_says_otherwise() {
    let folder = taken();
    let make = "oiiotool photo.exr --colorconvert linear sRGB -d uint8 -o eight.png";
    let run = extract(&folder, make, "eight.png", "");
    assert!(run.status == 0 && run.stderr.contains("was developed for the eye"), "{run:?}");
    let (level, because) = verdict(&folder);
    assert!(level == "wrong" && because.contains("developed"), "{level}: {because}");
    let run = extract(&folder, "", "eight.png", "--transfer srgb");
    assert_eq!((run.status, run.stderr.as_str()), (0, ""));
    assert_ne!(verdict(&folder).0, "wrong");
}
