//! Disks that fill up under a file: the old one stays, nothing is left beside it, and one line says so.

use super::{RUNS, assert_one_line};
use crate::common::Workdir;
use crate::ready::{ready, sh};

/// Every file that a tool can write, as `old`.
const FILES: [(&str, &str); 16] = [
    ("vkernel", "vkernel --facets 9x9 -o old"),
    ("vkernel", "vkernel --facets 9x9 --save kernel=old"),
    ("vkernel", "vkernel --facets 9x9 --save residues=old"),
    ("vforward", "vforward scene.json --reflectance cc24 -o old"),
    ("vforward", "vforward scene.json --reflectance cc24 --save facet_rgb=old"),
    ("vforward", "vforward scene.json --reflectance 0.5 --render old.png"),
    ("vforward", "vforward scene.json --reflectance 0.5 --render old.exr"),
    ("vextract", "extract photo.exr -o old"),
    ("vextract", "extract photo.exr --overlay old.png"),
    ("vextract", "vextract photo.exr --preview old.png"),
    ("vestimate", "vestimate samples.ndjson -o old"),
    ("vestimate", "vestimate samples.ndjson --save reflectance=old"),
    ("vestimate", "vestimate samples.ndjson --trace old"),
    ("vestimate", "vestimate samples.ndjson --plot old.svg"),
    ("vestimate", "vestimate samples.ndjson --spectra old.csv"),
    ("vscore", "vscore estimates.ndjson -o old"),
];

const BEFORE: &str = "for old in old old.png old.exr old.svg old.csv; do echo before > $old; done";

/// The folder with the old files in it, and a line that says what differs from that.
fn with_old_files() -> (Workdir, String) {
    let folder = ready();
    let listed = sh(&folder, &format!("{BEFORE}; ls -A; cat old*")).stdout;
    (folder, listed)
}

/// The limit on the size of a file stands for a disk of that size: it needs no rights.
#[test]
fn a_file_that_may_not_grow() {
    let (folder, before) = with_old_files();
    for (tool, run) in FILES {
        // A process that does not care about the signal is told by the error.
        let line = format!("(trap '' XFSZ; ulimit -f 1; {run} > /dev/null)");
        assert_one_line(&sh(&folder, &line), tool, 1, "File too large", &line);
        assert_eq!(sh(&folder, "ls -A; cat old*").stdout, before, "{line}");
        let killed =
            sh(&folder, &format!("status=0; (ulimit -f 1; {run} > /dev/null) || status=$?; exit $status"));
        assert_eq!(killed.status, 153, "{run}: {killed:?}");
        assert_eq!(sh(&folder, "ls -A; cat old*").stdout, before, "{run}");
    }
}

#[test]
fn a_disk_that_fills_up() {
    let (folder, _) = with_old_files();
    let mounted = |script: &str| {
        format!(
            "mkdir -p disk; unshare -rm sh -euc '
                extract() {{ sh extract \"$@\"; }}
                mount -t tmpfs -o size=64k tmpfs disk; {script}'"
        )
    };
    if !folder.can(&mounted("true"), "a tmpfs that fills up, which takes the right to mount one") {
        return;
    }
    for (tool, run) in FILES {
        let run = run.replace("old", "disk/old");
        let fill = "cp old* disk; head -c 1M /dev/zero > disk/full 2> /dev/null || true";
        let listed = "ls -A disk; cat disk/old*";
        let before = sh(&folder, &mounted(&format!("{fill}; {listed}"))).stdout;
        let line =
            mounted(&format!("{fill}; status=0; {run} > /dev/null || status=$?; {listed}; exit $status"));
        let ended = sh(&folder, &line);
        assert_one_line(&ended, tool, 1, "No space left on device", &run);
        assert_eq!(ended.stdout, before, "{run}");
    }
}

/// What fitted is kept line by line, and the run goes on where there is room again.
#[test]
fn a_run_goes_on_where_the_disk_was_full() {
    let folder = ready();
    for (tool, run) in RUNS {
        let line = format!("(trap '' XFSZ; ulimit -f 3; {run} --resume resumed)");
        let large = sh(&folder, &format!("{run} | wc -c")).stdout.trim().parse::<usize>().unwrap() > 2048;
        let ended = sh(&folder, &line);
        if large {
            assert_one_line(&ended, tool, 1, "File too large", &line);
        }
        let ended =
            sh(&folder, &format!("{run} > whole; {run} --resume=resumed; cmp whole resumed; rm resumed"));
        assert_eq!((ended.status, ended.stdout.as_str()), (0, ""), "{run}: {ended:?}");
    }
}

/// Arrays of records that were not written would be read as if they had been.
#[test]
fn no_array_without_its_records() {
    let folder = ready();
    let line = "vestimate samples.ndjson --save exposure=exposure.npy";
    for (to, says) in [("> /dev/full", "standard output"), ("-o no/such/file", "no/such/file")] {
        let ended = sh(&folder, &format!("{line} {to}"));
        assert_one_line(&ended, "vestimate", 1, says, to);
    }
    let limited = format!("(trap '' XFSZ; ulimit -f 3; {line} -o out.ndjson)");
    assert_one_line(&sh(&folder, &limited), "vestimate", 1, "out.ndjson: File too large", &limited);
    assert_eq!(sh(&folder, "ls -A | grep -e npy -e out -e vfold || true").stdout, "");
}
