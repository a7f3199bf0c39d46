//! From a picture file to a photograph: formats, EXIF, the RAW files of cameras.

mod alpha;
mod code_points;
mod decode;
mod eight_bits;
mod exif;
mod exif_block;
mod exif_taken;
mod icc;
mod jpeg;
mod jpeg_data;
mod levels;
mod open;
mod openexr;
mod openexr_pixels;
mod picture_file;
mod pixel_shape;
mod png_chunks;
mod primaries;
#[cfg_attr(not(feature = "raw"), path = "no_raw.rs")]
mod raw;
mod refused;
mod stated;
mod taken;
mod tiff;

pub use picture_file::PictureFile;
