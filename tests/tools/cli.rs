//! The contract of the command line, the same for all five tools: exit status, help, whole files, pipes,
//! pass-through.

use proptest::prelude::*;
use serde_json::{Value, json};

use crate::common::{Ended, Workdir};
use crate::ready::{ready, sh};

const TOOLS: [&str; 5] = ["vkernel", "vforward", "vextract", "vestimate", "vscore"];

/// Each tool at work on what [`ready`] leaves.
const RUNS: [&str; 5] = [
    "vkernel --facets 3x3",
    "vforward scene.json --reflectance cc24 --noise-sd 0.01 --seed 5",
    "extract photo.exr",
    "vestimate samples.ndjson",
    "vscore estimates.ndjson",
];

fn after_setup(script: &str) -> Ended {
    sh(&ready(), script)
}

/// Standard output of a run that must be clean.
fn printed(script: &str) -> String {
    let run = after_setup(script);
    assert!(run.status == 0 && run.stderr.is_empty(), "{script}: {run:?}");
    run.stdout
}

fn records(stdout: &str) -> Vec<Value> {
    stdout.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

#[test]
fn help_and_version_name_the_tool() {
    let folder = Workdir::new();
    for tool in TOOLS {
        for flag in ["-h", "--help", "--version"] {
            let run = folder.sh(&format!("{tool} {flag}"));
            assert!(run.status == 0 && run.stderr.is_empty() && run.stdout.contains(tool), "{tool} {flag}");
        }
        let version = folder.sh(&format!("{tool} --version")).stdout;
        assert_eq!(version, format!("{tool} {}\n", env!("CARGO_PKG_VERSION")));
        let help = folder.sh(&format!("{tool} --help")).stdout;
        assert!(help.contains("Example"), "{tool}: help without an example");
    }
}

#[test]
fn every_tool_lists_the_built_in_spectra() {
    let folder = Workdir::new();
    for tool in TOOLS {
        for (what, member) in
            [("cameras", "canon-5d-mark-ii"), ("illuminants", "D65"), ("reflectances", "cc24")]
        {
            let run = folder.sh(&format!("{tool} --list {what}"));
            assert!(run.status == 0 && run.stdout.contains(member), "{tool} {what}: {run:?}");
        }
    }
}

#[test]
fn wrong_usage_is_2_and_bad_data_is_1() {
    let folder = Workdir::new();
    for tool in TOOLS {
        assert_eq!(folder.sh(&format!("{tool} --no-such-flag")).status, 2, "{tool}");
    }
    for tool in ["vforward --reflectance 0.5", "vestimate", "vscore"] {
        assert_eq!(folder.sh(&format!("echo nonsense | {tool}")).status, 1, "{tool}");
    }
}

#[test]
fn a_bad_record_is_3_and_the_rest_is_done() {
    let run = after_setup("sed '3s/facet_rgb/facets/' samples.ndjson | vestimate");
    let records = records(&run.stdout);
    assert_eq!((run.status, records.len()), (3, 25));
    let why = records[2]["error"].as_str().unwrap();
    let id = records[2]["id"].as_str().unwrap();
    assert_eq!(run.stderr, format!("vestimate: 1 of 24 failed; first: {id}: {why}\n"));
    let failed: Vec<_> = (0..25).filter(|n| records[*n].get("error").is_some()).collect();
    assert_eq!(failed, [2]);
    let estimated = records.iter().filter(|record| record.get("estimate").is_some()).count();
    assert_eq!(estimated, 23);
}

#[test]
fn output_goes_to_a_file_instead() {
    for run in RUNS {
        let stdout = printed(&format!("{run} --no-history"));
        let file = printed(&format!("{run} --no-history -o out.ndjson; cat out.ndjson"));
        assert_eq!(stdout, file, "{run}");
    }
}

#[test]
fn a_table_saves_what_its_records_would() {
    let save = "--save metrics.rmse=$n/rmse --save reflectance=$n/r --save wavelengths_nm=$n/nm \
        --save samples=$n/n";
    let script = format!(
        "mkdir 1 2; n=1; vscore estimates.ndjson {save} -o out
        n=2; vscore estimates.ndjson {save} --table -o out
        for file in rmse r nm n; do cmp 1/$file 2/$file; done; ls 2 | wc -l"
    );
    assert_eq!(printed(&script), "4\n");
}

/// Runs that fail after the output was opened; in the last one a good scene has gone through before.
const FAILING: [&str; 5] = [
    "vkernel --angle-deg 1 --tolerance 1e-12",
    "echo nonsense | vforward --reflectance 0.5",
    "extract missing.exr",
    "{ cat samples.ndjson; printf '{\"kind\":'; } | vestimate",
    "{ cat estimates.ndjson; printf '{\"kind\":'; } | vscore",
];

#[test]
fn a_failing_run_leaves_no_file() {
    for run in FAILING {
        let before = printed("ls -A");
        let after = after_setup(&format!("{run} -o out.ndjson && echo done; ls -A"));
        assert_eq!(after.stdout, before, "{run}");
        assert_eq!(after.stderr.lines().count(), 1, "{run}: {}", after.stderr);
    }
}

#[test]
fn a_check_that_finds_something_keeps_its_report() {
    let folder = Workdir::new();
    let run = folder.sh("vkernel --method midpoint --check -o report.txt --save kernel=K.npy");
    assert_eq!((run.status, run.stdout.as_str()), (1, ""));
    assert!(run.stderr.starts_with("vkernel: the kernel fails these checks: "), "{}", run.stderr);
    assert!(folder.sh("cat report.txt").stdout.contains("BROKEN"));
    assert_eq!(folder.sh("ls").stdout, "K.npy\nreport.txt\n");
}

#[test]
fn a_failing_run_keeps_the_file_that_was_there() {
    for run in FAILING {
        let after = after_setup(&format!("echo before > out.ndjson; {run} -o out.ndjson || cat out.ndjson"));
        assert_eq!(after.stdout, "before\n", "{run}");
    }
}

#[test]
fn a_reader_that_leaves_is_no_failure() {
    for run in [
        "vkernel --facets 40x40",
        "vforward scene.json --reflectance munsell",
        "extract $(yes photo.exr | head -n 60)",
        "vforward scene.json --reflectance munsell | vestimate",
        "vscore long.ndjson",
    ] {
        let lengthen = "{ head -n 1 estimates.ndjson; \
            for n in 1 2 3 4; do tail -n +2 estimates.ndjson; done; } > long.ndjson";
        let script = format!(
            "{lengthen}\n{{ status=0; {run} || status=$?; echo $status > status; }} | head -c 10; cat status"
        );
        assert_eq!(printed(&script), "{\"kind\":\"s0\n", "{run}");
    }
}

#[test]
fn progress_counts_the_samples_when_asked() {
    let run = after_setup(
        "vestimate estimates.ndjson --progress always > out.ndjson; grep -c '\"kind\":\"sample\"' out.ndjson",
    );
    let count = run.stdout.trim();
    assert_eq!(run.stderr, format!("vestimate: {count} samples\n"));
    let run = after_setup("vestimate estimates.ndjson --progress always --quiet > out.ndjson");
    assert_eq!((run.status, run.stderr.as_str()), (0, ""));
}

/// A device renamed away by a superuser would be gone for everybody.
#[test]
fn a_pipe_as_a_file_takes_the_bytes_and_stays_a_pipe() {
    let script = "mkfifo pipe; cat pipe > copy & vkernel --facets 1x1 --no-history -o pipe; wait
        vkernel --facets 1x1 --no-history | cmp - copy; test -p pipe && echo pipe";
    assert_eq!(printed(script), "pipe\n");
}

#[test]
fn a_full_disk_is_one_line() {
    for (tool, run) in TOOLS.iter().zip(RUNS) {
        let run = after_setup(&format!("{run} > /dev/full"));
        assert_eq!((run.status, run.stderr.lines().count()), (1, 1), "{run:?}");
        assert!(run.stderr.starts_with(&format!("{tool}: standard output: ")), "{run:?}");
    }
}

#[test]
fn a_closed_standard_error_changes_no_status() {
    let run = after_setup("vkernel --angle-deg 0 2>&-");
    assert_eq!((run.status, run.stderr.as_str()), (2, ""));
    let run = after_setup("vforward scene.json --reflectance no-such-name 2>&-");
    assert_eq!((run.status, run.stderr.as_str()), (1, ""));
    assert_eq!(printed("vkernel -v --facets 1x1 -o out.json 2>&-; ls out.json"), "out.json\n");
}

#[test]
fn threads_change_no_byte() {
    for run in RUNS {
        let one = printed(&format!("{run} --no-history -j 1"));
        assert_eq!(one, printed(&format!("{run} --no-history -j 2")), "{run}");
        assert!(!one.is_empty());
    }
}

/// The variance of pairs of points at the crease is infinite, so that their standard error says too little.
#[test]
fn a_kernel_that_misleads_says_so() {
    let kernel = "vkernel --method monte-carlo --samples 100 --facets 2x2";
    let said = |flags: &str| after_setup(&format!("{kernel} {flags} > scene")).stderr;
    assert!(said("").contains("form factors have standard errors of up to"));
    assert!(said("--check || :").contains("--sampling cosine avoids that"));
    assert_eq!((said("-q"), said("--sampling cosine")), (String::new(), String::new()));
}

#[test]
fn quiet_is_silent_and_verbose_is_not() {
    let render = "vforward scene.json --reflectance 0.5 --render again.exr --render-size 40x30 -o out.ndjson";
    assert_eq!(printed(&format!("{render} -q")), "");
    assert!(after_setup(render).stderr.starts_with("vforward: again.exr has its corners at --panel0 \""));
    assert!(after_setup("vkernel -v -o out.json").stderr.starts_with("vkernel: "));
    assert_eq!(after_setup("vkernel -v -q").status, 2);
}

#[test]
fn a_record_leaves_before_the_next_comes() {
    for (tool, input) in [("vestimate", "samples.ndjson"), ("vscore", "estimates.ndjson")] {
        let script = format!(
            "mkfifo slow
            {{ head -n 5 {input}; exec sleep 60; }} > slow & feeder=$!
            {tool} < slow > out & tool=$!
            for try in $(seq 200); do
                [ $(wc -l < out) = 5 ] && break || sleep 0.1
            done
            kill -9 $tool $feeder
            wc -l < out"
        );
        assert_eq!(after_setup(&script).stdout, "5\n", "{tool}");
    }
}

#[test]
fn every_tool_goes_on_with_its_own_file() {
    for run in RUNS {
        let script = format!(
            "{run} -q > whole; head -c 700 whole > out; {run} --resume out; cmp whole out; \
             {run} -j 2 --resume=out; cmp whole out"
        );
        assert_eq!(printed(&script), "", "{run}");
    }
}

#[test]
fn every_tool_adds_its_line_of_history() {
    let scene = |script: &str| records(&printed(script)).swap_remove(0);
    let tools = |scene: Value| -> Vec<_> {
        let line = |line: &Value| line["tool"].as_str().unwrap().to_owned();
        scene["history"].as_array().unwrap().iter().map(line).collect()
    };
    assert_eq!(tools(scene("vscore estimates.ndjson")), ["vkernel", "vforward", "vestimate", "vscore"]);
    assert_eq!(tools(scene("extract photo.exr")), ["vkernel", "vextract"]);
    assert!(scene("vkernel --no-history").get("history").is_none());
}

/// What the tools do not know comes out as it went in, wherever it stands.
#[test]
fn unknown_fields_and_kinds_pass_through() {
    let remark = json!({
        "kind": "remark",
        "text": "ß \u{1}\n\"",
        "x": [0.1, 5e-324, 1e308, u64::MAX, null, {"y": []}],
    });
    let extra = json!({"deep": [{"er": [1, 2.5, "three"]}]});
    let script = format!(
        r#"
        {{ vkernel --facets 2x2 | sed 's/}}$/,"operator":{extra}}}/'; cat <<'END'
{remark}
END
        }} | vforward --reflectance 0.2 0.6 | sed 's/}}$/,"place":{extra}}}/' | vestimate | vscore"#
    );
    let records = records(&printed(&script));
    let kinds: Vec<_> = records.iter().map(|record| record["kind"].as_str().unwrap()).collect();
    assert_eq!(kinds, ["scene", "sample", "sample", "remark", "summary"]);
    assert_eq!(records[0]["operator"], extra);
    assert!(records[..3].iter().all(|record| record["place"] == extra));
    let mut passed = records[3].clone();
    passed.as_object_mut().unwrap().remove("place");
    assert_eq!(passed, remark);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(8))]

    /// One double in ten would change in its last digit on its way through a careless reader.
    #[test]
    fn doubles_survive_the_stream(bits in prop::collection::vec(any::<u64>(), 2000)) {
        let odd = [5e-324, f64::MIN_POSITIVE, f64::MAX, 0.1 + 0.2, f64::MIN_POSITIVE.next_down(), -0.0, 1e23];
        let finite = bits.into_iter().map(f64::from_bits).filter(|x| x.is_finite());
        let doubles: Vec<f64> = odd.into_iter().chain(finite).collect();
        let script = format!("vscore <<END\n{}\nEND", json!({"kind": "doubles", "x": doubles}));
        let passed = records(&Workdir::new().sh(&script).stdout);
        let passed: Vec<f64> = serde_json::from_value(passed[0]["x"].clone()).unwrap();
        prop_assert!(passed.iter().map(|x| x.to_bits()).eq(doubles.iter().map(|x| x.to_bits())));
    }
}
