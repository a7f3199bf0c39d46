//! Pictures that pages show are those that the commands beside them make: the blocks of the page, or what
//! [`MADE_BY`] names.

use std::fs;
use std::path::{Path, PathBuf};

use crate::common::{Workdir, left_out};

const DOCS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/docs");

/// Pictures that no block of a page makes, and the lines that do, in an empty folder; `ROOT` is the
/// project.
const MADE_BY: [(&[&str], &str); 5] = [
    (
        &["fold.png", "spectrum.svg"],
        r#"sed -n '/^mkdir -p/,$p' "$ROOT/examples/quickstart" >steps; say() { :; }; out=$PWD; . ./steps"#,
    ),
    (&["bounces.svg"], r#"python3 -B "$ROOT/docs/bounces.py" >bounces.svg"#),
    (
        &["paper/green-45.png", "paper/munsell-45.png", "paper/munsell-60.png", "paper/metamers-default.svg"],
        r#"TOOLS=here "$ROOT/examples/paper/figures" >report.md; mv vfold-paper paper"#,
    ),
    (&["picker.png"], PICKER),
    (&["unfound.png"], UNFOUND),
];

/// Photographs in which no fold is found, side by side.
const UNFOUND: &str = r#"
photo=$ROOT/tests/data/photos/a_ideal_magenta_50.exr
oiiotool $photo --cut 300x480+200+0 --fullpixels -o cut.exr
oiiotool $photo --fill:color=0.06,0.04,0.03 200x240+20+300 -o covered.exr
oiiotool $photo --maxc 0.068,0.072,0.088 -o alike.exr
[ "$(vextract --find cut.exr covered.exr alike.exr | grep -c '"found":false')" = 3 ]
for case in cut covered alike; do
    oiiotool $case.exr --mulc 6 --colorconvert linear sRGB --resize 0x240 -d uint8 -o $case.png
done
oiiotool cut.png covered.png alike.png --mosaic:pad=4 3x1 -o unfound.png
"#;

/// The page of `vextract --pick` in a browser.
const PICKER: &str = r#"
echo '{"width": 640, "height": 480, "panel0": [[332.1,462.5],[345.3,77.1],[121.9,11.9],[103.9,442.2]],
  "panel1": [[332.1,462.5],[345.3,77.1],[484.9,16.7],[472,453.4]]}' >corners.json
cp "$ROOT/tests/data/photos/a_ideal_magenta_50.exr" photo.exr
: >said
vextract --pick photo.exr >picked.json 2>>said &
until grep -q http said; do sleep 0.1; done
node "$ROOT/tests/tools/picker/served.mjs" "$(grep -o 'http://[^ ]*' said)" picker.png corners.json
wait $!
"#;

/// By how much a number of a drawing may differ, px: other processors round otherwise.
const PX: f64 = 0.5;
/// By how much a value of a pixel may, of 255, and of how many pixels it may be more.
const VALUE: u8 = 8;
const PIXELS: f64 = 1e-3;

#[test]
fn pictures_of_no_page_are_what_is_made() {
    let mut stale: Vec<&str> = Vec::new();
    for (names, lines) in MADE_BY {
        if names == ["picker.png"] && std::env::var_os("PICKER_NODE_MODULES").is_none() {
            left_out("docs/picker.png, the corner picker in a browser, which tests/run installs");
            continue;
        }
        let folder = Workdir::new();
        let run = folder.sh(&format!("ROOT='{}'\n{lines}", env!("CARGO_MANIFEST_DIR")));
        assert_eq!(run.status, 0, "{names:?}: {run:?}");
        stale.extend(names.iter().copied().filter(|name| is_stale(name, folder.path())));
    }
    assert!(stale.is_empty(), "{stale:?} are stale: MANUAL=write cargo test --test manual writes them anew");
}

/// Pictures of docs that a page shows and its blocks did not make as they are, in the folder where they
/// ran.
pub fn stale_on(page: &str, folder: &Path) -> Vec<String> {
    let shown = page.split("![").skip(1).filter_map(|rest| rest.split_once("](")?.1.split(')').next());
    let of_docs = shown.map(|link| link.trim_start_matches("docs/")).filter(|link| !link.contains('/'));
    of_docs.filter(|name| !is_made_elsewhere(name) && is_stale(name, folder)).map(str::to_owned).collect()
}

fn is_made_elsewhere(name: &str) -> bool {
    MADE_BY.iter().any(|(names, _)| names.contains(&name))
}

/// Whether a picture of docs is not the one in a folder. With `MANUAL=write` it becomes that one.
fn is_stale(name: &str, folder: &Path) -> bool {
    let [kept, made] = [Path::new(DOCS), folder].map(|folder| folder.join(name));
    if !made.exists() {
        return true;
    }
    let is_alike = if name.ends_with(".svg") { drawings_are_alike } else { pixels_are_alike };
    let is_stale = !kept.exists() || !is_alike(&kept, &made);
    if is_stale && std::env::var("MANUAL").is_ok_and(|what| what == "write") {
        fs::copy(made, kept).unwrap();
        return false;
    }
    is_stale
}

fn pixels_are_alike(kept: &PathBuf, made: &PathBuf) -> bool {
    let [kept, made] = [kept, made].map(|path| image::open(path).unwrap().into_rgb8());
    if kept.dimensions() != made.dimensions() {
        return false;
    }
    let differs =
        |(a, b): (&image::Rgb<u8>, &image::Rgb<u8>)| a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > VALUE);
    let differing = kept.pixels().zip(made.pixels()).filter(|pair| differs(*pair)).count();
    (differing as f64) < PIXELS * f64::from(kept.width()) * f64::from(kept.height())
}

fn drawings_are_alike(kept: &PathBuf, made: &PathBuf) -> bool {
    let [kept, made] = [kept, made].map(|path| fs::read_to_string(path).unwrap());
    let [(words, numbers), (made_words, made_numbers)] = [kept, made].map(|drawing| parts(&drawing));
    let near = |(a, b): (&f64, &f64)| (a - b).abs() <= PX;
    words == made_words && numbers.len() == made_numbers.len() && numbers.iter().zip(&made_numbers).all(near)
}

/// Words and numbers of a drawing, without the pictures in it, which are those of the numbers beside them.
fn parts(drawing: &str) -> (String, Vec<f64>) {
    let mut pieces = drawing.split("data:image");
    let first = pieces.next().unwrap().to_owned();
    let text = pieces.fold(first, |text, piece| text + piece.split_once('"').map_or("", |(_, rest)| rest));
    let is_of_number = |letter: char| letter.is_ascii_digit() || letter == '.' || letter == '-';
    let words = text.replace(is_of_number, "");
    let numbers = text.split(|letter| !is_of_number(letter)).filter_map(|piece| piece.parse().ok()).collect();
    (words, numbers)
}
