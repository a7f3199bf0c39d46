//! What the header of an OpenEXR file says: whose colours it holds, or why it holds none that can be read.

use std::io::{Read, Seek};

use exr::meta::MetaData;
use exr::meta::header::Header;

use super::primaries::are_srgb;
use super::stated::{OTHER_COLOURS, Statement};
use crate::image::numbers::Transfer;

/// What is to be known before the pixels are decoded.
pub(super) enum Kind {
    /// A flat picture in red, green and blue, and what it says of them.
    Colours(Vec<Statement>),
    /// Something else, which needs something to be done.
    Other { is: String, remedy: &'static str },
}

/// The kind of a file whose header can be read.
pub(super) fn kind(file: impl Read + Seek) -> Option<Kind> {
    let MetaData { headers, .. } = MetaData::read_from_buffered(file, false).ok()?;
    let Some(header) = headers.iter().find(|header| is_in_colour(header)) else {
        let (is, remedy) = other(&headers);
        return Some(Kind::Other { is, remedy });
    };
    if !is_filled(header) {
        let is = "a picture whose data window leaves part of its display window empty".to_owned();
        let remedy = "make its display window that of its pixels, as `oiiotool --fullpixels` does";
        return Some(Kind::Other { is, remedy });
    }
    Some(Kind::Colours(colours(header).into_iter().collect()))
}

/// Whether it is a flat picture in red, green and blue.
pub(super) fn is_in_colour(header: &Header) -> bool {
    !header.deep && has(header, ["R", "G", "B"])
}

fn has<const N: usize>(header: &Header, names: [&str; N]) -> bool {
    let names_in = |wanted: &str| header.channels.list.iter().any(|channel| channel.name.eq(wanted));
    names.into_iter().all(names_in)
}

/// What there is in the place of colours.
fn other(headers: &[Header]) -> (String, &'static str) {
    let is_deep = headers.iter().any(|header| header.deep);
    let names =
        || headers.iter().flat_map(|header| &header.channels.list).map(|channel| channel.name.to_string());
    if is_deep {
        return ("a deep picture, of many samples a pixel".to_owned(), "flatten it");
    }
    if let Some(layered) = names().find(|name| name.contains('.')) {
        let is = format!("a picture in layers, such as '{layered}', without R, G and B of its own");
        return (is, "save the layer that is meant by itself, as R, G and B");
    }
    if headers.iter().any(|header| has(header, ["Y"])) {
        return ("a picture of luminance (Y), not of colours".to_owned(), "save it as R, G and B");
    }
    (format!("a picture of {}", names().collect::<Vec<_>>().join(", ")), "save it as R, G and B")
}

/// Whether there are pixels all over the window that is shown: decoders make the rest black.
fn is_filled(header: &Header) -> bool {
    let (shown, data) = (header.shared_attributes.display_window, header.own_attributes.layer_position);
    let from = shown.position - data;
    let end = |from: i32, size: usize| i64::from(from) + size as i64;
    from.x() >= 0
        && from.y() >= 0
        && end(from.x(), shown.size.x()) <= header.layer_size.x() as i64
        && end(from.y(), shown.size.y()) <= header.layer_size.y() as i64
}

/// `whiteLuminance` says how bright 1 was, which no measurement here depends on.
fn colours(header: &Header) -> Option<Statement> {
    let says = header.shared_attributes.chromaticities?;
    let corners =
        [says.red, says.green, says.blue, says.white].map(|corner| [corner.x().into(), corner.y().into()]);
    let of_space = || format!("a red at {}, {}, a colour space {OTHER_COLOURS}", says.red.x(), says.red.y());
    let says = if are_srgb(&corners) { Ok(Transfer::Linear) } else { Err(of_space()) };
    Some(Statement { by: "attribute chromaticities", says })
}
