//! Every flag that a message, a page or a report names is one of the tools'.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use crate::common::Workdir;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");
const TOOLS: [&str; 5] = ["vkernel", "vforward", "vextract", "vestimate", "vscore"];

/// Flags of other programs that messages and pages name, those of cargo, `OpenImageIO`, GNU parallel and
/// vfold-measure.
const OTHERS: [&str; 11] = [
    "--features",
    "--release",
    "--fullpixels",
    "--header",
    "--keep-order",
    "--mosaic",
    "--pipe",
    "--sshlogin",
    "--subimage",
    "--will-cite",
    "--yes",
];

/// What `--help` of each tool lists.
fn known() -> BTreeMap<&'static str, BTreeSet<String>> {
    let listed = |tool: &str| {
        let help = Workdir::new().sh(&format!("{tool} --help")).stdout;
        let entries = help.lines().map(str::trim_start).filter(|line| line.starts_with('-'));
        let named = entries.filter_map(|line| flags(line).into_iter().next());
        let also = help.lines().filter(|line| line.contains("[alias")).flat_map(flags);
        named.chain(also).collect::<BTreeSet<String>>()
    };
    TOOLS.into_iter().map(|tool| (tool, listed(tool))).collect()
}

/// The words of a text that look like flags.
fn flags(text: &str) -> Vec<String> {
    let is_of_a_word = |letter: char| letter.is_ascii_lowercase() || letter.is_ascii_digit() || letter == '-';
    let starts = text.match_indices("--").filter(|(at, _)| {
        !text[..*at].ends_with(|before: char| before.is_alphanumeric() || matches!(before, '-' | '_'))
    });
    let words = starts.map(|(at, _)| {
        let rest = &text[at + 2..];
        rest.split(|letter: char| !is_of_a_word(letter)).next().unwrap_or_default().trim_end_matches('-')
    });
    let words = words.filter(|word| word.starts_with(|first: char| first.is_ascii_lowercase()));
    words.map(|word| format!("--{word}")).collect()
}

/// Files below a folder that end so.
fn files(folder: &str, ending: &str) -> Vec<PathBuf> {
    let (mut found, mut folders) = (Vec::new(), vec![Path::new(ROOT).join(folder)]);
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|found| ending.split('|').any(|one| found == one)) {
                found.push(path);
            }
        }
    }
    found
}

/// What a file says to people: of the page for the browser not its colours, of the manual not its escapes.
fn text(path: &Path) -> String {
    let text = fs::read_to_string(path).unwrap().replace("\\-", "-");
    match text.split_once("</style>") {
        Some((_, rest)) => rest.to_owned(),
        None => text,
    }
}

#[test]
fn every_flag_that_is_named_exists() {
    let known = known();
    assert!(known["vextract"].contains("--white") && known["vkernel"].contains("--bow"), "{known:?}");
    let all: BTreeSet<&str> = known.values().flatten().map(String::as_str).chain(OTHERS).collect();
    let mut pages = files("src", "rs");
    pages.extend(files("docs", "md"));
    pages.extend(files("man", "1|5|7"));
    pages.extend(
        ["README.md", "share/picker.html", "share/vfold-measure"].map(|page| Path::new(ROOT).join(page)),
    );
    let (mut unknown, mut met) = (Vec::new(), BTreeSet::new());
    for page in pages {
        for (n, line) in text(&page).lines().enumerate() {
            let place = format!("{}:{}", page.display(), n + 1);
            for flag in flags(line) {
                if !all.contains(flag.as_str()) {
                    unknown.push(format!("{place}: {flag}"));
                }
                met.insert(flag);
            }
            for (tool, of_tool) in &known {
                let before = format!("{tool} --");
                let after = line.split(&before).skip(1);
                let named = after.filter_map(|rest| flags(&format!("--{rest}")).into_iter().next());
                unknown.extend(
                    named
                        .filter(|flag| !of_tool.contains(flag))
                        .map(|flag| format!("{place}: {tool} {flag}")),
                );
            }
        }
    }
    assert_eq!(unknown, Vec::<String>::new());
    let idle: Vec<_> = OTHERS.iter().filter(|flag| !met.contains(**flag)).collect();
    assert!(idle.is_empty(), "nothing names {idle:?} any more");
}
