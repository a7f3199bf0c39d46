//! Rendered photographs with known answers through the tools: fold and light from the sidecar, facets,
//! spectrum, score.
//!
//! All of `../shared/photos` where that folder is there, else the copies under `tests/data/photos`. The table
//! is printed with `cargo test --test tools photographs -- --nocapture`.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use crate::common::{Workdir, is_there};

const COPIES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/photos");
const ALL: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/photos");

/// What a picture must reach: facet means, percent rms; RMSE and CIEDE2000 with the exposure known, with it
/// free, and with the light fitted as well of which nothing is told.
///
/// The truth is in the picture's sidecar: the reflectance with which it was rendered, and the mean of each
/// facet without noise. How near an estimate comes to it depends on the sheet, since three channels leave
/// some spectra more open than others, so there is a bound for each picture. All are below an RMSE of 0.051
/// and, but for the fifth in unknown light, below a CIEDE2000 of 1, which an eye hardly sees; within that
/// they are half as large again as measured, so that a loss of accuracy is noticed.
///
/// An exposure that somebody states is believed to 2 %, which is what the colours of the fifth are off by
/// where it is known. Where it is free they are off by a level of 0.001, within the bars, since photographs
/// of ideal folds are estimated as all photographs are.
struct Bounds {
    picture: &'static str,
    facets_percent: f64,
    known: [f64; 2],
    free: [f64; 2],
    fitted: [f64; 2],
}

// CIEDE2000 of `d` with its exposure known was 0.118: classes of spectra are as frequent under an ideal fold
// as among the spectra that are known, which makes its RMSE less there, and more where the exposure is free
#[rustfmt::skip]
const BOUNDS: [Bounds; 8] = [
    Bounds { picture: "a", facets_percent: 0.2,
        known: [0.0155, 0.041], free: [0.0122, 0.165], fitted: [0.0149, 0.601] },
    Bounds { picture: "b", facets_percent: 0.5,
        known: [0.0177, 0.163], free: [0.0080, 0.306], fitted: [0.0104, 0.485] },
    Bounds { picture: "c", facets_percent: 0.5,
        known: [0.0362, 0.476], free: [0.0380, 0.785], fitted: [0.0369, 0.612] },
    Bounds { picture: "d", facets_percent: 0.5,
        known: [0.0125, 0.220], free: [0.0167, 0.247], fitted: [0.0258, 0.829] },
    Bounds { picture: "e", facets_percent: 0.5,
        known: [0.0136, 0.134], free: [0.0102, 0.630], fitted: [0.0137, 1.350] },
    Bounds { picture: "f", facets_percent: 0.6,
        known: [0.0480, 0.725], free: [0.0294, 0.639], fitted: [0.0503, 0.644] },
    Bounds { picture: "h", facets_percent: 0.2,
        known: [0.0139, 0.037], free: [0.0136, 0.187], fitted: [0.0142, 0.357] },
    Bounds { picture: "g", facets_percent: 0.5,
        known: [0.0097, 0.083], free: [0.0098, 0.085], fitted: [0.0080, 0.118] },
];

/// What was measured in one picture.
struct Measured {
    name: String,
    facets_percent: f64,
    known: [f64; 2],
    free: [f64; 2],
    fitted: [f64; 2],
    /// The same taken with an angle 2° wrong that is fitted too, and how far off it is found, degrees.
    turned: [f64; 2],
    angle_error_deg: f64,
    /// The light as found, where there is more than a sun on the bisecting plane; then the scores if it is
    /// not fitted.
    light: Option<String>,
}

#[test]
fn photographs_give_their_spectra() {
    println!(
        "picture                           facets rms %   RMSE  CIEDE2000   exposure free: RMSE  CIEDE2000   \
         light fitted: RMSE  CIEDE2000   angle 2° wrong, fitted: RMSE  CIEDE2000  found within °"
    );
    for sidecar in sidecars() {
        let m = measure(&sidecar);
        let bounds = BOUNDS.iter().find(|bounds| m.name.starts_with(bounds.picture)).unwrap();
        let ([rmse, delta_e], [free_rmse, free_delta_e], [fitted_rmse, fitted_delta_e]) =
            (m.known, m.free, m.fitted);
        println!(
            "{:<34}{:>12.3}{rmse:>8.4}{delta_e:>10.3}{free_rmse:>21.4}{free_delta_e:>11.3}\
             {fitted_rmse:>21.4}{fitted_delta_e:>11.3}{:>32.4}{:>11.3}{:>16.2}{}",
            m.name,
            m.facets_percent,
            m.turned[0],
            m.turned[1],
            m.angle_error_deg,
            m.light.unwrap_or_default()
        );
        assert!(m.facets_percent < bounds.facets_percent, "{}: facets", m.name);
        for (scores, limits) in [(m.known, bounds.known), (m.free, bounds.free), (m.fitted, bounds.fitted)] {
            assert!(scores.iter().zip(limits).all(|(score, limit)| *score < limit), "{}: {scores:?}", m.name);
        }
        // one bound for all: a wrong angle that is fitted should cost little more than the unknown light does
        assert!(m.turned[0] < 0.04 && m.turned[1] < 1.8, "{}: {:?}", m.name, m.turned);
        // 2° are more than two standard deviations of a measured angle: with noise, what is told draws what
        // is found by a fifth of that; the rounding of a JPEG looks like another angle
        assert!(m.angle_error_deg < 0.42 || bounds.picture == "f", "{}: {}°", m.name, m.angle_error_deg);
    }
}

/// The chart faces the light, the panels do not. Corners off by an eighth of a patch, a D65 scene in the
/// light of D50 and another chart's reflectances change the exposure by little. The true exposure and
/// reflectance are those of the sidecar; each mistake has its own bounds, since the colours of a sheet taken
/// to be in D65 keep the difference of the two lights, and those of another chart its difference.
#[test]
fn a_chart_in_the_picture_makes_the_exposure_known() {
    let path = Path::new(ALL).join("e_chart_purple_45.json");
    if !is_there(ALL) {
        return;
    }
    let sidecar: Value = serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
    for (what, shift_px, flags, exposure_limit, limits) in [
        ("as it is", 0.0, "--illuminant D50", 0.001, [0.012, 0.2]),
        ("corners off by 8 px", 8.0, "--illuminant D50", 0.002, [0.012, 0.2]),
        ("taken for D65", 0.0, "--illuminant D65", 0.02, [0.1, 5.0]),
        (
            "taken for BabelColor's",
            0.0,
            "--illuminant D50 --chart-reference cc24-babelcolor",
            0.01,
            [0.035, 0.7],
        ),
    ] {
        let (exposure, [rmse, delta_e]) = by_chart(&sidecar, &path.with_extension("tif"), shift_px, flags);
        println!(
            "chart {what}: exposure {:+.3} %, RMSE {rmse:.4}, CIEDE2000 {delta_e:.3}",
            100.0 * (exposure - 1.0)
        );
        assert!((exposure - 1.0).abs() < exposure_limit, "{what}: {exposure}");
        assert!(rmse < limits[0] && delta_e < limits[1], "{what}: {rmse} {delta_e}");
    }
}

/// A light that the chart contradicts is a doubt, whatever the facets allow; a daylight near the true one is
/// not.
#[test]
fn a_chart_that_looks_otherwise_is_a_doubt() {
    if !is_there(ALL) {
        return;
    }
    let photo = Path::new(ALL).join("e_chart_purple_45.tif");
    let run = Workdir::new().sh(&format!(
        "vextract -q --find '{0}' > found.json
        vkernel --angle-deg 45 -o scene.json
        for light in D50 D65 A FL2; do
            vextract -q '{0}' --scene scene.json --regions found.json --camera canon-5d-mark-ii \
                --illuminant $light | vestimate -q | grep -o '\"because\":\"[^\"]*'
        done",
        photo.display()
    ));
    let because: Vec<_> = run.stdout.lines().collect();
    assert_eq!(because.len(), 4, "{} {}", run.stdout, run.stderr);
    for (n, because) in because.into_iter().enumerate() {
        assert_eq!(because.contains("the patches of the chart are"), n >= 2, "{because}");
    }
}

/// Exposure over the true one, and scores, with the chart's corners shifted and with `flags` of vextract.
fn by_chart(sidecar: &Value, photo: &Path, shift_px: f64, flags: &str) -> (f64, [f64; 2]) {
    let corner = |(patch, corner): (usize, usize)| {
        let [x, y] =
            [0, 1].map(|k| number(&sidecar["chart_px"][patch]["corners_TL_TR_BR_BL"][corner][k]) + shift_px);
        format!("{x},{y}")
    };
    let run = Workdir::new().sh(&format!(
        r#"
cat > truth.csv <<END
{truth}END
vkernel --angle-deg 45 |
vextract -v "{photo}" --camera canon-5d-mark-ii {flags} --panel0 "{panel0}" --panel1 "{panel1}" \
    --chart "{chart}" 2>said |
vestimate -q | vscore --truth truth.csv
grep -q "exposure .* ± .*, residuals .* % (most .* % in " said
"#,
        truth = csv(sidecar, "reflectance"),
        photo = photo.display(),
        panel0 = corners(&sidecar["panels_px"]["A"]),
        panel1 = corners(&sidecar["panels_px"]["B"]),
        chart = [(0, 0), (5, 1), (23, 2), (18, 3)].map(corner).join(" "),
    ));
    assert!(run.status == 0 && run.stderr.is_empty(), "{}", run.stderr);
    let sample: Value =
        run.stdout.lines().map(|line| serde_json::from_str(line).unwrap()).find(is_sample).unwrap();
    let exposure = number(&sample["exposure"]) / number(&sidecar["white_rgb"][1]);
    (exposure, ["rmse", "ciede2000"].map(|score| number(&sample["metrics"][score])))
}

/// The sidecars of all pictures that the tools, as they were built, read.
fn sidecars() -> Vec<PathBuf> {
    let folder = if is_there(ALL) { ALL } else { COPIES };
    let mut paths: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    let readable = |path: &Path| cfg!(feature = "raw") || !path.with_extension("dng").exists();
    paths.retain(|path| path.extension().is_some_and(|e| e == "json") && readable(path));
    paths.sort();
    paths
}

fn measure(path: &Path) -> Measured {
    let sidecar: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    let photo = path.with_file_name(text(&sidecar["file"]));
    let run = Workdir::new().sh(&script(&sidecar, &photo));
    assert!(run.status == 0 && run.stderr.is_empty(), "{}: {}", photo.display(), run.stderr);
    let samples: Vec<Value> =
        run.stdout.lines().map(|line| serde_json::from_str(line).unwrap()).filter(is_sample).collect();
    let [known, free, fitted, ignored, turned] = [0, 1, 2, 3, 4].map(|n| {
        let metrics = &samples[n]["metrics"];
        ["rmse", "ciede2000"].map(|score| number(&metrics[score]))
    });
    let found =
        |n: usize, name: &str| ["value", "sd"].map(|part| number(&samples[n]["estimate"]["fit"][name][part]));
    let light = || {
        let names = ["tilt_deg", "sky", "sky_cct_k"];
        let each = names.map(|name| format!("{name} {:.4} ± {:.4}", found(2, name)[0], found(2, name)[1]));
        format!("  {}; if ignored {:.3} {:.1}", each.join(", "), ignored[0], ignored[1])
    };
    let facets_percent = facets_percent(&samples[0], &sidecar["facet_mean_rgb_10x10"]);
    Measured {
        name: text(&sidecar["name"]).to_owned(),
        facets_percent,
        known,
        free,
        fitted,
        turned,
        angle_error_deg: (found(4, "angle_deg")[0] - number(&sidecar["angle_deg"])).abs(),
        light: (number(&sidecar["ambient_fraction"]) > 0.0).then(light),
    }
}

/// The pipelines that a user would type who knows what the sidecar knows, and who knows nothing of the light.
fn script(sidecar: &Value, photo: &Path) -> String {
    let ambient = number(&sidecar["ambient_fraction"]);
    let (angle, tilt, sky) = (&sidecar["angle_deg"], &sidecar["light_tilt_deg"], ambient / (1.0 - ambient));
    let camera = match text(&sidecar["camera"]) {
        "Canon EOS 5D Mark II" => "canon-5d-mark-ii",
        "Nikon 5100 (NPL)" => "nikon-d5100",
        other => panic!("the sidecar names another camera: {other}"),
    };
    let illuminant = text(&sidecar["illuminant"]);
    let sky_illuminant = if ambient > 0.0 { "--sky-illuminant daylight:8000" } else { "" };
    let [panel0, panel1] = ["A", "B"].map(|panel| corners(&sidecar["panels_px"][panel]));
    let exposure = sidecar["white_rgb"].as_array().unwrap().iter().map(number).fold(0.0, f64::max);
    let truth = csv(sidecar, "reflectance");
    // what the camera did to its JPEG
    let (did, undo) = match sidecar.get("jpeg") {
        Some(jpeg) => {
            let did = ["white_balance_gains", "camera_to_linear_srgb"].map(|field| (field, &jpeg[field]));
            (json!(std::collections::BTreeMap::from(did)).to_string(), "--undo did.json")
        }
        None => (String::new(), ""),
    };
    let (card, reference) = match sidecar.get("card_reflectance") {
        Some(_) => (csv(sidecar, "card_reflectance"), "--reference-panel card.csv"),
        None => (String::new(), ""),
    };
    format!(
        r#"
cat > truth.csv <<END
{truth}END
cat > card.csv <<END
{card}END
cat > did.json <<END
{did}
END
vkernel --angle-deg {angle} --tilt-deg {tilt} --sky {sky} -o scene.json
vextract "{photo}" --exact-corners --scene scene.json {undo} --camera {camera} \
    --illuminant {illuminant} {sky_illuminant} --panel0 "{panel0}" --panel1 "{panel1}" \
    --exposure {exposure} -o sample.ndjson
vestimate -q sample.ndjson {reference} | vscore --truth truth.csv
vestimate -q sample.ndjson {reference} --exposure free | vscore --truth truth.csv
vkernel --angle-deg {angle} -o scene.json
vextract "{photo}" --exact-corners --scene scene.json {undo} --camera {camera} --illuminant {illuminant} \
    --panel0 "{panel0}" --panel1 "{panel1}" -o sample.ndjson
vestimate -q sample.ndjson {reference} --fit exposure,tilt,sky | vscore --truth truth.csv
vestimate -q sample.ndjson {reference} --exposure {exposure} | vscore --truth truth.csv
vkernel --angle-deg {wrong_angle} -o scene.json
vextract "{photo}" --exact-corners --scene scene.json {undo} --camera {camera} --illuminant {illuminant} \
    --panel0 "{panel0}" --panel1 "{panel1}" -o sample.ndjson
vestimate -q sample.ndjson {reference} --fit exposure,tilt,sky,angle | vscore --truth truth.csv
"#,
        wrong_angle = number(angle) + 2.0,
        photo = photo.display()
    )
}

/// Corners in the order of the command line.
fn corners(panel: &Value) -> String {
    let ends = ["crease_0", "crease_1", "outer_1", "outer_0"];
    ends.map(|end| format!("{},{}", panel[end][0], panel[end][1])).join(" ")
}

/// A spectrum of the sidecar as a table.
fn csv(sidecar: &Value, spectrum: &str) -> String {
    let (nm, values) = (sidecar["wavelengths_nm"].as_array().unwrap(), sidecar[spectrum].as_array().unwrap());
    let rows = nm.iter().zip(values).map(|(nm, value)| format!("{nm},{value}\n"));
    std::iter::once("wavelength,sheet\n".to_owned()).chain(rows).collect()
}

/// Relative rms error of the facets in their strongest channel, percent.
fn facets_percent(sample: &Value, truth: &Value) -> f64 {
    let facets =
        (0..200).map(|k| (&sample["facet_rgb"][k], &truth[["A", "B"][k / 100]][k / 10 % 10][k % 10]));
    let total = |channel: usize| facets.clone().map(|(_, truth)| number(&truth[channel])).sum::<f64>();
    let strongest = (0..3).max_by(|a, b| total(*a).total_cmp(&total(*b))).unwrap();
    let error = |(got, want): (&Value, &Value)| number(&got[strongest]) / number(&want[strongest]) - 1.0;
    100.0 * (facets.map(|facet| error(facet).powi(2)).sum::<f64>() / 200.0).sqrt()
}

fn is_sample(record: &Value) -> bool {
    record["kind"] == "sample"
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

fn text(value: &Value) -> &str {
    value.as_str().unwrap()
}
