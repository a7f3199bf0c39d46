//! Drawings, as another program reads them: text that is text in SVG, the right colours in PNG, the right
//! numbers in maps.

use roxmltree::Document;
use serde_json::Value;
use vfold::stream::{Reader, Record};

use crate::common::Workdir;

const SAMPLE: &str = "vkernel --facets 2x2 | vforward --reflectance cc24:red --noise-sd 1e-3 | vestimate";

/// All that a drawing says.
fn words(svg: &str) -> Vec<String> {
    let svg = Document::parse(svg).unwrap();
    let texts = svg.descendants().filter(|node| node.has_tag_name("text"));
    texts.map(|node| node.text().unwrap_or_default().trim().to_owned()).collect()
}

#[test]
fn a_spectrum_is_drawn_with_its_band_and_the_truth() {
    let folder = Workdir::new();
    let run = folder.sh(&format!("{SAMPLE} --plot red.svg >/dev/null; cat red.svg"));
    assert_eq!(run.status, 0, "{run:?}");
    let said = words(&run.stdout);
    for word in ["wavelength, nm", "reflectance", "cc24:red", "true (dashed)", "estimated", "true", "folded"]
    {
        assert!(said.iter().any(|one| one == word), "{word}: {said:?}");
    }
    assert!(run.stdout.contains("<polygon") && run.stdout.contains("sans-serif"));
    let run = folder.sh(&format!(
        "{SAMPLE} --plot red.png >/dev/null; \
            oiiotool red.png --colorcount:eps=.02,.02,.02 0,.447,.698:0,0,0:1,1,1"
    ));
    assert!(run.status == 0 && run.stderr.is_empty(), "{run:?}");
    let counts: Vec<usize> =
        run.stdout.lines().filter_map(|line| line.split_whitespace().next()?.parse().ok()).collect();
    assert!(counts[0] > 500 && counts[1] > 500 && counts[2] > 100_000, "blue, black, white: {counts:?}");
}

/// The flat sheets have the sRGB of `vscore --colour`, which is that of colour-science.
#[test]
fn swatches_have_the_colours_of_the_sheets() {
    let folder = Workdir::new();
    let run = folder.sh(&format!(
        "{SAMPLE} >one; vscore one --colour | sed -n 2p; vscore one --plot red.svg >/dev/null; cat red.svg"
    ));
    let (record, svg) = run.stdout.split_once('\n').unwrap();
    let record: Value = serde_json::from_str(record).unwrap();
    let byte = |n: usize| (255.0 * record["colour"]["srgb"][n].as_f64().unwrap()).round() as u8;
    let colour = format!("#{:02X}{:02X}{:02X}", byte(0), byte(1), byte(2));
    assert!(svg.contains(&colour), "{colour}");
}

/// Maps show what the estimate leaves: their mean square is the one that the estimator found on its own way,
/// by compressed data.
#[test]
fn residuals_are_those_of_the_estimator() {
    let folder = Workdir::new();
    let fits = [
        ("", ""),
        ("", "--fit exposure,tilt"),
        ("", "--fit sky,angle"),
        ("", "--noise-sd 2e-3 --model-error 1e-3"),
        ("--reference-panel 0.8", ""),
    ];
    for (card, fit) in fits {
        let run = folder.sh(&format!(
            "vkernel --facets 6x6 --tilt-deg 2 --sky 0.1 |
                vforward --reflectance cc24:orange --photon-noise 1e-3 {card} \
                    | vestimate --quiet {fit} -o out; pwd"
        ));
        assert_eq!(run.status, 0, "{card} {fit}: {run:?}");
        let mut reader = Reader::open(&format!("{}/out", run.stdout.trim())).unwrap();
        let (Record::Scene(scene), Record::Sample(sample)) =
            (reader.read().unwrap().unwrap(), reader.read().unwrap().unwrap())
        else {
            unreachable!("a scene and a sample")
        };
        let estimate = sample.estimate().unwrap().unwrap();
        let residuals = vfold::scene::residuals(&sample, &estimate, &scene).unwrap().unwrap();
        let all: Vec<f64> = residuals.measured().collect();
        let rms = (all.iter().map(|value| value * value).sum::<f64>() / all.len() as f64).sqrt();
        let told = estimate.residual_rms;
        assert!((rms - told).abs() < 1e-3 * told, "{card} {fit}: {rms} not {told}");
    }
}

#[test]
fn facets_that_were_not_measured_are_grey() {
    let folder = Workdir::new();
    let run = folder.sh(&format!(
        "{SAMPLE} | sed 's/\"facet_rgb\":\\[\\[[^]]*\\]/\"facet_rgb\":[null/' \
            | vestimate --plot grey.svg >/dev/null
        cat grey.svg; {SAMPLE} --plot all.svg >/dev/null; grep -c 'not measured' all.svg || true"
    ));
    assert_eq!(run.status, 0, "{run:?}");
    assert!(run.stdout.contains("not measured") && run.stdout.trim_end().ends_with("\n0"), "{run:?}");
}

/// Each has its name and its true spectrum, and what is not shown is counted.
#[test]
fn more_estimates_than_one_drawing_holds_have_a_chart_each() {
    let folder = Workdir::new();
    let of = |set: &str| {
        format!(
            "vkernel --facets 2x2 | vforward --reflectance {set} \
                | vestimate -q --plot drawn.svg >/dev/null; cat drawn.svg"
        )
    };
    let chart = words(&folder.sh(&of("cc24")).stdout);
    assert_eq!(chart.iter().filter(|word| word.starts_with("cc24:")).count(), 24, "{chart:?}");
    assert!(
        chart[0].starts_with("reflectance over wavelength in nm") && chart[0].ends_with("dashed: true"),
        "{chart:?}"
    );
    let chips = words(&folder.sh(&of("munsell")).stdout);
    assert!(chips[0].starts_with("60 of 1269 samples; "), "{:?}", chips[0]);
    assert_eq!(chips.iter().filter(|word| word.starts_with("munsell:")).count(), 60);
    let shown =
        folder.sh("vkernel --facets 2x2 | vforward --reflectance cc24 | vestimate -q --plot - >/dev/null");
    assert!(shown.stderr.ends_with("\n7 of 24 samples\n"), "{}", shown.stderr);
}

#[test]
fn many_samples_are_drawn_as_a_batch() {
    let folder = Workdir::new();
    let run = folder.sh("vkernel --facets 2x2 | vforward --reflectance cc24 --noise-sd 1e-3 | vestimate >all
        vscore all --plot all.svg >scored; cat all.svg; tail -n 1 scored; vscore all --plot all.png >/dev/null
        oiiotool --info all.png");
    assert_eq!(run.status, 0, "{run:?}");
    let (svg, rest) = run.stdout.split_once("</svg>").unwrap();
    let said = words(&format!("{svg}</svg>"));
    assert!(said.iter().any(|word| word == "24 of 24 samples scored"), "{said:?}");
    assert!(said.iter().any(|word| word == "the worst 10 by rmse"), "{said:?}");
    assert_eq!(said.iter().filter(|word| word.starts_with("cc24:")).count(), 10);
    let summary: Value = serde_json::from_str(rest.trim().lines().next().unwrap()).unwrap();
    let worst = summary["rmse"]["worst"].as_f64().unwrap();
    assert!(
        said.iter().any(|word| word.parse().is_ok_and(|x: f64| (x / worst - 1.0).abs() < 5e-3)),
        "{worst}"
    );
    assert!(rest.contains("all.png") && rest.contains("760 x"), "{rest}");
}

/// Row sums of the matrix that `--save kernel` writes, as NumPy adds them up; direct light is the sine of
/// half the angle.
#[test]
fn kernels_are_drawn_with_their_numbers() {
    let folder = Workdir::new();
    for (flags, direct) in
        [("--angle-deg 50", Some("0.423")), ("--folds 3 --angle-deg 60 --mesh facets", None)]
    {
        let run = folder.sh(&format!(
            "vkernel --facets 4x4 {flags} --plot K.svg --save kernel=K.npy >/dev/null; cat K.svg
            python3 -c 'import numpy as np; K = np.load(\"K.npy\").sum(1); \
                print(f\"{{K.min():.3g}} {{K.max():.3g}}\")'"
        ));
        assert_eq!(run.status, 0, "{run:?}");
        let (svg, sums) = run.stdout.split_once("</svg>").unwrap();
        let said = words(&format!("{svg}</svg>"));
        for sum in sums.split_whitespace().chain(direct) {
            assert!(said.iter().any(|word| word == sum), "{flags}: {sum} in {said:?}");
        }
    }
}

#[test]
fn shapes_without_rows_and_columns_have_no_maps() {
    let run = Workdir::new().sh("printf 'v 0 0 0\\nv 1 0 0\\nv 0 1 0\\nf 1 2 3\\n' >one.obj; \
        vkernel --shape one.obj --light 0,0,1 --plot one.svg");
    assert_eq!((run.status, run.stdout.as_str()), (2, ""));
    assert!(run.stderr.contains("no rows and columns"), "{run:?}");
}

#[test]
fn other_endings_are_refused() {
    let run = Workdir::new().sh(&format!("{SAMPLE} --plot red.pdf"));
    assert_eq!(run.status, 2);
    assert!(
        run.stderr.contains("'red.pdf'") && run.stderr.contains("end the name in .svg or .png"),
        "{run:?}"
    );
}

/// Samples without a spectrum carry their error, and what else there is goes out whole.
#[test]
fn where_no_sample_can_be_drawn_the_records_are_whole() {
    let folder = Workdir::new();
    let made = folder.sh(
        "vkernel --facets 2x2 | vforward --reflectance cc24:red | sed 's/\"facet_rgb\":/\"facet\":/' >bad",
    );
    assert_eq!(made.status, 0, "{}", made.stderr);
    for (command, lines) in [("vestimate bad", 2), ("vscore bad", 3), ("vestimate bad | vscore", 3)] {
        let run =
            folder.sh(&format!("{command} --plot none.svg || echo $?; ls none.svg 2>/dev/null || true"));
        let said =
            run.stderr.lines().filter(|line| line.contains("no sample has an estimate to draw")).count();
        assert!(
            run.stdout.ends_with("\n3\n") && run.stdout.lines().count() == lines + 1 && said == 1,
            "{run:?}"
        );
    }
    let run = folder.sh("head -n 1 bad | vestimate --plot none.svg || echo $?");
    assert!(run.stdout.ends_with("\n1\n") && run.stderr.contains("to draw"), "{run:?}");
}
