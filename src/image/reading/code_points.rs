//! Colours and curve as the code points of video: ITU-T H.273, tables 2 to 4.

use super::stated::{OTHER_COLOURS, OTHER_CURVE};
use crate::image::numbers::Transfer;

/// The curve of colour primaries, transfer function and matrix, which PNG and ICC profiles contain.
pub(super) fn transfer(points: [u8; 3], is_full_range: bool) -> Result<Transfer, String> {
    const BT_709: u8 = 1;
    const UNSPECIFIED: u8 = 2;
    let [primaries, transfer, matrix] = points;
    let what = format!("{primaries}/{transfer}/{matrix}");
    if matrix != 0 || !is_full_range {
        return Err(format!("{what}, which is video"));
    }
    if !matches!(primaries, BT_709 | UNSPECIFIED) {
        return Err(format!("{what}, {OTHER_COLOURS}"));
    }
    match transfer {
        8 => Ok(Transfer::Linear),
        13 => Ok(Transfer::Srgb),
        _ => Err(format!("{what}, {OTHER_CURVE}")),
    }
}
