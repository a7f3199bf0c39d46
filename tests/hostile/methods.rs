//! Flat sheets and several lights.

use crate::{assert_refused, case};

/// A flat sheet under two lights, and a fold.
const SHEETS: &str = "vkernel --angle-deg 180 --facets 1x1 -o flat.json
    vforward flat.json --reflectance 0.5 --illuminant D65 --illuminant A -o flat.ndjson
    vkernel --facets 2x2 | vforward --reflectance 0.5 -o fold.ndjson
    printf 'wavelength,a,b\\n400,0,0\\n500,0.5,0.2\\n700,0.5,0.9\\n' > dark.csv";

#[test]
fn flags_that_do_not_fit_the_method() {
    assert_refused(
        SHEETS,
        &[
            case("vestimate flat.ndjson --method guess", 2, &["--method"]),
            case("vestimate flat.ndjson --method park --components 0", 2, &["--components", "1..=1000"]),
            case("vestimate flat.ndjson --method park --components 1270", 2, &["--components", "1000"]),
            case("vestimate flat.ndjson --components 3", 2, &["--components", "park or khan"]),
            case("vestimate flat.ndjson --basis cc24", 2, &["--basis", "park or khan"]),
            case("vestimate fold.ndjson --smoothness 5", 2, &["--smoothness", "--prior smooth"]),
            case("vestimate fold.ndjson --prior none --smoothness 5", 2, &["--smoothness", "--prior smooth"]),
            case("vestimate flat.ndjson --method park --basis cc25", 1, &["cc25", "cc24"]),
            case("vestimate flat.ndjson --method park --prior smooth", 2, &["--prior", "--method park"]),
            case("vestimate flat.ndjson --method khan --fit sky", 2, &["--fit", "--method khan"]),
            case("vestimate flat.ndjson --method khan --noise-sd 1", 2, &["--noise-sd"]),
            case("vestimate flat.ndjson --method khan --plan", 2, &["--plan"]),
            case("vestimate flat.ndjson --method khan --join", 2, &["--join", "--method"]),
            case("vestimate fold.ndjson --prior smooth --join", 2, &["--join", "--prior"]),
            case("vestimate fold.ndjson --join --fit none", 2, &["--join", "--fit"]),
            case("vestimate fold.ndjson --join --exposure sum", 2, &["--exposure", "free"]),
            case("vestimate fold.ndjson --join=", 2, &["--join", "field"]),
            case(
                "vestimate flat.ndjson --method park --smoothness auto",
                2,
                &["--smoothness auto", "--method park"],
            ),
        ],
    );
}

/// A plan has no samples and makes no search: what it would ignore is refused.
#[test]
fn flags_that_do_not_fit_a_plan() {
    assert_refused(
        SHEETS,
        &[
            case("vestimate fold.ndjson --plan --plot x.svg", 2, &["--plan", "--plot"]),
            case("vestimate fold.ndjson --plan --spectra x.csv", 2, &["--plan", "--spectra"]),
            case("vestimate fold.ndjson --plan --trace x", 2, &["--plan", "--trace"]),
            case("vestimate fold.ndjson --plan --start 0.5", 2, &["--plan", "--start"]),
            case("vestimate fold.ndjson --plan --smoothness 5", 2, &["--plan", "--smoothness"]),
            case("vestimate fold.ndjson --plan --illuminants no.csv", 2, &["--plan", "--illuminants"]),
            case("vestimate fold.ndjson --plan --noise-sd auto", 2, &["--noise-sd", "'auto'", "--plan"]),
        ],
    );
}

#[test]
fn several_lights() {
    assert_refused(
        SHEETS,
        &[
            case("vforward flat.json --reflectance 1 --illuminant D65 --illuminant", 2, &["--illuminant"]),
            case("vforward flat.json --reflectance 1 --illuminant D65 --illuminant D66", 1, &["D66", "D65"]),
            case(
                "vforward flat.json --reflectance 1 --illuminant D65 --illuminant A --render x.exr",
                2,
                &["--illuminant", "--render"],
            ),
            case(
                "vextract x.exr --scene flat.json --illuminant D65 --illuminant A --panel0 '0,0 9,0 9,9 0,9'",
                2,
                &["--illuminant", "one light"],
            ),
            case(
                "sed '1s/\"illuminants\":.*]}]/\"illuminants\":[]/' flat.ndjson | vestimate",
                1,
                &["illuminants", "none"],
            ),
        ],
    );
}

/// The error of the one sample that a script leaves.
fn error_of(script: &str) -> String {
    let folder = crate::common::Workdir::new();
    folder.sh(SHEETS);
    let run = folder.sh(script);
    assert!(run.says_what_failed(), "{script}: {run:?}");
    let sample: serde_json::Value = serde_json::from_str(run.stdout.lines().last().unwrap()).unwrap();
    sample["error"].as_str().unwrap().to_owned()
}

#[test]
fn samples_that_do_not_fit_the_method() {
    for (script, says) in [
        (
            "vestimate fold.ndjson --method park",
            "folded, but this method ignores bounces; use vkernel --angle-deg 180",
        ),
        ("vestimate flat.ndjson --method park --components 70", "70 components requested"),
        ("vestimate flat.ndjson --method khan --components 7", "camera and lights have 6"),
        ("vestimate flat.ndjson --method khan --exposure free", "give --exposure X or sum"),
        (
            "vestimate flat.ndjson --method park --smoothness 0 --components 8",
            "the values do not determine 8 components",
        ),
        ("vestimate flat.ndjson --method khan --components 2 --basis dark.csv", "zero at a wavelength"),
        (
            r#"sed '2s/"facet_rgb":\[\[/&[0.1,0.1,0.1],/' flat.ndjson | vestimate"#,
            "2 facets in one picture, 3 in another",
        ),
        (
            r#"sed '2s/"facet_rgb":\[\(.*\]\]\),\[\[.*\]\]\],/"facet_rgb":\1,/' flat.ndjson | vestimate"#,
            "3 channels, but the scene has 6",
        ),
    ] {
        let error = error_of(script);
        assert!(error.contains(says), "{script}: {error}");
    }
}
