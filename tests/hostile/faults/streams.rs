//! Standard streams: closed, full, cut in the middle of a line, slow.

use super::{READERS, RUNS, assert_one_line};
use crate::ready::{ready, sh};

#[test]
fn a_full_disk_fails_the_pipeline() {
    let folder = ready();
    for (tool, run) in RUNS {
        let line = format!("{run} > /dev/full");
        assert_one_line(&sh(&folder, &line), tool, 1, "standard output: No space left", &line);
    }
    let pipeline = "bash -o pipefail -c 'vestimate samples.ndjson > /dev/full | vscore --table'";
    assert_eq!(sh(&folder, pipeline).status, 1);
}

/// Help, version and lists are output like any other.
#[test]
fn a_full_disk_takes_no_answers() {
    let folder = ready();
    for (tool, _) in RUNS {
        for flag in ["--help", "--version", "--list cameras", "--generate man"] {
            let line = format!("{tool} {flag} > /dev/full");
            assert_one_line(&sh(&folder, &line), tool, 1, "standard output: No space left", &line);
            assert_eq!(sh(&folder, &format!("{tool} {flag} | true; {tool} {flag} 2>&- | wc -l")).stderr, "");
        }
    }
}

/// Nobody reads what is said, and it changes nothing.
#[test]
fn a_full_or_closed_standard_error_changes_nothing() {
    let folder = ready();
    for (_, run) in RUNS {
        let want = sh(&folder, &format!("{run} -q --no-history"));
        for stderr in ["2> /dev/full", "2>&-"] {
            let got = sh(&folder, &format!("{run} -v --progress always --no-history {stderr}"));
            assert_eq!((got.status, got.stdout.as_str()), (want.status, want.stdout.as_str()), "{run}");
        }
        assert_eq!(sh(&folder, &format!("{run} --no-such-flag 2> /dev/full")).status, 2, "{run}");
    }
}

/// A closed standard output is the null device by the time a program starts: nobody wants the records. Those
/// that go to files do.
#[test]
fn a_closed_standard_output_is_nobody() {
    let folder = ready();
    for (_, run) in RUNS {
        let ended = sh(&folder, &format!("{run} >&- && {run} -o out.ndjson >&- <&- && test -s out.ndjson"));
        assert_eq!((ended.status, ended.stderr.as_str()), (0, ""), "{run}");
    }
}

/// A reader that has seen enough is no failure, one that fails is one.
#[test]
fn a_reader_that_leaves() {
    let folder = ready();
    for (_, run) in RUNS {
        for (reader, status) in [("head -c 10", 0), ("true", 0), ("sh -c 'head -c 10; exit 7'", 7)] {
            let line = format!(
                "bash -o pipefail -c '. ./functions; {run} | {reader}'",
                reader = reader.replace('\'', "\"")
            );
            let functions = "echo 'extract() { sh extract \"$@\"; }' > functions";
            let ended = sh(&folder, &format!("{functions}\n{line}"));
            assert_eq!((ended.status, ended.stderr.as_str()), (status, ""), "{line}");
        }
    }
}

/// All records before the cut are there, whole, and the pipeline fails.
#[test]
fn half_a_line_ends_the_stream() {
    let folder = ready();
    for (tool, input) in READERS {
        let name = tool.split(' ').next().unwrap();
        for keep in ["head -c -1", "head -c -30"] {
            let whole = sh(&folder, &format!("head -n -1 {input} | {tool} --no-history"));
            let line = format!("{keep} {input} | {tool} --no-history");
            let cut = sh(&folder, &line);
            assert_one_line(&cut, name, 1, "the stream was cut", &line);
            let records = |text: &str| -> Vec<String> {
                text.lines().filter(|line| !line.contains("\"summary\"")).map(str::to_owned).collect()
            };
            assert_eq!(records(&cut.stdout), records(&whole.stdout), "{line}");
            assert!(cut.stdout.is_empty() || cut.stdout.ends_with('\n'), "{line}");
            let pipeline = format!("bash -o pipefail -c '{line} | cat > /dev/null'");
            assert_eq!(sh(&folder, &pipeline).status, 1, "{line}");
        }
    }
}

#[test]
fn a_writer_that_pauses_within_a_line() {
    let folder = ready();
    for (tool, input) in READERS {
        let slowly = format!(
            "{{ head -c 300 {input}; sleep 0.1; tail -c +301 {input} | head -c 4000; sleep 0.1; \
             tail -c +4301 {input}; }}"
        );
        let ended = sh(
            &folder,
            &format!("{tool} < {input} > whole; {slowly} | {tool} | {{ sleep 0.1; cmp - whole; }}"),
        );
        assert_eq!((ended.status, ended.stdout.as_str(), ended.stderr.as_str()), (0, "", ""), "{tool}");
    }
}
