//! Corners marked by a person on a web page served on this machine.

use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;

use vfold::cli::{self, Reply, ServedFile};
use vfold::files::keep_complete;
use vfold::image::{Detections, Photograph, Point, find_all, find_fold_around, parse_point, write_preview};
use vfold::stream::{Output, picked_line};
use vfold::{Error, Result};

use super::{Args, balance, finding, reading::Reading};

const PAGE: &str = include_str!("../../../share/picker.html");
/// A page left open for longer has been forgotten.
const WAIT: Duration = Duration::from_secs(60 * WAIT_MINUTES);
const WAIT_MINUTES: u64 = 10;
/// Commands that show a page in a browser, by system.
const OPENERS: [&str; 2] = ["xdg-open", "open"];

/// Prints what a person marks in the photograph, starting with the detected fold.
///
/// # Errors
/// [`Error::Usage`] for several photographs, [`Error::Picture`] if nobody marks corners, as
/// [`Reading::open`], [`write_preview`] and [`cli::ask_on_page`].
pub fn print(args: &Args, images: &[PathBuf], reading: &Reading, out: &mut Output) -> Result<()> {
    let [path] = images else {
        let problem = format!("{} photographs, but the page shows one", images.len());
        return Err(Error::usage("--pick", problem, "give one, or open their previews in share/picker.html"));
    };
    let photograph = reading.open(path)?;
    let lens = args.placing.lens(&photograph)?;
    let found = finding::line(path, &photograph, &find_all(&photograph, &lens))?;
    // everything else remains as the person marked it
    let around = |clicks| {
        let fold = find_fold_around(&photograph, &lens, clicks);
        let found = Detections { fold, chart: None, white_candidates: Vec::new() };
        finding::line(path, &photograph, &found)
    };
    let files = [
        ServedFile { name: "", media_type: "text/html; charset=utf-8", bytes: PAGE.into() },
        ServedFile {
            name: "photograph.png",
            media_type: "image/png",
            bytes: preview(args, path, &photograph)?,
        },
        ServedFile { name: "regions.json", media_type: "application/json", bytes: found.into() },
    ];
    let reply = |name: &str, text: &str| match name {
        "done" => picked_line("the page", text)
            .map_or_else(|problem| Reply::Refused(problem.to_string()), Reply::Answered),
        "find" => match clicks(text).map(around) {
            Some(Ok(line)) => Reply::Text(line),
            Some(Err(problem)) => Reply::Refused(problem.to_string()),
            None => Reply::Refused("write two points as x,y x,y".to_owned()),
        },
        _ => Reply::Refused("there is no page of this name".to_owned()),
    };
    let line = cli::ask_on_page(&files, WAIT, |address| show(path, address), reply)?;
    let problem = format!("no corners came from the page within {WAIT_MINUTES} minutes");
    let remedy = "run it again, or give --panel0 and --panel1";
    out.text(&line.ok_or_else(|| Error::picture(path, problem, remedy))?)
}

/// The photograph in a format for browsers.
fn preview(args: &Args, path: &Path, photograph: &Photograph) -> Result<Vec<u8>> {
    let unwritten = |source| Error::File { path: "the page's picture".to_owned(), source };
    let folder = tempfile::tempdir().map_err(unwritten)?;
    let file = folder.path().join("photograph.png");
    write_preview(&file, photograph, path, &balance::of_photograph(args, photograph))?;
    keep_complete()?; // a page needs it now
    std::fs::read(&file).map_err(unwritten)
}

/// Two places in the photograph, px, as `x,y x,y`.
fn clicks(text: &str) -> Option<[Point; 2]> {
    text.split_whitespace().map(parse_point).collect::<Option<Vec<_>>>()?.try_into().ok()
}

/// Opens the page for a user at a terminal, and prints its address.
fn show(path: &Path, address: &str) {
    cli::say("vextract", &format!("{}: mark the panels in a browser at {address}", path.display()));
    cli::say("vextract", "waiting for the page: press Done there to end it, or Ctrl-C here");
    let open = |opener: &&str| {
        let quiet = Command::new(opener).arg(address).stdout(Stdio::null()).stderr(Stdio::null()).spawn();
        quiet.is_ok()
    };
    if std::io::stderr().is_terminal() {
        OPENERS.iter().any(open);
    }
}
