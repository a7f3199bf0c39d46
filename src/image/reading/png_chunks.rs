//! Statements of a PNG file's chunks on its numbers, except an ICC profile.

use std::io::{BufRead, Seek};

use png::{CodingIndependentCodePoints, Decoder, Info, ScaledFloat, SourceChromaticities};

use super::primaries::are_srgb;
use super::stated::{OTHER_COLOURS, OTHER_CURVE, Statement};
use crate::image::numbers::Transfer;

/// The gAMA that writers use for sRGB, whose curve has no such number (PNG, third edition, 11.3.2.5).
const GAMMA_OF_SRGB: f64 = 0.45455;
/// Tolerance within which gAMA equals a number.
const SAME_GAMMA: f64 = 5e-4;

/// Statements of the chunks before the pixels; none for an unreadable file, which its decoder will refuse.
pub(super) fn statements(file: impl BufRead + Seek) -> Vec<Statement> {
    Decoder::new(file).read_info().map_or_else(|_| Vec::new(), |reader| of_info(reader.info()))
}

fn of_info(info: &Info) -> Vec<Statement> {
    let by = |by, says| Statement { by, says };
    let points = info.coding_independent_code_points.map(|points| by("chunk cICP", code_points(points)));
    let srgb = info.srgb.map(|_| by("chunk sRGB", Ok(Transfer::Srgb)));
    let gamma = info.gama_chunk.map(|gamma| by("chunk gAMA", self::gamma(gamma)));
    let others = info.chrm_chunk.filter(|colours| !are_srgb(&corners(colours)));
    let colours = others.map(|_| by("chunk cHRM", Err(format!("a colour space {OTHER_COLOURS}"))));
    [points, srgb, gamma, colours].into_iter().flatten().collect()
}

/// ITU-T H.273, tables 2 to 4.
fn code_points(points: CodingIndependentCodePoints) -> Result<Transfer, String> {
    const BT_709: u8 = 1;
    const UNSPECIFIED: u8 = 2;
    let CodingIndependentCodePoints { color_primaries, transfer_function, matrix_coefficients, .. } = points;
    let what = format!("{color_primaries}/{transfer_function}/{matrix_coefficients}");
    if matrix_coefficients != 0 || !points.is_video_full_range_image {
        return Err(format!("{what}, which is video"));
    }
    if !matches!(color_primaries, BT_709 | UNSPECIFIED) {
        return Err(format!("{what}, {OTHER_COLOURS}"));
    }
    match transfer_function {
        8 => Ok(Transfer::Linear),
        13 => Ok(Transfer::Srgb),
        _ => Err(format!("{what}, {OTHER_CURVE}")),
    }
}

fn gamma(gamma: ScaledFloat) -> Result<Transfer, String> {
    let gamma = f64::from(gamma.into_value());
    let is = |number: f64| (gamma - number).abs() < SAME_GAMMA;
    match () {
        () if is(1.0) => Ok(Transfer::Linear),
        () if is(GAMMA_OF_SRGB) => Ok(Transfer::Srgb),
        () => Err(format!("{gamma:.5}, {OTHER_CURVE}")),
    }
}

fn corners(colours: &SourceChromaticities) -> [[f64; 2]; 4] {
    let SourceChromaticities { red, green, blue, white } = colours;
    [red, green, blue, white].map(|(x, y)| [x, y].map(|part| part.into_value().into()))
}
