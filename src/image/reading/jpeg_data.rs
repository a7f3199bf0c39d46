//! Whether the data of a JPEG reach the end of its picture, although an end marker follows them.
//!
//! Where data are missing, the decoder takes zeros for them, and then grey. Behind the last pixel, it ignores
//! whatever stands before the marker. So bytes put there change the picture only if data are missing.

use std::collections::BTreeMap;
use std::io::Cursor;

use image::DynamicImage;
use image::codecs::jpeg::JpegDecoder;

use super::jpeg::Jpeg;

/// Bytes without a marker, and with few equal bits in a row: codes of many are in no table.
const FILLER: [u8; 4] = [0x5a, 0x93, 0x2d, 0xb6];
/// Repetitions, to fill some blocks of pixels.
const FILLER_COUNT: usize = 256;

/// Whether all of this picture was decoded from the file's data.
pub(super) fn are_whole(bytes: &[u8], picture: &DynamicImage) -> bool {
    let jpeg = Jpeg(bytes);
    let Some((data, rest)) = jpeg.end().and_then(|end| bytes.split_at_checked(end)) else { return false };
    if !has_all_scans(&jpeg) {
        return false;
    }
    let filled = [data, &FILLER.repeat(FILLER_COUNT), rest].concat();
    let filled = JpegDecoder::new(Cursor::new(filled)).and_then(DynamicImage::from_decoder);
    filled.is_ok_and(|filled| filled == *picture)
}

/// Whether its scans contain the last bit of all frequencies of all components.
fn has_all_scans(jpeg: &Jpeg) -> bool {
    let mut found: BTreeMap<u8, u64> = jpeg.component_names().into_iter().map(|name| (name, 0)).collect();
    for scan in jpeg.scans() {
        for name in scan.components {
            found.entry(name).and_modify(|found| *found |= scan.frequencies);
        }
    }
    found.values().all(|found| *found == u64::MAX)
}
