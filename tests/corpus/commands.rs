//! Command lines, streams and pictures that nobody would write, through the tools themselves.
//!
//! `PROPTEST_CASES=100000 cargo test --release --test corpus commands` looks for more.

use std::ffi::{OsStr, OsString};
use std::os::unix::ffi::OsStrExt;
use std::path::Path;
use std::process::{Command, Output};
use std::sync::LazyLock;

use proptest::prelude::*;
use tempfile::TempDir;

use crate::cases;
use crate::targets::records::{edited, edited_stream};

const TOOLS: [(&str, &str); 5] = [
    ("vkernel", env!("CARGO_BIN_EXE_vkernel")),
    ("vforward", env!("CARGO_BIN_EXE_vforward")),
    ("vextract", env!("CARGO_BIN_EXE_vextract")),
    ("vestimate", env!("CARGO_BIN_EXE_vestimate")),
    ("vscore", env!("CARGO_BIN_EXE_vscore")),
];

/// What flags are given, whatever they ask for.
const VALUES: &[&str] = &[
    "0",
    "1",
    "0.5",
    "-1",
    "45",
    "1e308",
    "1e-308",
    "NaN",
    "inf",
    "-inf",
    "",
    "x",
    "1x1",
    "2x3",
    "0x0",
    "100000x100000",
    "99999999999999999999",
    "1,2,3",
    "0,0,1:2",
    "point:0,0,5",
    "400:700:50",
    "700:400:5",
    "auto",
    "none",
    "free",
    "cc24",
    "cc24:red",
    "munsell:5R6/12",
    "D65",
    "0.18",
    "daylight:5500",
    "daylight:1",
    "0=0.5",
    "1=cc24:red",
    "panel 0=0.5",
    "=",
    "a=",
    "a,b",
    "rmse,pd",
    "tilt,sky",
    "\u{1b}[31m\n",
    "é",
    "0,0 9,0 9,9 0,9",
    "1,1 11,1 11,4 1,4",
    "1,5 11,5 11,8 1,8",
    "table.csv",
    "table.csv:a",
    "kernel.npy",
    "corner.obj",
    "photo.png",
    "scene.json",
    "samples.ndjson",
    "regions.json",
    "missing.json",
    ".",
    "deep.json",
    "canon-5d-mark-ii",
    "sun:40deg",
    "sky:48.1,11.6,2026-06-21T14:30+02:00",
    "sky",
    "photographs.ndjson",
    "id",
];
/// What flags that write are given.
const WRITTEN: &[&str] = &[
    "out.json",
    "no/such.json",
    "out.svg",
    "out.png",
    "out.exr",
    "out.csv",
    "out.sp",
    "out.spdx",
    "out.npy",
    "",
    "scene.json/out.png",
    ".",
    "kernel=out.npy",
    "facet_rgb=out.npy",
    "estimate.reflectance=no/such.npy",
];
/// More would take long, and is what was asked for.
const SMALL: &[&str] = &["1", "2", "0", "-1", "x", "1e9"];

/// A flag, and what it is given.
struct Flag {
    name: String,
    values: Vec<String>,
}

/// The flags of a tool, as its completions tell them.
fn flags(tool: &str) -> Vec<Flag> {
    let completions = Command::new(tool).args(["--generate", "fish"]).output().unwrap().stdout;
    let completions = String::from_utf8(completions).unwrap();
    completions.split("complete -c ").filter_map(flag).collect()
}

fn flag(completion: &str) -> Option<Flag> {
    let name = completion.split_once(" -l ")?.1.split_whitespace().next()?.to_owned();
    let own = |values: &[&str]| values.iter().map(|value| (*value).to_owned()).collect();
    let choices = completion.split_once("-a \"").map(|(_, choices)| choices);
    let values = match name.as_str() {
        _ if !completion.contains(" -r") => Vec::new(),
        "output" | "resume" | "save" | "render" | "overlay" | "preview" | "plot" | "spectra" | "trace" => {
            own(WRITTEN)
        }
        "threads" | "samples" | "folds" | "components" => own(SMALL),
        _ => match choices {
            Some(choices) => {
                choices.lines().filter_map(|line| Some(line.split_once("\\t")?.0.to_owned())).collect()
            }
            None => own(VALUES),
        },
    };
    Some(Flag { name, values })
}

static FLAGS: LazyLock<[Vec<Flag>; 5]> = LazyLock::new(|| TOOLS.map(|(_, path)| flags(path)));

/// Files that flags may name.
static FILES: LazyLock<TempDir> = LazyLock::new(|| {
    let folder = tempfile::tempdir().unwrap();
    let kept = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus");
    let copy = |from: &str, to: &str| std::fs::copy(kept.join(from), folder.path().join(to)).unwrap();
    copy("streams/fold.ndjson", "samples.ndjson");
    copy("streams/photograph.ndjson", "photographs.ndjson");
    for (target, file) in [("npy", "kernel.npy"), ("obj", "corner.obj"), ("picture", "photo.png")] {
        copy(&format!("kept/{target}/good"), file);
    }
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    let samples = std::fs::read_to_string(folder.path().join("samples.ndjson")).unwrap();
    write("scene.json", &format!("{}\n", samples.lines().next().unwrap()));
    write("table.csv", "nm,a,b\n400,0.1,0.2\n550,0.5,0.2\n700,0.3,0.2\n");
    write(
        "regions.json",
        r#"{"panel0": [[1,1],[11,1],[11,4],[1,4]], "panel1": [[1,5],[11,5],[11,8],[1,8]]}"#,
    );
    write("deep.json", &"[".repeat(100_000));
    folder
});

/// A folder with the files, for one run.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for file in std::fs::read_dir(FILES.path()).unwrap().map(Result::unwrap) {
        std::fs::copy(file.path(), folder.path().join(file.file_name())).unwrap();
    }
    folder
}

/// Runs a tool with bounded memory and time.
fn run(folder: &Path, tool: usize, arguments: &[OsString], input: &str) -> Output {
    let limited = r#"ulimit -v 4000000; input=$1; shift; exec timeout -s KILL 60 "$@" < "$input""#;
    let mut command = Command::new("sh");
    command
        .env_remove("RUST_BACKTRACE")
        .current_dir(folder)
        .args(["-c", limited, "sh", input, TOOLS[tool].1])
        .args(arguments);
    command.output().unwrap()
}

fn names(folder: &Path) -> Vec<OsString> {
    let mut names: Vec<_> =
        std::fs::read_dir(folder).unwrap().map(|file| file.unwrap().file_name()).collect();
    names.sort();
    names
}

/// Runs a tool and checks how it ends; what it wrote.
fn checked(folder: &Path, tool: usize, arguments: &[OsString], input: &str) -> Result<String, TestCaseError> {
    let before = names(folder);
    let ended = run(folder, tool, arguments, input);
    let told =
        format!("{} {arguments:?} < {input}: {:?} {}", TOOLS[tool].0, ended.status, shown(&ended.stderr));
    let Some(status @ 0..=3) = ended.status.code() else { return Err(TestCaseError::fail(told)) };
    let said = String::from_utf8(ended.stderr.clone());
    let written = String::from_utf8(ended.stdout).map_err(|_| TestCaseError::fail(told.clone()))?;
    let lines = |text: &str| text.is_empty() || text.ends_with('\n');
    let prefix = format!("{}: ", TOOLS[tool].0);
    let progress = arguments.iter().any(|argument| argument == "--progress=always");
    let plain = |text: &str| {
        lines(text) && text.lines().all(|line| line.starts_with(&prefix) && !line.contains(char::is_control))
    };
    prop_assert!(said.is_ok_and(|said| progress || plain(&said)), "{told}");
    prop_assert!(!matches!(status, 1 | 2) || !ended.stderr.is_empty(), "{told}");
    prop_assert!(lines(&written), "half a line: {told}");
    let resumed = arguments.iter().any(|argument| argument.as_bytes().starts_with(b"--resume"));
    let checks = arguments.iter().any(|argument| argument == "--check");
    prop_assert!(
        !matches!(status, 1 | 2) || resumed || checks || names(folder) == before,
        "a file is left: {told}"
    );
    Ok(written)
}

fn shown(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// An argument that chance makes of a tool's flags.
fn argument(tool: usize, flag: usize, value: usize) -> OsString {
    let flag = &FLAGS[tool][flag % FLAGS[tool].len()];
    match flag.values.len() {
        0 => format!("--{}", flag.name).into(),
        // what is no text at all
        _ if value.is_multiple_of(97) => {
            [OsStr::new(&format!("--{}=", flag.name)), OsStr::from_bytes(b"\xff\x80")]
                .iter()
                .copied()
                .collect()
        }
        count => format!("--{}={}", flag.name, flag.values[value % count]).into(),
    }
}

proptest! {
    #![proptest_config(cases(48))]

    #[test]
    fn command_lines_end_as_they_should(
        tool in 0..TOOLS.len(),
        flags in prop::collection::vec((any::<usize>(), any::<usize>()), 0..6),
        positional in prop::option::weighted(0.7, 0..VALUES.len()),
        input in prop::sample::select(vec![
            "samples.ndjson",
            "scene.json",
            "photographs.ndjson",
            "/dev/null",
            "deep.json",
            "photo.png",
        ]),
    ) {
        let arguments: Vec<_> = positional
            .map(|k| OsString::from(VALUES[k]))
            .into_iter()
            .chain(flags.into_iter().map(|(flag, value)| argument(tool, flag, value)))
            .collect();
        checked(folder().path(), tool, &arguments, input)?;
    }

    #[test]
    fn records_that_no_tool_wrote_go_through(edits in prop::collection::vec(any::<u8>(), 1..14)) {
        let folder = folder();
        std::fs::write(folder.path().join("edited.ndjson"), edited_stream(&edits)).unwrap();
        let arguments = |line: &str| line.split(' ').map(OsString::from).collect::<Vec<_>>();
        let flags = arguments("--reflectance 0.5 --wavelengths-nm 400:700:50 -");
        checked(folder.path(), 1, &flags, "edited.ndjson")?;
        let estimated = checked(folder.path(), 3, &arguments("-q --prior cc24 -"), "edited.ndjson")?;
        std::fs::write(folder.path().join("estimated.ndjson"), &estimated).unwrap();
        checked(folder.path(), 4, &arguments("--table -"), "estimated.ndjson")?;
        checked(folder.path(), 3, &arguments("-q --prior cc24 --fit tilt,sky -"), "edited.ndjson")?;
    }

    #[test]
    fn photographs_that_no_tool_wrote_go_through(edits in prop::collection::vec(any::<u8>(), 4..13)) {
        let folder = folder();
        let photograph = std::fs::read_to_string(folder.path().join("photographs.ndjson")).unwrap();
        let two = photograph.clone() + &edited(&photograph, &edits);
        std::fs::write(folder.path().join("two.ndjson"), two).unwrap();
        let arguments = |line: &str| line.split(' ').map(OsString::from).collect::<Vec<_>>();
        for line in ["-q --prior cc24 --fit auto -", "-q --prior cc24 --join=id -"] {
            let estimated = checked(folder.path(), 3, &arguments(line), "two.ndjson")?;
            std::fs::write(folder.path().join("estimated.ndjson"), &estimated).unwrap();
            checked(folder.path(), 4, &arguments("--table --truth cc24:orange -"), "estimated.ndjson")?;
        }
    }

    #[test]
    fn pictures_with_wrong_bytes_are_measured_or_refused(
        file in any::<prop::sample::Index>(),
        edits in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..5),
    ) {
        let folder = folder();
        let kept = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus/kept/picture");
        let pictures = names(&kept);
        let mut bytes = std::fs::read(kept.join(file.get(&pictures))).unwrap();
        for (place, byte) in edits.into_iter().filter(|_| !bytes.is_empty()).collect::<Vec<_>>() {
            let place = place.index(bytes.len());
            bytes[place] = byte;
        }
        std::fs::write(folder.path().join("photo.tif"), bytes).unwrap();
        let arguments = ["photo.tif", "--camera=1", "--regions=regions.json", "--overlay=seen.png", "-v"];
        checked(folder.path(), 2, &arguments.map(OsString::from), "scene.json")?;
    }
}
