//! What would be wrong in silence is refused or said: previews, crease ends that differ, pictures that were
//! developed, a light that nobody named.

use crate::common::{Ended, Workdir};

const PHOTO: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/photos/a_ideal_magenta_50.exr");
const JPEG: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/photos/f_srgb_blue_flower_50.jpg");
const PANELS: &str = "--panel0 '332,462 345,77 122,12 104,442' --panel1 '332,462 345,77 485,17 472,446'";

fn extract(folder: &Workdir, photo: &str, flags: &str) -> Ended {
    folder.sh(&format!(
        "vkernel --angle-deg 50 --facets 2x2 | vextract '{photo}' \
            --camera canon-5d-mark-ii {flags} -o out.ndjson"
    ))
}

#[test]
fn a_preview_is_no_photograph() {
    let folder = Workdir::new();
    let made = folder.sh(&format!("vextract '{PHOTO}' --preview preview.png"));
    assert_eq!((made.status, made.stderr.as_str()), (0, ""));
    assert_eq!(
        extract(&folder, PHOTO, &format!("--illuminant D65 {PANELS} --overlay overlay.png")).status,
        0
    );
    // saved again by another program, the first two times with the description, then with the comment
    let again = folder
        .sh("vkernel --angle-deg 50 | vforward --reflectance 0.5 --render render.png -q > rendered.ndjson
        oiiotool render.png -o again.tif -o again.jpg; oiiotool preview.png -o again.png");
    assert_eq!((again.status, again.stderr.as_str()), (0, ""));
    for picture in ["preview.png", "overlay.png", "render.png", "again.tif", "again.jpg", "again.png"] {
        let run = extract(&folder, picture, &format!("--illuminant D65 {PANELS}"));
        assert_eq!(run.status, 1, "{run:?}");
        assert!(
            run.stderr.ends_with("give the original photograph\n") && run.stderr.contains(picture),
            "{run:?}"
        );
    }
}

#[test]
fn a_crease_has_its_ends_in_one_place() {
    let folder = Workdir::new();
    let turned = "--panel0 '332,462 345,77 122,12 104,442' --panel1 '345,77 332,462 472,446 485,17'";
    let run = extract(&folder, PHOTO, &format!("--illuminant D65 {turned}"));
    assert_eq!(run.status, 2, "{run:?}");
    for part in
        ["crease end 0 of panel 0 is at 332,462", "crease end 0 of panel 1 at 345,77", "from the same end"]
    {
        assert!(run.stderr.contains(part), "{run:?}");
    }
    // clicked twice, a few pixels apart
    let twice = "--panel0 '332,462 345,77 122,12 104,442' --panel1 '334,461 343,79 485,17 472,446'";
    let run = extract(&folder, PHOTO, &format!("--illuminant D65 {twice}"));
    assert_eq!((run.status, run.stderr.as_str()), (0, ""));
}

#[test]
fn a_picture_that_was_developed_is_warned_of() {
    let folder = Workdir::new();
    let run = extract(&folder, JPEG, &format!("--illuminant D65 {PANELS}"));
    assert_eq!(run.status, 0, "{run:?}");
    assert!(run.stderr.contains("warning: ") && run.stderr.contains("--undo"), "{run:?}");
    assert!(folder.sh("cat out.ndjson").stdout.contains("\"developed\":true"));
    let undone =
        r#"{"white_balance_gains": [2, 1, 1.5], "camera_to_linear_srgb": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}"#;
    folder.sh(&format!("echo '{undone}' > did.json"));
    let run = extract(&folder, JPEG, &format!("--illuminant D65 {PANELS} --undo did.json"));
    assert!(run.status == 0 && !run.stderr.contains("developed"), "{run:?}");
    assert!(!folder.sh("cat out.ndjson").stdout.contains("\"developed\""));
}

#[test]
fn a_light_that_nobody_named_is_said() {
    let run = extract(&Workdir::new(), PHOTO, PANELS);
    assert_eq!(run.status, 0, "{run:?}");
    assert!(run.stderr.contains("daylight assumed") && run.stderr.contains("--illuminant"), "{run:?}");
}

#[test]
fn a_flag_that_nothing_uses_is_said() {
    let folder = Workdir::new();
    folder.sh("echo '{\"panel0\": [[332,462],[345,77],[122,12],[104,442]], \
        \"panel1\": [[332,462],[345,77],[485,17],[472,446]]}' > regions.json");
    for flag in
        ["--chart-cos 0.3", "--chart-reference cc24-babelcolor", "--white-cos 0.5", "--white-reflectance 0.9"]
    {
        let run = extract(&folder, PHOTO, &format!("--illuminant D65 --regions regions.json {flag}"));
        let name = flag.split_once(' ').unwrap().0;
        let is_said =
            run.stderr.lines().count() == 1 && run.stderr.contains(&format!("{name} is not used: "));
        assert!(run.status == 0 && is_said, "{flag}: {run:?}");
    }
    let run =
        folder.sh("vkernel --facets 2x2 | vforward --reflectance 0.5 | vestimate --illuminants A -o out");
    assert!(run.status == 0 && run.stderr.starts_with("vestimate: --illuminants is not used: "), "{run:?}");
}
