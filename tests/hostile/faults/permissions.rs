//! Files and folders that may not be read or written.

use super::assert_one_line;
use crate::ready::{ready, sh};

/// Runs that meet a file without rights, and what they call it.
const RUNS: [(&str, &str, &str); 14] = [
    ("vforward", "vforward closed.json --reflectance 0.5", "closed.json"),
    ("vforward", "vforward scene.json --reflectance closed.csv", "closed.csv"),
    ("vforward", "vforward scene.json --reflectance 0.5 --camera closed.csv", "closed.csv"),
    ("vforward", "vforward --kernel closed.npy --reflectance 0.5", "closed.npy"),
    ("vextract", "vextract closed.exr --preview preview.png", "closed.exr"),
    ("vextract", "env scene=closed.json sh extract photo.exr", "closed.json"),
    (
        "vextract",
        "vextract photo.exr --scene scene.json --camera nikon-d5100 --regions closed.json",
        "closed.json",
    ),
    ("vestimate", "vestimate closed.ndjson", "closed.ndjson"),
    ("vestimate", "vestimate samples.ndjson --resume closed.ndjson", "closed.ndjson"),
    ("vscore", "vscore closed.ndjson", "closed.ndjson"),
    ("vkernel", "vkernel --shape closed.obj", "closed.obj"),
    ("vkernel", "vkernel -o locked/out.json", "locked/out.json"),
    ("vestimate", "vestimate samples.ndjson --plot locked/out.svg", "locked/out.svg"),
    ("vscore", "vscore estimates.ndjson --save rmse=locked/out.npy", "locked/out.npy"),
];

#[test]
fn a_file_that_may_not_be_read_or_written() {
    let folder = ready();
    let run = folder.sh(
        "for ending in json csv npy exr ndjson obj; do : > closed.$ending; chmod 000 closed.$ending; done
        mkdir locked; chmod 555 locked",
    );
    assert_eq!((run.status, run.stderr.as_str()), (0, ""));
    // Rights mean nothing to a superuser.
    let nobody = "nobody() { if [ $(id -u) = 0 ]; then setpriv --reuid=65534 --regid=65534 \
        --clear-groups \"$@\"; else \"$@\"; fi; }";
    if !folder.can(&format!("{nobody}; nobody vkernel --version"), "files that may not be read") {
        return;
    }
    for (tool, line, says) in RUNS {
        let ended = sh(&folder, &format!("{nobody}; nobody {line}"));
        assert_one_line(&ended, tool, 1, &format!("{says}: "), line);
        assert!(ended.stderr.to_lowercase().contains("permission denied"), "{line}: {ended:?}");
    }
    assert_eq!(sh(&folder, "ls -A locked; cat closed.* 2> /dev/null || true").stdout, "");
}
