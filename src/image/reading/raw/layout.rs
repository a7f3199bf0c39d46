//! The layout of a DNG's numbers in the file, and the directory shown to the decoder.
//!
//! # Source
//! Adobe, *Digital Negative Specification* 1.7, chapters 2 and 4; *TIFF* 6.0.

use std::path::Path;

use rawler::imgop::Dim2;

use super::refused::{check_size, damaged, unread};
use super::tiff_directories::{Directory, Tiff};
use crate::Result;
use crate::error::counted;
use crate::image::reading::jpeg::Jpeg;
use crate::image::reading::tiff::tags;
use crate::image::reading::tiff::written::{long, written};

/// Offsets and lengths of strips.
const STRIPS: [u16; 2] = [tags::STRIP_OFFSETS, tags::STRIP_BYTE_COUNTS];
/// Width and height of tiles.
const TILE_SIZE: [u16; 2] = [tags::TILE_WIDTH, tags::TILE_LENGTH];
/// Offsets and lengths of tiles.
const TILES: [u16; 2] = [tags::TILE_OFFSETS, tags::TILE_BYTE_COUNTS];
const FILTERS_LAYOUT: u16 = 50711;
const SUB_TILE: u16 = 50974;
/// Interleaving factors of rows and columns.
const INTERLEAVE: [u16; 2] = [50975, 52547];
const JXL_DISTANCE: u16 = 52553;

/// Tags of the first directory shown to the decoder: make, model, orientation, directories of EXIF and GPS,
/// version and colours.
const OF_CAMERA: [u16; 10] = [271, 272, 274, 34665, 34853, 50706, 50721, 50722, 50778, 50779];

/// Photometric interpretation shown to the decoder, which need not know the colours.
const LINEAR: usize = 34892;

const UNCOMPRESSED: usize = 1;
const LOSSLESS_JPEG: usize = 7;
const DEFLATE: usize = 8;
const LOSSY_JPEG: usize = 34892;
const JPEG_XL: usize = 52546;

/// Predictors of floats: bytes by significance, less that of the sample one, two or four before.
const FLOAT_PREDICTORS: [usize; 3] = [3, 34894, 34895];

/// The offset of the first directory and the bytes appended to the file, as shown to the decoder.
pub(super) struct Shown {
    first: [u8; 4],
    added: Vec<u8>,
}

impl Shown {
    /// Modifies a file as the decoder shall see it.
    pub fn to(&self, file: &mut Vec<u8>) {
        file[4..8].copy_from_slice(&self.first);
        // do not double the memory of a file of hundreds of megabytes
        file.reserve_exact(self.added.len());
        file.extend(&self.added);
    }
}

/// The layout of the numbers in the file.
pub(super) struct Layout {
    pub size: Dim2,
    pub samples: usize,
    pub bits: usize,
    pub is_float: bool,
    compression: usize,
    predictor: usize,
    interleave: [usize; 2],
    segments: Segments,
}

/// The strips or tiles of a picture.
struct Segments {
    are_tiles: bool,
    size: Dim2,
    offsets: Vec<usize>,
    lengths: Vec<usize>,
}

impl Layout {
    /// # Errors
    /// [`Error::Picture`] if the decoder does not unpack this layout correctly, or the file is cut short.
    pub fn read(path: &Path, tiff: Tiff, directory: &Directory) -> Result<Self> {
        let number = |tag, default: usize| directory.number(tag).map_or(default, |number| number as usize);
        let size = Dim2::new(number(tags::WIDTH, 0), number(tags::HEIGHT, 0));
        let samples = number(tags::SAMPLES_PER_PIXEL, 1);
        check_size(path, size, samples)?;
        let all_bits = directory.numbers(tags::BITS_PER_SAMPLE).unwrap_or_else(|| vec![1.0]);
        let formats = directory.numbers(tags::SAMPLE_FORMAT).unwrap_or_else(|| vec![1.0]);
        let differ = |numbers: &[f64]| numbers.windows(2).any(|pair| pair[0] as usize != pair[1] as usize);
        if differ(&all_bits) || differ(&formats) {
            return Err(unread(path, "whose samples differ in their bits or format"));
        }
        let layout = Self {
            size,
            samples,
            bits: all_bits[0] as usize,
            is_float: formats[0] as usize == 3,
            compression: number(tags::COMPRESSION, UNCOMPRESSED),
            predictor: number(tags::PREDICTOR, 1),
            interleave: INTERLEAVE.map(|tag| number(tag, 1)),
            segments: Segments::read(path, directory, size, samples)?,
        };
        let sub_tile = directory.numbers(SUB_TILE).unwrap_or_default();
        let planar = samples > 1 && number(tags::PLANAR_CONFIGURATION, 1) != 1;
        let oddity = if !layout.is_float && formats[0] as usize != 1 {
            Some("of signed numbers")
        } else if planar {
            Some("whose colours are stored one after another (PlanarConfiguration 2)")
        } else if number(tags::FILL_ORDER, 1) != 1 {
            Some("whose bits are stored in reversed order (FillOrder 2)")
        } else if number(FILTERS_LAYOUT, 1) != 1 {
            Some("whose colour filters stand in staggered rows or columns (CFALayout above 1)")
        } else if sub_tile.iter().any(|size| *size as usize != 1) {
            Some("whose numbers are stored in blocks (SubTileBlockSize)")
        } else if !layout.is_deinterleaved() {
            Some(
                "interleaved other than by 2 rows and columns of one integer a pixel, \
                 an even number each",
            )
        } else {
            None
        };
        if let Some(what) = oddity {
            return Err(unread(path, what));
        }
        layout.check_compression(path, tiff, directory)?;
        Ok(layout)
    }

    /// Whether the decoder deinterleaves rows and columns correctly. It does so by halves of the numbers, and
    /// not for floats.
    fn is_deinterleaved(&self) -> bool {
        let Dim2 { w, h } = self.size;
        match self.interleave {
            [1, 1] => true,
            [2, 2] => self.samples == 1 && !self.is_float && w.is_multiple_of(2) && h.is_multiple_of(2),
            _ => false,
        }
    }

    /// # Errors
    /// [`Error::Picture`] if the decoder would fail, or unpack wrong numbers.
    fn check_compression(&self, path: &Path, tiff: Tiff, directory: &Directory) -> Result<()> {
        let Self { bits, is_float, segments, .. } = self;
        let row_bits = self.row_bits();
        let is_read = match self.compression {
            UNCOMPRESSED if *is_float => [16, 24, 32].contains(bits),
            UNCOMPRESSED => (1..=16).contains(bits) && row_bits.is_multiple_of(8),
            LOSSLESS_JPEG => !is_float,
            DEFLATE => *is_float && FLOAT_PREDICTORS.contains(&self.predictor) && [16, 24, 32].contains(bits),
            JPEG_XL if directory.number(JXL_DISTANCE).is_none_or(|distance| distance.abs() > 0.0) => {
                return Err(unread(path, "compressed as lossy JPEG XL"));
            }
            JPEG_XL => !is_float && [8, 16].contains(bits),
            LOSSY_JPEG => return Err(unread(path, "compressed as lossy JPEG")),
            _ => false,
        };
        if !is_read {
            let kind = if *is_float { "floats" } else { "integers" };
            let what = format!(
                "of {kind} of {}, compression {}, predictor {}",
                counted(bits, "bit"),
                self.compression,
                self.predictor
            );
            return Err(unread(path, &what));
        }
        for (n, (offset, length)) in segments.offsets.iter().zip(&segments.lengths).enumerate() {
            let end = offset.checked_add(*length);
            let Some(bytes) = end.and_then(|end| tiff.file().get(*offset..end)) else {
                return Err(damaged(path, "its numbers are not all in the file"));
            };
            let rows = segments.rows(n, self.size);
            if self.compression == UNCOMPRESSED && rows * row_bits / 8 > *length {
                return Err(damaged(path, "its numbers are not all in the file"));
            }
            // it takes all strips for whole ones
            if self.compression == DEFLATE && rows != segments.size.h {
                return Err(unread(
                    path,
                    "compressed by Deflate whose last strip has fewer rows than the others",
                ));
            }
            if self.compression == LOSSLESS_JPEG {
                self.check_jpeg(path, bytes, rows)?;
            }
        }
        Ok(())
    }

    /// Bits per row of a strip or tile, uncompressed.
    fn row_bits(&self) -> usize {
        self.segments.size.w * self.samples * self.bits
    }

    /// The decoder takes the numbers of a segment row by row, whatever the rows of the JPEG.
    fn check_jpeg(&self, path: &Path, bytes: &[u8], rows: usize) -> Result<()> {
        const LOSSLESS: u8 = 0xc3;
        let frame = Jpeg(bytes).frame();
        let frame = frame.ok_or_else(|| damaged(path, "a part that should be JPEG is not"))?;
        if frame.marker != LOSSLESS {
            return Err(unread(path, "compressed as lossy JPEG"));
        }
        if frame.bits < 10 {
            return Err(unread(path, &format!("compressed as lossless JPEG of {} bits", frame.bits)));
        }
        let row = self.segments.size.w * self.samples;
        let theirs = frame.width * usize::from(frame.components);
        let fits = theirs.is_multiple_of(row) || row.is_multiple_of(theirs.max(1));
        let (theirs, needed, most) = (theirs * frame.height, row * rows, row * self.segments.size.h);
        if !fits || theirs < needed || theirs > 2 * most {
            return Err(unread(path, "whose JPEG parts have other sizes than its tiles or strips"));
        }
        Ok(())
    }

    /// A directory of the layout and the camera's notes, to be appended to the file.
    ///
    /// The decoder merges adjacent strips. Compressed ones are therefore shown as tiles, and others with no
    /// more bytes than their numbers take.
    pub fn shown(&self, tiff: Tiff, root: &Directory) -> Shown {
        let Self { size, segments, .. } = self;
        let are_tiles = segments.are_tiles || self.compression != UNCOMPRESSED;
        let [offsets, lengths] = if are_tiles { TILES } else { STRIPS };
        let length = |n: usize| match self.compression {
            UNCOMPRESSED => segments.rows(n, *size) * self.row_bits() / 8,
            _ => segments.lengths[n],
        };
        let number = |tag: u16, number: usize| (tag, tags::LONG, vec![number as u64]);
        let mut entries = vec![
            number(tags::WIDTH, size.w),
            number(tags::HEIGHT, size.h),
            number(tags::BITS_PER_SAMPLE, self.bits),
            number(tags::COMPRESSION, self.compression),
            number(tags::PHOTOMETRIC, LINEAR),
            number(tags::SAMPLES_PER_PIXEL, self.samples),
            number(tags::PREDICTOR, self.predictor),
            number(tags::SAMPLE_FORMAT, if self.is_float { 3 } else { 1 }),
            number(INTERLEAVE[0], self.interleave[0]),
            number(INTERLEAVE[1], self.interleave[1]),
            (offsets, tags::LONG, segments.offsets.iter().map(|offset| *offset as u64).collect()),
            (lengths, tags::LONG, (0..segments.lengths.len()).map(|n| length(n) as u64).collect()),
        ];
        if are_tiles {
            entries.push(number(TILE_SIZE[0], segments.size.w));
            entries.push(number(TILE_SIZE[1], segments.size.h));
        } else {
            entries.push(number(tags::ROWS_PER_STRIP, segments.size.h));
        }
        let of_camera: Vec<_> =
            OF_CAMERA.into_iter().filter_map(|tag| Some((tag, root.stored(tag)?))).collect();
        // directories begin at even offsets
        let pad = tiff.file().len() % 2;
        let at = (tiff.file().len() + pad) as u64;
        let mut added = vec![0; pad];
        added.extend(written(tiff.is_little(), &entries, &of_camera, at));
        Shown { first: long(tiff.is_little(), at), added }
    }
}

impl Segments {
    fn read(path: &Path, directory: &Directory, picture: Dim2, samples: usize) -> Result<Self> {
        let whole = |tag: u16| -> Vec<usize> {
            directory.numbers(tag).unwrap_or_default().into_iter().map(|number| number as usize).collect()
        };
        let first = |tag: u16, default: usize| whole(tag).first().copied().unwrap_or(default);
        let are_tiles = directory.has_tag(TILES[0]);
        let [offsets, lengths] = if are_tiles { TILES } else { STRIPS }.map(whole);
        let size = if are_tiles {
            Dim2::new(first(TILE_SIZE[0], 0), first(TILE_SIZE[1], 0))
        } else {
            Dim2::new(picture.w, first(tags::ROWS_PER_STRIP, picture.h).min(picture.h))
        };
        if size.w == 0 || size.h == 0 {
            return Err(damaged(path, "its strips or tiles have no size"));
        }
        let (columns, rows) = (picture.w.div_ceil(size.w), picture.h.div_ceil(size.h));
        check_size(path, Dim2::new(columns * size.w, rows * size.h), samples)?;
        let count = columns * rows;
        if offsets.len() != count || lengths.len() != count {
            let problem = format!(
                "the number of its strips or tiles is {} instead of {count}",
                offsets.len().min(lengths.len())
            );
            return Err(damaged(path, problem));
        }
        Ok(Self { are_tiles, size, offsets, lengths })
    }

    /// The rows of a segment; tiles are complete, the last strip may be shorter.
    fn rows(&self, segment: usize, picture: Dim2) -> usize {
        if self.are_tiles { self.size.h } else { self.size.h.min(picture.h - segment * self.size.h) }
    }
}
