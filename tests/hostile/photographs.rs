//! Pictures and corners.

use serde_json::Value;

use crate::common::Workdir;
use crate::{assert_refused, case};

/// The copy of a photograph that [`photographs`] spoils.
const PHOTO: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/photos/a_ideal_magenta_50.exr");

#[test]
fn photographs() {
    let setup = format!(
        r#"
        vkernel --angle-deg 50 --facets 2x2 -o scene.json
        cp '{PHOTO}' photo.exr
        echo 'this is no picture' > text.png
        cp text.png text.nef
        : > empty.tif
        oiiotool photo.exr -d uint16 -o photo.tif
        oiiotool photo.exr -d uint16 -o photo.png
        oiiotool photo.exr -d uint8 -o photo.jpg
        for photo in photo.exr photo.tif photo.png photo.jpg; do
            head -c $(($(wc -c < $photo) / 2)) $photo > cut-$photo
            head -c 20 $photo > begun-$photo
        done
        rm photo.tif photo.png photo.jpg
        oiiotool photo.exr --ch R -d uint16 -o grey.tif
        oiiotool photo.exr --ch R,R,R -d uint16 -o thrice.tif
        oiiotool photo.exr -d uint16 --attrib tiff:bigtiff 1 -o big.tif
        oiiotool photo.exr -d uint8 -o photo.jpg
        mv photo.jpg photo.nef
        oiiotool photo.exr --chnames a.R,a.G,a.B -o layered.exr
        printf 'nm,grey\n380,1\n720,1\n' > one.csv
        cat > extract <<'END'
        photo=$1 corners=$2
        shift 2
        vextract $photo --panel0 "$corners" --scene scene.json --camera canon-5d-mark-ii "$@"
END
        cat > whole <<'END'
        photo=$1
        shift
        sh extract $photo "332,462 345,77 122,12 104,442" "$@"
END
        "#
    );
    assert_refused(
        &setup,
        &[
            case(
                "sh extract photo.exr '332,462 345,77 104,442 122,12'",
                2,
                &["--panel0", "cross", "crease end 0"],
            ),
            case("sh extract photo.exr '332,462 345,77 122,12'", 2, &["--panel0", "3 corners instead of 4"]),
            case("sh extract photo.exr '332,462 345,77 122,12 a,b'", 2, &["--panel0", "a,b"]),
            case("sh extract photo.exr '332,462 345,77 122,12 NaN,442'", 2, &["--panel0", "corner 4"]),
            case("sh extract photo.exr '332,462 345,77 345,77 104,442'", 2, &["--panel0", "same point"]),
            case(
                "sh whole photo.exr --panel 2='332,462 345,77 485,17 472,446'",
                2,
                &["--panel", "no flat panel 2", "0, 1"],
            ),
            case(
                "sh whole photo.exr --panel 0='332,462 345,77 485,17 472,446'",
                2,
                &["--panel", "panel 0 is stated twice"],
            ),
            case("sh whole photo.exr --panel '332,462 345,77 485,17 472,446'", 2, &["--panel", "N="]),
            case("sh extract photo.exr ''", 2, &["--panel0", "0 corners"]),
            case(
                "sh extract photo.exr '932,462 945,77 722,12 704,442'",
                1,
                &["panel 0: no facet", "640 x 480 px"],
            ),
            case("sh whole photo.exr --refine=0", 2, &["--refine", "out of range"]),
            case("sh whole photo.exr --refine=0.5", 2, &["--refine: 0.5 px is out of range", "1 to 100"]),
            case("sh whole photo.exr --refine=101", 2, &["--refine: 101 px is out of range", "1 to 100"]),
            case("sh whole photo.exr --refine=NaN", 2, &["--refine", "out of range"]),
            case("vextract photo.exr --preview one.png --refine=101", 2, &["--refine", "1 to 100"]),
            case(
                "sh whole photo.exr --refine --panel1 '32,462 45,77 85,17 72,446'",
                2,
                &["--panel", "one point of the sheet", "crease"],
            ),
            case("sh whole photo.exr --distortion 0.1,x", 2, &["--distortion", "K1,K2"]),
            case("sh whole photo.exr --distortion=-0.5", 2, &["--distortion", "bends the picture back"]),
            case("sh whole photo.exr --distortion NaN", 2, &["--distortion"]),
            case("sh whole photo.exr --overlay no/such/folder.png", 1, &["no/such/folder.png"]),
            case("sh whole photo.exr photo.exr --overlay one.png", 2, &["--overlay", "2 photographs", "{}"]),
            case("vextract photo.exr text.png --preview one.png", 2, &["--preview", "2 photographs", "{}"]),
            case("vextract text.png --preview one.png", 1, &["text.png", "not a PNG"]),
            case("vextract photo.exr --preview no/such/folder.png", 1, &["no/such/folder.png"]),
            case("sh whole .", 1, &["folder"]),
            case(
                "sh whole grey.tif",
                1,
                &["grey.tif", "a grey picture", "camera has 3 channels", "--camera"],
            ),
            case("sh whole thrice.tif", 1, &["thrice.tif", "a grey picture saved as RGB", "--camera"]),
            case(
                "vextract photo.exr --scene scene.json --camera one.csv \
                    --panel0 '332,462 345,77 122,12 104,442'",
                1,
                &["photo.exr", "an RGB picture", "camera has 1 channel;"],
            ),
            case("sh whole big.tif", 1, &["big.tif", "BigTIFF", "less than 4 GiB"]),
            case("sh whole photo.nef", 1, &["photo.nef", "named like a camera's RAW file", "JPEG"]),
            case("sh whole text.nef", 1, &["text.nef", "does not begin like one", "copy it again"]),
            case("sh whole layered.exr", 1, &["layered.exr", "in layers", "R, G and B"]),
            case("sh whole text.png", 1, &["text.png", "not a PNG, TIFF, JPEG, OpenEXR or RAW"]),
            case("sh whole empty.tif", 1, &["empty.tif", "empty"]),
            case("sh whole cut-photo.exr", 1, &["cut-photo.exr", "cut short"]),
            case("sh whole cut-photo.tif", 1, &["cut-photo.tif", "cut short"]),
            case("sh whole cut-photo.png", 1, &["cut-photo.png", "cut short"]),
            case("sh whole cut-photo.jpg", 1, &["cut-photo.jpg", "ends too early"]),
            case("sh whole begun-photo.exr", 1, &["begun-photo.exr", "cut short"]),
            case("sh whole begun-photo.tif", 1, &["begun-photo.tif", "cut short"]),
            case("sh whole begun-photo.png", 1, &["begun-photo.png", "cut short"]),
            case("sh whole begun-photo.jpg", 1, &["begun-photo.jpg", "cut short"]),
            case("sh whole photo.exr --margin -1", 2, &["--margin"]),
            case("sh whole photo.exr --margin 1000", 1, &["photo.exr", "no facet", "--margin"]),
            case("sh whole photo.exr --white-level 1e-9", 1, &["photo.exr", "no facet", "white level"]),
            case(
                "sh whole photo.exr --panel1 '332,462 345,77 122,12 104,442'",
                2,
                &["panels 0 and 1", "overlap"],
            ),
            case("sh whole photo.exr --white-level 0", 2, &["--white-level", "black level"]),
            case("sh whole photo.exr --exposure 0", 2, &["--exposure", "above 0"]),
            case("sh whole photo.exr --transfer gamma", 2, &["--transfer", "srgb"]),
            case(
                "vextract photo.exr --scene scene.json --camera nikon-d510 --panel0 '0,0 9,0 9,9 0,9'",
                1,
                &["nikon-d5100"],
            ),
            case(
                "vextract photo.exr --panel0 '332,462 345,77 122,12 104,442' < scene.json",
                2,
                &["--camera"],
            ),
            // the fold would be found
            case("vextract photo.exr < scene.json", 2, &["--camera"]),
            case("vextract --panel0 '332,462 345,77 122,12 104,442' < scene.json", 2, &["IMAGE"]),
        ],
    );
}

/// In a batch a photograph that cannot be used does not stop the others.
#[test]
fn photographs_of_a_batch() {
    let folder = Workdir::new();
    let run = folder.sh(&format!(
        "echo no picture > text.png
        vkernel --angle-deg 50 --facets 2x2 | vextract '{PHOTO}' text.png missing.tif '{PHOTO}' \
            --camera canon-5d-mark-ii --illuminant D65 --panel0 '332,462 345,77 122,12 104,442'"
    ));
    assert!(run.says_what_failed(), "{run:?}");
    assert!(run.stderr.starts_with("vextract: 2 of 4 failed; first: text: text.png: "), "{}", run.stderr);
    let records: Vec<Value> = run.stdout.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let errors: Vec<_> = records.iter().map(|record| record["error"].as_str().unwrap_or_default()).collect();
    assert_eq!((errors[0], errors[1], errors[4]), ("", "", ""));
    assert!(errors[2].starts_with("text.png: ") && errors[3].starts_with("missing.tif: "), "{errors:?}");
}

#[test]
fn lists_of_photographs() {
    assert_refused(
        r#"
        vkernel --facets 1x1 -o scene.json
        printf '\n\n' > empty.txt
        printf '\377\n' > bytes.txt
        echo photo.tif | gzip > list.txt.gz
        cat > extract <<'END'
        vextract --files-from "$@" --scene scene.json --camera canon-5d-mark-ii --panel0 '0,0 9,0 9,9 0,9'
END
        "#,
        &[
            case("sh extract empty.txt", 2, &["--files-from", "empty.txt", "one name per line"]),
            case("sh extract - < empty.txt", 2, &["--files-from", "one name per line"]),
            case("sh extract missing.txt", 1, &["missing.txt", "No such file"]),
            case("sh extract bytes.txt", 1, &["bytes.txt", "UTF-8"]),
            case("sh extract list.txt.gz", 1, &["compressed by gzip; run it through gzip -dc first"]),
            case("sh extract .", 1, &["directory"]),
            case("vextract --files-from - --panel0 '0,0 9,0 9,9 0,9'", 2, &["--files-from", "--scene FILE"]),
            case(
                "echo x.exr | vextract --files-from - --scene scene.json --regions -",
                2,
                &["--regions", "list of photographs", "--regions FILE"],
            ),
            // which reads no scene
            case("echo x.exr | vextract --find --files-from -", 1, &["x.exr", "No such file"]),
        ],
    );
}
