//! Sheets that fluoresce, beside folds of measured ones that were computed elsewhere wavelength by
//! wavelength, every bounce exciting the sheet.

use std::fs;

use serde_json::Value;

use crate::common::{Workdir, is_there};

/// Folds with their explanations; not part of the project.
const FOLDS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/fluorescence");
const CAMERAS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data/cameras");
/// Noise of their facets.
const SD: f64 = 1e-3;

/// The matrix with this part of its fluorescence left: what lies next to the diagonal is reflected.
fn weaker(matrix: &str, strength: f64) -> String {
    let mut rows = matrix.lines();
    let header = rows.next().unwrap();
    let excitation_nm: Vec<f64> = header.split(',').skip(1).map(|nm| nm.parse().unwrap()).collect();
    let weaker = |row: &str| {
        let (emission, factors) = row.split_once(',').unwrap();
        let emission_nm: f64 = emission.parse().unwrap();
        let factors = factors.split(',').zip(&excitation_nm).map(|(factor, nm)| {
            let factor: f64 = factor.parse().unwrap();
            if emission_nm - nm > 10.5 { format!(",{}", strength * factor) } else { format!(",{factor}") }
        });
        format!("{emission}{}\n", factors.collect::<String>())
    };
    format!("{header}\n{}", rows.map(weaker).collect::<String>())
}

fn facets(sample: &Value) -> Vec<f64> {
    let facets = sample["facet_rgb"].as_array().unwrap().iter();
    facets.flat_map(|facet| facet.as_array().unwrap()).map(|value| value.as_f64().unwrap()).collect()
}

#[test]
fn measured_sheets_are_computed_as_elsewhere() {
    if !is_there(FOLDS) {
        return;
    }
    let folder = Workdir::new();
    let mut compared = 0;
    for entry in fs::read_dir(FOLDS).unwrap() {
        let path = entry.unwrap().path();
        let Some(name) = path.file_name().unwrap().to_str().unwrap().strip_suffix(".ndjson") else {
            continue;
        };
        let (camera, angle_deg) =
            if name.ends_with("-45-D65") { ("canon_eos_5d_mark_ii", 45) } else { ("nikon_d5100", 60) };
        let (sheet, light) = name.rsplit_once('-').unwrap();
        let (sheet, _) = sheet.rsplit_once('-').unwrap();
        let (sheet, strength) = match sheet.rsplit_once('-') {
            Some((sheet, "05")) => (sheet, 0.5),
            Some((sheet, "02")) => (sheet, 0.2),
            _ => (sheet, 1.0),
        };
        let matrix = fs::read_to_string(format!("{FOLDS}/donaldson/{sheet}.csv")).unwrap();
        fs::write(folder.path().join("matrix.csv"), weaker(&matrix, strength)).unwrap();
        let run = folder.sh(&format!(
            "vkernel --angle-deg {angle_deg} --facets 10x10 --mesh facets | \
             vforward -q --donaldson matrix.csv --camera {CAMERAS}/{camera}.csv --illuminant {light}"
        ));
        assert_eq!((run.status, run.stderr.as_str()), (0, ""), "{name}");
        let ours = facets(&serde_json::from_str(run.stdout.lines().nth(1).unwrap()).unwrap());
        let text = fs::read_to_string(&path).unwrap();
        let theirs = facets(&serde_json::from_str(text.lines().nth(1).unwrap()).unwrap());
        assert_eq!(ours.len(), theirs.len());
        let deviations = ours.iter().zip(&theirs).map(|(ours, theirs)| (ours - theirs) / SD);
        let chi_squared = deviations.map(|deviation| deviation * deviation).sum::<f64>() / ours.len() as f64;
        println!("{name}: chi squared {chi_squared:.3} a value");
        // of 600 values it spreads by 0.06
        assert!((0.75..1.25).contains(&chi_squared), "{name}: chi squared {chi_squared} a value");
        compared += 1;
    }
    assert!(compared >= 16, "{compared} folds");
}

/// A brightened sheet on the wavelengths of its scene, and the same sheet without what fluoresces.
const SHEETS: &str = "
printf 'emission_nm,360,400,450,500,550\n400,0.1,0.5,0,0,0\n450,0.2,0.1,0.7,0,0\n500,0.05,0.02,0.02,0.8,0\n\
    550,0,0,0,0,0.9\n' > bright.csv
printf 'emission_nm,360,400,450,500,550\n400,0,0.5,0,0,0\n450,0,0,0.7,0,0\n500,0,0,0,0.8,0\n\
    550,0,0,0,0,0.9\n' > plain.csv
printf 'nm,r\n400,0.5\n450,0.7\n500,0.8\n550,0.9\n' > r.csv
vkernel --angle-deg 50 --facets 3x3 --sky 0.2 > scene.json
";

fn facets_of(folder: &Workdir, flags: &str) -> Vec<f64> {
    let run = folder.sh(&format!("vforward scene.json --wavelengths-nm 400:550:50 {flags}"));
    assert_eq!((run.status, run.stderr.as_str()), (0, ""), "{flags}");
    facets(&serde_json::from_str(run.stdout.lines().nth(1).unwrap()).unwrap())
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    assert!(a.len() == b.len() && !a.is_empty());
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// What fluoresces is more the bluer the light; without it a matrix is a reflectance.
#[test]
fn a_matrix_without_fluorescence_is_a_reflectance() {
    let folder = Workdir::new();
    folder.sh(SHEETS);
    let reflectance = facets_of(&folder, "--reflectance r.csv --sky-illuminant D75");
    let plain = facets_of(&folder, "--donaldson plain.csv --sky-illuminant D75");
    assert!(largest_difference(&plain, &reflectance) < 1e-12);
    let [bulb, day] = ["2856K", "D75"].map(|light| {
        let bright = facets_of(&folder, &format!("--donaldson bright.csv --illuminant {light}"));
        largest_difference(&bright, &facets_of(&folder, &format!("--reflectance r.csv --illuminant {light}")))
    });
    assert!(bulb > 0.005 && day > 2.0 * bulb, "{bulb} {day}");
}

/// Of direct light the matrix makes what `--fluorescence` says for that light; of bounces more, as they
/// excite the sheet again.
#[test]
fn direct_light_is_what_a_part_of_white_says() {
    let folder = Workdir::new();
    folder.sh(SHEETS);
    folder.sh("vforward scene.json --wavelengths-nm 400:550:50 --donaldson bright.csv -o truth.ndjson");
    folder.sh("python3 - <<'END'
import json
truth = json.loads(open('truth.ndjson').readlines()[1])['truth']
parts = [total - r for total, r in zip(truth['total_radiance_factor'], truth['reflectance'])]
open('f.csv', 'w').write('nm,f\\n' + ''.join(f'{nm},{f!r}\\n' for nm, f in \
    zip(truth['wavelengths_nm'], parts)))
END");
    let both = |bounces: &str| {
        let matrix = facets_of(&folder, &format!("--donaldson bright.csv --bounces {bounces}"));
        let part =
            facets_of(&folder, &format!("--reflectance r.csv --fluorescence f.csv --bounces {bounces}"));
        (matrix, part)
    };
    let (matrix, part) = both("0");
    assert!(largest_difference(&matrix, &part) < 1e-12);
    let (matrix, part) = both("inf");
    assert!(matrix.iter().zip(&part).all(|(matrix, part)| *matrix > part - 1e-12));
    assert!(largest_difference(&matrix, &part) > 0.005);
}

#[test]
fn what_says_nothing_of_a_matrix_is_refused_in_one_line() {
    let folder = Workdir::new();
    folder.sh(SHEETS);
    let short = "--wavelengths-nm 400:550:50 --donaldson";
    for (flags, want) in [
        (format!("{short} bright.csv --illuminant D50 --illuminant D65"), "give one --illuminant"),
        ("--donaldson bright.csv".to_owned(), "its samples cover 400..550 nm"),
        (format!("{short} r.csv"), "the name of column 'r' is not an excitation wavelength"),
        (format!("{short} bright.csv --reference-panel 0.9"), "cannot be used with"),
    ] {
        let run = folder.sh(&format!("vforward scene.json {flags}"));
        assert!(run.status != 0 && run.stdout.is_empty(), "{flags}: {run:?}");
        assert!(run.stderr.contains(want) && run.stderr.lines().count() == 1, "{flags}: {run:?}");
    }
}

/// A script that writes Donaldson matrices of two sheets: one that emits, and the same without what
/// fluoresces. In Python, `reflected` is the reflectance at `nm`, `sent` what is emitted there of light of
/// the wavelength `of`.
fn matrices([emitting, plain]: [&str; 2], reflected: &str, sent: &str) -> String {
    format!(
        "python3 - <<'END'
from math import exp
for name, strength in ('{emitting}', 1), ('{plain}', 0):
    with open(f'{{name}}.csv', 'w') as file:
        excitation = range(300, 710, 10)
        file.write('emission_nm,' + ','.join(map(str, excitation)) + '\\n')
        for nm in range(380, 710, 10):
            def factor(of):
                return {reflected} if of == nm else strength * (nm - of > 10) * {sent}
            file.write(f'{{nm}},' + ','.join(repr(factor(of)) for of in excitation) + '\\n')
END
"
    )
}

/// Facets of a white sheet with a brightener, and of the same without: emission about 440 nm, Gaussian in
/// wavelengths.
fn white() -> String {
    let sent = "0.06 * exp(-(((nm - 440) / 22) ** 2 + ((of - 365) / 28) ** 2) / 2)";
    matrices(["brightened", "white"], "0.86 - 0.65 / (1 + exp((nm - 402) / 8))", sent)
        + "for sheet in brightened white; do
    vkernel --angle-deg 45 | vforward -q --donaldson $sheet.csv --illuminant D65 --wavelengths-nm 400:700:5 \
        --camera canon-5d-mark-ii --noise-sd 1e-3 >$sheet.ndjson
done
"
}

/// The record of a sheet, and its verdict.
fn estimated(folder: &Workdir, sheet: &str, flags: &str) -> Value {
    let run = folder.sh(&format!("vestimate -q {flags} {sheet}"));
    assert_eq!((run.status, run.stderr.as_str()), (0, ""), "{sheet} {flags}");
    serde_json::from_str::<Value>(run.stdout.lines().nth(1).unwrap()).unwrap()
}

fn numbers(of: &Value) -> Vec<f64> {
    of.as_array().unwrap().iter().map(|value| value.as_f64().unwrap()).collect()
}

/// Root mean square difference from 430 nm on, where cameras see.
fn rmse(estimate: &Value, field: &str, truth: &[f64]) -> f64 {
    let nm = numbers(&estimate["wavelengths_nm"]);
    let own = numbers(&estimate[field]);
    let off: Vec<f64> =
        (0..nm.len()).filter(|n| (430.0..=680.0).contains(&nm[*n])).map(|n| own[n] - truth[n]).collect();
    (off.iter().map(|off| off * off).sum::<f64>() / off.len() as f64).sqrt()
}

#[test]
fn a_brightener_is_told_from_what_is_reflected() {
    let folder = Workdir::new();
    let run = folder.sh(&white());
    assert_eq!((run.status, run.stderr.as_str()), (0, ""));
    for exposure in ["--exposure 1", "--exposure free"] {
        let record = estimated(&folder, "brightened.ndjson", exposure);
        let (estimate, truth) = (&record["estimate"], &record["truth"]);
        let found = &estimate["fluorescence"];
        let of = |name: &str| found[name].as_f64().unwrap();
        let [reflected, total] = ["reflectance", "total_radiance_factor"].map(|field| numbers(&truth[field]));
        let sizes = total.iter().zip(&reflected).map(|(total, reflected)| total - reflected);
        let size = sizes.fold(0.0, f64::max);
        println!("{exposure}: {found}, truly {size:.3}");
        assert!(of("probability") > 0.9 && (425.0..=455.0).contains(&of("peak_nm")), "{found}");
        assert!((of("size") - size).abs() < 4.0 * of("size_sd") + 0.02, "{found}: truly {size}");
        let [of_reflected, of_total] = [("reflectance", &reflected), ("total_radiance_factor", &total)]
            .map(|(f, truth)| rmse(estimate, f, truth));
        assert!(of_reflected < 0.04 && of_total < 0.04, "{exposure}: {of_reflected} {of_total}");
        let verdict = estimate["verdict"]["because"].as_str().unwrap();
        assert!(verdict.contains("the sheet contains a brightener"), "{verdict}");
        folder.sh(&format!("vestimate -q {exposure} brightened.ndjson --spectra both.csv -o both.ndjson"));
        let header = fs::read_to_string(folder.path().join("both.csv")).unwrap();
        let columns: Vec<&str> = header.lines().next().unwrap().split(',').collect();
        assert!(columns.len() == 5 && columns[3].ends_with(" total"), "{columns:?}");
        let record = estimated(&folder, "white.ndjson", exposure);
        assert!(record["estimate"]["fluorescence"].is_null(), "{exposure}: {}", record["estimate"]);
    }
}

/// With a channel or two, many spectra have one effect: none of them is taken for light that a sheet emits.
#[test]
fn few_channels_tell_of_no_fluorescence() {
    let folder = Workdir::new();
    for channels in [1, 2] {
        let run = folder.sh(&format!(
            "awk -v n={channels} 'BEGIN {{
                 printf \"nm\"
                 for (k = 0; k < n; k++) printf \",c%d\", k
                 print \"\"
                 for (nm = 400; nm <= 700; nm += 5) {{
                     printf \"%d\", nm
                     for (k = 0; k < n; k++) {{
                         off = 2 * ((nm - 400) * n / 300 - k - 0.5)
                         printf \",%.6f\", exp(-off * off / 2)
                     }}
                     print \"\"
                 }}
             }}' > camera.csv
             vkernel | vforward -q --reflectance cc24 --camera camera.csv --noise-sd 1e-3 | vestimate -q"
        ));
        let records = run.stdout.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
        let samples: Vec<Value> = records.filter(|record| record["kind"] == "sample").collect();
        assert_eq!(samples.len(), 24, "{run:?}");
        for sample in samples {
            assert!(sample["estimate"]["fluorescence"].is_null(), "{channels}: {}", sample["id"]);
        }
    }
}

#[test]
fn what_visible_light_excites_is_named_and_never_good() {
    if !is_there(FOLDS) {
        return;
    }
    let folder = Workdir::new();
    let sheets = ["lemon-crayon-on-card", "yellow-textile"];
    let scenes = ["45-D65", "60-D50"];
    let mut named = 0;
    for sheet in sheets.iter().flat_map(|sheet| scenes.map(|scene| format!("{FOLDS}/{sheet}-{scene}.ndjson")))
    {
        for exposure in ["--exposure 1", "--exposure free"] {
            let verdict = &estimated(&folder, &sheet, exposure)["estimate"]["verdict"];
            assert_ne!(verdict["level"], "good", "{sheet} {exposure}: {verdict}");
            named += usize::from(verdict["because"].as_str().unwrap().contains("this sheet fluoresces"));
        }
    }
    assert!(named >= 6, "{named} of 8");
}

/// Photographs of a yellow cloth whose dye violet and blue light excites, and of the same cloth without the
/// dye: with the sun two and three degrees to the side, unlike what is stated.
fn dyed() -> String {
    let sent = "0.07 * exp(-(((nm - 520) / 20) ** 2 + ((of - 450) / 30) ** 2) / 2)";
    matrices(["dyed", "undyed"], "0.05 + 0.7 / (1 + exp((490 - nm) / 8))", sent)
        + "vkernel --angle-deg 50 >stated.json
for tilt in 2 3; do
    vkernel --angle-deg 50 --tilt-deg $tilt >scene.json
    for sheet in dyed undyed; do
        vforward scene.json --donaldson $sheet.csv --illuminant D65 --wavelengths-nm 400:700:5 \
            --exposure 0.7 --camera canon-5d-mark-ii --photon-noise 0.005 \
            --render $sheet.tif --render-size 320x240 2>corners >$sheet.truth
        eval vextract --scene stated.json $sheet.tif $(sed 's/.* has its corners at //' corners) \
            --transfer linear --illuminant D65 --camera canon-5d-mark-ii -q -o $sheet$tilt.ndjson
    done
done
"
}

#[test]
fn a_dye_in_a_photograph_is_named_and_its_light_told_from_what_is_reflected() {
    let folder = Workdir::new();
    let run = folder.sh(&dyed());
    assert_eq!((run.status, run.stderr.as_str()), (0, ""));
    let truth = fs::read_to_string(folder.path().join("dyed.truth")).unwrap();
    let truth: Value = serde_json::from_str(truth.lines().nth(1).unwrap()).unwrap();
    let reflected = numbers(&truth["truth"]["reflectance"]);
    for tilt in [2, 3] {
        let [dyed, undyed] =
            ["dyed", "undyed"].map(|sheet| estimated(&folder, &format!("{sheet}{tilt}.ndjson"), ""));
        let (estimate, plain) = (&dyed["estimate"], &undyed["estimate"]);
        let verdict = &estimate["verdict"];
        println!("{tilt}: {verdict} {}", estimate["fluorescence"]);
        assert_eq!(verdict["level"], "doubtful", "{tilt}: {verdict}");
        assert!(verdict["because"].as_str().unwrap().contains("this sheet fluoresces"), "{tilt}: {verdict}");
        let peak_nm = estimate["fluorescence"]["peak_nm"].as_f64().unwrap();
        assert!((510.0..=545.0).contains(&peak_nm), "{tilt}: {peak_nm}");
        let [off, without] = [estimate, plain].map(|one| rmse(one, "reflectance", &reflected));
        println!("{tilt}: {off} {without}");
        assert!(off < 0.1 && without < 0.05, "{tilt}: {off} {without}");
        assert!(plain["fluorescence"].is_null(), "{tilt}: {plain}");
    }
    for (sheet, is_dyed) in [("dyed", true), ("undyed", false)] {
        let joined = format!("cat {sheet}2.ndjson {sheet}3.ndjson | vestimate -q --join");
        let run = folder.sh(&joined);
        assert_eq!((run.status, run.stderr.as_str()), (0, ""), "{sheet}");
        let records = run.stdout.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
        for record in records.filter(|record| record["kind"] == "sample") {
            let estimate = &record["estimate"];
            let off = rmse(estimate, "reflectance", &reflected);
            println!("{sheet} joined: {off} {} {}", estimate["verdict"], estimate["fluorescence"]);
            assert_eq!(!estimate["fluorescence"].is_null(), is_dyed, "{sheet}: {estimate}");
            assert!(off < if is_dyed { 0.1 } else { 0.05 }, "{sheet}: {off}");
        }
    }
}

/// A thin sheet before a bright table: light from behind comes through it, in proportion to the square of its
/// reflectance.
const THIN: &str = "
python3 - <<'END'
from math import exp
with open('r.csv', 'w') as r, open('f.csv', 'w') as f:
    r.write('nm,r\\n')
    f.write('nm,f\\n')
    for nm in range(400, 705, 5):
        reflectance = 0.62 - 0.25 * exp(-((nm - 470) / 60) ** 2 / 2)
        r.write(f'{nm},{reflectance!r}\\n')
        f.write(f'{nm},{0.12 * reflectance ** 2!r}\\n')
END
vkernel --angle-deg 45 >scene.json
for flags in '--fluorescence f.csv' ''; do
    n=$((${n:--1} + 1))
    vforward scene.json -q --reflectance r.csv $flags --illuminant D65 --camera canon-5d-mark-ii \\
        --noise-sd 1e-3 >sheet$n.ndjson
done
";

#[test]
fn light_comes_through_a_sheet_unless_it_is_backed() {
    let folder = Workdir::new();
    let run = folder.sh(THIN);
    assert_eq!((run.status, run.stderr.as_str()), (0, ""));
    let off =
        |record: &Value| rmse(&record["estimate"], "reflectance", &numbers(&record["truth"]["reflectance"]));
    let because = |record: &Value| record["estimate"]["verdict"]["because"].as_str().unwrap().to_owned();
    let [open, backed] =
        ["", "--backed"].map(|flag| estimated(&folder, "sheet0.ndjson", &format!("--exposure 1 {flag}")));
    assert!(because(&open).contains("light from behind comes through the sheet"), "{}", because(&open));
    assert!(!because(&backed).contains("from behind"), "{}", because(&backed));
    // that of one said to be backed is as good only because errors of the camera's sensitivities are possible
    assert!(off(&open) < 0.022, "{} {}", off(&open), off(&backed));
    // what nothing comes through is the same either way, and the scene says what it was taken to be
    let [open, backed] =
        ["", "--backed"].map(|flag| estimated(&folder, "sheet1.ndjson", &format!("--exposure 1 {flag}")));
    assert!(because(&open).starts_with("model and facets") && because(&open) == because(&backed));
    let run = folder.sh("vestimate -q --exposure 1 --backed sheet0.ndjson | vestimate -q --exposure 1");
    let [scene, record] = [0, 1].map(|n| run.stdout.lines().nth(n).unwrap());
    assert_eq!(serde_json::from_str::<Value>(scene).unwrap()["backed"], true);
    assert!(!record.contains("from behind"), "the scene says that it is backed");
}
