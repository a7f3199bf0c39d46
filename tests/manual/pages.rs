//! The manual is that of the tools as they are: man pages, completions and schemas that are checked in are
//! what `--generate` prints, and every example of `--help` and of vfold-stream(5) runs as it stands.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::common::Workdir;

const TOOLS: [&str; 5] = ["vkernel", "vforward", "vextract", "vestimate", "vscore"];

/// `MANUAL=write cargo test --test manual` rewrites them.
#[test]
fn pages_completions_and_schemas_are_up_to_date() {
    let mut kept = schemas();
    kept.push(("man/vfold-stream.5".to_owned(), printed("vkernel", "stream")));
    for tool in TOOLS {
        kept.push((format!("man/{tool}.1"), printed(tool, "man")));
        kept.push((format!("share/completions/{tool}.bash"), printed(tool, "bash")));
        kept.push((format!("share/completions/_{tool}"), printed(tool, "zsh")));
        kept.push((format!("share/completions/{tool}.fish"), printed(tool, "fish")));
    }
    let write = std::env::var("MANUAL").is_ok_and(|what| what == "write");
    let mut stale = Vec::new();
    for (file, text) in kept {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(&file);
        if write {
            fs::write(path, text).unwrap();
        } else if !fs::read_to_string(path).is_ok_and(|kept| kept == text) {
            stale.push(file);
        }
    }
    assert!(stale.is_empty(), "{stale:?} are stale: MANUAL=write cargo test --test manual writes them anew");
}

fn printed(tool: &str, what: &str) -> String {
    let run = Workdir::new().sh(&format!("{tool} --generate {what}"));
    assert!(run.status == 0 && run.stderr.is_empty(), "{tool} {what}: {run:?}");
    run.stdout
}

/// The schema of each kind of record, from that of the stream.
fn schemas() -> Vec<(String, String)> {
    let stream: Value = serde_json::from_str(&printed("vkernel", "schema")).unwrap();
    let records = stream["$defs"].as_object().unwrap().iter();
    records.map(|(kind, schema)| (format!("share/schema/{kind}.json"), format!("{schema:#}\n"))).collect()
}

/// How each shell completes `TOOL --progr` with the file that is checked in.
const SHELLS: [(&str, &str); 3] = [
    (
        "bash",
        "bash --norc -c \". $C/$T.bash; COMP_WORDS=($T --progr); COMP_CWORD=1; \
            _$T $T --progr $T; echo \\$COMPREPLY\"",
    ),
    (
        "zsh",
        "zsh -f -c \"fpath=($C \\$fpath); autoload -Uz compinit; compinit -u -D; autoload +X _$T; \
            functions _$T\" | grep -o -m 1 -e --progress",
    ),
    ("fish", "fish --no-config -c \"source $C/$T.fish; complete -C '$T --progr'\" | cut -f 1"),
];

#[test]
fn every_shell_loads_its_completions() {
    let folder = Workdir::new();
    for (shell, complete) in SHELLS {
        if !folder.can(&format!("command -v {shell}"), "its completions") {
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

/// How each shell completes `FLAG BEGIN` of a tool: built-in names, and files, of which the folder has one
/// that begins so, too.
const NAMES: [(&str, &str); 3] = [
    (
        "bash",
        "bash --norc -c \". $C/$T.bash; COMP_WORDS=($T $F $B); COMP_CWORD=2; _$T $T $B $F; \
            printf '%s\\n' \\${COMPREPLY[@]}\"",
    ),
    // as it is defined: who completes is at a terminal
    (
        "zsh",
        "zsh -f -c \"fpath=($C \\$fpath); autoload -Uz compinit; compinit -u -D; \
            autoload +X _$T; functions _$T\" | grep -e \"^'$F=\" -e \"$F=\" | tr ' (' '\\n\\n' \
            | sed 's/)*\".*//; s/_files/'$B'-file/' | grep -e \"^$B\"; echo $B-file",
    ),
    ("fish", "fish --no-config -c \"source $C/$T.fish; complete -C '$T $F $B'\" | cut -f 1"),
];

#[test]
fn every_shell_completes_names_and_files() {
    let folder = Workdir::new();
    for (shell, complete) in NAMES {
        if !folder.can(&format!("command -v {shell}"), "its completions") {
            continue;
        }
        for (tool, flag, begin, name) in [
            ("vextract", "--camera", "nikon-d51", "nikon-d5100"),
            ("vforward", "--illuminant", "D6", "D65"),
            ("vforward", "--reflectance", "cc2", "cc24"),
            ("vscore", "--truth", "mun", "munsell"),
        ] {
            let run = folder.sh(&format!(
                "C='{}/share/completions' T={tool} F={flag} B={begin}\n: > {begin}-file\n{complete}",
                env!("CARGO_MANIFEST_DIR")
            ));
            for wanted in [name, &format!("{begin}-file")] {
                assert!(
                    run.stdout.lines().any(|line| line == wanted),
                    "{shell} {tool} {flag}: {wanted}: {run:?}"
                );
            }
        }
    }
}

#[test]
fn man_shows_every_page() {
    if !Workdir::new().can("command -v groff", "how man pages are set") {
        return;
    }
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
printf '%s %s\n' '{"panel0": [[332,462],[345,77],[122,12],[104,442]],' \
    '"panel1": [[332,462],[345,77],[485,17],[472,446]]}' > corners.json
vforward scene.json --reflectance cc24:red -o samples.ndjson
vestimate samples.ndjson -o estimates.ndjson
for angle in 30 60; do
    vkernel --angle-deg $angle | vforward --reflectance 0.5 | vestimate -o angle-$angle.ndjson
done
printf 'nm,red\n380,0.05\n600,0.4\n780,0.6\n' > measured.csv
vscore estimates.ndjson -o scored.ndjson
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

/// What the examples of vfold-stream(5) need beside the tools.
const NEEDED: [(&str, &str); 4] = [
    ("jq", "jq --version"),
    ("parallel", "parallel --version"),
    ("numpy", "python3 -c 'import numpy'"),
    ("jsonschema", "python3 -c 'import jsonschema'"),
];

#[test]
fn examples_of_the_stream_page_run() {
    let page = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("man/vfold-stream.5")).unwrap();
    let (_, examples) = page.split_once(".SH EXAMPLES").unwrap();
    let unescaped = examples.replace("\\e", "\\").replace("\\-", "-");
    let examples: Vec<_> = unescaped.lines().filter(|line| line.starts_with("  ")).collect();
    assert!(examples.len() > 8, "{examples:?}");
    let folder = Workdir::new();
    assert_eq!(folder.sh(SETUP).status, 0);
    let missing: Vec<_> = NEEDED
        .iter()
        .filter(|(program, line)| !folder.can(line, &format!("examples with {program}")))
        .collect();
    for example in examples {
        if missing.iter().any(|(program, _)| example.contains(program)) {
            continue;
        }
        let run = folder.sh(example);
        assert!(run.status == 0 && run.stderr.is_empty(), "{example}: {run:?}");
        let may_be_silent = ["<", ">", "-o ", ".error"].iter().any(|sign| example.contains(sign));
        assert!(may_be_silent || !run.stdout.is_empty(), "{example} prints nothing");
    }
}
