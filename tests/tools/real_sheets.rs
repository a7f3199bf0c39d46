//! Photographs of sheets as they are, glossy, rough, bowed, under a real sky and through a real lens, with
//! the defaults of every tool: the truth is what an instrument of 45:0 says. The table is printed with
//! `cargo test --test tools real_sheets -- --nocapture`.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use nalgebra::{DMatrix, DVector, SymmetricEigen};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use serde_json::{Value, json};
use vfold::colorimetry::{Colorimeter, Observer};
use vfold::estimate::measured::Measured;
use vfold::estimate::photograph;
use vfold::estimate::prior::Prior;
use vfold::image::{Point, camera_pose};
use vfold::scene::{FoldSetting, PhotographedFold, Picture, Setting};
use vfold::spectrum::{WavelengthGrid, illuminant};
use vfold::stream::{Reader, Record, Sample, Scene};

use crate::common::{Ended, Workdir, left_out};

const SHARED: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared");

/// What came of a photograph.
pub struct Outcome {
    name: String,
    pub rmse: f64,
    mean_error: f64,
    delta_e: Option<f64>,
    /// CIEDE2000 that is expected where nothing is known but what the facets and the prior tell.
    expected_delta_e: Option<f64>,
    pub within_two_sd: f64,
    /// Two standard deviations to both sides.
    pub bar: f64,
    /// What the tools say is not ideal about the photograph.
    findings: Vec<String>,
    /// The kind of day on which they say that it was taken, and the verdict.
    day: Option<String>,
    level: String,
}

#[test]
fn sheets_as_they_are_give_their_spectra() {
    let Some(real) = sidecars("real") else { return };
    let all: Vec<Outcome> = real.iter().map(|path| of_real(path)).collect();
    let every: Vec<&Outcome> = all.iter().filter(|one| one.name.starts_with("all_")).collect();
    print_table(&all);
    // 0.023 before gloss changed with the fold and the sun's colour varied as in the photographs that priors
    // are fitted to: all rendered ones together came nearer by that, two of these five went further off
    assert!(mean(&every, |one| one.rmse) < 0.024, "all effects: {}", mean(&every, |one| one.rmse));
    let delta_e = mean(&every, |one| one.delta_e.unwrap());
    assert!(delta_e < 2.0, "all effects: {delta_e}");
    assert!(mean(&every, |one| one.within_two_sd) > 0.85);
    assert!(mean(&every, |one| one.bar) < 0.2, "all effects: bars of {}", mean(&every, |one| one.bar));
    for one in all.iter().filter(|one| one.name.starts_with("one_")) {
        assert!(one.rmse < 0.03 && one.within_two_sd > 0.85, "{}: {}", one.name, one.rmse);
        // what a free exposure leaves open of the lightness is more than some of them are off by
        let (delta_e, expected) = (one.delta_e.unwrap(), one.expected_delta_e.unwrap());
        assert!(delta_e < expected.max(1.5), "{}: {delta_e}, expected {expected}", one.name);
    }
    for (name, symptom) in [
        ("one_gloss", "the sheet is glossy"),
        ("one_rough", "the sheet is rough"),
        ("one_crease", "the crease is rounded"),
        ("one_camera", "the lens darkens the corners of the picture"),
    ] {
        let Some(one) = all.iter().find(|one| one.name == name) else { continue };
        assert!(one.findings.iter().any(|what| what == symptom), "{name}: {:?}", one.findings);
    }
}

/// Taken as the others are; error model and priors were looked at with them in view.
#[test]
fn more_sheets_give_their_spectra() {
    let Some(more) = sidecars("real/more") else { return };
    let all: Vec<Outcome> = more.iter().map(|path| of_real(path)).collect();
    print_table(&all);
    let every: Vec<&Outcome> = all.iter().collect();
    assert!(mean(&every, |one| one.rmse) < 0.029, "more: {}", mean(&every, |one| one.rmse));
    assert!(mean(&every, |one| one.within_two_sd) > 0.85);
}

/// Overcast, in haze, under thin cloud and in the shade; nothing is stated of the sky.
#[test]
fn sheets_under_other_skies_give_their_spectra() {
    let Some(skies) = sidecars("sky") else { return };
    let all: Vec<Outcome> = skies.iter().map(|path| of_real(path)).collect();
    print_table(&all);
    let every: Vec<&Outcome> = all.iter().collect();
    assert!(mean(&every, |one| one.rmse) < 0.038, "other skies: {}", mean(&every, |one| one.rmse));
    assert!(mean(&every, |one| one.within_two_sd) > 0.85);
    for one in all.iter().filter(|one| one.level == "good") {
        assert!(one.within_two_sd > 0.7, "{}: {}", one.name, one.within_two_sd);
    }
    let kind = |path: &PathBuf| {
        let sidecar: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
        let sky = &sidecar["rendered"]["sky"];
        match (sky["type"].as_str(), sky["share"].as_f64()) {
            (Some("overcast"), _) => "overcast",
            (_, Some(0.9..)) => "shade",
            _ => "hazy",
        }
    };
    let right = all.iter().zip(&skies).filter(|(one, path)| one.day.as_deref() == Some(kind(path))).count();
    // of the two in which the sun gives half of the light or more the facets leave it open whether the day is
    // hazy
    assert!(right + 2 >= all.len(), "{:?}", all.iter().map(|one| &one.day).collect::<Vec<_>>());
}

/// On a white table, on grass, on red and on blue cloth.
#[test]
fn sheets_on_other_grounds_give_their_spectra() {
    let Some(grounds) = sidecars("ground") else { return };
    let all: Vec<Outcome> = grounds.iter().map(|path| of_real(path)).collect();
    print_table(&all);
    let every: Vec<&Outcome> = all.iter().collect();
    assert!(mean(&every, |one| one.rmse) < 0.05, "other grounds: {}", mean(&every, |one| one.rmse));
    assert!(mean(&every, |one| one.within_two_sd) > 0.85);
}

/// Within twice their noise its facets are those of an ideal fold of another spectrum, 0.08 off, which says
/// little of itself.
#[test]
fn a_little_gloss_is_not_taken_for_bounces() {
    let run = Workdir::new().sh("
        vkernel --angle-deg 70 | vforward --reflectance cc24:yellow --specular-weight 0.2 \
            --illuminant daylight:5300 --exposure 0.6 \\
            --noise-sd 1e-3 --photon-noise 1e-2 --render p.tif --render-size 400x300 -q -o simulated.ndjson
        vkernel --angle-deg 70 -o scene.json
        vextract p.tif --regions simulated.ndjson --scene scene.json --camera canon-5d-mark-ii \
            --illuminant D55 -q -o p.ndjson
        for fit in none auto; do vestimate -q --fit $fit p.ndjson | vscore -q --truth cc24:yellow; done");
    let found: Vec<Value> = run.stdout.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let found = found.iter().filter(|record| record["kind"] == "sample");
    let found: Vec<[f64; 2]> = found
        .map(|one| [&one["estimate"]["residual_rms"], &one["metrics"]["rmse"]].map(|n| n.as_f64().unwrap()))
        .collect();
    let [[ideal_residual, ideal], [residual, rmse]] = found[..] else { panic!("{run:?}") };
    println!(
        "residual and RMSE, ideal fold {ideal_residual:.3} {ideal:.3}, by default {residual:.3} {rmse:.3}"
    );
    assert!(ideal_residual < 2.0 && residual < 1.0 && rmse < 0.04 && rmse < 0.6 * ideal, "{found:?}");
}

/// Their shapes are among those of the prior, so that this tests the way from the picture to the spectrum,
/// not the prior.
#[test]
fn measured_materials_give_their_reflectance() {
    let Some(materials) = sidecars("materials") else { return };
    for (exposure, most) in [("--exposure 1", 0.03), ("--exposure free", 0.042)] {
        let all: Vec<Outcome> = materials.iter().map(|path| of_material(path, exposure)).collect();
        println!("{exposure}");
        print_table(&all);
        let error = mean(&all.iter().collect::<Vec<_>>(), |one| one.mean_error);
        assert!(error < most, "{exposure}: {error}");
        let within = mean(&all.iter().collect::<Vec<_>>(), |one| one.within_two_sd);
        assert!(within > 0.85, "{exposure}: {within}");
    }
}

/// Each material left out of the sheets that are known, as one is that nobody measured.
#[test]
fn measured_materials_left_out_in_turn() {
    let Some(materials) = sidecars("materials") else { return };
    for (exposure, most) in [(Some(1.0), 0.03), (None, 0.042)] {
        let all: Vec<Outcome> =
            materials.iter().map(|path| left_out_of_what_is_known(path, exposure)).collect();
        println!("left out, exposure {exposure:?}");
        print_table(&all);
        let error = mean(&all.iter().collect::<Vec<_>>(), |one| one.mean_error);
        assert!(error < most, "{exposure:?}: {error}");
        let within = mean(&all.iter().collect::<Vec<_>>(), |one| one.within_two_sd);
        assert!(within > 0.85, "{exposure:?}: {within}");
    }
}

/// Name of the measured sheet that a material's photograph is of.
fn measured_name(path: &Path) -> &'static str {
    let name = path.file_stem().unwrap().to_string_lossy().into_owned();
    let known: Vec<&str> = vfold::sheet::measured_names().filter(|known| known.ends_with(&name)).collect();
    let [known] = known[..] else { panic!("{name}: {known:?}") };
    known
}

/// What vextract makes of a material's photograph.
fn material(path: &Path) -> (Scene, Sample) {
    let folder = Workdir::new();
    let records = folder.path().join("records.ndjson");
    let run = folder.sh(&format!("{} > records.ndjson", material_records(path)));
    assert!(run.status == 0, "{}: {}", path.display(), run.stderr);
    let mut reader = Reader::open(&records.to_string_lossy()).unwrap();
    let mut records = std::iter::from_fn(|| reader.read().unwrap());
    match (records.next(), records.next()) {
        (Some(Record::Scene(scene)), Some(Record::Sample(sample))) => (scene, sample),
        _ => panic!("{}: no scene and sample", path.display()),
    }
}

fn left_out_of_what_is_known(path: &Path, exposure: Option<f64>) -> Outcome {
    let known = measured_name(path);
    let (scene, sample) = material(path);
    let setting = FoldSetting::of(&scene).unwrap();
    let [rgb, sd] = [sample.facet_rgb().unwrap(), sample.facet_sd().unwrap().unwrap()];
    let fold = PhotographedFold::of(&setting).leaving_out(known);
    let measured = Measured { rgb: &rgb, sd: &sd };
    let parts = fold.parts(&Picture::of(&sample, &measured, exposure).unwrap()).unwrap().unwrap();
    let grid = scene.grid().unwrap();
    let prior = Prior::built_in(grid.wavelengths_nm()).unwrap();
    let parts = [parts];
    let estimate = photograph::estimate(&parts, &prior).unwrap();
    let estimate = &estimate.photographs[0];
    let sample = json!({"estimate": {
        "reflectance": estimate.reflectance,
        "reflectance_sd": estimate.reflectance_sd(),
    }});
    let sidecar: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    let bands = numbers(&sidecar["bands_nm"]);
    let place = |band: &f64| grid.wavelengths_nm().iter().position(|nm| (nm - band).abs() < 0.1).unwrap();
    let places: Vec<usize> = bands.iter().map(place).collect();
    outcome(path, &sample, &numbers(&sidecar["reflectance_45_0"]), |all| {
        places.iter().map(|n| all[*n]).collect()
    })
}

/// An oracle that knows how a material reflects over the directions, one shape for all wavelengths, and how
/// much at 45:0: what its facets are off from the photograph's, no estimate from them can know of the 45:0
/// reflectance.
#[test]
fn materials_facets_do_not_tell_all_that_an_instrument_says() {
    let Some(materials) = sidecars("materials") else { return };
    println!("measured facets over those of the true reflectance and the material's own shape, by band");
    let mut squares = Vec::new();
    for path in &materials {
        let known = measured_name(path);
        let place = vfold::sheet::measured_names().position(|name| name == known).unwrap();
        let shape = &vfold::sheet::measured().unwrap()[place];
        let (scene, sample) = material(path);
        let setting = FoldSetting::of(&scene).unwrap();
        let sidecar: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
        let panel = |name: &str| -> [Point; 4] {
            let corners = sidecar[name].as_array().unwrap().iter().map(numbers);
            corners.map(|at| Point::new(at[0], at[1])).collect::<Vec<_>>().try_into().unwrap()
        };
        let eye = camera_pose(&setting.fold, &[panel("panel0"), panel("panel1")]).unwrap();
        let folded = setting.folded_sheet(shape.clone(), eye.position.coords, None).unwrap();
        let model = Setting::of(&scene).unwrap().model().unwrap();
        let measured = sample.facet_rgb().unwrap();
        let truth = numbers(&sidecar["reflectance_45_0"]);
        let ratios: Vec<f64> = truth
            .iter()
            .enumerate()
            .map(|(channel, reflectance)| {
                let albedo = folded.albedo(&vec![*reflectance; scene.grid().unwrap().len()]).unwrap();
                let predicted = model.facet_rgb(&albedo) + folded.beyond(&albedo);
                // away from the crease
                let facets = (0..200).filter(|facet| facet % 100 >= 20);
                let ratio = |facet: usize| {
                    measured.get(facet, channel).map(|value| value / predicted[(facet, channel)])
                };
                let ratios: Vec<f64> = facets.filter_map(ratio).collect();
                ratios.iter().sum::<f64>() / ratios.len() as f64
            })
            .collect();
        println!("{known:<40}{}", ratios.iter().map(|ratio| format!("{ratio:>8.3}")).collect::<String>());
        squares.extend(ratios.iter().map(|ratio| (ratio - 1.0).powi(2)));
    }
    let rms = (squares.iter().sum::<f64>() / squares.len() as f64).sqrt();
    println!("root mean square {rms:.3}");
    assert!((0.03..0.12).contains(&rms), "{rms}");
}

/// The command that makes the records of a material's photograph.
fn material_records(path: &Path) -> String {
    let sidecar: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    let bands = numbers(&sidecar["bands_nm"]);
    let wavelengths: Vec<f64> = (0..61).map(|n| 400.0 + 5.0 * f64::from(n)).collect();
    let channel = |band: &f64| wavelengths.iter().map(|nm| f64::from((nm - band).abs() < 0.1)).collect();
    let camera = table(&wavelengths, &bands.iter().map(channel).collect::<Vec<_>>());
    let light = table(&wavelengths, &[vec![1.0; 61]]);
    format!(
        r#"
cat > camera.csv <<END
{camera}END
cat > light.csv <<END
{light}END
vkernel --angle-deg {angle} --tilt-deg {tilt} |
vextract -q "{photo}" --camera camera.csv --illuminant light.csv --panel0 '{panel0}' --panel1 '{panel1}'"#,
        angle = sidecar["angle_deg"],
        tilt = sidecar["tilt_deg"],
        photo = path.with_extension("exr").display(),
        panel0 = corners(&sidecar["panel0"]),
        panel1 = corners(&sidecar["panel1"]),
    )
}

/// What vforward makes of a sheet of which the renderer was told the same: facets away from the crease within
/// 0.6 % of its photograph's, the noise of which is 0.1 %.
#[test]
fn simulated_sheets_look_as_the_renderers_do() {
    for (name, flags) in [
        ("one_gloss", "--specular-weight 0.5 --specular-roughness 0.4"),
        ("one_rough", "--body-roughness-deg 20"),
    ] {
        let path = Path::new(SHARED).join("real").join(name).with_extension("json");
        if !path.exists() {
            left_out(&format!("{}, which is not there", path.display()));
            return;
        }
        let sidecar: Value = serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
        let told = &sidecar["told"];
        let wavelengths = numbers(&sidecar["wavelengths_nm"]);
        let columns = |columns: &[Vec<f64>]| table(&wavelengths, columns);
        let camera: Vec<_> =
            told["camera_sensitivities_rgb"].as_array().unwrap().iter().map(numbers).collect();
        let run = Workdir::new().sh(&format!(
            r#"
cat > camera.csv <<END
{camera}END
cat > light.csv <<END
{light}END
cat > truth.csv <<END
{truth}END
vkernel --angle-deg {angle} > scene.json
vextract -q "{photo}" --camera camera.csv --illuminant light.csv --panel0 '{panel0}' --panel1 '{panel1}' \
    < scene.json | tail -n 1
vforward scene.json --camera camera.csv --illuminant light.csv --reflectance truth.csv {flags} \
    --eye=0.96547,1.10338,8.36309 | tail -n 1
"#,
            camera = columns(&camera),
            light = columns(&[numbers(&told["illuminant_spd"])]),
            truth = columns(&[numbers(&sidecar["reflectance"])]),
            angle = told["angle_deg"],
            photo = path.with_extension("tif").display(),
            panel0 = corners(&told["panel0"]),
            panel1 = corners(&told["panel1"]),
        ));
        assert!(run.status == 0, "{name}: {}", run.stderr);
        let [seen, made] =
            [0, 1].map(|n| rows(&serde_json::from_str(run.stdout.lines().nth(n).unwrap()).unwrap()));
        // the photograph's exposure is its own
        let scale = seen[1..].iter().flatten().sum::<f64>() / made[1..].iter().flatten().sum::<f64>();
        for (row, (seen, made)) in seen.iter().zip(&made).enumerate().skip(1) {
            for (seen, made) in seen.iter().zip(made) {
                assert!(
                    (seen / (scale * made) - 1.0).abs() < 6e-3,
                    "{name}, row {row}: {seen} {}",
                    scale * made
                );
            }
        }
    }
}

/// Means of the rows of both panels, crease first: row by panel and channel.
fn rows(sample: &Value) -> Vec<Vec<f64>> {
    let facets: Vec<Vec<f64>> = sample["facet_rgb"].as_array().unwrap().iter().map(numbers).collect();
    let mean = |panel: usize, row: usize, channel: usize| {
        (0..10).map(|column| facets[100 * panel + 10 * row + column][channel]).sum::<f64>() / 10.0
    };
    (0..10).map(|row| (0..6).map(|n| mean(n / 3, row, n % 3)).collect()).collect()
}

pub fn print_table(all: &[Outcome]) {
    println!(
        "picture                RMSE   mean error  CIEDE2000  expected  within two sd  width of the bars"
    );
    for Outcome { name, rmse, mean_error, delta_e, expected_delta_e, within_two_sd, bar, .. } in all {
        let [delta_e, expected] =
            [delta_e, expected_delta_e].map(|one| one.map_or_else(String::new, |one| format!("{one:.2}")));
        println!(
            "{name:<20}{rmse:>8.4}{mean_error:>12.4}{delta_e:>10}{expected:>11}\
             {within_two_sd:>14.2}{bar:>15.3}"
        );
    }
}

fn mean(all: &[&Outcome], of: impl Fn(&Outcome) -> f64) -> f64 {
    all.iter().map(|one| of(one)).sum::<f64>() / all.len() as f64
}

/// The sidecars of a folder of photographs, in the order of their names.
pub fn sidecars(folder: &str) -> Option<Vec<PathBuf>> {
    let folder = Path::new(SHARED).join(folder);
    let Ok(entries) = fs::read_dir(&folder) else {
        left_out(&format!("the photographs of {}, which is not there", folder.display()));
        return None;
    };
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "json"));
    paths.sort();
    Some(paths)
}

fn of_real(path: &Path) -> Outcome {
    let sidecar: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    let truth = numbers(&sidecar["reflectance"]);
    let truth_csv = table(&numbers(&sidecar["wavelengths_nm"]), std::slice::from_ref(&truth));
    let script = format!(
        "{}\ncat > truth.csv <<END\n{truth_csv}END\n\
            vestimate -q --save covariance=covariance.npy records.ndjson | vscore --truth truth.csv",
        real_records(path, "records.ndjson")
    );
    let folder = Workdir::new();
    let sample = sample(path, &folder.sh(&script));
    for found in ["ends_at", "darkest", "processing", "open_sides"] {
        assert!(sample["image"].get(found).is_none(), "{}: {found}", path.display());
    }
    let covariance = fs::read(folder.path().join("covariance.npy")).unwrap();
    let covariance: Vec<f64> = npyz::NpyFile::new(&covariance[..]).unwrap().into_vec().unwrap();
    let expected = expected_delta_e(&numbers(&sample["estimate"]["reflectance"]), &covariance);
    Outcome { expected_delta_e: Some(expected), ..outcome(path, &sample, &truth, <[f64]>::to_vec) }
}

/// Mean CIEDE2000 between an estimate and spectra that are drawn from what is left open of it.
fn expected_delta_e(estimate: &[f64], covariance: &[f64]) -> f64 {
    const DRAWS: usize = 2000;
    let bands = estimate.len();
    let d65 = illuminant("D65").unwrap();
    let meter = Colorimeter::new(&WavelengthGrid::default(), &d65, Observer::Cie1964_10deg).unwrap();
    let SymmetricEigen { eigenvalues, eigenvectors } =
        DMatrix::from_column_slice(bands, bands, covariance).symmetric_eigen();
    let sd = eigenvalues.map(|variance| variance.max(0.0).sqrt());
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let mut draw = || {
        let normal =
            DVector::from_fn(bands, |n, _| sd[n] * Distribution::<f64>::sample(&StandardNormal, &mut random));
        let off = &eigenvectors * normal;
        let drawn: Vec<f64> = estimate.iter().zip(&off).map(|(r, off)| (r + off).clamp(0.0, 1.0)).collect();
        meter.delta_e_2000(&drawn, estimate)
    };
    (0..DRAWS).map(|_| draw()).sum::<f64>() / DRAWS as f64
}

/// The shell lines that make a file of records of a photograph.
pub fn real_records(path: &Path, records: &str) -> String {
    let sidecar: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    let told = &sidecar["told"];
    let wavelengths = numbers(&sidecar["wavelengths_nm"]);
    let columns = |columns: Vec<Vec<f64>>| table(&wavelengths, &columns);
    let camera = columns(told["camera_sensitivities_rgb"].as_array().unwrap().iter().map(numbers).collect());
    let light = columns(vec![numbers(&told["illuminant_spd"])]);
    let calibration = match (told.get("chart"), told.get("white_region")) {
        (Some(chart), _) => {
            let cos = &told["chart_cos"];
            format!("--chart '{}' --chart-cos {cos} --chart-reference cc24-babelcolor", corners(chart))
        }
        (_, Some(white)) => {
            let (reflectance, cos) = (&told["white_reflectance"], &told["white_cos"]);
            format!("--white-region '{}' --white-reflectance {reflectance} --white-cos {cos}", corners(white))
        }
        _ => String::new(),
    };
    let scene = format!(
        "--angle-deg {} --tilt-deg {} --slant-deg {}",
        told["angle_deg"], told["tilt_deg"], told["slant_deg"]
    );
    let panels =
        format!("--panel0 '{}' --panel1 '{}' --refine", corners(&told["panel0"]), corners(&told["panel1"]));
    let photo = path.with_extension("tif");
    format!(
        r#"
cat > camera.csv <<END
{camera}END
cat > light.csv <<END
{light}END
vkernel {scene} | vextract -q "{photo}" --camera camera.csv --illuminant light.csv {panels} \
    {calibration} > {records}"#,
        photo = photo.display(),
    )
}

fn of_material(path: &Path, exposure: &str) -> Outcome {
    let sidecar: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    let bands = numbers(&sidecar["bands_nm"]);
    let run = Workdir::new().sh(&format!("{} | vestimate -q {exposure}", material_records(path)));
    let sample = sample(path, &run);
    let place = |band: &f64| ((band - 400.0) / 5.0).round() as usize;
    let places: Vec<usize> = bands.iter().map(place).collect();
    let truth = numbers(&sidecar["reflectance_45_0"]);
    outcome(path, &sample, &truth, |estimate| places.iter().map(|place| estimate[*place]).collect())
}

/// The sample among what a pipeline printed.
fn sample(path: &Path, run: &Ended) -> Value {
    assert!(run.status == 0, "{}: {}", path.display(), run.stderr);
    let records = run.stdout.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
    records.into_iter().find(|record| record["kind"] == "sample").unwrap()
}

pub fn outcome(path: &Path, sample: &Value, truth: &[f64], at: impl Fn(&[f64]) -> Vec<f64>) -> Outcome {
    let reflectance = at(&numbers(&sample["estimate"]["reflectance"]));
    let sd = at(&numbers(&sample["estimate"]["reflectance_sd"]));
    let count = truth.len() as f64;
    let findings = sample["estimate"]["findings"].as_array().into_iter().flatten();
    let errors: Vec<f64> = reflectance.iter().zip(truth).map(|(found, truth)| found - truth).collect();
    let within = errors.iter().zip(&sd).filter(|(error, sd)| error.abs() < 2.0 * **sd).count();
    Outcome {
        name: path.file_stem().unwrap().to_string_lossy().into_owned(),
        rmse: (errors.iter().map(|error| error * error).sum::<f64>() / count).sqrt(),
        mean_error: errors.iter().map(|error| error.abs()).sum::<f64>() / count,
        delta_e: sample["metrics"]["ciede2000"].as_f64(),
        expected_delta_e: None,
        within_two_sd: within as f64 / count,
        bar: 4.0 * sd.iter().sum::<f64>() / count,
        findings: findings.map(|one| one["what"].as_str().unwrap().to_owned()).collect(),
        day: sample["estimate"]["day"]["kind"].as_str().map(ToOwned::to_owned),
        level: sample["estimate"]["verdict"]["level"].as_str().unwrap_or_default().to_owned(),
    }
}

pub fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

fn corners(panel: &Value) -> String {
    let corners = panel.as_array().unwrap().iter().map(|corner| format!("{},{}", corner[0], corner[1]));
    corners.collect::<Vec<_>>().join(" ")
}

/// Columns of numbers beside wavelengths, as CSV.
fn table(wavelengths: &[f64], columns: &[Vec<f64>]) -> String {
    let mut text = String::from("nm");
    (0..columns.len()).for_each(|n| write!(text, ",c{n}").unwrap());
    text.push('\n');
    for (row, nm) in wavelengths.iter().enumerate() {
        write!(text, "{nm}").unwrap();
        columns.iter().for_each(|column| write!(text, ",{}", column[row]).unwrap());
        text.push('\n');
    }
    text
}
