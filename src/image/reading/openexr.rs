//! The header of an OpenEXR file: its colour space, or why it contains no readable colours.

use exr::compression::Compression;
use exr::meta::attribute::{AttributeValue, SampleType};
use exr::meta::header::Header;

use super::picture_file::PictureFile;
use super::pixel_shape::{self, RESAMPLE};
use super::primaries::are_srgb;
use super::stated::{OTHER_COLOURS, OTHER_CURVE, Statement};
use crate::image::numbers::Transfer;

/// Contents of a file, known before the pixels are decoded.
pub(super) enum Kind {
    /// A flat picture in red, green and blue, and its statements on them.
    Colours(Vec<Statement>),
    /// Something else, and what to do.
    Other { is: String, remedy: &'static str },
}

/// The contents of a file with a readable header.
pub(super) fn kind(file: &mut PictureFile) -> Option<Kind> {
    let file = exr::block::read(file, false).ok()?;
    let headers = file.headers();
    let in_colour: Vec<_> = headers.iter().filter(|header| is_in_colour(header)).collect();
    let (is, remedy) = match in_colour[..] {
        [] => other(headers),
        [header] => match not_read(header) {
            Some(why) => why,
            None => return Some(Kind::Colours(statements(header))),
        },
        _ => (several(headers), "save the intended part alone, with `oiiotool --subimage N`"),
    };
    Some(Kind::Other { is, remedy })
}

const OTHER_COMPRESSION: &str = "save it with another compression, such as ZIP";

/// Why a picture in red, green and blue cannot be read nevertheless, and what to do.
fn not_read(header: &Header) -> Option<(String, &'static str)> {
    if let Compression::HTJ2K32 | Compression::HTJ2K256 = header.compression {
        let is = "this vfold does not read OpenEXR compressed by HTJ2K".to_owned();
        return Some((is, OTHER_COMPRESSION));
    }
    let is_whole = |name: &str| {
        header
            .channels
            .list
            .iter()
            .any(|channel| channel.name.eq(name) && channel.sample_type == SampleType::U32)
    };
    if let Some(name) = ["R", "G", "B"].into_iter().find(|name| is_whole(name)) {
        let is = format!("its channel {name} holds whole numbers (UINT), for which white is undefined");
        return Some((is, "save it as half or float"));
    }
    if let [first, others @ ..] = &views(header)[..]
        && !others.is_empty()
    {
        let is = format!("a picture of several views: {first}, {}", others.join(", "));
        return Some((is, "save the intended view alone, as R, G and B"));
    }
    let aspect = header.shared_attributes.pixel_aspect;
    if let Some(is) = pixel_shape::objection("attribute pixelAspectRatio", aspect.into()) {
        return Some((is, RESAMPLE));
    }
    if !is_filled(header) {
        let is = "a picture whose data window leaves part of its display window empty".to_owned();
        return Some((is, "set its display window to its pixels, with `oiiotool --fullpixels`"));
    }
    None
}

/// The eyes or cameras whose pictures one part contains.
fn views(header: &Header) -> Vec<String> {
    header.own_attributes.multi_view_names.iter().flatten().map(ToString::to_string).collect()
}

/// Message that several parts are in colour, with their names or numbers.
fn several(headers: &[Header]) -> String {
    let in_colour = headers.iter().enumerate().filter(|(_, header)| is_in_colour(header));
    let names = in_colour.map(|(n, header)| match &header.own_attributes.layer_name {
        Some(name) => format!("{n} '{name}'"),
        None => n.to_string(),
    });
    format!("several pictures in one file, its parts {}", names.collect::<Vec<_>>().join(", "))
}

/// Whether it is a flat picture in red, green and blue.
pub(super) fn is_in_colour(header: &Header) -> bool {
    !header.deep && has(header, ["R", "G", "B"])
}

fn has<const N: usize>(header: &Header, names: [&str; N]) -> bool {
    let names_in = |wanted: &str| header.channels.list.iter().any(|channel| channel.name.eq(wanted));
    names.into_iter().all(names_in)
}

/// What the file contains in place of colours.
fn other(headers: &[Header]) -> (String, &'static str) {
    let is_deep = headers.iter().any(|header| header.deep);
    let names =
        || headers.iter().flat_map(|header| &header.channels.list).map(|channel| channel.name.to_string());
    if is_deep {
        return ("a deep picture, with many samples per pixel".to_owned(), "flatten it");
    }
    if let Some(layered) = names().find(|name| name.contains('.')) {
        let is = format!("a picture in layers, such as '{layered}', without R, G and B of its own");
        return (is, "save the intended layer alone, as R, G and B");
    }
    let has_any = |wanted: [&str; 3]| headers.iter().any(|header| has(header, wanted));
    if has_any(["X", "Y", "Z"]) {
        let is = "a picture of CIE XYZ (channels X, Y and Z), not of a camera's colours";
        return (is.to_owned(), "give the camera's own picture, as R, G and B");
    }
    if has_any(["Y", "RY", "BY"]) {
        let is = "a picture of luminance and chroma (channels Y, RY and BY), whose chroma has less detail";
        return (is.to_owned(), "give the original, as R, G and B");
    }
    if headers.iter().any(|header| has(header, ["Y"])) {
        return ("a picture of luminance (Y), not of colours".to_owned(), "save it as R, G and B");
    }
    (format!("a picture of {}", names().collect::<Vec<_>>().join(", ")), "save it as R, G and B")
}

/// Whether pixels fill the display window: decoders make the rest black.
fn is_filled(header: &Header) -> bool {
    let (shown, data) = (header.shared_attributes.display_window, header.own_attributes.layer_position);
    let from = shown.position - data;
    let end = |from: i32, size: usize| i64::from(from) + size as i64;
    from.x() >= 0
        && from.y() >= 0
        && end(from.x(), shown.size.x()) <= header.layer_size.x() as i64
        && end(from.y(), shown.size.y()) <= header.layer_size.y() as i64
}

/// A header's statements on its numbers. Chromaticities alone imply linear light.
fn statements(header: &Header) -> Vec<Statement> {
    let (interop, colours) = (interop(header), colours(header));
    let says_curve = interop.is_some();
    let colours = colours.filter(|colours| !says_curve || colours.says.is_err());
    [interop, colours].into_iter().flatten().collect()
}

/// `whiteLuminance` states how bright 1 was, on which no measurement depends.
fn colours(header: &Header) -> Option<Statement> {
    let says = header.shared_attributes.chromaticities?;
    let corners =
        [says.red, says.green, says.blue, says.white].map(|corner| [corner.x().into(), corner.y().into()]);
    let of_space = || format!("a red at {}, {}, a colour space {OTHER_COLOURS}", says.red.x(), says.red.y());
    let says = if are_srgb(&corners) { Ok(Transfer::Linear) } else { Err(of_space()) };
    Some(Statement { by: "attribute chromaticities", says })
}

/// The colour space by name: `lin_rec709_scene` is linear, with the primaries of Rec. 709, which are sRGB's.
///
/// # Source
/// Color Interop Forum, "Color Space Encodings for Texture Assets and CG Rendering" (2025), as in OpenEXR
/// 3.4.
fn interop(header: &Header) -> Option<Statement> {
    let attributes = header.own_attributes.other.iter().chain(&header.shared_attributes.other);
    let text = attributes.into_iter().find_map(|(name, value)| match value {
        AttributeValue::Text(text) if name.eq("colorInteropID") => Some(text.to_string()),
        _ => None,
    })?;
    let id = text.trim().to_ascii_lowercase();
    if matches!(id.as_str(), "" | "data" | "unknown" | "raw") {
        return None;
    }
    let says = match id.split('_').collect::<Vec<_>>()[..] {
        ["lin", "rec709", _] => Ok(Transfer::Linear),
        ["srgb", "rec709", _] => Ok(Transfer::Srgb),
        [_, "rec709", _] => Err(format!("{text}, {OTHER_CURVE}")),
        [_, _, "scene" | "display"] => Err(format!("{text}, {OTHER_COLOURS}")),
        _ => Err(format!("{text}, a colour space that is not known here")),
    };
    Some(Statement { by: "attribute colorInteropID", says })
}
