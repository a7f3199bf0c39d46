//! Tags of TIFF directories, types of their values, and limits.
//!
//! Those that DNG alone has are defined where they are read.

pub const NEW_SUBFILE_TYPE: u16 = 254;
pub const WIDTH: u16 = 256;
pub const HEIGHT: u16 = 257;
pub const BITS_PER_SAMPLE: u16 = 258;
pub const COMPRESSION: u16 = 259;
pub const PHOTOMETRIC: u16 = 262;
pub const FILL_ORDER: u16 = 266;
pub const STRIP_OFFSETS: u16 = 273;
pub const SAMPLES_PER_PIXEL: u16 = 277;
pub const ROWS_PER_STRIP: u16 = 278;
pub const STRIP_BYTE_COUNTS: u16 = 279;
pub const X_RESOLUTION: u16 = 282;
pub const Y_RESOLUTION: u16 = 283;
pub const PLANAR_CONFIGURATION: u16 = 284;
pub const TRANSFER_FUNCTION: u16 = 301;
pub const PREDICTOR: u16 = 317;
pub const WHITE_POINT: u16 = 318;
pub const PRIMARIES: u16 = 319;
pub const TILE_WIDTH: u16 = 322;
pub const TILE_LENGTH: u16 = 323;
pub const TILE_OFFSETS: u16 = 324;
pub const TILE_BYTE_COUNTS: u16 = 325;
pub const SUB_DIRECTORIES: u16 = 330;
pub const EXTRA_SAMPLES: u16 = 338;
pub const SAMPLE_FORMAT: u16 = 339;
pub const JPEG_TABLES: u16 = 347;
pub const REFERENCE_BLACK_WHITE: u16 = 532;
pub const PROFILE: u16 = 34675;
pub const DNG_VERSION: u16 = 50706;
pub const BLACK_LEVEL: u16 = 50714;
pub const WHITE_LEVEL: u16 = 50717;

/// Types of values.
pub const BYTE: u16 = 1;
pub const SHORT: u16 = 3;
pub const LONG: u16 = 4;
pub const RATIONAL: u16 = 5;
pub const UNDEFINED: u16 = 7;
pub const FLOAT: u16 = 11;
pub const DOUBLE: u16 = 12;

/// Bytes per entry of a directory.
pub const ENTRY_BYTES: usize = 12;
/// More directories than cameras or photographs have; a chain of them may be circular.
pub const DIRECTORIES_MAX: usize = 64;

/// Bytes per value of a type; 1 for an unknown type.
pub fn value_bytes(kind: u16) -> u64 {
    /// By type, from 1 on.
    const SIZES: [u64; 13] = [1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8, 4];
    *SIZES.get(usize::from(kind).wrapping_sub(1)).unwrap_or(&1)
}
