//! Reading pictures written by other programs, upright, and refusing what is no picture.
//!
//! `oiiotool` writes the pictures and is the witness for orientation.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};
use tempfile::TempDir;
use vfold::Error;
use vfold::image::{Photograph, Pixel, ReadOptions, Transfer, write_linear, write_srgb_png};

const PHOTOS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/photos");

pub(super) fn oiiotool(folder: &TempDir, arguments: &str) {
    let run = Command::new("oiiotool").args(arguments.split_whitespace()).current_dir(folder).output();
    let run = run.expect("these tests need oiiotool: apt-get install openimageio-tools");
    assert!(run.status.success(), "oiiotool {arguments}: {}", String::from_utf8_lossy(&run.stderr));
}

pub(super) fn open(path: impl AsRef<Path>) -> vfold::Result<Photograph> {
    Photograph::open(path.as_ref(), &ReadOptions::default())
}

pub(super) fn light(photograph: &Photograph, x: usize, y: usize) -> [f64; 3] {
    match photograph.pixel(x, y) {
        Pixel::Light(light) => light,
        other => panic!("({x}, {y}) is {other:?}"),
    }
}

pub(super) fn assert_light(photograph: &Photograph, want: [f64; 3], tolerance: f64) {
    let got = light(photograph, 1, 1);
    assert!(got.iter().zip(want).all(|(got, want)| (got - want).abs() < tolerance), "{got:?} {want:?}");
}

fn assert_same_picture(got: &Photograph, want: &Photograph, tolerance: f64, what: &str) {
    assert_eq!((got.width(), got.height()), (want.width(), want.height()), "{what}");
    for (x, y) in (0..want.width()).flat_map(|x| (0..want.height()).map(move |y| (x, y))) {
        let (got, want) = (light(got, x, y), light(want, x, y));
        assert!(
            got.iter().zip(want).all(|(a, b)| (a - b).abs() < tolerance),
            "{what} ({x}, {y}): {got:?} {want:?}"
        );
    }
}

/// A gradient in both directions, so that no two of the eight orientations look alike.
const GRADIENT: &str =
    "--pattern fill:topleft=.1,.2,.3:topright=.9,.2,.3:bottomleft=.1,.8,.3:bottomright=.5,.5,.9 48x32 3";

/// What sets a picture of each orientation upright, by EXIF's definition of where its first row and column
/// belong; Pillow's `exif_transpose` does the same. (`oiiotool` 2.4's own `--reorient` mixes up 5 and 7.)
const UPRIGHT: [&str; 8] = [
    "",
    "--flop",
    "--rotate180",
    "--flip",
    "--transpose",
    "--rotate90",
    "--transpose --rotate180",
    "--rotate270",
];

#[test]
fn every_orientation_is_turned_upright() {
    let folder = tempfile::tempdir().unwrap();
    for (n, turn) in (1..=8).zip(UPRIGHT) {
        oiiotool(&folder, &format!("{GRADIENT} {turn} -d uint8 -o upright.png"));
        let upright = open(folder.path().join("upright.png")).unwrap();
        for (name, tolerance) in [("turned.tif", 1e-12), ("turned.jpg", 0.05)] {
            oiiotool(&folder, &format!("{GRADIENT} -d uint8 --orientation {n} -o {name}"));
            let turned = open(folder.path().join(name)).unwrap();
            assert_eq!(turned.info().camera.orientation.exif(), n);
            assert_same_picture(&turned, &upright, tolerance, &format!("{name}, orientation {n}"));
        }
    }
}

/// The PNG's EXIF chunk is laid in by hand: this `oiiotool` writes none.
#[test]
fn a_png_is_turned_upright() {
    let folder = tempfile::tempdir().unwrap();
    oiiotool(&folder, &format!("{GRADIENT} -d uint8 --orientation 6 -o turned.tif"));
    let pixels = image::open(folder.path().join("turned.tif")).unwrap().into_rgb8();
    let mut exif = b"II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x06\0\0\0\0\0\0\0".to_vec();
    for (broken, n) in [(false, 6), (true, 1)] {
        exif.truncate(if broken { 20 } else { exif.len() });
        let mut encoder = PngEncoder::new(fs::File::create(folder.path().join("turned.png")).unwrap());
        encoder.set_exif_metadata(exif.clone()).unwrap();
        encoder.write_image(&pixels, 48, 32, ExtendedColorType::Rgb8).unwrap();
        let turned = open(folder.path().join("turned.png")).unwrap();
        assert_eq!(
            (turned.info().camera.orientation.exif(), turned.info().camera.notes.len()),
            (n, usize::from(broken))
        );
        if !broken {
            assert_same_picture(&turned, &open(folder.path().join("turned.tif")).unwrap(), 1e-12, "PNG");
        }
    }
}

#[test]
fn the_camera_is_known_from_exif() {
    let photograph = open(Path::new(PHOTOS).join("f_srgb_blue_flower_50.jpg")).unwrap();
    let info = photograph.info();
    assert_eq!(info.camera.make.as_deref(), Some("NIKON CORPORATION"));
    assert_eq!(info.camera.model.as_deref(), Some("NIKON D5100"));
    assert_eq!(
        (info.camera.exposure_s, info.camera.f_number, info.camera.iso),
        (Some(0.004), Some(8.0), Some(100))
    );
    assert_eq!((info.format.as_str(), info.transfer_used), ("JPEG, 8-bit, RGB", Transfer::Srgb));
    assert_eq!(info.camera.notes, [""; 0]);
}

/// IEC 61966-2-1 at 0.2, 0.4, 0.6, which 255 and 65535 divide evenly (colour-science 0.4.7, `eotf_sRGB`).
pub(super) const SRGB: [f64; 3] = [0.033104766570885055, 0.13286832155381798, 0.31854677812509186];

#[test]
fn every_format_and_depth_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let linear = [0.2, 0.4, 0.6];
    for (name, depth, format, want, tolerance) in [
        ("a.png", "uint8", "PNG, 8-bit, RGB", SRGB, 1e-15),
        ("b.png", "uint16", "PNG, 16-bit, RGB", linear, 1e-15),
        ("a.tif", "uint8", "TIFF, 8-bit, RGB", SRGB, 1e-15),
        ("b.tif", "uint16", "TIFF, 16-bit, RGB", linear, 1e-15),
        ("c.tif", "float", "TIFF, float, RGB", linear, 1e-7),
        ("a.exr", "half", "OpenEXR, float, RGB", linear, 3e-4),
        ("b.exr", "float", "OpenEXR, float, RGB", linear, 1e-7),
        ("a.jpg", "uint8", "JPEG, 8-bit, RGB", SRGB, 5e-3),
    ] {
        oiiotool(&folder, &format!("--pattern constant:color=.2,.4,.6 16x9 3 -d {depth} -o {name}"));
        let photograph = open(folder.path().join(name)).unwrap();
        assert_eq!((photograph.info().format.as_str(), photograph.channels()), (format, 3));
        assert_light(&photograph, want, tolerance);
    }
}

#[test]
fn the_transfer_can_be_chosen() {
    let folder = tempfile::tempdir().unwrap();
    oiiotool(&folder, "--pattern constant:color=.2,.4,.6 4x4 3 -d uint16 -o deep.tif");
    oiiotool(&folder, "--pattern constant:color=.2,.4,.6 4x4 3 -d uint8 -o shallow.png");
    oiiotool(&folder, "--pattern constant:color=.2,.4,.6 4x4 3 -d float -o float.exr");
    for (name, transfer, want) in [
        ("deep.tif", Transfer::Srgb, SRGB),
        ("float.exr", Transfer::Srgb, SRGB),
        ("shallow.png", Transfer::Linear, [0.2, 0.4, 0.6]),
    ] {
        let options = ReadOptions { transfer, ..ReadOptions::default() };
        let photograph = Photograph::open(&folder.path().join(name), &options).unwrap();
        assert_eq!(photograph.info().transfer_used, transfer);
        assert_light(&photograph, want, 1e-7);
    }
}

#[test]
fn grey_pictures_have_one_channel_and_transparent_pixels_none() {
    let folder = tempfile::tempdir().unwrap();
    oiiotool(&folder, "--pattern constant:color=.4 4x4 1 -d uint16 -o grey.png");
    let grey = open(folder.path().join("grey.png")).unwrap();
    assert_eq!((grey.channels(), grey.info().format.as_str()), (1, "PNG, 16-bit, grey"));
    assert_light(&grey, [0.4; 3], 1e-15);
    image::RgbaImage::from_fn(4, 4, |x, _| image::Rgba([51, 102, 153, if x == 1 { 200 } else { 0 }]))
        .save(folder.path().join("alpha.png"))
        .unwrap();
    let alpha = open(folder.path().join("alpha.png")).unwrap();
    assert_eq!((alpha.channels(), alpha.pixel(0, 0)), (3, Pixel::NotFinite));
    assert_light(&alpha, SRGB, 1e-15);
}

#[test]
fn integers_are_clipped_from_the_white_level() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("levels.tif");
    image::ImageBuffer::from_fn(4, 1, |x, _| {
        image::Rgb([[100_u16, 1000, 1001, 65535][x as usize], 500, 500])
    })
    .save(&path)
    .unwrap();
    let options =
        ReadOptions { black_level: Some(200.0), white_level: Some(1001.0), ..ReadOptions::default() };
    let photograph = Photograph::open(&path, &options).unwrap();
    assert!((light(&photograph, 0, 0)[0] + 100.0 / 801.0).abs() < 1e-15);
    assert!((light(&photograph, 1, 0)[0] - 800.0 / 801.0).abs() < 1e-15);
    assert_eq!([2, 3].map(|x| photograph.pixel(x, 0)), [Pixel::Clipped; 2]);
    assert_eq!(open(&path).unwrap().pixel(3, 0), Pixel::Clipped);
}

// ---- hostile files ----

/// The message of a file that must be refused, which is one line and names the file.
pub(super) fn refusal(path: &Path) -> String {
    let error = open(path).unwrap_err();
    assert_eq!(error.exit_status(), 1, "{error}");
    let message = error.to_string();
    assert!(message.starts_with(&path.display().to_string()) && !message.contains('\n'), "{message}");
    message
}

pub(super) fn written(folder: &TempDir, name: &str, bytes: &[u8]) -> PathBuf {
    let path = folder.path().join(name);
    fs::write(&path, bytes).unwrap();
    path
}

#[test]
fn what_is_no_picture_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    assert!(refusal(&written(&folder, "empty.tif", b"")).ends_with("the file is empty; copy it again"));
    let text = refusal(&written(&folder, "text.tif", b"wavelength,reflectance\n400,0.1\n"));
    assert!(text.contains("not a PNG, TIFF, JPEG, OpenEXR or RAW picture; save it again"), "{text}");
    assert!(refusal(&written(&folder, "animation.png", b"GIF89a\x01\0\x01\0\0\0\0")).contains("not a PNG"));
    assert!(matches!(open(folder.path().join("missing.tif")), Err(Error::File { .. })));
    assert!(matches!(open(folder.path()), Err(Error::Picture { .. })));
}

/// One small picture of each format.
fn pictures(folder: &TempDir) -> Vec<(&'static str, Vec<u8>)> {
    ["p.png", "p.tif", "p.jpg", "p.exr"]
        .map(|name| {
            let compression = if name == "p.tif" { "--compression lzw" } else { "" };
            oiiotool(folder, &format!("{GRADIENT} --noise {compression} -o {name}"));
            (name, fs::read(folder.path().join(name)).unwrap())
        })
        .into()
}

#[test]
fn a_file_cut_short_anywhere_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes) in pictures(&folder) {
        for tenth in 1..10 {
            refusal(&written(&folder, name, &bytes[..bytes.len() * tenth / 10]));
        }
    }
}

/// The decoder takes zeros for what is missing before an end marker, and then grey.
#[test]
fn a_jpeg_cut_short_before_its_end_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    for (name, how) in [("one.jpg", ""), ("more.jpg", "--attrib:type=int jpeg:progressive 1")] {
        oiiotool(&folder, &format!("{GRADIENT} --noise {how} -o {name}"));
        let path = folder.path().join(name);
        open(&path).unwrap();
        let bytes = fs::read(path).unwrap();
        let scan = bytes.windows(2).position(|two| two == [0xff, 0xda]).unwrap();
        // 14 bytes of a scan's header
        let (data, rest) = (scan + 14, bytes.len() - 2 - scan - 14);
        for part in 0..20 {
            let cut = [&bytes[..data + rest * part / 20], &[0xff, 0xd9]].concat();
            let refused = refusal(&written(&folder, "cut.jpg", &cut));
            assert!(
                refused.ends_with("the JPEG data ends too early; copy the file again"),
                "{part}: {refused}"
            );
        }
        // another picture in place of the rest
        refusal(&written(&folder, "two.jpg", &[&bytes[..data + rest / 2], &bytes].concat()));
        open(written(&folder, "behind.jpg", &[&bytes[..], b"any bytes", &bytes].concat())).unwrap();
    }
}

/// A changed byte may spoil the picture but must not stop the program.
#[test]
fn changed_bytes_never_panic() {
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes) in pictures(&folder) {
        for k in 0..150 {
            let mut changed = bytes.clone();
            // the first bytes hold the header: change each of them, and others all over the file
            let at = if k < 100 { k } else { k * 7919 };
            changed[at % bytes.len()] ^= 1 << (k % 8);
            let _ = open(written(&folder, name, &changed)).map(|photograph| photograph.pixel(0, 0));
        }
    }
}

/// Overwrites what follows `mark`, `skip` bytes on.
fn overwrite(bytes: &mut [u8], mark: &[u8], skip: usize, new: &[u8]) {
    let at = bytes.windows(mark.len()).position(|window| window == mark).unwrap() + mark.len() + skip;
    bytes[at..at + new.len()].copy_from_slice(new);
}

/// Sets the size in a picture's header to 60000 x 60000 px.
fn inflate(name: &str, bytes: &mut [u8]) {
    match name {
        "p.png" => {
            overwrite(bytes, b"IHDR", 0, &[0, 0, 0xea, 0x60, 0, 0, 0xea, 0x60]);
            let check = crc32(&bytes[12..29]).to_be_bytes();
            overwrite(bytes, b"IHDR", 13, &check);
        }
        "p.tif" => {
            for tag in [b"\0\x01\x03\0\x01\0\0\0", b"\x01\x01\x03\0\x01\0\0\0"] {
                overwrite(bytes, tag, 0, &60000_u16.to_le_bytes());
            }
        }
        "p.jpg" => overwrite(bytes, b"\xff\xc0", 3, &[0xea, 0x60, 0xea, 0x60]),
        _ => {
            for window in [&b"dataWindow\0box2i\0"[..], b"displayWindow\0box2i\0"] {
                overwrite(bytes, window, 12, &[0x5f, 0xea, 0, 0, 0x5f, 0xea, 0, 0]);
            }
        }
    }
}

/// PNG specification, annex D.
pub(super) fn crc32(bytes: &[u8]) -> u32 {
    let step = |crc: u32, _| if crc & 1 == 1 { 0xedb8_8320 ^ (crc >> 1) } else { crc >> 1 };
    !bytes.iter().fold(!0, |crc, byte| (0..8).fold(crc ^ u32::from(*byte), step))
}

#[test]
fn a_header_that_claims_gigapixels_is_refused_at_once() {
    let folder = tempfile::tempdir().unwrap();
    for (name, mut bytes) in pictures(&folder) {
        inflate(name, &mut bytes);
        let message = refusal(&written(&folder, name, &bytes));
        // a TIFF contradicts itself before its size matters
        let problem = if name == "p.tif" {
            "inconsistent sizes"
        } else {
            "60000 x 60000 px would take more than 2 GiB"
        };
        assert!(message.contains(problem), "{message}");
    }
}

// ---- writing ----

#[test]
fn a_written_picture_is_whole_or_absent() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["a.exr", "a.tif", "a.png"] {
        let path = folder.path().join(name);
        fs::write(&path, "old").unwrap();
        assert!(write_linear(&path, 2, 2, &[f64::NAN; 12]).is_err());
        assert!(write_linear(&path, 2, 2, &[0.5; 11]).is_err());
        assert_eq!(fs::read(&path).unwrap(), b"old");
        write_linear(&path, 2, 2, &[0.2, 0.4, 0.6].repeat(4)).unwrap();
        assert_light(&open(&path).unwrap(), [0.2, 0.4, 0.6], 1e-7);
        oiiotool(&folder, &format!("--stats {name}"));
    }
    write_srgb_png(&folder.path().join("b.png"), 2, 2, &[0.2, 0.4, 0.6].repeat(4)).unwrap();
    assert_light(&open(folder.path().join("b.png")).unwrap(), SRGB, 1e-15);
    assert!(write_linear(&folder.path().join("a.gif"), 1, 1, &[0.5; 3]).is_err());
    assert!(matches!(
        write_srgb_png(Path::new("/no/such/folder/a.png"), 1, 1, &[0.5; 3]),
        Err(Error::File { .. })
    ));
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 4, "no temporary file stays behind");
}
