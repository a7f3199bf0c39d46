//! Lines and streams without end: in bounded memory, none lost. `VFOLD_LINE_MB` and `VFOLD_RECORDS` set other
//! sizes than the suite's, such as 1000 and 10000000.

use crate::ready::{ready, sh};

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
                    within(16)
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
        "{{ printf '{{\"kind\":\"remark\",\"text\":\"'; head -c {megabytes}M /dev/zero \
            | tr '\\0' x; echo '\"}}'; }}"
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

/// A list of `megabytes` of the same items, as a shell command that prints it.
fn list(item: &str, megabytes: usize) -> String {
    let count = (megabytes << 20) / (item.len() + 1);
    format!("{{ printf '['; yes '{item},' | head -n {count} | tr -d '\\n'; printf '{item}]'; }}")
}

/// Text of two bytes is the least that a number has.
#[test]
fn a_list_that_nobody_reads_takes_no_more_than_its_text() {
    let (folder, megabytes) = (ready(), size("VFOLD_LINE_MB", 30));
    for (item, tool) in [("1", "vforward --reflectance 0.5"), ("1", "vestimate"), ("{}", "vscore")] {
        let list = list(item, megabytes);
        let ended = sh(
            &folder,
            &format!(
                "{{ printf '{{\"kind\":\"remark\",\"x\":'; {list}; echo '}}'; }} > long
                ({}; {tool} -j 2 long | grep -v '\"summary\"' | cmp - long)",
                within(6 * megabytes)
            ),
        );
        assert_eq!((ended.status, ended.stderr.as_str()), (0, ""), "{tool} '{item}'");
    }
}

/// Fields that a tool reads, filled with what takes most memory for its text.
#[test]
fn a_list_that_is_read_is_bounded() {
    let (folder, megabytes) = (ready(), size("VFOLD_LINE_MB", 30));
    let bound = (40 * megabytes).min(6 * megabytes + 6000);
    for (tool, field, item) in
        [("vestimate", "facet_rgb", "1"), ("vestimate", "facet_rgb", "[1]"), ("vscore", "estimate", "1")]
    {
        let list = list(item, megabytes);
        let ended = sh(
            &folder,
            &format!(
                "{{ head -n 1 samples.ndjson; printf '{{\"kind\":\"sample\",\"id\":\"a\",\"{field}\":'; \
                    {list}; echo '}}'; }} > long
                ({}; {tool} -j 2 long | tail -n +2 | grep -c '\"error\":\"field .{field}. *')",
                within(bound)
            ),
        );
        assert_eq!((ended.status, ended.stdout.as_str()), (0, "1\n"), "{field} '{item}'");
        let said = format!("{tool}: 1 of 1 failed; first: a: field '{field}'");
        assert!(ended.stderr.starts_with(&said) && ended.stderr.lines().count() == 1, "{}", ended.stderr);
    }
}

/// So long that it cannot be a record. Memory for a line that grows may have to be moved, and counts twice
/// then.
#[test]
fn a_line_without_end_ends() {
    let folder = ready();
    for (fill, megabytes, says) in [("y", 16, "not a JSON object"), ("{", 1700, "more than 1 GiB")] {
        let ended =
            sh(&folder, &format!("({}; yes '{fill}' | tr -d '\\n' | vscore -j 2)", within(megabytes)));
        let line = ended.stderr.lines().count() == 1
            && ended.stderr.contains(": -:1: ")
            && ended.stderr.contains(says);
        assert!(ended.status == 1 && ended.stdout.is_empty() && line, "'{fill}': {ended:?}");
    }
}

/// However many are read ahead, large samples are few.
#[test]
fn large_samples_are_not_read_ahead() {
    let (folder, megabytes) = (ready(), size("VFOLD_LINE_MB", 30));
    let list = list("1", megabytes);
    let ended = sh(
        &folder,
        &format!(
            "{{ printf ',\"x\":'; {list}; }} > x
            large() {{ head -c -2 sample; cat x; echo '}}'; }}
            head -n 2 samples.ndjson | tail -n 1 > sample; head -n 1 samples.ndjson > long
            for n in 1 2 3 4 5 6 7 8 9 10; do large >> long; done
            ({}; vestimate -j 2 long | grep -c '\"estimate\":')",
            within(8 * megabytes + 100)
        ),
    );
    assert_eq!((ended.status, ended.stdout.as_str(), ended.stderr.as_str()), (0, "10\n", ""));
}

#[test]
fn a_stream_of_crumbs_loses_none() {
    let (folder, records) = (ready(), size("VFOLD_RECORDS", 100_000));
    for tool in ["vforward --reflectance 0.5", "vestimate", "vscore"] {
        let ended = sh(
            &folder,
            &format!(
                "({}; yes '{{\"kind\":\"crumb\"}}' | head -n {records} | {tool} -j 2 \
                    | grep -v summary | uniq -c)",
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
    assert!(ended.says_what_failed(), "{ended:?}");
    assert_eq!(ended.stdout, format!("{records}\n"));
}

/// Pictures, kernels and records that do not fit say so in one line.
#[test]
fn what_does_not_fit_into_memory_is_refused() {
    let folder = ready();
    let made = sh(
        &folder,
        "oiiotool --pattern constant:color=0.5,0.5,0.5 12000x10000 3 -d uint16 --compression zip -o large.tif
        vkernel --facets 1x1 -o one.json",
    );
    assert_eq!((made.status, made.stderr.as_str()), (0, ""));
    let panels = "--panel0 '0,0 9,0 9,9 0,9' --panel1 '0,0 9,0 9,9 0,9' --camera canon-5d-mark-ii";
    for (command, says) in [
        (format!("vextract large.tif --scene one.json {panels}"), "large.tif: not enough memory for "),
        ("vkernel --facets 512x512 --mesh facets".to_owned(), "form factors: not enough memory for "),
        ("vkernel --facets 512x512 --check".to_owned(), "form factors: not enough memory for "),
        (
            "vkernel --angle-deg 10 --facets 200x200 --tolerance 1e-6".to_owned(),
            "undivided panels: not enough memory for ",
        ),
        (
            "{ printf '{\"kind\":\"remark\",\"x\":\"'; head -c 700M /dev/zero | tr '\\0' x; \
                echo '\"}'; } | vestimate -j 2"
                .to_owned(),
            "not enough memory for ",
        ),
    ] {
        let ended = sh(&folder, &format!("(export RAYON_NUM_THREADS=2; {}; {command})", within(100)));
        let line = ended.stderr.lines().count() == 1
            && ended.stderr.contains(says)
            && ended.stderr.contains("ulimit");
        assert!(ended.status == 1 && ended.stdout.is_empty() && line, "{command}: {ended:?}");
    }
}
