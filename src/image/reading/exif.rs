//! The camera's notes in EXIF: make, exposure, orientation.
//!
//! Measuring needs none of it except the orientation, so missing fields are omitted and broken ones become
//! notes.

use exif::{Context, Exif, In, Reader, Tag, Value};

use super::exif_taken::taken;
use super::stated::{OTHER_COLOURS, OTHER_CURVE, Statement};
use crate::image::numbers::Transfer;
use crate::image::photograph::{CameraNotes, Orientation};

/// Tolerance within which EXIF's gamma equals a number.
const SAME_GAMMA: f64 = 5e-3;

/// The contents of a block.
pub(super) struct Tags {
    pub camera: CameraNotes,
    /// Colour space and curve of the picture's numbers.
    pub stated: Vec<Statement>,
    /// Pixels per unit of length, across and down.
    pub density: Option<[f64; 2]>,
}

/// The fields of a page of a file, or else of its first.
struct Fields {
    exif: Exif,
    page: In,
}

impl Fields {
    fn get(&self, tag: Tag) -> Option<&Value> {
        let of = |page| self.exif.get_field(tag, page).map(|field| &field.value);
        of(self.page).or_else(|| of(In::PRIMARY))
    }
}

/// Reads a [`block`](super::exif_block::block). That of a TIFF file may have its picture on another `page`
/// than the first.
pub(super) fn read(block: Option<Vec<u8>>, page: usize) -> Tags {
    let mut notes = Vec::new();
    let exif = block.and_then(|block| parse(block, &mut notes));
    let fields = exif.map(|exif| Fields { exif, page: In(page as u16) });
    let field = |tag| fields.as_ref().and_then(|fields| fields.get(tag));
    let camera = CameraNotes {
        make: field(Tag::Make).and_then(text),
        model: field(Tag::Model).and_then(text),
        exposure_s: field(Tag::ExposureTime).and_then(positive),
        f_number: field(Tag::FNumber).and_then(positive),
        focal_mm: field(Tag::FocalLength).and_then(positive),
        focal_35mm: field(Tag::FocalLengthIn35mmFilm)
            .and_then(|value| value.get_uint(0))
            .filter(|focal_mm| *focal_mm > 0)
            .map(f64::from),
        iso: field(Tag::PhotographicSensitivity).and_then(|value| value.get_uint(0)),
        orientation: field(Tag::Orientation)
            .map_or(Orientation::UPRIGHT, |value| orientation(value, &mut notes)),
        xyz_to_camera: fields.as_ref().and_then(xyz_to_camera),
        taken: taken(field),
        notes,
    };
    let density = |tag| field(tag).and_then(positive);
    let density = density(Tag::XResolution).zip(density(Tag::YResolution)).map(<[f64; 2]>::from);
    Tags {
        camera,
        density,
        stated: fields.iter().flat_map(|fields| [colour_space(fields), gamma(fields)]).flatten().collect(),
    }
}

/// Statement of EXIF and DCF on a picture's colours; `uncalibrated` alone states nothing.
fn colour_space(fields: &Fields) -> Option<Statement> {
    const SRGB: u32 = 1;
    const ADOBE_RGB: u32 = 2;
    let space = fields.get(Tag::ColorSpace).and_then(|value| value.get_uint(0));
    let is_optional = fields.get(Tag::InteroperabilityIndex).and_then(text).as_deref() == Some("R03");
    let says = match space {
        Some(ADOBE_RGB) => Err(()),
        _ if is_optional => Err(()),
        Some(SRGB) => Ok(Transfer::Srgb),
        _ => return None,
    };
    Some(Statement { by: "EXIF", says: says.map_err(|()| format!("Adobe RGB, {OTHER_COLOURS}")) })
}

/// EXIF's statement on the exponent for display; 2.2 is also written for sRGB's curve.
fn gamma(fields: &Fields) -> Option<Statement> {
    let gamma = positive(fields.get(Tag::Gamma)?)?;
    let is = |number: f64| (gamma - number).abs() < SAME_GAMMA;
    let says = match () {
        () if is(1.0) => Ok(Transfer::Linear),
        () if is(2.2) => Ok(Transfer::Srgb),
        () => Err(format!("{gamma}, {OTHER_CURVE}")),
    };
    Some(Statement { by: "EXIF Gamma", says })
}

fn parse(block: Vec<u8>, notes: &mut Vec<String>) -> Option<Exif> {
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
fn xyz_to_camera(fields: &Fields) -> Option<[[f64; 3]; 3]> {
    const D65: u32 = 21;
    let field = |number| fields.get(Tag(Context::Tiff, number));
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
    use super::super::exif_block::block;
    use super::*;
    use std::io::Cursor;

    fn tags(bytes: Vec<u8>, page: usize) -> Tags {
        read(Some(block(&mut Cursor::new(bytes)).unwrap()), page)
    }

    /// A little-endian block with these entries: tag, type, count, value.
    fn directory(entries: &[(u16, u16, u32, u32)]) -> Vec<u8> {
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
            let camera = tags(broken, 0).camera;
            assert_eq!(camera.orientation, Orientation::UPRIGHT);
            assert!(camera.notes[0].ends_with("is ignored"), "{:?}", camera.notes);
        }
    }

    /// Directories and values may be anywhere, here between the pixels of a large file.
    #[test]
    fn tags_are_found_in_a_large_file() {
        const MIB: usize = 1 << 20;
        let (first, exif, make) = (3 * MIB - 5, 6 * MIB + 3, 9 * MIB);
        let mut large = vec![0xff; 12 * MIB];
        let mut put = |at: usize, bytes: &[u8]| large[at..at + bytes.len()].copy_from_slice(bytes);
        put(0, b"II*\0");
        put(4, &(first as u32).to_le_bytes());
        let entries = [(0x10f, 2, 6, make as u32), (0x112, 3, 1, 6), (0x8769, 4, 1, exif as u32)];
        put(first, &directory(&entries)[8..]);
        put(exif, &directory(&[(0x8827, 3, 1, 400)])[8..]);
        put(make, b"Canon\0");
        let camera = tags(large, 0).camera;
        assert_eq!((camera.orientation.exif(), camera.iso, camera.notes), (6, Some(400), vec![]));
        assert_eq!(camera.make.as_deref(), Some("Canon"));
    }

    /// EXIF may belong to the page that is read, or to the thumbnail before it.
    #[test]
    fn a_page_has_its_own_tags_and_those_of_the_first() {
        let mut pages = directory(&[(0x112, 3, 1, 6), (0x8769, 4, 1, 38)]);
        pages[34] = 56; // the next page
        pages.extend(&directory(&[(0x8827, 3, 1, 400)])[8..]);
        pages.extend(&directory(&[(0x8769, 13, 1, 74)])[8..]);
        pages.extend(&directory(&[(0x9209, 3, 1, 1)])[8..]);
        let [first, second] = [0, 1].map(|page| tags(pages.clone(), page).camera);
        assert_eq!((first.taken.other_light, first.iso), (None, Some(400)));
        assert_eq!(second.taken.other_light, Some(crate::image::OtherLight::Flash));
        assert_eq!((second.orientation.exif(), second.iso, second.notes), (6, Some(400), vec![]));
    }

    #[test]
    fn a_pointer_that_leads_nowhere_is_noted() {
        for nowhere in [0, 9999] {
            let camera = tags(directory(&[(0x112, 3, 1, 6), (0x8769, 4, 1, nowhere)]), 0).camera;
            assert_eq!(camera.orientation.exif(), 6);
            assert!(camera.notes.iter().any(|note| note.ends_with("is ignored")), "{:?}", camera.notes);
        }
    }

    /// Libtiff writes the offset of EXIF's directory with type IFD.
    #[test]
    fn directories_are_found_by_either_type() {
        for kind in [4, 13] {
            let mut both = directory(&[(0x8769, kind, 1, 26)]);
            both.extend(&directory(&[(0x8827, 3, 1, 400)])[8..]);
            let camera = tags(both, 0).camera;
            assert_eq!((camera.iso, camera.notes), (Some(400), vec![]));
        }
    }

    #[test]
    fn good_fields_survive_a_bad_one() {
        // the make lies outside the block
        let (make, orientation) = ((0x10f, 2, 2000, 9000), (0x112, 3, 1, 6));
        let camera = tags(directory(&[make, orientation]), 0).camera;
        assert_eq!((camera.make, camera.orientation.exif()), (None, 6));
        assert_eq!(camera.notes.len(), 1);
    }

    #[test]
    fn an_impossible_orientation_is_noted() {
        let camera = tags(directory(&[(0x112, 3, 1, 9)]), 0).camera;
        assert_eq!(camera.orientation, Orientation::UPRIGHT);
        assert!(camera.notes[0].contains("orientation"));
    }
}
