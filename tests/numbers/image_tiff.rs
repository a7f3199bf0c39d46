//! TIFF in every layout that the specification has for a picture: the numbers that `OpenImageIO` reads, or a
//! refusal with the reason. `TIFF=write` makes a page of what came out; without it the page is checked to say
//! so.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

use rayon::prelude::*;
use vfold::image::{Photograph, Pixel, ReadOptions, Transfer};

const PAGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/benches/results/tiff.md");
const WRITER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/numbers/tiff_files.py");
const HEAD: &str = "\
# TIFF, layout by layout

`cargo test --test numbers tiff` writes one small picture in every layout, \
has OpenImageIO and vfold read it, and compares all pixels: strips or
tiles; samples side by side or a plane each; uncompressed, PackBits, LZW, Deflate; \
without predictor, with differences (2), with that of floats
(3); alternately little-endian and big-endian. A cell counts the files that give the same numbers \
within 1e-6, or are refused, with the reason. Where
OpenImageIO reads a file differently from the same picture in strips, or not at all (2.4: 64-bit \
floats in tiles), vfold's numbers must be those of the
strips; the test prints how many these are.

";
/// Files that one process of oiiotool reads.
const AT_ONCE: usize = 64;

/// A file: its number, and what it is.
struct Made {
    n: usize,
    is_grey: bool,
    row: String,
    column: String,
    what: String,
}

#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Came {
    Same,
    /// The numbers that `OpenImageIO` reads of the same picture in another layout, but not in this one.
    Right,
    Refused(String),
    Other(String),
}

fn made(folder: &Path) -> Vec<Made> {
    let run = Command::new("python3").arg(WRITER).arg(folder).output().unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let of_line = |line: &str| {
        let [n, kind, samples, planes, cut, ..] = line.split('\t').collect::<Vec<_>>()[..] else {
            panic!("{line}")
        };
        let column = if planes == "planes" { format!("planes in {cut}") } else { cut.to_owned() };
        let (row, is_grey) = (format!("{kind} | {samples}"), samples.starts_with("grey"));
        Made { n: n.parse().unwrap(), is_grey, row, column, what: line.to_owned() }
    };
    String::from_utf8(run.stdout).unwrap().lines().map(of_line).collect()
}

/// Has `OpenImageIO` read the files and write what it read, where it can.
fn by_openimageio(folder: &Path, files: &[Made]) {
    let colours = |file: &Made| if file.is_grey { "0,0,0" } else { "0,1,2" };
    let convert = |files: &[Made]| {
        let mut run = Command::new("oiiotool");
        for file in files {
            run.arg(format!("{}.tif", file.n)).args(["--ch", colours(file), "--chnames", "R,G,B"]);
            run.args(["-d", "float", "-o", &format!("{}.exr", file.n)]);
        }
        run.current_dir(folder).output().unwrap().status.success()
    };
    files.par_chunks(AT_ONCE).filter(|files| !convert(files)).for_each(|files| {
        for file in files.chunks(1) {
            convert(file);
        }
    });
}

/// `first` is a file of the same picture in the plainest layout.
fn compare(folder: &Path, file: &Made, first: &Made) -> Came {
    let options = ReadOptions { transfer: Transfer::Linear, ..ReadOptions::default() };
    let ours = match Photograph::open(&folder.join(format!("{}.tif", file.n)), &options) {
        Ok(photograph) => photograph,
        Err(error) => {
            let message = error.to_string();
            let (_, why) = message.split_once(": ").unwrap();
            return Came::Refused(why.split(';').next().unwrap().to_owned());
        }
    };
    let is_theirs = |n: usize| {
        let theirs = Photograph::open(&folder.join(format!("{n}.exr")), &options);
        theirs.is_ok_and(|theirs| are_same(&ours, &theirs))
    };
    match () {
        () if is_theirs(file.n) => Came::Same,
        () if is_theirs(first.n) => Came::Right,
        () => Came::Other("other numbers".to_owned()),
    }
}

fn are_same(ours: &Photograph, theirs: &Photograph) -> bool {
    let size = |photograph: &Photograph| (photograph.width(), photograph.height());
    let near = |at: (usize, usize)| match (ours.pixel(at.0, at.1), theirs.pixel(at.0, at.1)) {
        (Pixel::Light(ours), Pixel::Light(theirs)) => {
            ours.iter().zip(theirs).all(|(a, b)| (a - b).abs() < 1e-6)
        }
        _ => false,
    };
    size(ours) == size(theirs) && (0..ours.height()).all(|y| (0..ours.width()).all(|x| near((x, y))))
}

#[test]
fn every_layout_is_read_as_openimageio_does_or_refused() {
    let folder = tempfile::tempdir().unwrap();
    let files = made(folder.path());
    by_openimageio(folder.path(), &files);
    let came: Vec<Came> = files
        .par_iter()
        .map(|file| {
            let first = files.iter().find(|first| first.row == file.row).unwrap();
            compare(folder.path(), file, first)
        })
        .collect();
    let others: Vec<_> = files.iter().zip(&came).filter(|(_, came)| matches!(came, Came::Other(_))).collect();
    let others: Vec<_> = others.iter().map(|(file, came)| format!("{}: {came:?}", file.what)).collect();
    assert!(others.is_empty(), "{} of {}:\n{}", others.len(), files.len(), others.join("\n"));
    for came in &came {
        if let Came::Refused(why) = came {
            let is_true = why.starts_with("this vfold does not read TIFF with ")
                || why.starts_with("it is grey, but has ");
            assert!(is_true && !why.contains("damaged"), "{why}");
        }
    }
    let misread = came.iter().filter(|came| **came == Came::Right).count();
    println!("{misread} files are right that this OpenImageIO reads otherwise than their picture in strips");
    let page = page(&files, &came);
    if std::env::var("TIFF").is_ok_and(|wish| wish == "write") {
        fs::write(PAGE, &page).unwrap();
    }
    assert_eq!(
        fs::read_to_string(PAGE).unwrap(),
        page,
        "make it anew: TIFF=write cargo test --test numbers tiff"
    );
}

/// How often files of a row and a column came out in each way.
type Cells<'a> = BTreeMap<(&'a str, &'a str), BTreeMap<&'a Came, usize>>;

/// What `OpenImageIO` misreads depends on its version, which the page does not.
fn page(files: &[Made], came: &[Came]) -> String {
    const COLUMNS: [&str; 4] = ["strips", "tiles", "planes in strips", "planes in tiles"];
    let came: Vec<_> =
        came.iter().map(|came| if *came == Came::Right { &Came::Same } else { came }).collect();
    let (mut rows, mut cells): (Vec<&str>, Cells) = Default::default();
    for (file, came) in files.iter().zip(came.iter().copied()) {
        if !rows.contains(&file.row.as_str()) {
            rows.push(&file.row);
        }
        *cells.entry((&file.row, &file.column)).or_default().entry(came).or_default() += 1;
    }
    let same = came.iter().filter(|came| ***came == Came::Same).count();
    let mut page = format!(
        "{HEAD}{} files: {same} the same, {} refused.\n\n| samples | channels | {} |\n\
         |---|---|---|---|---|---|\n",
        files.len(),
        files.len() - same,
        COLUMNS.join(" | ")
    );
    for row in rows {
        let cell = |column: &&str| {
            let counts = cells[&(row, *column)].iter().map(|(came, count)| match came {
                Came::Same | Came::Right => format!("{count} same"),
                Came::Refused(why) | Came::Other(why) => {
                    format!(
                        "{count} refused: {}",
                        why.trim_start_matches("this vfold does not read TIFF with ")
                    )
                }
            });
            counts.collect::<Vec<_>>().join(", ")
        };
        page += &format!("| {row} | {} |\n", COLUMNS.iter().map(cell).collect::<Vec<_>>().join(" | "));
    }
    page
}
