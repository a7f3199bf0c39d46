//! The camera's notes in EXIF: make, exposure, orientation.
//!
//! Measuring needs none of it except the orientation, so missing fields are omitted and broken ones become
//! notes.

use std::io::{self, Read, Seek, SeekFrom};

use exif::{Context, Exif, In, Reader, Tag, Value};

use super::exif_taken::taken;
use super::stated::{OTHER_COLOURS, OTHER_CURVE, Statement};
use crate::image::numbers::Transfer;
use crate::image::photograph::{CameraNotes, Orientation};

/// Tolerance within which EXIF's gamma equals a number.
const SAME_GAMMA: f64 = 5e-3;
/// Bytes of a large TIFF file that are searched for tags at the start, at the end and at the first directory.
const TAGS_BYTES: usize = 1 << 20;

/// A TIFF file's own EXIF block: the whole file, but for a large one only the places where tags are kept,
/// with the pixels in between left blank.
pub(super) fn tiff_tags(file: &mut (impl Read + Seek)) -> io::Result<Vec<u8>> {
    let mut block = vec![0; file.seek(SeekFrom::End(0))? as usize];
    read_part(file, &mut block, 0)?;
    let directory = match block.get(..8) {
        Some(&[b'I', _, _, _, a, b, c, d]) => u32::from_le_bytes([a, b, c, d]),
        Some(&[_, _, _, _, a, b, c, d]) => u32::from_be_bytes([a, b, c, d]),
        _ => 0,
    };
    read_part(file, &mut block, directory as usize)?;
    let end = block.len();
    read_part(file, &mut block, end.saturating_sub(TAGS_BYTES))?;
    Ok(block)
}

fn read_part(file: &mut (impl Read + Seek), block: &mut [u8], from: usize) -> io::Result<()> {
    let to = from.saturating_add(TAGS_BYTES).min(block.len());
    let Some(part) = block.get_mut(from..to) else { return Ok(()) };
    file.seek(SeekFrom::Start(from as u64))?;
    file.read_exact(part)
}

/// The contents of a block.
pub(super) struct Tags {
    pub camera: CameraNotes,
    /// Colour space and curve of the picture's numbers.
    pub stated: Vec<Statement>,
    /// Pixels per unit of length, across and down.
    pub density: Option<[f64; 2]>,
}

/// Reads an EXIF block, which has the layout of a TIFF file; a TIFF file is its own block, and its picture
/// may be on another `page` than the first.
pub(super) fn read(block: Option<Vec<u8>>, page: usize) -> Tags {
    let mut notes = Vec::new();
    let exif = block.and_then(|block| parse(block, &mut notes));
    let field =
        |tag| exif.as_ref().and_then(|exif| exif.get_field(tag, In::PRIMARY)).map(|field| &field.value);
    let of_page = |tag| exif.as_ref()?.get_field(tag, In(page as u16)).map(|field| &field.value);
    let camera = CameraNotes {
        make: field(Tag::Make).and_then(text),
        model: field(Tag::Model).and_then(text),
        exposure_s: field(Tag::ExposureTime).and_then(positive),
        f_number: field(Tag::FNumber).and_then(positive),
        focal_35mm: field(Tag::FocalLengthIn35mmFilm)
            .and_then(|value| value.get_uint(0))
            .filter(|focal_mm| *focal_mm > 0)
            .map(f64::from),
        iso: field(Tag::PhotographicSensitivity).and_then(|value| value.get_uint(0)),
        orientation: of_page(Tag::Orientation)
            .or_else(|| field(Tag::Orientation))
            .map_or(Orientation::UPRIGHT, |value| orientation(value, &mut notes)),
        xyz_to_camera: exif.as_ref().and_then(xyz_to_camera),
        taken: exif.as_ref().map(taken).unwrap_or_default(),
        notes,
    };
    let density = |tag| field(tag).and_then(positive);
    let density = density(Tag::XResolution).zip(density(Tag::YResolution)).map(<[f64; 2]>::from);
    Tags {
        camera,
        density,
        stated: exif.iter().flat_map(|exif| [colour_space(exif), gamma(exif)]).flatten().collect(),
    }
}

/// Statement of EXIF and DCF on a picture's colours; `uncalibrated` alone states nothing.
fn colour_space(exif: &Exif) -> Option<Statement> {
    const SRGB: u32 = 1;
    const ADOBE_RGB: u32 = 2;
    let field = |tag| exif.get_field(tag, In::PRIMARY).map(|field| &field.value);
    let space = field(Tag::ColorSpace).and_then(|value| value.get_uint(0));
    let is_optional = field(Tag::InteroperabilityIndex).and_then(text).as_deref() == Some("R03");
    let says = match space {
        Some(ADOBE_RGB) => Err(()),
        _ if is_optional => Err(()),
        Some(SRGB) => Ok(Transfer::Srgb),
        _ => return None,
    };
    Some(Statement { by: "EXIF", says: says.map_err(|()| format!("Adobe RGB, {OTHER_COLOURS}")) })
}

/// EXIF's statement on the exponent for display; 2.2 is also written for sRGB's curve.
fn gamma(exif: &Exif) -> Option<Statement> {
    let gamma = positive(&exif.get_field(Tag::Gamma, In::PRIMARY)?.value)?;
    let is = |number: f64| (gamma - number).abs() < SAME_GAMMA;
    let says = match () {
        () if is(1.0) => Ok(Transfer::Linear),
        () if is(2.2) => Ok(Transfer::Srgb),
        () => Err(format!("{gamma}, {OTHER_CURVE}")),
    };
    Some(Statement { by: "EXIF Gamma", says })
}

/// Changes the type of pointers to tag directories from IFD, as written by libtiff, to LONG: both have 4
/// bytes, and the parser knows only the latter.
fn directories_as_long(block: &mut [u8]) {
    const ENTRY_BYTES: usize = 12;
    const IFD: u16 = 13;
    const LONG: u16 = 4;
    let is_little = block.starts_with(b"II");
    let of_two =
        |bytes: [u8; 2]| if is_little { u16::from_le_bytes(bytes) } else { u16::from_be_bytes(bytes) };
    let of_four =
        |bytes: [u8; 4]| if is_little { u32::from_le_bytes(bytes) } else { u32::from_be_bytes(bytes) };
    let Some(&[a, b, c, d]) = block.get(4..8) else { return };
    let first = of_four([a, b, c, d]) as usize;
    let Some(&[a, b]) = block.get(first..first.saturating_add(2)) else { return };
    let entries = block[first + 2..].chunks_exact_mut(ENTRY_BYTES).take(of_two([a, b]).into());
    for kind in entries.filter_map(|entry| entry.get_mut(2..4)) {
        if of_two([kind[0], kind[1]]) == IFD {
            kind.copy_from_slice(&if is_little { LONG.to_le_bytes() } else { LONG.to_be_bytes() });
        }
    }
}

fn parse(mut block: Vec<u8>, notes: &mut Vec<String>) -> Option<Exif> {
    directories_as_long(&mut block);
    Reader::new()
        .continue_on_error(true)
        .read_raw(block)
        .or_else(|error| {
            error.distill_partial_result(|errors| {
                notes.extend(errors.iter().map(|error| format!("EXIF: {error}; the field is ignored")));
            })
        })
        .map_err(|error| notes.push(format!("EXIF: {error}; all of it is ignored")))
        .ok()
}

/// DNG's matrix for D65, which is the first or the second.
fn xyz_to_camera(exif: &Exif) -> Option<[[f64; 3]; 3]> {
    const D65: u32 = 21;
    let field = |number| exif.get_field(Tag(Context::Tiff, number), In::PRIMARY).map(|field| &field.value);
    let is_daylight = |number| field(number).and_then(|value| value.get_uint(0)) == Some(D65);
    let matrices = [(0xc622, 0xc65b), (0xc621, 0xc65a)];
    let (matrix, _) = matrices.into_iter().find(|(_, illuminant)| is_daylight(*illuminant))?;
    let Value::SRational(numbers) = field(matrix)? else { return None };
    let numbers: [f64; 9] =
        numbers.iter().map(exif::SRational::to_f64).collect::<Vec<_>>().try_into().ok()?;
    let finite = numbers.iter().all(|number| number.is_finite());
    finite.then(|| std::array::from_fn(|row| std::array::from_fn(|column| numbers[3 * row + column])))
}

fn orientation(value: &Value, notes: &mut Vec<String>) -> Orientation {
    value.get_uint(0).and_then(Orientation::from_exif).unwrap_or_else(|| {
        notes.push("EXIF: the orientation is not one of 1 to 8; the picture is taken as upright".to_owned());
        Orientation::UPRIGHT
    })
}

fn text(value: &Value) -> Option<String> {
    let Value::Ascii(lines) = value else { return None };
    let line = String::from_utf8_lossy(lines.first()?).trim().to_owned();
    (!line.is_empty()).then_some(line)
}

fn positive(value: &Value) -> Option<f64> {
    let Value::Rational(ratios) = value else { return None };
    ratios.first().map(exif::Rational::to_f64).filter(|ratio| ratio.is_finite() && *ratio > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A little-endian block with these entries: tag, type, count, value.
    fn block(entries: &[(u16, u16, u32, u32)]) -> Vec<u8> {
        let mut bytes = b"II*\0\x08\0\0\0".to_vec();
        bytes.extend((entries.len() as u16).to_le_bytes());
        for (tag, kind, count, value) in entries {
            bytes.extend(tag.to_le_bytes());
            bytes.extend(kind.to_le_bytes());
            bytes.extend(count.to_le_bytes());
            bytes.extend(value.to_le_bytes());
        }
        bytes.extend([0; 4]);
        bytes
    }

    #[test]
    fn no_exif_is_no_fault() {
        let camera = read(None, 0).camera;
        assert_eq!((camera.orientation, camera.notes), (Orientation::UPRIGHT, vec![]));
    }

    #[test]
    fn broken_exif_becomes_a_note() {
        for broken in [b"nonsense".to_vec(), b"II*\0".to_vec(), b"II*\0\xff\xff\xff\xff".to_vec()] {
            let camera = read(Some(broken), 0).camera;
            assert_eq!(camera.orientation, Orientation::UPRIGHT);
            assert!(camera.notes[0].ends_with("is ignored"), "{:?}", camera.notes);
        }
    }

    /// The directory may be anywhere, here between the pixels of a large file.
    #[test]
    fn tags_are_found_in_a_large_file() {
        let (size, directory) = (6 * TAGS_BYTES, 3 * TAGS_BYTES - 5);
        let small = block(&[(0x112, 3, 1, 6)]);
        let mut large = vec![0xff; size];
        large[..4].copy_from_slice(&small[..4]);
        large[4..8].copy_from_slice(&(directory as u32).to_le_bytes());
        large[directory..directory + small.len() - 8].copy_from_slice(&small[8..]);
        let camera = read(Some(tiff_tags(&mut io::Cursor::new(large)).unwrap()), 0).camera;
        assert_eq!((camera.orientation.exif(), camera.notes), (6, vec![]));
    }

    /// Libtiff writes the offset of EXIF's directory with type IFD.
    #[test]
    fn directories_are_found_by_either_type() {
        for kind in [4, 13] {
            let mut both = block(&[(0x8769, kind, 1, 26)]);
            both.extend(&block(&[(0x8827, 3, 1, 400)])[8..]);
            let camera = read(Some(both), 0).camera;
            assert_eq!((camera.iso, camera.notes), (Some(400), vec![]));
        }
    }

    #[test]
    fn good_fields_survive_a_bad_one() {
        // the make lies outside the block
        let (make, orientation) = ((0x10f, 2, 2000, 9000), (0x112, 3, 1, 6));
        let camera = read(Some(block(&[make, orientation])), 0).camera;
        assert_eq!((camera.make, camera.orientation.exif()), (None, 6));
        assert_eq!(camera.notes.len(), 1);
    }

    #[test]
    fn an_impossible_orientation_is_noted() {
        let camera = read(Some(block(&[(0x112, 3, 1, 9)])), 0).camera;
        assert_eq!(camera.orientation, Orientation::UPRIGHT);
        assert!(camera.notes[0].contains("orientation"));
    }
}
