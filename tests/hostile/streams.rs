//! Scenes and samples.

use serde_json::Value;

use crate::common::Workdir;
use crate::{assert_refused, case};

/// Lines that `sed` makes of a good scene and its sample.
const STREAM: &str = "vkernel --angle-deg 50 --facets 2x2 --no-history |
    vforward --reflectance 0.5 --wavelengths-nm 400:700:10 --no-history -o good.ndjson";

/// A field may be of any length, but not what is said of it.
#[test]
fn long_fields_are_not_echoed() {
    let folder = Workdir::new();
    folder.sh(&format!("{STREAM}\nhead -c 20000 /dev/zero | tr '\\0' x > long"));
    for (edit, tool) in [
        (r#"1s/"facets":{"panels":/&"LONG",&/"#, "vestimate"),
        (r#"1s/"wavelengths_nm":\[/"wavelengths_nm":["LONG",/"#, "vestimate"),
        (r#"2s/"exposure":1.0/"exposure":"LONG"/"#, "vestimate"),
        (r#"2s/"facet_rgb":\[/"facet_rgb":["LONG",/"#, "vestimate"),
        (r#"2s/"truth":{/"truth":"LONG","x":{/"#, "vscore"),
    ] {
        let run = folder.sh(&format!("sed '{edit}' good.ndjson | sed \"s/LONG/$(cat long)/\" | {tool}"));
        assert!(matches!(run.status, 1 | 3), "{edit}: {}", run.stderr);
        let records = run.stdout.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
        let errors: Vec<_> =
            records.filter_map(|record| Some(record["error"].as_str()?.to_owned())).collect();
        let said = errors.first().unwrap_or(&run.stderr);
        assert!((1..600).contains(&said.len()), "{edit}: {said}");
    }
}

#[test]
fn streams() {
    assert_refused(
        STREAM,
        &[
            case("vforward --reflectance 0.5 < /dev/null", 1, &["-:1", "no record", "the preceding tool"]),
            case("vestimate < /dev/null", 1, &["-:1", "no record"]),
            case("vscore /dev/null", 1, &["/dev/null:1", "no record"]),
            case("echo hello | vestimate", 1, &["-:1", "not a JSON object"]),
            case("echo '[1, 2]' | vscore", 1, &["-:1", "not a JSON object"]),
            case("echo '{}' | vscore", 1, &["-:1", "'kind'"]),
            case("echo | vestimate", 1, &["-:1", "not a JSON object"]),
            case("head -c -1 good.ndjson | vestimate", 1, &["-:2", "cut"]),
            case("tail -n 1 good.ndjson | vestimate", 1, &["-:1", "sample before any scene"]),
            case("printf '\\0\\377\\n' | vestimate", 1, &["-:1", "not a JSON object"]),
            case("gzip -c good.ndjson | vestimate", 1, &["-:1", "gzip -dc"]),
            case("gzip -c good.ndjson | vscore", 1, &["-:1", "gzip -dc"]),
            case("gzip -c good.ndjson | vforward --reflectance 0.5", 1, &["-:1", "gzip -dc"]),
            case(
                "gzip -c good.ndjson | vextract picture.tif --panel0 '5,9 5,1 1,1 1,9' \
                    --panel1 '5,9 5,1 9,1 9,9'",
                1,
                &["-:1", "gzip -dc"],
            ),
            case("xz -c good.ndjson | vestimate", 1, &["-:1", "xz -dc"]),
            case("bzip2 -c good.ndjson | vestimate", 1, &["-:1", "bzip2 -dc"]),
            case("iconv -f UTF-8 -t UTF-16 good.ndjson | vestimate", 1, &["-:1", "iconv -f UTF-16 -t UTF-8"]),
            case("iconv -f UTF-8 -t UTF-16LE good.ndjson | vscore", 1, &["-:1", "iconv -f UTF-16LE"]),
            case("iconv -f UTF-8 -t UTF-16BE good.ndjson | vestimate", 1, &["-:1", "iconv -f UTF-16BE"]),
            case("iconv -f UTF-8 -t UTF-32 good.ndjson | vestimate", 1, &["-:1", "iconv -f UTF-32 -t UTF-8"]),
            case("iconv -f UTF-8 -t UTF-32LE good.ndjson | vestimate", 1, &["-:1", "iconv -f UTF-32LE"]),
            case("printf '\\211PNG\\r\\n\\032\\n' | vestimate", 1, &["-:1", "not a JSON object"]),
            case("printf 'nm,a\\n400,0.5\\n' | vestimate", 1, &["-:1", "not a JSON object"]),
            case("sed 1s/{// good.ndjson | vestimate", 1, &["-:1", "not a JSON object"]),
            case("{ cat good.ndjson; printf nonsense; } | vestimate", 1, &["-:3", "not a JSON object"]),
            case("yes '[' | head -n 200000 | tr -d '\\n' | sed '$a\\' | vscore", 1, &["-:1"]),
            case("sed 's#vfold/1#vfold/2#' good.ndjson | vestimate", 1, &["-:1", "vfold/2", "vkernel"]),
            case("sed 's#\"format\":#\"old\":#' good.ndjson | vestimate", 1, &["-:1", "'format'"]),
            case("sed 's/\"poles\":\\[/&1.5,/' good.ndjson | vestimate", 1, &["-:1", "response"]),
            case(
                "sed 's/\"poles\":\\[[^,]*/\"poles\":[1.5/' good.ndjson | vestimate",
                1,
                &["poles", "(-1, 1)"],
            ),
            case(
                "sed 's/\"poles\":\\[[^,]*/\"poles\":[-1/' good.ndjson | vestimate",
                1,
                &["poles", "(-1, 1)"],
            ),
            case("sed 's/\"residues\":/\"rest\":/' good.ndjson | vestimate", 1, &["residues"]),
            case(
                "sed 's/\"angle_deg\":50.0/&,\"angle_sd_deg\":0/' good.ndjson | vestimate",
                1,
                &["geometry.angle_sd_deg", "above 0"],
            ),
            // edited after vkernel
            case(
                "sed 's/\"angle_deg\":50.0/\"angle_deg\":52.0/' good.ndjson | vestimate",
                1,
                &["'response'", "not that of this geometry; make the scene again with vkernel"],
            ),
            case(
                "sed 's/\"panel\":.1.0,1.0./\"panel\":[1.0,2.0]/; 2d' good.ndjson | \
                    vforward --reflectance 0.5",
                1,
                &["'response'", "not that of this geometry"],
            ),
            case(
                "sed 's/\"angle_deg\":50/\"angle_deg\":0/' good.ndjson | vestimate",
                1,
                &["geometry", "180"],
            ),
            case(
                "sed 's/\"rows\":2/\"rows\":1000000000/' good.ndjson | vestimate",
                1,
                &["-:1", "geometry", "GB"],
            ),
            case("sed 's/\"rows\":2/\"rows\":-2/' good.ndjson | vestimate", 1, &["facets"]),
            case(
                "sed 's/\"panels\":2/\"panels\":3/' good.ndjson | vestimate",
                1,
                &["-:1", "facets.panels", "a fold"],
            ),
            case("sed 's/\"channels\":\\[/&\"X\",/' good.ndjson | vestimate", 1, &["-:1", "camera.channels"]),
            case("sed 's/\"sky\":0/\"sky\":-1/' good.ndjson | vestimate", 1, &["light"]),
            case("sed 's/\"power\":\\[/&1,/' good.ndjson | vestimate", 1, &["illuminants", "31 wavebands"]),
            case("sed 's/\"power\":\\[/&-/' good.ndjson | vestimate", 1, &["-:1", "illuminants", "from 0"]),
            case(
                "sed 's/\"residues\":\\[\\[/&9/' good.ndjson | vestimate",
                1,
                &["-:1", "residues", "add up to 1"],
            ),
            case("vestimate good.ndjson --model-error -1", 2, &["--model-error", "0 to 1"]),
            case("vestimate good.ndjson --model-error NaN", 2, &["--model-error"]),
            case("vestimate good.ndjson --reference-panel cc24", 2, &["--reference-panel", "a set"]),
            case("sed 's/\"camera\":/\"eye\":/' good.ndjson | vestimate", 1, &["camera", "missing"]),
            case("vestimate good.ndjson --smoothness -1", 2, &["--smoothness", "0 or more"]),
            case("vestimate good.ndjson --start cc24", 2, &["--start"]),
            case("vestimate good.ndjson --trace -", 2, &["--trace", "records", "--output FILE"]),
            case("vestimate good.ndjson -o - --trace -", 2, &["--trace", "records", "--output FILE"]),
            case("vestimate good.ndjson --noise-sd -1", 2, &["--noise-sd", "0 or more"]),
            case("vestimate good.ndjson --exposure 0", 2, &["--exposure"]),
            case("vestimate good.ndjson --exposure loud", 2, &["--exposure", "free"]),
            case("vestimate good.ndjson --prior munsel", 1, &["munsel", "munsell"]),
            case("vestimate good.ndjson --prior 0.5", 2, &["--prior", "one spectrum", "two or more"]),
            case("vestimate good.ndjson --fit colour", 2, &["--fit", "tilt"]),
            case("vestimate good.ndjson --fit auto,angle", 2, &["--fit", "auto cannot be combined"]),
            case("vestimate good.ndjson --fit none,tilt", 2, &["--fit", "none cannot be combined"]),
            case("vestimate good.ndjson --fit auto,auto", 2, &["--fit", "auto cannot be combined"]),
            case("vestimate good.ndjson --fit ''", 2, &["--fit", "auto"]),
            case("vestimate good.ndjson --fit gloss", 2, &["--fit", "gloss", "auto"]),
            case("vestimate good.ndjson --fit auto --prior smooth", 2, &["--fit", "--prior"]),
            case("vestimate good.ndjson --fit auto --method park", 2, &["--fit", "--method"]),
            case("vestimate good.ndjson --fit exposure --exposure 1", 2, &["--fit", "--exposure"]),
            case("vestimate good.ndjson --fit sky --prior smooth", 2, &["--fit", "--prior"]),
            case(
                "sed 's/\"mesh\":\"auto\"/\"mesh\":\"facets\"/' good.ndjson | vestimate --fit angle",
                1,
                &["-:1", "mesh auto"],
            ),
            case(
                "vkernel --angle-deg 180 | vforward --reflectance 1 | vestimate --fit angle",
                1,
                &["-:1", "angle"],
            ),
            case(
                "vkernel --sky only | vforward --reflectance 0.5 | vestimate --fit sky",
                1,
                &["-:1", "there is no sun"],
            ),
            case(
                "vkernel | vforward --reflectance 0.5 --illuminant A | vestimate --fit sky",
                1,
                &["-:1", "--fit sky has nothing to fit"],
            ),
            case(
                "vkernel | vforward --reflectance 0.5 --illuminant E | vestimate --fit daylight",
                1,
                &["-:1", "--fit daylight has nothing to fit"],
            ),
            case("vestimate good.ndjson --plan --camera nikon-d5100", 2, &["--camera", "already"]),
            case("vestimate good.ndjson --camera nikon-d5100", 2, &["--plan"]),
            case("vestimate good.ndjson --plan --prior none", 2, &["--plan", "--prior"]),
            case("vestimate good.ndjson --trace no/such.ndjson", 1, &["no/such.ndjson"]),
            case(
                "sed 's/\"sensitivities\":[^]]*/\"sensitivities\":[[0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,\
                    0,0,0,0,0,0,0,0,0,0,0/' good.ndjson | vestimate",
                1,
                &["-:1", "channel 0", "does not respond"],
            ),
            case("vestimate good.ndjson --plot no/such.svg", 1, &["no/such.svg"]),
            case("vestimate good.ndjson --save nothing=x.npy", 1, &["x.npy", "--save"]),
            case("vscore good.ndjson --truth cc25", 1, &["cc25", "cc24"]),
            case("vscore good.ndjson --observer 5", 2, &["--observer", "2 or 10"]),
        ],
    );
}

/// A sample that cannot be used goes out with an error in its record, and the exit status is 3.
#[test]
fn samples() {
    let folder = Workdir::new();
    folder.sh(STREAM);
    for (edit, says) in [
        (r#"2s/"facet_rgb":\[/&[0.1,0.1,0.1],/"#, "9 facets, but the scene has 8"),
        (r#"2s/"facet_rgb":\[\[/&0.1,/"#, "facets have different numbers of channels"),
        (
            r#"2s/"facet_rgb":[^}]*]]/"facet_rgb":[null,null,null,null,null,null,null,null]/"#,
            "no facet was measured",
        ),
        (r#"2s/\[\[0/[[-9/;2s/\],\[0/],[-9/g;2s/,0\.\([0-9]*\),/,-0.\1,/g"#, "no light in any facet"),
        (
            r#"2s/"facet_rgb":[^}]*]]/"facet_rgb":[[0,0,0],[0,0,0],[0,0,0],[0,0,0],null,null,null,null]/"#,
            "no light",
        ),
        (r#"2s/"facet_rgb":/"facets":/"#, "missing; make it with vforward or vextract"),
        (r#"2s/"facet_rgb":\[/"facet_rgb":["x",/"#, "facet_rgb"),
        (r#"2s/"exposure":1.0/"exposure":"x"/"#, "exposure"),
        (r#"2s/"exposure":1.0/"exposure":0/"#, "a number above 0"),
        (r#"2s/"exposure":1.0/"exposure":-1/"#, "a number above 0"),
        (r#"2s/"facet_rgb":/"facet_sd":[[1,1,1]],&/"#, "1 facet, but facet_rgb has 8"),
        (r#"2s/"facet_rgb":/"facet_sd":[[-1,1,1]],&/"#, "-1e0 cannot be"),
    ] {
        assert_marked(&folder, &format!("sed '{edit}' good.ndjson | vestimate"), says);
    }
}

/// So does an estimate that cannot be scored.
#[test]
fn estimates() {
    let folder = Workdir::new();
    folder.sh(&format!("{STREAM}\nvestimate good.ndjson -o estimated.ndjson"));
    folder.sh("printf 'nm,Red,white\\n380,0.1,0.9\\n780,0.1,0.9\\n' > measured.csv");
    for (edit, flags, says) in [
        (
            "s/\"id\":\"0.5\"/\"id\":\"cc24:red\"/",
            "--truth measured.csv",
            "(nearest: measured:Red); give one",
        ),
        ("s/\"estimate\":/\"guess\":/", "", "run the samples through vestimate first"),
        ("2s/\\(\"estimate\".*\"wavelengths_nm\":\\[\\)400/\\1401/", "", "estimate it again"),
        ("s/\"truth\":/\"guess\":/", "", "give --truth SPEC"),
        ("s/\"reflectance_sd\":\\[/&-/", "", "estimate.reflectance_sd"),
        ("s/\"reflectance_sd\":\\[/&-/", "--colour", "is not a standard deviation; give numbers from 0"),
        (
            "s/\"residual_rms\"/\"fit\":{\"sky\":{\"value\":1,\"sd\":-1,\"supported\":true}},&/",
            "",
            "estimate.fit",
        ),
        ("", "--truth cc24", "--truth cc24 has no '0.5' among its 24 spectra; give one"),
    ] {
        assert_marked(&folder, &format!("sed '{edit}' estimated.ndjson | vscore {flags}"), says);
    }
}

/// The one sample of a stream goes out with an error that says so.
fn assert_marked(folder: &Workdir, line: &str, says: &str) {
    // vscore's summary comes after them
    let run = folder.sh(&format!("status=0; {line} > out || status=$?; head -n 2 out; exit $status"));
    assert!(run.says_what_failed() && run.stdout.lines().count() == 2, "{line}: {run:?}");
    let sample: Value = serde_json::from_str(run.stdout.lines().last().unwrap()).unwrap();
    let error = sample["error"].as_str().unwrap();
    assert!(error.contains(says), "{line}: {error}");
}

/// What a flag names is blamed on the flag or its file, not on the stream.
#[test]
fn spectra_of_flags() {
    assert_refused(
        &format!(
            "{STREAM}
            printf 'nm,a,b\\n500,0.2,0.5\\n600,0.2,0.5\\n' > narrow.csv
            printf 'nm,a,b\\n400,-1,0.5\\n700,1,0.5\\n' > below.csv"
        ),
        &[
            case("vestimate good.ndjson --start 2", 2, &["vestimate: --start: reflectance 2 is outside"]),
            case("vestimate good.ndjson --start -1", 2, &["vestimate: --start: reflectance -1 is outside"]),
            case("vestimate good.ndjson --reference-panel 2", 2, &["vestimate: --reference-panel: refl"]),
            case("vestimate good.ndjson --start narrow.csv:a", 2, &["--start: spectrum 'narrow:a'", "500"]),
            case("vestimate good.ndjson --prior narrow.csv", 2, &["--prior: spectrum 'narrow:a'", "500"]),
            case(
                "vestimate good.ndjson --illuminant unknown --illuminants narrow.csv",
                2,
                &["--illuminants: spectrum 'narrow:a'", "500"],
            ),
            case("vestimate good.ndjson --start below.csv:a", 1, &["vestimate: spectrum 'below.csv:a'"]),
            case("vestimate good.ndjson --illuminants below.csv", 1, &["vestimate: spectrum 'below.csv:a'"]),
            case("vestimate good.ndjson --illuminants no.csv", 1, &["vestimate: no.csv: No such file"]),
        ],
    );
}
