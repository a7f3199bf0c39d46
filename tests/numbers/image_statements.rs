//! What picture files say of their own numbers: believed, or refused.

use std::fs;
use std::path::{Path, PathBuf};

use image::codecs::jpeg::JpegEncoder;
use image::codecs::png::PngEncoder;
use image::codecs::tiff::TiffEncoder;
use image::{ExtendedColorType, ImageEncoder};
use moxcms::{ColorProfile, ProfileClass, ToneReprCurve};
use tempfile::TempDir;
use vfold::image::{Photograph, ReadOptions, Transfer, write_linear};

use super::image_files::{SRGB, assert_light, crc32, light, oiiotool, open, refusal, written};

const LINEAR: [f64; 3] = [0.2, 0.4, 0.6];
const SIZE: (u32, u32) = (16, 9);

/// The picture all over in one colour, as bytes of 16 bits and of 8.
fn samples(bits: u8) -> Vec<u8> {
    let stored = |value: f64| match bits {
        8 => vec![(value * 255.0).round() as u8],
        _ => ((value * 65535.0).round() as u16).to_ne_bytes().to_vec(),
    };
    LINEAR.into_iter().flat_map(stored).collect::<Vec<_>>().repeat((SIZE.0 * SIZE.1) as usize)
}

/// A file that an encoder makes, with an ICC profile and an EXIF block.
fn encoded(folder: &TempDir, name: &str, profile: Option<&ColorProfile>, exif: Option<Vec<u8>>) -> PathBuf {
    fn encode(
        mut encoder: impl ImageEncoder,
        bits: u8,
        profile: Option<&ColorProfile>,
        exif: Option<Vec<u8>>,
    ) {
        profile.map_or(Ok(()), |profile| encoder.set_icc_profile(profile.encode().unwrap())).unwrap();
        exif.map_or(Ok(()), |exif| encoder.set_exif_metadata(exif)).unwrap();
        let colours = if bits == 8 { ExtendedColorType::Rgb8 } else { ExtendedColorType::Rgb16 };
        encoder.write_image(&samples(bits), SIZE.0, SIZE.1, colours).unwrap();
    }
    let path = folder.path().join(name);
    let file = fs::File::create(&path).unwrap();
    match path.extension().and_then(|ending| ending.to_str()) {
        Some("png") => encode(PngEncoder::new(file), 16, profile, exif),
        Some("tif") => encode(TiffEncoder::new(file), 16, profile, exif),
        _ => encode(JpegEncoder::new_with_quality(file, 100), 8, profile, exif),
    }
    path
}

/// A profile of sRGB's primaries and another curve.
fn profile(curve: ToneReprCurve) -> ColorProfile {
    let curve = Some(curve);
    let mut profile = ColorProfile::new_srgb();
    (profile.red_trc, profile.green_trc, profile.blue_trc) = (curve.clone(), curve.clone(), curve);
    profile.cicp = None;
    profile
}

#[test]
fn icc_profiles_are_believed_or_refused() {
    let folder = tempfile::tempdir().unwrap();
    let straight = profile(ToneReprCurve::Lut(vec![]));
    let changed = |change: fn(&mut ColorProfile)| {
        let mut other = straight.clone();
        change(&mut other);
        other
    };
    for (name, tolerance) in [("a.png", 1e-12), ("a.tif", 1e-12), ("a.jpg", 7e-3)] {
        let with = |profile: &ColorProfile| encoded(&folder, name, Some(profile), None);
        assert_light(&open(with(&ColorProfile::new_srgb())).unwrap(), SRGB, tolerance);
        assert_light(&open(with(&straight)).unwrap(), LINEAR, tolerance);
        for (other, says) in [
            (ColorProfile::new_adobe_rgb(), "curve"),
            (ColorProfile::new_display_p3(), "primaries"),
            (ColorProfile::new_pro_photo_rgb(), "curve"),
            (ColorProfile::new_aces_aces_2065_1_linear(), "primaries"),
            (profile(ToneReprCurve::Lut(vec![0x0233])), "curve"),
            (ColorProfile::new_gray_with_gamma(1.0), "which is for grey numbers"),
            (changed(|profile| profile.profile_class = ProfileClass::Abstract), "not that of a picture"),
            (changed(|profile| profile.cicp = ColorProfile::new_srgb().cicp), "code points contradict"),
        ] {
            let path = with(&other);
            let refused = refusal(&path);
            assert!(refused.contains("ICC profile") && refused.contains(says), "{refused}");
            // whoever made it knows better
            let linear = ReadOptions { transfer: Transfer::Linear, ..ReadOptions::default() };
            assert_light(&Photograph::open(&path, &linear).unwrap(), LINEAR, tolerance);
        }
    }
}

/// A chunk of a PNG file.
fn chunk(kind: &[u8; 4], data: &[u8]) -> Vec<u8> {
    let body = [&kind[..], data].concat();
    [&(data.len() as u32).to_be_bytes()[..], &body, &crc32(&body).to_be_bytes()].concat()
}

/// A PNG file with chunks before and behind its pixels.
fn png(folder: &TempDir, before: &[u8], behind: &[u8]) -> PathBuf {
    const HEADER: usize = 33;
    const END: usize = 12;
    let plain = folder.path().join("plain.png");
    write_linear(&plain, 4, 4, &LINEAR.repeat(16)).unwrap();
    let plain = fs::read(plain).unwrap();
    let (head, rest) = plain.split_at(HEADER);
    let (pixels, end) = rest.split_at(rest.len() - END);
    written(folder, "chunks.png", &[head, before, pixels, behind, end].concat())
}

/// Chunk by chunk; numbers are what PNG's specification, third edition, says of them.
#[test]
fn png_chunks_are_believed_or_refused() {
    let folder = tempfile::tempdir().unwrap();
    let with = |chunks: &[(&[u8; 4], &[u8])]| {
        let chunks: Vec<u8> = chunks.iter().flat_map(|(kind, data)| chunk(kind, data)).collect();
        png(&folder, &chunks, &[])
    };
    let gamma = |gamma: u32| gamma.to_be_bytes();
    let corners: Vec<u8> = [31270_u32, 32900, 64000, 33000, 30000, 60000, 15000, 6000]
        .into_iter()
        .flat_map(u32::to_be_bytes)
        .collect();
    let wide: Vec<u8> = [31270_u32, 32900, 70800, 29200, 17000, 79700, 13100, 4600]
        .into_iter()
        .flat_map(u32::to_be_bytes)
        .collect();
    for (chunks, want) in [
        (vec![(b"sRGB", &[0][..])], SRGB),
        (vec![(b"gAMA", &gamma(45455))], SRGB),
        (vec![(b"gAMA", &gamma(100_000))], LINEAR),
        (vec![(b"sRGB", &[1]), (b"gAMA", &gamma(45455)), (b"cHRM", &corners)], SRGB),
        (vec![(b"cHRM", &corners)], LINEAR),
        (vec![(b"cICP", &[1, 13, 0, 1])], SRGB),
        (vec![(b"cICP", &[1, 8, 0, 1])], LINEAR),
    ] {
        assert_light(&open(with(&chunks)).unwrap(), want, 1e-12);
    }
    for (chunks, says) in [
        (vec![(b"gAMA", &gamma(55556)[..])], "its chunk gAMA says 0.55556, whose curve"),
        (
            vec![(b"sRGB", &[0]), (b"gAMA", &gamma(100_000))],
            "its chunk sRGB says srgb, its chunk gAMA linear",
        ),
        (vec![(b"cHRM", &wide)], "its chunk cHRM says a colour space whose primaries"),
        (vec![(b"cICP", &[9, 16, 0, 1])], "its chunk cICP says 9/16/0, whose primaries"),
        (vec![(b"cICP", &[1, 1, 0, 1])], "1/1/0, whose curve"),
        (vec![(b"cICP", &[1, 13, 0, 0])], "video"),
    ] {
        let refused = refusal(&with(&chunks));
        assert!(refused.contains(says) && refused.contains("--transfer"), "{refused}");
    }
}

/// A statement that is damaged, or stands where the decoder of the pixels does not look, is one all the same.
#[test]
fn statements_are_found_wherever_they_are_and_whatever_they_are_like() {
    let folder = tempfile::tempdir().unwrap();
    let exif = chunk(b"eXIf", &exif(1, None));
    assert_light(&open(png(&folder, &exif, &[])).unwrap(), SRGB, 1e-12);
    assert_light(&open(png(&folder, &[], &exif)).unwrap(), SRGB, 1e-12);
    assert_light(&open(png(&folder, &[], &chunk(b"sRGB", &[0]))).unwrap(), SRGB, 1e-12);
    let damaged = |mut chunk: Vec<u8>| {
        *chunk.last_mut().unwrap() ^= 1;
        chunk
    };
    for (chunk, by) in [
        (damaged(exif), "chunk eXIf"),
        (damaged(chunk(b"sRGB", &[0])), "chunk sRGB"),
        (chunk(b"sRGB", &[0, 0]), "chunk sRGB"),
        (chunk(b"sRGB", &[4]), "chunk sRGB"),
        (chunk(b"gAMA", &[0, 0, 0x80, 0, 0]), "chunk gAMA"),
        (chunk(b"cHRM", &[0; 4]), "chunk cHRM"),
        (chunk(b"cICP", &[9, 16, 0]), "chunk cICP"),
        (damaged(chunk(b"cICP", &[9, 16, 0, 1])), "chunk cICP"),
        (chunk(b"iCCP", b"profile\0\0not compressed"), "ICC profile"),
    ] {
        for path in [png(&folder, &chunk, &[]), png(&folder, &[], &chunk)] {
            let refused = refusal(&path);
            assert!(refused.contains(&format!("its {by} says something that cannot be read; ")), "{refused}");
            let linear = ReadOptions { transfer: Transfer::Linear, ..ReadOptions::default() };
            assert_light(&Photograph::open(&path, &linear).unwrap(), LINEAR, 1e-12);
        }
    }
    // the first of two parts alone, or one that no number could have
    let jpeg = fs::read(encoded(&folder, "a.jpg", Some(&ColorProfile::new_srgb()), None)).unwrap();
    let at = jpeg.windows(12).position(|window| window == b"ICC_PROFILE\0").unwrap() + 12;
    for numbers in [[1, 2], [0, 1]] {
        let mut part = jpeg.clone();
        part[at..at + 2].copy_from_slice(&numbers);
        let refused = refusal(&written(&folder, "part.jpg", &part));
        assert!(refused.contains("its ICC profile says something that cannot be read"), "{refused}");
    }
}

/// A little-endian block of an EXIF directory with a colour space, and perhaps one of interoperability.
fn exif(colour_space: u8, interoperability: Option<&[u8; 4]>) -> Vec<u8> {
    let entry = |tag: u16, kind: u16, count: u32, value: [u8; 4]| {
        [&tag.to_le_bytes()[..], &kind.to_le_bytes(), &count.to_le_bytes(), &value].concat()
    };
    let mut directory = vec![entry(0xa001, 3, 1, [colour_space, 0, 0, 0])];
    directory.extend(interoperability.map(|_| entry(0xa005, 4, 1, [56, 0, 0, 0])));
    let mut bytes = b"II*\0\x08\0\0\0\x01\0".to_vec();
    bytes.extend(entry(0x8769, 4, 1, [26, 0, 0, 0]));
    bytes.extend([0; 4]);
    bytes.extend((directory.len() as u16).to_le_bytes());
    bytes.extend(directory.concat());
    bytes.extend([0; 4]);
    if let Some(name) = interoperability {
        bytes.extend([&[1, 0], &entry(1, 2, 4, *name)[..], &[0; 4]].concat());
    }
    bytes
}

#[test]
fn exif_colour_spaces_are_believed_or_refused() {
    let folder = tempfile::tempdir().unwrap();
    let with = |block| encoded(&folder, "a.png", None, Some(block));
    assert_light(&open(with(exif(1, None))).unwrap(), SRGB, 1e-12);
    assert_light(&open(with(exif(255, None))).unwrap(), LINEAR, 1e-12); // says nothing
    assert_light(&open(with(exif(1, Some(b"R98\0")))).unwrap(), SRGB, 1e-12);
    for block in [exif(2, None), exif(255, Some(b"R03\0"))] {
        let refused = refusal(&with(block));
        assert!(refused.contains("its EXIF says Adobe RGB"), "{refused}");
    }
    let straight = profile(ToneReprCurve::Lut(vec![]));
    let refused = refusal(&encoded(&folder, "a.png", Some(&straight), Some(exif(1, None))));
    assert!(refused.contains("its ICC profile says linear, its EXIF srgb"), "{refused}");
}

/// A depth implies a curve only for numbers of that depth.
#[test]
fn eight_bits_in_a_deeper_file_need_a_statement() {
    let folder = tempfile::tempdir().unwrap();
    let gradient = "--pattern fill:left=.2,.4,.6:right=.9,.1,.3 48x32 3";
    oiiotool(&folder, &format!("{gradient} -d uint8 -o eight.png"));
    let eight = open(folder.path().join("eight.png")).unwrap();
    for (name, how, numbers) in [
        ("a.tif", "-d uint16", "16-bit numbers"),
        ("half.exr", "-d half", "floats"),
        ("a.exr", "-d float", "floats"),
    ] {
        oiiotool(&folder, &format!("eight.png --attrib oiio:ColorSpace Linear {how} -o {name}"));
        let path = folder.path().join(name);
        let refused = refusal(&path);
        assert!(
            refused.contains(&format!("its {numbers} are those of 8 bits: it was converted")),
            "{refused}"
        );
        assert!(refused.contains("give the RAW file, or state with --transfer srgb or linear"), "{refused}");
        let srgb = ReadOptions { transfer: Transfer::Srgb, ..ReadOptions::default() };
        assert_light(&Photograph::open(&path, &srgb).unwrap(), light(&eight, 1, 1), 5e-4);
        oiiotool(&folder, &format!("{gradient} {how} -o {name}"));
        open(&path).unwrap();
    }
}

/// `oiiotool` writes what it says with `oiio:ColorSpace`, and needs no more to be believed.
#[test]
fn what_oiiotool_converts_is_what_it_was() {
    let folder = tempfile::tempdir().unwrap();
    oiiotool(
        &folder,
        "--pattern constant:color=.2,.4,.6 16x9 3 --colorconvert linear sRGB -d uint16 -o a.png",
    );
    assert_light(&open(folder.path().join("a.png")).unwrap(), LINEAR, 1e-4);
}

#[test]
fn openexr_says_whose_colours_it_holds() {
    let folder = tempfile::tempdir().unwrap();
    let made = |arguments: &str| {
        oiiotool(&folder, &format!("--pattern constant:color=.2,.4,.6 16x9 3 -d float {arguments} -o a.exr"));
        folder.path().join("a.exr")
    };
    let chromaticities = |numbers: &str| format!("--attrib:type=float[8] chromaticities {numbers}");
    let rec709 = chromaticities("0.64,0.33,0.3,0.6,0.15,0.06,0.3127,0.329");
    assert_light(&open(made(&rec709)).unwrap(), LINEAR, 1e-7);
    assert_light(&open(made("--attrib:type=float whiteLuminance 80")).unwrap(), LINEAR, 1e-7);
    let over = open(made("--fullsize 8x5+3+2")).unwrap();
    assert_eq!((over.width(), over.height(), light(&over, 7, 4)[1] > 0.39), (8, 5, true));
    for (arguments, says) in [
        (chromaticities("0.7347,0.2653,0,1,0.0001,-0.077,0.32168,0.33767").as_str(), "chromaticities"),
        ("--chnames diffuse.R,diffuse.G,diffuse.B", "in layers, such as 'diffuse."),
        ("--ch 0 --chnames Y", "luminance (Y)"),
        ("--chnames X,Y,Z", "CIE XYZ (channels X, Y and Z)"),
        ("--chnames u,v,w", "a picture of u, v, w"),
        ("--crop 8x5+3+2", "leaves part of its display window empty"),
    ] {
        let refused = refusal(&made(arguments));
        assert!(refused.contains(says), "{refused}");
    }
}

/// By the names of the Color Interop Forum.
#[test]
fn openexr_names_its_colour_space() {
    let folder = tempfile::tempdir().unwrap();
    let made = |id: &str, more: &str| {
        let colour = "--pattern constant:color=.2,.4,.6 16x9 3 -d float";
        oiiotool(&folder, &format!("{colour} --attrib:type=string colorInteropID {id} {more} -o a.exr"));
        folder.path().join("a.exr")
    };
    let rec709 = "--attrib:type=float[8] chromaticities 0.64,0.33,0.3,0.6,0.15,0.06,0.3127,0.329";
    for (id, want) in [
        ("lin_rec709_scene", LINEAR),
        ("srgb_rec709_scene", SRGB),
        ("srgb_rec709_display", SRGB),
        ("data", LINEAR),
        ("unknown", LINEAR),
    ] {
        for more in ["", rec709] {
            assert_light(&open(made(id, more)).unwrap(), want, 1e-7);
        }
    }
    for (id, why) in [
        ("g22_rec709_scene", "whose curve is neither linear nor sRGB's"),
        ("lin_ap1_scene", "whose primaries are not sRGB's"),
        ("srgb_p3d65_display", "whose primaries are not sRGB's"),
        ("house:own", "a colour space that is not known here"),
    ] {
        let refused = refusal(&made(id, ""));
        assert!(refused.contains(&format!("its attribute colorInteropID says {id}, {why}")), "{refused}");
    }
}

#[test]
fn openexr_that_is_not_read_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let grey = "--pattern constant:color=.2,.4,.6 16x9 3 -d float";
    oiiotool(&folder, &format!("{grey} --attrib oiio:subimagename left -o a.exr"));
    oiiotool(&folder, &format!("{grey} --attrib oiio:subimagename right -o b.exr"));
    oiiotool(&folder, "a.exr b.exr --siappend -o two.exr");
    let refused = refusal(&folder.path().join("two.exr"));
    assert!(
        refused.contains("several pictures in one file, its parts 0 'left', 1 'right'; save the intended"),
        "{refused}"
    );
    oiiotool(&folder, "--pattern constant:color=.2,.4,.6 16x9 3 -d uint32 -o whole.exr");
    let refused = refusal(&folder.path().join("whole.exr"));
    assert!(refused.contains("channel R holds whole numbers (UINT)"), "{refused}");
    let bytes = fs::read(folder.path().join("a.exr")).unwrap();
    let view = |name: &str| [&(name.len() as u32).to_le_bytes()[..], name.as_bytes()].concat();
    let views = [view("left"), view("right")].concat();
    let views = [&b"multiView\0stringvector\0"[..], &(views.len() as u32).to_le_bytes(), &views].concat();
    // attributes follow the mark and the version
    let spliced = [&bytes[..8], &views, &bytes[8..]].concat();
    let refused = refusal(&written(&folder, "views.exr", &spliced));
    assert!(refused.contains("a picture of several views: left, right; save the intended"), "{refused}");
    let mark = b"compression\0compression\0";
    let at = bytes.windows(mark.len()).position(|window| window == mark).unwrap() + mark.len() + 4;
    for (number, why) in [(10, "HTJ2K"), (11, "HTJ2K"), (12, "compression")] {
        let mut changed = bytes.clone();
        changed[at] = number;
        let refused = refusal(&written(&folder, "a.exr", &changed));
        assert!(refused.contains("this vfold does not read") && refused.contains(why), "{refused}");
        assert!(!refused.contains("damaged"), "{refused}");
    }
}

#[test]
fn gamma_of_exif_is_believed_or_refused() {
    let folder = tempfile::tempdir().unwrap();
    // a directory of EXIF with its Gamma, behind it
    let gamma = |tenths: u32| {
        let entry = |tag: u16, kind: u16, value: u32| {
            [&tag.to_le_bytes()[..], &kind.to_le_bytes(), &1_u32.to_le_bytes(), &value.to_le_bytes()].concat()
        };
        let mut bytes = b"II*\0\x08\0\0\0\x01\0".to_vec();
        bytes.extend(
            [entry(0x8769, 4, 26), vec![0; 4], vec![1, 0], entry(0xa500, 5, 44), vec![0; 4]].concat(),
        );
        bytes.extend([tenths.to_le_bytes(), 10_u32.to_le_bytes()].concat());
        encoded(&folder, "a.png", None, Some(bytes))
    };
    assert_light(&open(gamma(10)).unwrap(), LINEAR, 1e-12);
    assert_light(&open(gamma(22)).unwrap(), SRGB, 1e-12);
    let refused = refusal(&gamma(18));
    assert!(
        refused.contains("its EXIF Gamma says 1.8, whose curve is neither linear nor sRGB's"),
        "{refused}"
    );
}

#[test]
fn kinds_of_jpeg_that_are_not_read_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let jpeg = fs::read(encoded(&folder, "a.jpg", None, None)).unwrap();
    let frame = jpeg.windows(2).position(|two| two == [0xff, 0xc0]).unwrap();
    for (marker, bits, kind) in [
        (0xc1, 12, "JPEG of 12 bits"),
        (0xc3, 8, "lossless JPEG"),
        (0xc9, 8, "JPEG with arithmetic coding"),
        (0xf7, 8, "JPEG-LS"),
    ] {
        let mut other = jpeg.clone();
        (other[frame + 1], other[frame + 4]) = (marker, bits);
        let refused = refusal(&written(&folder, "other.jpg", &other));
        assert!(refused.contains(&format!("this vfold does not read {kind}; save it again")), "{refused}");
        assert!(!refused.contains("damaged"), "{refused}");
    }
}

/// Angles are measured in pixels.
#[test]
fn pixels_that_are_not_square_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let assert_shape = |path: &Path, by: &str, aspect: &str| {
        let refused = refusal(path);
        let says = format!("by its {by}, its pixels are {aspect} times as wide as high; resample it");
        assert!(refused.contains(&says), "{refused}");
    };
    let size = |across: u32, down: u32| {
        chunk(b"pHYs", &[&across.to_be_bytes()[..], &down.to_be_bytes(), &[0]].concat())
    };
    assert_shape(&png(&folder, &size(1000, 1067), &[]), "chunk pHYs", "1.067");
    for chunk in [size(2835, 2834), size(0, 5)] {
        open(png(&folder, &chunk, &[])).unwrap();
    }
    for (name, by) in [("a.tif", "XResolution and YResolution"), ("a.exr", "attribute pixelAspectRatio")] {
        let made = |aspect: &str| {
            let aspect = format!("--attrib:type=float PixelAspectRatio {aspect}");
            oiiotool(&folder, &format!("--pattern constant:color=.2,.4,.6 16x9 3 {aspect} -o {name}"));
            folder.path().join(name)
        };
        open(made("1")).unwrap();
        assert_shape(&made("2"), by, "2");
    }
    let mut jpeg = fs::read(encoded(&folder, "a.jpg", None, None)).unwrap();
    let at = jpeg.windows(5).position(|window| window == b"JFIF\0").unwrap() + 8;
    for (density, is_square) in [([0, 0, 0, 0], true), ([0, 72, 0, 72], true), ([0, 12, 0, 11], false)] {
        jpeg[at..at + 4].copy_from_slice(&density);
        let path = written(&folder, "density.jpg", &jpeg);
        if is_square { drop(open(path).unwrap()) } else { assert_shape(&path, "JFIF header", "0.917") }
    }
}

/// Of 32 bits and more, only floats; of four inks, none.
#[test]
fn numbers_that_are_no_light_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let mut inks = fs::read(encoded(&folder, "a.jpg", None, None)).unwrap();
    let frame = inks.windows(2).position(|two| two == [0xff, 0xc0]).unwrap();
    inks[frame + 9] = 4;
    assert!(refusal(&written(&folder, "inks.jpg", &inks)).contains("CMYK"));
    let wide = Path::new("wide.tif");
    let mut bytes = fs::read(encoded(&folder, "a.tif", None, None)).unwrap();
    let bits = bytes.windows(8).rposition(|entry| entry == [2, 1, 3, 0, 3, 0, 0, 0]).unwrap();
    let at = u32::from_le_bytes(bytes[bits + 8..bits + 12].try_into().unwrap()) as usize;
    bytes[at..at + 6].copy_from_slice(&[32, 0, 32, 0, 32, 0]);
    assert!(refusal(&written(&folder, wide.to_str().unwrap(), &bytes)).contains("integers of 32 bits"));
    let mut big = bytes;
    big[2] = 43;
    assert!(refusal(&written(&folder, "big.tif", &big)).contains("BigTIFF"));
}

#[test]
fn pictures_under_the_names_of_raw_files_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let jpeg = fs::read(encoded(&folder, "a.jpg", None, None)).unwrap();
    for name in ["a.nef", "A.NEF", "a.dng", "a.CR2"] {
        let refused = refusal(&written(&folder, name, &jpeg));
        assert!(refused.contains("like a camera's RAW file, but it is a JPEG picture"), "{refused}");
    }
    write_linear(&folder.path().join("a.exr"), 1, 1, &LINEAR).unwrap();
    fs::rename(folder.path().join("a.exr"), folder.path().join("a.nef")).unwrap();
    assert!(refusal(&folder.path().join("a.nef")).contains("but it is an OpenEXR picture"));
}
