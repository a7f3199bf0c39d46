//! Lines and streams without end: in bounded memory, none lost. `VFOLD_LINE_MB` and `VFOLD_RECORDS` set other sizes than the
//! suite's, such as 1000 and 10000000.

use crate::{ready, sh};

fn size(name: &str, usual: usize) -> usize {
    std::env::var(name).ok().and_then(|size| size.parse().ok()).unwrap_or(usual)
}

/// A limit on the memory of what follows: so many MB beside what threads and the library take.
fn within(megabytes: usize) -> String {
    format!("ulimit -v {}", (megabytes + 400) * 1024)
}

#[test]
fn a_line_of_nothing_is_refused() {
    let (folder, megabytes) = (ready(), size("VFOLD_LINE_MB", 30));
    for tool in ["vforward --reflectance 0.5", "vestimate", "vscore"] {
        for (fill, end) in [("x", "true"), ("[", "echo"), (" ", "echo")] {
            let ended = sh(
                &folder,
                &format!(
                    "({}; {{ head -c {megabytes}M /dev/zero | tr '\\0' '{fill}'; {end}; }} | {tool} -j 2)",
                    within(3 * megabytes)
                ),
            );
            let line = ended.stderr.lines().count() == 1 && ended.stderr.contains(": -:1: ");
            assert!(ended.status == 1 && ended.stdout.is_empty() && line, "{tool} '{fill}': {ended:?}");
        }
    }
}

#[test]
fn a_long_record_passes_through() {
    let (folder, megabytes) = (ready(), size("VFOLD_LINE_MB", 30));
    let record = format!(
        "{{ printf '{{\"kind\":\"remark\",\"text\":\"'; head -c {megabytes}M /dev/zero | tr '\\0' x; echo '\"}}'; }}"
    );
    for tool in ["vforward --reflectance 0.5", "vestimate", "vscore"] {
        let line = format!(
            "({}; {record} | {tool} -j 2 | grep -v '\"summary\"' | cmp - long)",
            within(6 * megabytes)
        );
        let ended = sh(&folder, &format!("{record} > long; {line}"));
        assert_eq!((ended.status, ended.stderr.as_str()), (0, ""), "{tool}");
    }
}

#[test]
fn a_stream_of_crumbs_loses_none() {
    let (folder, records) = (ready(), size("VFOLD_RECORDS", 100_000));
    for tool in ["vforward --reflectance 0.5", "vestimate", "vscore"] {
        let ended = sh(
            &folder,
            &format!(
                "({}; yes '{{\"kind\":\"crumb\"}}' | head -n {records} | {tool} -j 2 | grep -v summary | uniq -c)",
                within(64)
            ),
        );
        let want = format!("{records} {{\"kind\":\"crumb\"}}\n");
        assert_eq!(
            (ended.status, ended.stdout.trim_start(), ended.stderr.as_str()),
            (0, want.as_str(), ""),
            "{tool}"
        );
    }
}

/// Samples that cannot be used are counted one by one, and the status is 3.
#[test]
fn a_stream_of_empty_samples_loses_none() {
    let (folder, records) = (ready(), size("VFOLD_RECORDS", 100_000) / 4);
    let ended = sh(
        &folder,
        &format!(
            "({}; {{ cat scene.json; yes '{{\"kind\":\"sample\"}}' | head -n {records}; }} > crumbs
            head -n 1 samples.ndjson > scene; tail -n +2 crumbs >> scene
            status=0; vestimate -j 2 scene > out || status=$?
            grep -c '\"error\":' out; exit $status)",
            within(64)
        ),
    );
    assert_eq!((ended.status, ended.stdout, ended.stderr.as_str()), (3, format!("{records}\n"), ""));
}
