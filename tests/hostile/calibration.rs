//! Files of regions, charts, white cards and flat fields.

use crate::{assert_refused, case};

const PHOTO: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/photos/a_ideal_magenta_50.exr");

/// A photograph, and `extract`, which measures it with more flags.
fn setup() -> String {
    format!(
        r#"
        vkernel --angle-deg 50 --facets 2x2 -o scene.json
        cp '{PHOTO}' photo.exr
        cat > extract <<'END'
        vextract photo.exr --scene scene.json --camera canon-5d-mark-ii "$@"
END
        cat > marked <<'END'
        sh extract --panel0 "332,462 345,77 122,12 104,442" "$@"
END
        "#
    )
}

#[test]
fn regions() {
    let setup = setup()
        + r#"
        square='[[1,1],[99,1],[99,99],[1,99]]'
        : > empty.json
        echo 7 > number.json
        echo '[7]' > numbers.json
        truncate -s 70M large.json
        echo "{\"panle0\": $square}" > misspelt.json
        echo '{"panel0": [[1,1],[99,1],[99,99],[1,"99"]]}' > text.json
        echo '{"panel0": [[1,1],[99,1],[99,99],[1,1e999]]}' > infinite.json
        echo '{"panel0": [[1,1],[99,1],[1,99],[99,99]]}' > crossed.json
        echo '{"panel0": [[1,1],[9999,1],[9999,99],[1,99]]}' > outside.json
        echo "{\"panel0\": $square, \"panel1\": $square}" > same.json
        echo "{\"chart\": $square}" > without.json
        echo "{\"panel0\": $square, \"width\": 640}" > width.json
        echo "{\"panel0\": $square, \"width\": 0, \"height\": 0}" > no-size.json
        echo "{\"panel0\": $square, \"width\": 480, \"height\": 640}" > upended.json
        echo "[{\"panel0\": $square}]" > nameless.json
        echo "[{\"image\": \"a\"}, {\"image\": \"a\"}]" > twice.json
        echo "[{\"image\": \"other.exr\", \"panel0\": $square}]" > others.json
        echo "[]" > none.json
        echo "{\"panel0\": $square, \"chart\": $square, \"white\": $square}" > both.json
        "#;
    assert_refused(
        &setup,
        &[
            case("sh extract --regions .", 1, &["directory"]),
            case("sh extract --regions empty.json", 1, &["empty.json", "it holds no regions"]),
            case("sh extract --regions number.json", 1, &["number.json", "entry 0", "object"]),
            case("sh extract --regions numbers.json", 1, &["numbers.json", "entry 0", "object"]),
            case("sh extract --regions large.json", 1, &["large.json", "64 MiB"]),
            case("sh extract --regions misspelt.json", 1, &["'panle0'", "panel0, panel1, .., chart, white"]),
            case("sh extract --regions text.json", 1, &["'panel0'", "string", "four corners"]),
            case("sh extract --regions infinite.json", 1, &["infinite.json", "out of range"]),
            case("sh extract --regions crossed.json", 1, &["'panel0'", "cross"]),
            case("sh extract --regions outside.json", 1, &["panel 0", "640 x 480 px"]),
            case("sh extract --regions same.json", 2, &["panels 0 and 1", "overlap"]),
            // the fold is found, but where the file has a chart there is none
            case("sh extract --regions without.json -q", 1, &["--chart"]),
            case("sh extract --regions width.json", 1, &["'width' and 'height'", "both"]),
            case("sh extract --regions no-size.json", 1, &["'width' and 'height'", "above 0"]),
            case("sh extract --regions upended.json", 1, &["480 x 640 px", "640 x 480 px"]),
            case("sh extract --regions nameless.json", 1, &["entry 0", "'image'"]),
            case("sh extract --regions twice.json", 1, &["'a' occurs twice"]),
            case("sh extract --regions others.json", 1, &["'photo.exr'", "add one"]),
            case("sh extract --regions none.json", 1, &["none.json", "it holds no regions"]),
            case("sh extract --regions both.json", 2, &["--regions", "keep one"]),
            case("sh extract --regions both.json --exposure 1", 2, &["--exposure", "keep one"]),
        ],
    );
}

#[test]
fn charts_and_white_cards() {
    let setup = setup()
        + r#"
        printf 'wavelength,a,b\n400,0,0.5\n700,0,0.5\n' > dark.csv
        printf 'wavelength,a,b\n500,0.2,0.5\n600,0.2,0.5\n' > narrow.csv
        oiiotool photo.exr --ch R -d uint16 -o grey.tif
        oiiotool photo.exr --mulc 0 -o black.exr
        oiiotool photo.exr --resize 64x48 -o small.exr
        oiiotool photo.exr --fill:color=.004,.005,.004 80x80+540+200 -o shade.exr
        echo 'this is no picture' > text.png
        cat > chart <<'END'
        sh marked --chart "200,200 260,200 260,260 200,260" "$@"
END
        cat > shade <<'END'
        vextract shade.exr --scene scene.json --camera canon-5d-mark-ii \
            --panel0 "332,462 345,77 122,12 104,442" --white-region "550,210 610,210 610,270 550,270" "$@"
END
        cat > card <<'END'
        sh marked --white-region "200,200 260,200 260,260 200,260" "$@"
END
        "#;
    assert_refused(
        &setup,
        &[
            case("sh marked --chart '1,1 99,1 99,99'", 2, &["--chart", "3 corners", "first patch"]),
            case(
                "sh marked --chart '1,1 999,1 999,99 1,99'",
                1,
                &["chart", "end of the first row", "outside"],
            ),
            case("sh marked --chart '9,9 12,9 12,12 9,12'", 1, &["chart", "too few pixels"]),
            case("sh marked --chart '1,1 99,1 99,99 1,99'", 1, &["chart", "does not rise"]),
            case("sh marked --chart '130,30 330,100 320,440 120,420'", 1, &["chart", "off by"]),
            case("sh marked --chart '1,1 99,1 99,99 1,99' --exposure 1", 2, &["--exposure", "--chart"]),
            case(
                "sh marked --chart '1,1 99,1 99,99 1,99' --white-region '1,1 99,1 99,99 1,99'",
                2,
                &["--white-region", "--chart"],
            ),
            case("sh chart --chart-cos 0", 2, &["--chart-cos", "above 0"]),
            case("sh chart --chart-cos 1.01", 2, &["--chart-cos", "at most 1"]),
            case("sh chart --chart-cos NaN", 2, &["--chart-cos", "NaN"]),
            case("sh card --white-cos -1", 2, &["--white-cos", "-1"]),
            case("sh chart --chart-grid 24", 2, &["--chart-grid", "10x10"]),
            case("sh chart --chart-grid 5x5", 2, &["--chart-grid", "24 patches of 'cc24'"]),
            case("sh chart --chart-grid 9999999999x9999999999", 2, &["--chart-grid", "24 patches"]),
            case("sh chart --chart-reference cc42", 1, &["cc42", "cc24"]),
            case("sh chart --chart-reference narrow.csv --chart-grid 1x2", 1, &["narrow:a", "500..600 nm"]),
            case("sh chart --chart-reference dark.csv --chart-grid 1x2", 1, &["dark:a", "black"]),
            case("sh card --white-reflectance cc24", 2, &["--white-reflectance", "a set"]),
            case("sh card --white-reflectance 1.2", 2, &["--white-reflectance: ", "1.2", "0..1"]),
            case("sh card", 1, &["photo.exr: the white region overlaps panel 0", "beside the sheet"]),
            case("sh card --white-reflectance 0.9", 1, &["photo.exr: the white region overlaps panel 0"]),
            // a shadow is no white paper, and no card
            case(
                "sh shade",
                1,
                &["shade.exr: the white region is too dark", "times as bright", "--white-cos"],
            ),
            case("sh shade --white-reflectance 0.9", 1, &["shade.exr: the white region is too dark"]),
            case(
                "sh marked --white-region '1,1 9,1 9,9 1,9'",
                1,
                &["white region", "no light", "--white-region"],
            ),
            case(
                "sh marked --white-region '1,1 9,1 9,9 1,9' --white-reflectance 0.9",
                1,
                &["white card", "does not rise"],
            ),
            case(
                "vextract grey.tif --scene scene.json --camera canon-5d-mark-ii \
                 --panel0 '332,462 345,77 122,12 104,442' --white-region '200,200 260,200 260,260 200,260'",
                1,
                &["grey.tif", "a grey picture", "camera has 3 channels"],
            ),
            case("sh marked --chart-cos 0.5", 2, &["--chart", "--regions"]),
            case("sh marked --white-reflectance 0.9", 2, &["--white-region", "--regions"]),
            // what these write is all that they write
            case("sh extract --preview x.png -o x", 2, &["--preview", "--output"]),
            case("sh extract --preview x.png --resume x", 2, &["--preview", "--resume"]),
            case("sh extract --preview x.png --save facet_rgb=x", 2, &["--preview", "--save"]),
            case("sh extract --preview x.png --overlay y.png", 2, &["--preview", "--overlay"]),
            case("sh chart --save-camera x.csv -o x", 2, &["--save-camera", "--output"]),
            case("sh chart --save-camera x.csv --preview x.png", 2, &["--save-camera", "--preview"]),
            case("sh extract --overlay -", 2, &["--overlay", "a picture needs a file"]),
            case("sh extract --preview -", 2, &["--preview", "a picture needs a file"]),
            case("sh marked --white missing.exr", 1, &["missing.exr", "No such file"]),
            case("sh marked --white text.png", 1, &["text.png", "not a PNG"]),
            case("sh marked --white black.exr", 1, &["black.exr", "dark"]),
            case("sh marked --white small.exr", 1, &["photo.exr", "64 x 48"]),
        ],
    );
}
