//! Cameras known by what they write into their pictures, and by name.

use serde_json::Value;

use crate::common::Workdir;
use crate::real_sheets::numbers;

const CAMERAS: &str = include_str!("../../share/cameras.txt");

/// A small picture with a maker and a model, as `photo.tif`, and `extract`, which measures it.
const SETUP: &str = r#"
    vkernel --facets 1x1 -o scene.json
    cat > picture <<'END'
    oiiotool --pattern constant:color=0.4,0.5,0.3 40x40 3 --attrib Make "$1" --attrib Model "$2" \
        -d uint16 -o photo.tif
END
    cat > extract <<'END'
    exec vextract photo.tif --scene scene.json --illuminant D65 --panel0 '0,0 40,0 40,40 0,40' "$@"
END
"#;

/// Make and Model as the makers write them.
fn exif(maker: &str, model: &str) -> (String, String) {
    match maker {
        "Nikon" => ("NIKON CORPORATION".to_owned(), format!("NIKON {model}")),
        "Canon" => (maker.to_owned(), format!("Canon {model}")),
        "Sony" | "Fujifilm" => (maker.to_uppercase(), model.to_owned()),
        _ => (maker.to_owned(), model.to_owned()),
    }
}

fn scene(stdout: &str) -> Value {
    serde_json::from_str(stdout.lines().next().unwrap()).unwrap()
}

#[test]
fn all_of_rawtoaces_data_are_known_by_their_pictures() {
    let folder = Workdir::new();
    let of = |line: &str| {
        let [maker, model] = [0, 1].map(|k| line.split('\t').nth(k).unwrap());
        exif(maker, model)
    };
    // all in one process, which takes a tenth of a second to start
    let pictures = CAMERAS.lines().enumerate().map(|(n, line)| {
        let (make, model) = of(line);
        format!(" --attrib Make '{make}' --attrib Model '{model}' -d uint16 -o {n}.tif")
    });
    let pictures = pictures.collect::<String>();
    let run = folder.sh(&format!("{SETUP}\noiiotool --pattern constant:color=0.4,0.5,0.3 40x40 3{pictures}"));
    assert_eq!(run.status, 0, "{}", run.stderr);
    let listed = folder.sh("vextract --list cameras").stdout;
    for (n, line) in CAMERAS.lines().enumerate() {
        let (make, model) = of(line);
        let run = folder.sh(&format!("mv {n}.tif photo.tif; sh extract"));
        // of this one there are two measurements, which is said
        let is_twice = model == "Canon EOS 5D Mark II";
        assert!(run.status == 0 && run.stderr.contains("for the other measurement") == is_twice, "{run:?}");
        assert!(is_twice || run.stderr.is_empty(), "{make} {model}: {}", run.stderr);
        let camera = &scene(&run.stdout)["camera"];
        let name = camera["name"].as_str().unwrap();
        let plain = |text: &str| text.to_lowercase().replace([' ', '-', '.'], "");
        let of_model = plain(&model).replace("canon", "").replace("nikon", "").replace("eos", "");
        assert!(plain(name).ends_with(&of_model), "{make} {model} is {name}");
        assert!(listed.lines().any(|line| line.split(' ').next() == Some(name)), "{name} is not listed");
        assert_eq!(camera["sensitivities"].as_array().unwrap().len(), 3);
    }
}

#[test]
fn one_sensor_in_two_models_is_said() {
    let folder = Workdir::new();
    let run = folder.sh(&format!("{SETUP}\nsh picture Canon 'Canon EOS R8'; sh extract"));
    assert_eq!(scene(&run.stdout)["camera"]["name"], "canon-eos-r6m2");
    assert_eq!(
        run.stderr,
        "vextract: Canon EOS R8: using the sensitivities of canon-eos-r6m2, whose sensor is the same\n"
    );
    let quiet = folder.sh("sh extract --quiet");
    assert_eq!((quiet.status, quiet.stderr.as_str()), (0, ""));
}

#[test]
fn names_may_be_those_of_other_markets() {
    let folder = Workdir::new();
    let run = folder.sh(r"
        vkernel --facets 1x1 -o scene.json
        forward() { vforward scene.json --reflectance 0.5 --camera $1 --no-history | sed s/$1/CAMERA/; }
        forward canon-eos-600d > one
        forward canon-eos-rebel-t3i > two
        cmp one two");
    assert_eq!((run.status, run.stdout.as_str()), (0, ""), "{}", run.stderr);
}

/// Loudly, also if `--quiet` is asked for, and in the record.
#[test]
fn a_camera_that_nobody_measured_has_a_stand_in() {
    let folder = Workdir::new();
    let run =
        folder.sh(&format!("{SETUP}\nsh picture 'NIKON CORPORATION' 'NIKON D5200'; sh extract --quiet"));
    let camera = &scene(&run.stdout)["camera"];
    assert!(camera["name"].as_str().unwrap().starts_with("nikon-"), "{camera}");
    assert_eq!(camera["stands_in"]["camera"], "NIKON D5200");
    assert!(camera["stands_in"]["sensitivity_error"].as_f64().unwrap() > 0.03);
    let warning = "sensitivities of NIKON D5200 have not been measured: nikon-";
    assert!(run.stderr.contains(warning) && run.stderr.contains("--save-camera"), "{}", run.stderr);
    assert_eq!(run.stderr.lines().count(), 1, "{}", run.stderr);
    let judged = folder.sh("sh extract --quiet | vestimate -q --prior cc24 | tail -n 1");
    assert!(judged.stdout.contains("those of another camera stand in"), "{judged:?}");
    let run = folder.sh("sh picture 'Leica Camera AG' 'LEICA Q3'; sh extract");
    assert!(run.stderr.contains("the most typical of all makers"), "{}", run.stderr);
    let run = folder.sh("sh picture '' ''; sh extract");
    assert_eq!((run.status, run.stdout.as_str()), (2, ""));
    assert!(run.stderr.contains("the photograph names no camera"), "{}", run.stderr);
    let named = folder.sh("sh picture 'Leica Camera AG' 'LEICA Q3'; sh extract --camera nikon-d70");
    assert!(
        named.stderr.lines().count() == 1 && named.stderr.contains("photo.tif: its EXIF names LEICA Q3"),
        "{}",
        named.stderr
    );
    assert!(scene(&named.stdout)["camera"]["stands_in"].is_null());
}

/// A picture of the 24 patches as a compact camera sees them in direct sun, the gains of its channels and the
/// exposure not being told.
const CHART: &str = r#"
    vkernel --angle-deg 180 --facets 1x1 |
        vforward --reflectance cc24 --camera canon-powershot-s90 --illuminant sun:40deg \
            --save facet_rgb=chart.npy > /dev/null
    fills=$(python3 - <<'END'
import numpy as np
for k, rgb in enumerate(np.load("chart.npy")[:, 0]):
    place = 10 + 54 * (k % 6), 10 + 54 * (k // 6)
    print("--fill:color={0:.9f},{1:.9f},{2:.9f} 48x48+{3}+{4}".format(*rgb, *place))
END
    )
    oiiotool --create 340x230 3 $fills --mulc 0.9,0.5,0.7 \
        --noise:type=gaussian:stddev=0.002:seed=3 -d half -o chart.exr
    oiiotool chart.exr --mulc 0.01 -d half -o dark.exr
    oiiotool chart.exr --mulc 4 -d uint16 -o clipped.tif
    chart="10,10 328,10 328,220 10,220"
"#;

#[test]
fn a_chart_makes_a_camera_file() {
    let folder = Workdir::new();
    if !folder.can("python3 -c 'import numpy'", "a camera from a picture of a chart") {
        return;
    }
    let run = folder.sh(&format!(
        r#"{CHART}
        vextract chart.exr --chart "$chart" --illuminant sun:40deg --save-camera mine.csv
        head -n 1 mine.csv
        vkernel --facets 1x1 -o scene.json
        for camera in canon-powershot-s90 mine.csv; do
            vforward scene.json --reflectance 0.5 --camera $camera -q
        done"#
    ));
    assert_eq!(run.status, 0, "{}", run.stderr);
    let mut lines = run.stdout.lines();
    assert_eq!(lines.next(), Some("wavelength_nm,R,R_sd,G,G_sd,B,B_sd"));
    let scenes = lines.filter(|line| line.contains("\"sensitivities\""));
    let curves: Vec<Vec<Vec<f64>>> = scenes
        .map(|line| serde_json::from_value(scene(line)["camera"]["sensitivities"].clone()).unwrap())
        .collect();
    // gains of the channels are part of the file: shapes are compared
    let shape = |curve: &Vec<f64>| {
        let peak = curve.iter().copied().fold(0.0, f64::max);
        curve.iter().map(|value| value / peak).collect::<Vec<_>>()
    };
    let squares = (0..3).flat_map(|k| {
        let pairs = shape(&curves[0][k]).into_iter().zip(shape(&curves[1][k]));
        pairs.map(|(a, b)| (a - b).powi(2)).collect::<Vec<_>>()
    });
    let error = (squares.sum::<f64>() / 183.0).sqrt();
    println!("a camera of a picture of a chart: {error:.4}");
    assert!(error < 0.03, "{error}");
}

#[test]
fn charts_that_make_no_camera() {
    let folder = Workdir::new();
    if !folder.can("python3 -c 'import numpy'", "a camera from a picture of a chart") {
        return;
    }
    assert_eq!(folder.sh(&format!("{CHART}\nprintf '%s' \"$chart\" > corners")).status, 0);
    for (flags, status, says) in [
        ("dark.exr --chart \"$(cat corners)\"", 1, "the chart is too dark"),
        ("clipped.tif --chart \"$(cat corners)\"", 1, "is clipped; expose less"),
        ("chart.exr --chart '328,220 10,220 10,10 328,10'", 1, "the chart is turned or mirrored"),
        ("chart.exr --chart \"$(cat corners)\" --chart-grid 6x4", 1, "off by"),
        ("chart.exr chart.exr --chart \"$(cat corners)\"", 2, "give the one with the chart"),
        ("chart.exr", 2, "--chart"),
    ] {
        let run = folder.sh(&format!("vextract {flags} --illuminant sun:40deg --save-camera mine.csv"));
        assert_eq!((run.status, run.stderr.lines().count()), (status, 1), "{flags}: {}", run.stderr);
        assert!(run.stderr.contains(says), "{flags}: {}", run.stderr);
        assert!(!folder.path().join("mine.csv").exists());
    }
}

const BLUE_FIRST: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/spectra/camera_blue_first.csv");

/// The same curves in columns in another order and called otherwise, as CSV and as rawtoaces' JSON: the
/// camera is the same.
#[test]
fn channels_are_found_by_name_in_any_order() {
    let folder = Workdir::new();
    let run = folder.sh(&format!(
        r##"
        cut -d, -f 1,4,3,2 {BLUE_FIRST} | awk -F, -v OFS=, '{{ print $1, $4, $3, $2 }}' > rgb.csv
        head -n 1 rgb.csv | grep -qx 'wavelength,R,G,B'
        awk -F, -v OFS=, 'NR == 1 {{ print "nm,green,BLUE,Red" }}
            NR > 1 {{ print $1, $3, $4, $2 }}' rgb.csv > words.csv
        awk -F, -v OFS=, 'NR == 1 {{ print "nm,B,B_sd,IR,Canon G,R_std,R,Canon G uncertainty" }}
            NR > 1 {{ print $1, $4, 1, 2, $3, 3, $2, 4 }}' rgb.csv > beside.csv
        awk -F, -v OFS=, -v OFMT=%.17g 'NR == 1 {{ print "nm,R,G1,G2,B" }}
            NR > 1 {{ print $1, $2, 0, 2 * $3, $4 }}' rgb.csv > greens.csv
        awk -F, 'BEGIN {{
                printf "{{\"spectral_data\": {{\"index\": {{\"main\": [\"B\", \"R\", \"G\"]}}, "
                printf "\"data\": {{\"main\": {{"
            }}
            NR > 1 {{ printf "%s\"%s\": [%s, %s, %s]", (NR > 2 ? ", " : ""), $1, $4, $2, $3 }}
            END {{ print "}}}}}}}}" }}' rgb.csv > aces.json
        vkernel --facets 1x1 -o scene.json
        for file in rgb.csv {BLUE_FIRST} words.csv beside.csv greens.csv aces.json; do
            vforward scene.json --reflectance cc24:orange --camera $file \
                --save facet_rgb=found.npy -o found.ndjson
            echo "$(cksum < found.npy)" >> sums
        done
        test "$(sort -u sums | wc -l)" = 1 || {{ cat sums; exit 1; }}"##
    ));
    assert_eq!(run.status, 0, "{}{}", run.stdout, run.stderr);
    let said: Vec<&str> = run.stderr.lines().filter_map(|line| line.split(": ").nth(2)).collect();
    assert_eq!(
        said,
        [
            "channels B, G, R put in the order R, G, B",
            "channels green, BLUE, Red put in the order R, G, B",
            "standard deviations left out, channels R, G and B taken by name, IR left out",
            "G is the mean of G1 and G2",
            "channels B, R, G put in the order R, G, B",
        ],
        "{}",
        run.stderr
    );
}

/// Columns whose names say no colour are taken as they stand, which is said; so is that all were scaled to
/// one peak.
#[test]
fn what_a_cameras_file_leaves_open_is_said() {
    let folder = Workdir::new();
    let run = folder.sh(r"
        vkernel --facets 1x1 -o scene.json
        printf 'nm,c1,c2,c3\n400,0,0.1,0.9\n550,0.1,1,0.1\n700,0.8,0,0\n' > places.csv
        printf 'nm,R,G,B\n400,0,0.1,1\n550,0.1,1,0.1\n700,1,0,0\n' > scaled.csv
        printf 'nm,R,G,B\n400,0,0.1,0.9\n550,0.1,1,0.1\n700,0.8,0,0\n' > good.csv
        for camera in places.csv scaled.csv good.csv nikon-d5100 arri-d21 sigma-sd-merrill; do
            vforward scene.json --reflectance 0.5 --camera $camera -o $camera.ndjson
        done");
    assert_eq!(
        run.stderr.lines().collect::<Vec<_>>(),
        [
            "vforward: places.csv: channels c1, c2, c3 taken as R, G, B by position, \
             as no name gives a colour",
            "vforward: scaled.csv: all channels have the same peak, unlike any camera's: \
             scaled one by one, they have lost their ratios",
        ]
    );
}

/// A photograph through such a camera is not called good.
#[test]
fn channels_scaled_one_by_one_are_a_doubt() {
    let folder = Workdir::new();
    let run = folder.sh(&format!(
        r##"
        vkernel --angle-deg 50 -o scene.json
        awk -F, -v OFS=, 'NR == 1 {{ print "nm,R,G,B" }} NR > 1 {{ print $1, $4, $3, $2 }}' {BLUE_FIRST} \
            > camera.csv
        vforward scene.json --reflectance cc24:orange --camera camera.csv --illuminant D65 \
            --render orange.exr > both.json
        tail -n 1 both.json > corners.json
        awk -F, -v OFS=, 'NR == 1 {{ print }} NR > 1 {{ print $1, $2 / 0.8, $3, $4 / 0.9 }}' camera.csv \
            > scaled.csv
        for camera in camera.csv scaled.csv; do
            vextract orange.exr --scene scene.json --camera $camera --illuminant D65 --regions corners.json \
                | vestimate -o $camera.ndjson
        done"##
    ));
    assert_eq!(run.status, 0, "{}", run.stderr);
    let says = |camera: &str| {
        let text = std::fs::read_to_string(folder.path().join(format!("{camera}.ndjson"))).unwrap();
        text.contains("they have lost their ratios")
    };
    assert!(says("scaled.csv") && !says("camera.csv"), "{}", run.stderr);
}

/// A chip of the ColorChecker seen by one camera, estimated with the curves of another.
struct Chip {
    rmse: f64,
    within_two_sd: f64,
    level: String,
}

/// All 24 of them, and what is said of them.
fn chips(seen_by: &str, told: &str, noise: &str) -> (Vec<Chip>, String) {
    let run = Workdir::new().sh(&format!(
        "vkernel --angle-deg 45 -o scene.json
         vforward scene.json --reflectance cc24 --camera {seen_by} {noise} | tail -n +2 > samples.ndjson
         vforward scene.json --reflectance 0.5 --camera {told} | head -n 1 | cat - samples.ndjson | vestimate"
    ));
    assert_eq!(run.status, 0, "{}", run.stderr);
    let chip = |line: &str| {
        let record: Value = serde_json::from_str(line).unwrap();
        let [truth, found, sd] = [
            &record["truth"]["reflectance"],
            &record["estimate"]["reflectance"],
            &record["estimate"]["reflectance_sd"],
        ]
        .map(numbers);
        let off: Vec<f64> = truth.iter().zip(&found).map(|(truth, found)| (truth - found).abs()).collect();
        let bands = off.len() as f64;
        Chip {
            rmse: (off.iter().map(|off| off * off).sum::<f64>() / bands).sqrt(),
            within_two_sd: off.iter().zip(&sd).filter(|(off, sd)| **off < 2.0 * **sd).count() as f64 / bands,
            level: record["estimate"]["verdict"]["level"].as_str().unwrap().to_owned(),
        }
    };
    (run.stdout.lines().skip(1).map(chip).collect(), run.stderr)
}

/// Two measurements of one camera.
const LABORATORIES: [&str; 2] = ["canon-5d-mark-ii", "canon-eos-5d-mark-ii"];

/// The curves of another laboratory, told for computed facets: the spectra that the stated ones ask for are
/// improbable, and errors of sensitivities are allowed for.
#[test]
fn curves_of_another_laboratory_are_allowed_for() {
    let [one, other] = LABORATORIES;
    let mut found = Vec::new();
    for (seen_by, told) in [(one, other), (other, one), (one, one)] {
        let (chips, said) = chips(seen_by, told, "--noise-sd 1e-3");
        let is_said = said.contains("sensitivities are probably not quite those stated");
        assert_eq!(is_said, seen_by != told, "{said}");
        let mean = |of: fn(&Chip) -> f64| chips.iter().map(of).sum::<f64>() / chips.len() as f64;
        let (rmse, within) = (mean(|chip| chip.rmse), mean(|chip| chip.within_two_sd));
        println!("seen by {seen_by}, told {told}: RMSE {rmse:.4}, within two sd {within:.3}");
        found.push([rmse, within]);
    }
    let [one, other, right] = found[..] else { panic!("{found:?}") };
    let [rmse, within] = [0, 1].map(|k| 0.5 * (one[k] + other[k]));
    assert!(rmse < 0.03 && within > 0.88, "{found:?}");
    assert!(right[0] < 0.0175 && right[1] > 0.9, "{found:?}");
}

/// Without noise the stated curves are believed to the last digit. Chips that are then far outside of their
/// bars are good only if a probable spectrum explains them, as it does three of 48; nine would be otherwise.
#[test]
fn without_noise_most_that_another_laboratory_saw_is_doubted() {
    let [one, other] = LABORATORIES;
    let both = [(one, other), (other, one)].map(|(seen_by, told)| chips(seen_by, told, "").0);
    let is_far_off = |chip: &&Chip| chip.rmse > 0.03 && chip.within_two_sd < 0.7;
    let lies = both.iter().flatten().filter(is_far_off).filter(|chip| chip.level == "good").count();
    assert!(lies <= 3, "{lies}");
    assert!(chips(one, one, "").0.iter().all(|chip| chip.level == "good"));
}
