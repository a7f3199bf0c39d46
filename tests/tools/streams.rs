//! Streams that were sorted, damaged or converted on their way: every sample is taken in its own scene or
//! refused, and a bad line costs its own record.

use serde_json::Value;

use crate::common::{Ended, Workdir};

/// Two scenes in unlike light with two samples each, in the order in which the tools write them:
/// `stream.ndjson`. `by-kind.ndjson` has both scenes first, `shuffled.ndjson` then the samples in turn.
const TWO_LIGHTS: &str = "
vkernel --angle-deg 50 --facets 6x6 --id shade | vforward --reflectance cc24:orange cc24:red \
    --illuminant D75 > shade
vkernel --angle-deg 50 --facets 6x6 --id sun | vforward --reflectance cc24:orange cc24:red \
    --illuminant D50 > sun
cat shade sun > stream.ndjson
{ head -n 1 shade; head -n 1 sun; tail -n 2 shade; tail -n 2 sun; } > by-kind.ndjson
{ head -n 1 shade; head -n 1 sun; tail -n 1 sun; tail -n 2 shade; sed -n 2p sun; } > shuffled.ndjson
";

fn records(run: &Ended, kind: &str) -> Vec<Value> {
    let records = run.stdout.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
    records.filter(|record| record["kind"] == kind).collect()
}

/// Samples by scene and name.
fn sorted(run: &Ended) -> Vec<Value> {
    let mut samples = records(run, "sample");
    samples.sort_by_key(|sample| format!("{} {}", sample["scene"], sample["id"]));
    samples
}

fn error(record: &Value) -> &str {
    record["error"].as_str().unwrap_or_default()
}

#[test]
fn samples_find_their_scenes_above_others() {
    let folder = Workdir::new();
    folder.sh(TWO_LIGHTS);
    // each sample is a sheet of its own
    folder.sh("sed -i 's/\"scene\":\"\\([a-z]*\\)\",\"id\":\"cc24:\\([a-z]*\\)\"/&,\"sheet\":\"\\1 \\2\"/' \
        *.ndjson");
    for flags in ["-j 1", "-j 4", "--join=sheet"] {
        let estimated = |file: &str| {
            let run = folder.sh(&format!("vestimate {file} --no-history {flags} | vscore --no-history"));
            assert_eq!((run.status, run.stderr.as_str()), (0, ""), "{file} {flags}");
            run
        };
        let in_order = sorted(&estimated("stream.ndjson"));
        assert_eq!(in_order.len(), 4);
        for file in ["by-kind.ndjson", "shuffled.ndjson"] {
            assert!(sorted(&estimated(file)) == in_order, "{file} {flags}");
        }
        // in the other light they would be off by 0.1
        for sample in in_order {
            assert!(sample["metrics"]["rmse"].as_f64().unwrap() < 0.02, "{sample}");
        }
    }
}

/// So they do where more is made of them than records.
#[test]
fn drawings_and_groups_know_the_scenes_too() {
    let folder = Workdir::new();
    folder.sh(TWO_LIGHTS);
    folder.sh("sed -i 's/\"angle_deg\":50.0/\"angle_deg\":49.9999/' by-kind.ndjson stream.ndjson; :");
    let by = |file: &str| {
        folder.sh(&format!(
            "sed '/\"id\":\"sun\"/s/49.9999/50.0001/' {file} | vestimate --plot estimates.svg |
             vscore --by geometry.angle_deg --plot scores.svg --report report.html | tail -n 1
             cat estimates.svg scores.svg"
        ))
    };
    let (in_order, by_kind) = (by("stream.ndjson"), by("by-kind.ndjson"));
    assert_eq!((by_kind.status, by_kind.stderr.as_str()), (0, ""));
    assert!(in_order.stdout.contains("49.9999") && in_order.stdout.contains("50.0001"));
    assert_eq!(in_order.stdout, by_kind.stdout);
    let scenes = folder.sh("grep -o 'How it was measured: scene [a-z]*' report.html").stdout;
    assert_eq!(scenes, "How it was measured: scene shade\nHow it was measured: scene sun\n");
}

#[test]
fn a_sample_without_its_scene_is_refused() {
    let folder = Workdir::new();
    folder.sh(TWO_LIGHTS);
    let last = |script: &str| {
        let run = folder.sh(&format!("{script} | vestimate"));
        assert!(run.says_what_failed(), "{script}: {}", run.stderr);
        let mut samples = records(&run, "sample");
        (samples.pop().unwrap(), samples)
    };
    let (dusk, others) = last("sed '$s/\"scene\":\"sun\"/\"scene\":\"dusk\"/' stream.ndjson");
    assert!(error(&dusk).contains("'dusk'") && error(&dusk).contains("'sun'"), "{dusk}");
    assert!(others.len() == 3 && others.iter().all(|sample| sample["estimate"].is_object()));
    // two that are called alike, as scenes are if nobody names them: either may be that of a sample
    let (alike, others) = last("sed 's/\"shade\"/\"fold\"/;s/\"sun\"/\"fold\"/' by-kind.ndjson");
    assert!(error(&alike).contains("two scenes") && error(&alike).contains("--id"), "{alike}");
    assert!(others.len() == 3 && others.iter().all(|sample| error(sample).contains("two scenes")));
    let several = "for n in $(seq 70); do head -n 1 shade | sed \"s/shade/s$n/\"; done";
    let (far, _) = last(&format!("{{ {several}; tail -n 1 shade | sed 's/shade/s5/'; }}"));
    assert!(error(&far).contains("the last 64"), "{far}");
    // in order they may be called alike, and a sample need not name its scene
    let run =
        folder.sh("sed 's/\"shade\"/\"fold\"/;s/\"sun\"/\"fold\"/' stream.ndjson | vestimate | grep -c good");
    assert_eq!(run.stdout, "4\n", "{run:?}");
    let nameless = "sed 's/\"scene\":\"[a-z]*\",//'";
    let named = folder.sh("vestimate stream.ndjson --no-history | sed 's/\"scene\":\"[a-z]*\",//'");
    let nameless = folder.sh(&format!("{nameless} stream.ndjson | vestimate --no-history"));
    assert!(nameless.status == 0 && nameless.stdout == named.stdout, "{}", nameless.stderr);
}

/// Each kind of damage to the third of five records, and to none of the others.
#[test]
fn a_bad_line_costs_its_record() {
    let folder = Workdir::new();
    folder.sh("vkernel --facets 3x3 | vforward --reflectance cc24:red cc24:blue cc24:green cc24:white \
        --no-history > good.ndjson");
    let damages = [
        r#"3s/.$//"#,
        r#"3s/^.\{40\}//"#,
        r#"3s/^\(.\{60\}\).*/\1/"#,
        r#"3s/.*/warning: the disk is nearly full/"#,
        r#"3s/.*//"#,
        r#"3s/.*/[1, 2]/"#,
        r#"3s/.*/null/"#,
        r#"3s/.*/{}/"#,
        r#"3s/^/[/"#,
        r#"3s/$/,/"#,
        r#"3s/cc24:blue/\xff\xfe/"#,
        r#"3s/"id"/id/"#,
        r#"3s/1\.0/NaN/"#,
        r#"3s/.*/\x1f\x8b\x08/"#,
    ];
    for tool in ["vestimate", "vestimate --join=id", "vforward --reflectance 0.5"] {
        let whole = folder.sh(&format!("sed 3d good.ndjson | {tool} --no-history")).stdout;
        for damage in damages {
            let run = folder.sh(&format!(
                "LC_ALL=C sed '{damage}' good.ndjson > bad.ndjson\n{tool} --no-history < bad.ndjson"
            ));
            assert!(run.says_what_failed(), "{damage} {tool}: {run:?}");
            assert!(run.stderr.contains("1 of ") && run.stderr.contains("line 3: -:3: "), "{}", run.stderr);
            let (bad, others): (Vec<_>, Vec<_>) =
                run.stdout.lines().partition(|line| line.contains("\"error\":\"-:3: "));
            assert_eq!(others, whole.lines().collect::<Vec<_>>(), "{damage} {tool}");
            let bad: Value = serde_json::from_str(bad[0]).unwrap();
            assert_eq!((&bad["kind"], &bad["id"]), (&"sample".into(), &"line 3".into()));
        }
    }
    // the tools after it pass it on, and it is counted
    let scored = folder.sh("sed '3s/.$//' good.ndjson | vestimate 2> said | vscore --table; cat said");
    assert!(scored.stderr.contains("vscore: 1 of 4 failed; first: line 3: -:3: "), "{scored:?}");
    let scored =
        folder.sh("sed '3s/.$//' good.ndjson | vestimate 2> said | vscore 2>> said | tail -n 1; cat said");
    assert!(scored.stdout.contains("\"samples\":4,\"scored\":3"), "{scored:?}");
}

/// What stands below a scene that cannot be read is not taken in the light of the one before.
#[test]
fn a_bad_scene_costs_its_samples() {
    let folder = Workdir::new();
    folder.sh(TWO_LIGHTS);
    // called alike, as scenes are if nobody names them
    folder.sh("sed 's/\"shade\"/\"fold\"/;s/\"sun\"/\"fold\"/' stream.ndjson > alike.ndjson");
    for damage in ["4s/.$//", "4s/$/}/", "4s/^.\\(.*\\)/{ \\1/;4s/kind\":/kind\" : /;4s/.$//"] {
        let run = folder.sh(&format!("{{ sed '{damage}' alike.ndjson; cat sun; }} | vestimate"));
        assert!(run.says_what_failed() && run.stderr.contains("3 of 7"), "{damage}: {run:?}");
        let samples = records(&run, "sample");
        let failed: Vec<bool> = samples.iter().map(|sample| !error(sample).is_empty()).collect();
        assert_eq!(failed, [false, false, true, true, true, false, false], "{damage}");
        assert!(error(&samples[3]).contains("line 4"), "{}", samples[3]);
    }
}

#[test]
fn a_byte_order_mark_is_skipped() {
    let folder = Workdir::new();
    folder.sh(TWO_LIGHTS);
    let plain = folder.sh("vestimate stream.ndjson --no-history");
    // as programs write it that convert line by line, or two files that were put together
    for marked in
        ["sed '1s/^/\\xef\\xbb\\xbf/'", "sed 's/^/\\xef\\xbb\\xbf/'", "sed '1s/^/\\xef\\xbb\\xbf/;s/$/\\r/'"]
    {
        let run = folder.sh(&format!("LC_ALL=C {marked} stream.ndjson | vestimate --no-history"));
        assert_eq!((run.status, run.stderr.as_str()), (0, ""), "{marked}");
        assert!(run.stdout == plain.stdout, "{marked}");
    }
    let scene = folder.sh("head -n 1 shade | LC_ALL=C sed 's/^/\\xef\\xbb\\xbf/' > scene.json
         vforward scene.json --reflectance 0.5 --illuminant D65 --no-history | head -c 33");
    assert_eq!(scene.stdout, "{\"kind\":\"scene\",\"format\":\"vfold/1", "{scene:?}");
}

/// Lines that were lost stay lost, and nothing else is done again.
#[test]
fn runs_go_on_behind_bad_lines() {
    let folder = Workdir::new();
    folder.sh(TWO_LIGHTS);
    folder.sh("sed '3s/.$//;6s/sun/dusk/' stream.ndjson > bad.ndjson");
    let whole = folder.sh("vestimate bad.ndjson --resume whole.ndjson || echo $?; cat whole.ndjson");
    assert!(whole.stdout.starts_with("3\n"), "{whole:?}");
    for lines in 1..6 {
        let run = folder.sh(&format!(
            "head -n {lines} whole.ndjson > part.ndjson; vestimate bad.ndjson --resume part.ndjson \
                || echo $?; cmp part.ndjson whole.ndjson"
        ));
        assert!(run.status == 0 && run.says_nothing_else("3\n"), "{lines}: {run:?}");
    }
}

impl Ended {
    fn says_nothing_else(&self, stdout: &str) -> bool {
        self.stdout == stdout && self.said_otherwise().is_empty()
    }
}
