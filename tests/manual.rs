//! The manual is that of the tools as they are: man pages and completions that are checked in are what `--generate` prints,
//! and every example of `--help` runs as it stands.

// a test stops at the first surprise
#![allow(clippy::unwrap_used)]

mod common;

use std::fs;
use std::path::Path;

use common::Workdir;

const TOOLS: [&str; 5] = ["vkernel", "vforward", "vextract", "vestimate", "vscore"];

/// `MANUAL=write cargo test --test manual` rewrites them.
#[test]
fn man_pages_and_completions_are_up_to_date() {
    let folder = Workdir::new();
    let write = std::env::var("MANUAL").is_ok_and(|what| what == "write");
    let mut stale = Vec::new();
    for tool in TOOLS {
        for (what, file) in [
            ("man", format!("man/{tool}.1")),
            ("bash", format!("share/completions/{tool}.bash")),
            ("zsh", format!("share/completions/_{tool}")),
            ("fish", format!("share/completions/{tool}.fish")),
        ] {
            let run = folder.sh(&format!("{tool} --generate {what}"));
            assert!(run.status == 0 && run.stderr.is_empty(), "{tool} {what}: {run:?}");
            let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(&file);
            if write {
                fs::write(path, run.stdout).unwrap();
            } else if !fs::read_to_string(path).is_ok_and(|kept| kept == run.stdout) {
                stale.push(file);
            }
        }
    }
    assert!(stale.is_empty(), "{stale:?} are stale: MANUAL=write cargo test --test manual writes them anew");
}

/// How each shell completes `TOOL --progr` with the file that is checked in.
const SHELLS: [(&str, &str); 3] = [
    (
        "bash",
        "bash --norc -c \". $C/$T.bash; COMP_WORDS=($T --progr); COMP_CWORD=1; _$T $T --progr $T; echo \\$COMPREPLY\"",
    ),
    (
        "zsh",
        "zsh -f -c \"fpath=($C \\$fpath); autoload -Uz compinit; compinit -u -D; autoload +X _$T; functions _$T\" | grep -o -m 1 -e --progress",
    ),
    ("fish", "fish --no-config -c \"source $C/$T.fish; complete -C '$T --progr'\" | cut -f 1"),
];

/// A shell that is not there is left out: `tests/run` brings them.
#[test]
fn every_shell_loads_its_completions() {
    let folder = Workdir::new();
    for (shell, complete) in SHELLS {
        if folder.sh(&format!("command -v {shell}")).status != 0 {
            continue;
        }
        for tool in TOOLS {
            let script =
                format!("C='{}/share/completions'\nT={tool}\n{complete}", env!("CARGO_MANIFEST_DIR"));
            let run = folder.sh(&script);
            assert_eq!((run.stdout.as_str(), run.stderr.as_str()), ("--progress\n", ""), "{shell} {tool}");
        }
    }
}

#[test]
fn man_shows_every_page() {
    let pages = fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("man")).unwrap();
    for page in pages.map(|page| page.unwrap().path()) {
        let run = Workdir::new().sh(&format!("groff -k -man -Tutf8 -ww -z '{}'", page.display()));
        assert!(run.status == 0 && run.stderr.is_empty(), "{}: {run:?}", page.display());
    }
}

#[test]
fn the_overview_is_of_this_version() {
    let page = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("man/vfold.7")).unwrap();
    assert!(page.contains(concat!("\"vfold ", env!("CARGO_PKG_VERSION"), "\"")));
}

/// Leaves the files that the examples name.
const SETUP: &str = concat!(
    "cp '",
    env!("CARGO_MANIFEST_DIR"),
    "/tests/data/photos/a_ideal_magenta_50.exr' photo.exr\ncp '",
    env!("CARGO_MANIFEST_DIR"),
    "/tests/data/shapes/corner.obj' .",
    r#"
vkernel --angle-deg 50 -o scene.json
cp photo.exr 1.exr; cp photo.exr 2.exr
echo '{"panel0": [[332,462],[345,77],[122,12],[104,442]], "panel1": [[332,462],[345,77],[485,17],[472,446]]}' > corners.json
vforward scene.json --reflectance cc24:red -o samples.ndjson
vestimate samples.ndjson -o estimates.ndjson
for angle in 30 60; do vkernel --angle-deg $angle | vforward --reflectance 0.5 | vestimate -o angle-$angle.ndjson; done
printf 'nm,red\n380,0.05\n600,0.4\n780,0.6\n' > measured.csv
"#
);

#[test]
fn examples_of_help_run() {
    for tool in TOOLS {
        let help = Workdir::new().sh(&format!("{tool} --help")).stdout;
        let (_, end) = help.split_once("Examples:\n").unwrap();
        let examples = end.split("\n\n").next().unwrap().replace("\\\n", " ");
        assert!(examples.lines().count() >= 2, "{tool}: {examples}");
        for example in examples.lines() {
            let run = Workdir::new().sh(&format!("{SETUP}{example}"));
            assert_eq!(run.status, 0, "{example}: {run:?}");
        }
    }
}
