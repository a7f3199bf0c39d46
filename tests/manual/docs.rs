//! The documentation is true as far as it can be run: blocks of `sh` of every page, in their order, in a
//! clone, with no file that no page makes; what a block of `text` shows is printed; pictures are those that
//! are made; links lead to files and headings; tables between marks are those of benches/results. What
//! needs pictures or machines of the reader's stands in blocks of `console`.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::common::{Ended, Workdir};
use crate::imports::files;
use crate::pictures::stale_on;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// By how much a number that a page shows may differ from what is printed now, of itself: a change of the
/// prior moves it a little.
const OFF: f64 = 0.1;

/// A clone, as far as pages need it: nothing that they do not make themselves.
const SETUP: &str = r#"
export LC_ALL=C.UTF-8
for part in tests share examples; do ln -s "$ROOT/$part" $part; done
"#;

/// The fenced blocks of a kind.
fn blocks<'a>(page: &'a str, kind: &str) -> Vec<&'a str> {
    let starts = page.split(&format!("\n```{kind}\n")).skip(1).collect::<Vec<_>>();
    starts.into_iter().map(|block| block.split("\n```\n").next().unwrap()).collect()
}

/// Runs a page from its first block to its last, in a folder.
fn read_along(page: &str, folder: &Workdir) -> Ended {
    folder.sh(&format!("ROOT='{ROOT}'{SETUP}{}", blocks(page, "sh").join("\n")))
}

/// README.md and all pages of docs.
fn pages() -> Vec<(PathBuf, String)> {
    let docs = fs::read_dir(Path::new(ROOT).join("docs")).unwrap().map(|entry| entry.unwrap().path());
    let pages = docs.filter(|path| path.extension().is_some_and(|ending| ending == "md"));
    let others = ["README.md", "CONTRIBUTING.md", "docs/paper/README.md", "examples/cluster/README.md"]
        .map(|name| Path::new(ROOT).join(name));
    pages.chain(others).map(|path| (path.clone(), fs::read_to_string(path).unwrap())).collect()
}

#[test]
fn every_page_runs_and_shows_what_it_makes() {
    for (path, page) in pages() {
        // tests/tools/cluster.rs runs the scripts of the one, tests/manual/pictures.rs those of the other
        if path.ends_with("examples/cluster/README.md") || path.ends_with("docs/paper/README.md") {
            continue;
        }
        let folder = Workdir::new();
        let run = read_along(&page, &folder);
        assert_eq!(run.status, 0, "{}: {run:?}", path.display());
        let printed = format!("{}{}", run.stdout, run.stderr);
        for shown in blocks(&page, "text") {
            assert!(is_printed(shown, &printed), "{} shows {shown}, not {printed}", path.display());
        }
        let stale = stale_on(&page, folder.path());
        assert!(
            stale.is_empty(),
            "{}: {stale:?} are stale: MANUAL=write cargo test --test manual writes them anew",
            path.display()
        );
    }
}

/// Whether lines are printed as a page shows them, one below the other: words exactly, numbers within
/// [`OFF`].
fn is_printed(shown: &str, printed: &str) -> bool {
    let printed: Vec<&str> = printed.lines().collect();
    let shown: Vec<&str> = shown.lines().collect();
    printed
        .windows(shown.len())
        .any(|lines| shown.iter().zip(lines).all(|(shown, line)| is_line(shown, line)))
}

fn is_line(shown: &str, line: &str) -> bool {
    let is_word = |(shown, word): (&str, &str)| match (shown.parse::<f64>(), word.parse::<f64>()) {
        (Ok(shown), Ok(number)) => (shown - number).abs() <= OFF * number.abs(),
        _ => shown == word,
    };
    let [shown, line] = [shown, line].map(|line| line.split_whitespace().collect::<Vec<_>>());
    shown.len() == line.len() && shown.into_iter().zip(line).all(is_word)
}

#[test]
fn tables_between_marks_are_those_of_the_results() {
    let check = Command::new("python3")
        .args(["-B", "benches/figures.py", "--check"])
        .current_dir(ROOT)
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&check.stdout) + String::from_utf8_lossy(&check.stderr);
    assert!(check.status.success(), "benches/all figures writes them anew: {said}");
}

#[test]
fn a_newcomer_gets_through() {
    let run = read_along(include_str!("../../docs/tutorial.md"), &Workdir::new());
    assert!(
        run.stderr.contains(r#"--panel0 "358.28,441.60 346.13,100.03 155.42,55.00 166.27,426.90""#),
        "{run:?}"
    );
    let scores: Vec<Vec<&str>> = run
        .stdout
        .lines()
        .filter(|line| line.starts_with("mean "))
        .map(|line| line.split_whitespace().skip(1).collect())
        .collect();
    assert_eq!(scores.len(), 3, "{}", run.stdout);
    for score in scores {
        let [rmse, delta_e] = [0, 1].map(|n| score[n].parse::<f64>().unwrap());
        assert!(rmse < 0.03 && delta_e < 0.6, "{score:?}");
    }
}

#[test]
fn links_lead_somewhere() {
    let mut missing = Vec::new();
    for (path, page) in pages() {
        for link in page.split("](").skip(1).map(|rest| rest.split(')').next().unwrap()) {
            if !link.contains("://") && !leads_somewhere(&path, link) {
                missing.push(format!("{}: {link}", path.display()));
            }
        }
    }
    assert!(missing.is_empty(), "{missing:#?}");
}

/// Whether a link of a page leads to a file, and to a heading in it.
fn leads_somewhere(page: &Path, link: &str) -> bool {
    let (file, heading) = link.split_once('#').unwrap_or((link, ""));
    let to = if file.is_empty() { page.to_owned() } else { page.with_file_name(file) };
    let has_heading = || {
        let text = fs::read_to_string(&to).unwrap();
        text.lines().filter(|line| line.starts_with('#')).any(|line| anchor(line) == heading)
    };
    to.exists() && (heading.is_empty() || has_heading())
}

/// What a heading is called in links: small letters, digits and hyphens.
fn anchor(heading: &str) -> String {
    let letters = heading.trim_start_matches('#').trim().to_lowercase();
    let kept = letters.chars().filter(|letter| letter.is_alphanumeric() || " -_".contains(*letter));
    kept.map(|letter| if letter == ' ' { '-' } else { letter }).collect()
}

/// Messages on the page of symptoms, in bold and quotes, are those of the tools: what stands between their
/// numbers and names is found in a string of the source.
#[test]
fn symptoms_are_messages_of_the_tools() {
    let page =
        fs::read_to_string(Path::new(ROOT).join("docs/troubleshooting.md")).unwrap().replace('\n', " ");
    let sources: String = files(&Path::new(ROOT).join("src")).iter().map(|path| unbroken(path)).collect();
    let quoted = page.split("**\"").skip(1).map(|rest| rest.split("\"**").next().unwrap());
    let is_varying = |word: &str| {
        let bare = word.trim_matches(|letter: char| !letter.is_alphanumeric());
        bare.is_empty() || bare.len() == 1 || bare.contains(|letter: char| letter.is_ascii_digit())
    };
    let pieces = quoted.flat_map(|message| {
        let words: Vec<&str> = message.split([' ', '\'']).collect();
        words.split(|word| is_varying(word)).map(|words| words.join(" ")).collect::<Vec<_>>()
    });
    let pieces: Vec<String> = pieces.filter(|piece| piece.len() >= LONG).collect();
    let unknown: Vec<&String> = pieces
        .iter()
        .filter(|piece| !sources.contains(piece.trim_end_matches(['.', ',', ';', ':'])))
        .collect();
    assert!(pieces.len() > 20 && unknown.is_empty(), "{unknown:#?}");
}

/// Letters of a piece of a message that is looked for: shorter ones are words between two names.
const LONG: usize = 16;

/// A file with strings that go on in the next line as one.
fn unbroken(path: &Path) -> String {
    let text = fs::read_to_string(path).unwrap();
    let mut pieces = text.split("\\\n");
    let first = pieces.next().unwrap_or_default().to_owned();
    pieces.fold(first, |text, piece| text + piece.trim_start())
}
