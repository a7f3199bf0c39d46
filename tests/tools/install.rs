//! `share/install` and `share/uninstall`, cargo's own part apart.

use crate::common::Workdir;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

#[test]
fn what_was_installed_goes_again() {
    let folder = Workdir::new();
    let run = folder.sh(&format!(
        "mkdir bin; printf '#!/bin/sh\\necho \"$@\" >> cargo.log\\n' > bin/cargo; \
            chmod +x bin/cargo; PATH=$PWD/bin:$PATH
        mkdir -p place/share/man/man1 && echo other > place/share/man/man1/other.1
        '{ROOT}/share/install' \"$PWD/place\" > /dev/null; find place -type f | wc -l
        '{ROOT}/share/uninstall' \"$PWD/place\" > /dev/null; find place -type f; cut -d' ' -f1 cargo.log
        grep -c -- 'install .*--features raw' cargo.log"
    ));
    assert_eq!((run.status, run.stderr.as_str()), (0, ""));
    let lines: Vec<&str> = run.stdout.lines().collect();
    assert!(lines[0].trim().parse::<usize>().unwrap() > 20, "{lines:?}");
    assert_eq!(lines[1..], ["place/share/man/man1/other.1", "install", "uninstall", "1"]);
}
