//! Cameras: their sensitivities, what they did to a picture, and files of theirs that are not read.

use crate::{assert_refused, case};

const PHOTOS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/photos");

#[test]
fn camera_files() {
    assert_refused(
        r#"
        vkernel --facets 1x1 -o scene.json
        camera() { printf '{"spectral_data": {"index": {"main": %s}, "data": {"main": {%s}}}}' "$1" "$2"; }
        camera '["R", "G"]' '"400": [1, 2], "500": [1]' > ragged.json
        camera '["R"]' '"400": [1], "blue": [1]' > colour.json
        camera '["R"]' '"400": [1], "4e2": [1]' > twice.json
        camera '["R"]' '"400": [1]' > single.json
        camera '["R"]' '"400": [1], "nan": [1]' > nan.json
        camera '["R"]' '"400": [-1], "500": [2]' > negative.json
        camera '["R"]' '"400": [0], "500": [0]' > dark.json
        camera '["R"]' '"400": [1e999], "500": [0]' > infinite.json
        camera '["R"]' '' > empty.json
        camera '[]' '"400": [], "500": []' > blind.json
        echo '{"spectral_data": {"index": {"main": ["R"]}}}' > dataless.json
        echo 'nm,R' > table.json
        : > void.json
        head -c 20000 /dev/zero | tr '\0' '[' > deep.json
        truncate -s 70M long.json
        cat > forward <<'END'
        vforward scene.json --reflectance 0.5 --camera "$1"
END
        "#,
        &[
            case("sh forward ragged.json", 1, &["ragged.json", "1 number at 500 nm for 2 spectra"]),
            case("sh forward colour.json", 1, &["colour.json", "'blue' is not a wavelength"]),
            case("sh forward twice.json", 1, &["wavelength", "400"]),
            case("sh forward single.json", 1, &["wavelength"]),
            case("sh forward nan.json", 1, &["wavelength"]),
            case("sh forward negative.json", 1, &["-1 is below 0"]),
            case("sh forward dark.json", 1, &["zero at every wavelength"]),
            case("sh forward infinite.json", 1, &["infinite.json:1", "number out of range"]),
            case("sh forward empty.json", 1, &["empty.json", "no wavelengths"]),
            case("sh forward blind.json", 1, &["blind.json", "no spectra"]),
            case(
                "sh forward dataless.json",
                1,
                &["dataless.json:1", "missing field `data`", "spectral_data"],
            ),
            case("sh forward table.json", 1, &["table.json:1", "expected"]),
            case("sh forward void.json", 1, &["void.json:1", "EOF"]),
            case("sh forward deep.json", 1, &["deep.json:1"]),
            case("sh forward long.json", 1, &["long.json:1", "larger than 64 MiB"]),
            case("sh forward missing.json", 1, &["missing.json", "No such file"]),
        ],
    );
}

#[test]
fn what_a_camera_did() {
    let setup = format!(
        r#"
        vkernel --facets 1x1 -o scene.json
        did() {{ printf '{{"white_balance_gains": %s, "camera_to_linear_srgb": %s}}' "$1" "$2"; }}
        eye='[[1, 0, 0], [0, 1, 0], [0, 0, 1]]'
        did '[2, 1, 1.5]' "$eye" > good.json
        did '[2, 1]' "$eye" > two.json
        did '[2, 0, 1]' "$eye" > dark.json
        did '[2, -1, 1]' "$eye" > negative.json
        did '[2, 1, 1]' '[[1, 2, 3], [1, 2, 3], [0, 0, 1]]' > flat.json
        did '[2, 1, 1]' '[[1, 2], [1, 2]]' > small.json
        echo '{{"white_balance_gains": [2, 1, 1]}}' > half.json
        cp '{PHOTOS}/f_srgb_blue_flower_50.jpg' photo.jpg
        oiiotool photo.jpg --ch 0 -o grey.png
        cat > extract <<'END'
        photo=$1 did=$2
        shift 2
        vextract $photo --undo $did --panel0 '301.7,395.3 289.6,54.6 167.5,60.2 183.6,458.9' \
            --scene scene.json --camera nikon-d5100 "$@"
END
        "#
    );
    assert_refused(
        &setup,
        &[
            case("sh extract photo.jpg two.json", 1, &["two.json:1", "expected an array of length 3"]),
            case("sh extract photo.jpg dark.json", 1, &["dark.json", "gain 0 is not a number above 0"]),
            case("sh extract photo.jpg negative.json", 1, &["negative.json", "gain -1"]),
            case("sh extract photo.jpg flat.json", 1, &["flat.json", "cannot be inverted"]),
            case("sh extract photo.jpg small.json", 1, &["small.json:1"]),
            case("sh extract photo.jpg half.json", 1, &["half.json:1", "camera_to_linear_srgb"]),
            case("sh extract photo.jpg missing.json", 1, &["missing.json", "No such file"]),
            case("sh extract grey.png good.json", 1, &["grey.png", "a grey picture", "without --undo"]),
            case("sh extract photo.jpg good.json --white-level 10", 1, &["photo.jpg", "no facet"]),
        ],
    );
}

/// `--save-camera`, and what it wrote, spoiled.
#[test]
fn cameras_from_charts() {
    let setup = format!(
        r#"
        vkernel --facets 1x1 -o scene.json
        cp '{PHOTOS}/f_srgb_blue_flower_50.jpg' photo.jpg
        oiiotool photo.jpg --ch 0 -o grey.png
        cat > camera <<'END'
        photo=$1 file=$2
        shift 2
        vextract $photo --save-camera $file --chart '20,20 120,20 120,90 20,90' "$@"
END
        printf 'wavelength_nm,R,R_sd,G,G_sd,B,B_sd\n' > head
        {{ cat head; printf '400,1,0.1,1,0.1,1,0.1\n700,1,0.1,1,0.1,1,0.1\n'; }} > good.csv
        {{ cat head; printf '400,1,0.1,1,0.1,1\n700,1,0.1,1,0.1,1,0.1\n'; }} > short.csv
        {{ cat head; printf '400,NaN,0.1,1,0.1,1,0.1\n700,1,0.1,1,0.1,1,0.1\n'; }} > nan.csv
        {{ cat head; printf '400,-1,0.1,1,0.1,1,0.1\n700,1,0.1,1,0.1,1,0.1\n'; }} > negative.csv
        {{ cat head; printf '400,0,0.1,1,0.1,1,0.1\n700,0,0.1,1,0.1,1,0.1\n'; }} > dark.csv
        cp head empty.csv
        named() {{ printf 'nm,%s\n400,1,2,3,4\n700,1,2,3,4\n' "$1"; }}
        named R,G,B,red > twice.csv
        named R,G,g,B > greens.csv
        named B,IR,UV,W > some.csv
        "#
    );
    assert_refused(
        &setup,
        &[
            case("sh camera photo.jpg mine.txt", 2, &["--save-camera", "mine.txt", ".csv"]),
            case("sh camera missing.jpg mine.csv", 1, &["missing.jpg", "No such file"]),
            case("sh camera 'photo.jpg photo.jpg' mine.csv", 2, &["--save-camera", "2 photographs"]),
            case("sh camera grey.png mine.csv", 1, &["grey.png"]),
            case("sh camera photo.jpg mine.csv", 1, &["photo.jpg", "chart"]),
            case("sh camera photo.jpg mine.csv --chart-grid 0x4", 2, &["--chart-grid"]),
            case("sh camera photo.jpg mine.csv --illuminant D65 --illuminant A", 2, &["--illuminant"]),
            case("vextract photo.jpg --save-camera mine.csv", 2, &["--chart", "--regions"]),
            case("vforward scene.json --reflectance 0.5 --camera short.csv", 1, &["short.csv:2"]),
            case("vforward scene.json --reflectance 0.5 --camera nan.csv", 1, &["nan.csv:2", "NaN"]),
            case("vforward scene.json --reflectance 0.5 --camera negative.csv", 1, &["-1 is below 0"]),
            case("vforward scene.json --reflectance 0.5 --camera dark.csv", 1, &["zero at every wavelength"]),
            case("vforward scene.json --reflectance 0.5 --camera empty.csv", 1, &["empty.csv"]),
            case(
                "vforward scene.json --reflectance 0.5 --camera twice.csv",
                1,
                &["R, red have the same colour"],
            ),
            case(
                "vforward scene.json --reflectance 0.5 --camera greens.csv",
                1,
                &["G, g have the same colour"],
            ),
            case("vforward scene.json --reflectance 0.5 --camera some.csv", 1, &["B, IR, UV, W do not name"]),
        ],
    );
}

#[test]
fn cameras_that_are_not_known() {
    let setup = format!(
        r#"
        vkernel --facets 1x1 -o scene.json
        oiiotool '{PHOTOS}/f_srgb_blue_flower_50.jpg' --attrib Make NIKON --attrib Model '' -o modelless.tif
        cat > extract <<'END'
        vextract "$1" --panel0 '301.7,395.3 289.6,54.6 167.5,60.2 183.6,458.9' --scene scene.json
END
        "#
    );
    assert_refused(
        &setup,
        &[case("sh extract modelless.tif", 2, &["names no camera", "--list cameras", "rawtoaces"])],
    );
}

/// Tools that do not read RAW files say which do.
#[test]
#[cfg(not(feature = "raw"))]
fn raw_files_without_their_reader() {
    let setup = format!(
        r#"
        vkernel --facets 1x1 -o scene.json
        cp '{PHOTOS}/h_raw_magenta_50.dng' photo.tif
        printf 'FUJIFILMCCD-RAW 0201' > photo.raf
        printf '\0\0\0\030ftypcrx \0\0\0\0' > photo.cr3
        printf 'II*\0\020\0\0\0CR\002\0' > photo.cr2
        cat > extract <<'END'
        vextract "$1" --panel0 '0,0 9,0 9,9 0,9' --scene scene.json --camera 1
END
        "#
    );
    const SAYS: &[&str] = &["a camera's RAW file", "share/install", "--features raw", "linear TIFF"];
    assert_refused(
        &setup,
        &[
            case("sh extract photo.tif", 1, SAYS),
            case("sh extract photo.raf", 1, SAYS),
            case("sh extract photo.cr3", 1, SAYS),
            case("sh extract photo.cr2", 1, SAYS),
        ],
    );
}
