//! How a DNG's numbers are laid out in the file, and what the decoder is shown of it.
//!
//! # Source
//! Adobe, *Digital Negative Specification* 1.7, chapters 2 and 4; *TIFF* 6.0.

use std::path::Path;

use rawler::imgop::Dim2;

use super::super::jpeg::Jpeg;
use super::tiff_directories::{Directory, Tiff};
use super::{check_size, damaged, unread};
use crate::Result;

/// Tags of the layout.
mod tag {
    pub const WIDTH: u16 = 256;
    pub const HEIGHT: u16 = 257;
    pub const BITS: u16 = 258;
    pub const COMPRESSION: u16 = 259;
    pub const PHOTOMETRIC: u16 = 262;
    pub const FILL_ORDER: u16 = 266;
    /// Where strips are, and how long.
    pub const STRIPS: [u16; 2] = [273, 279];
    pub const SAMPLES: u16 = 277;
    pub const ROWS_PER_STRIP: u16 = 278;
    pub const PLANAR: u16 = 284;
    pub const PREDICTOR: u16 = 317;
    /// Width and height of tiles,
    pub const TILE_SIZE: [u16; 2] = [322, 323];
    /// where they are, and how long.
    pub const TILES: [u16; 2] = [324, 325];
    pub const SAMPLE_FORMAT: u16 = 339;
    pub const FILTERS_LAYOUT: u16 = 50711;
    pub const SUB_TILE: u16 = 50974;
    /// By how many rows and columns are interleaved.
    pub const INTERLEAVE: [u16; 2] = [50975, 52547];
    pub const JXL_DISTANCE: u16 = 52553;
}

/// Make, model, orientation, directories of EXIF and GPS, version and colours: what the decoder is shown of the first directory.
const OF_CAMERA: [u16; 10] = [271, 272, 274, 34665, 34853, 50706, 50721, 50722, 50778, 50779];

/// What the decoder is shown in the place of the colours, which are none of its business.
const LINEAR: usize = 34892;

const UNCOMPRESSED: usize = 1;
const LOSSLESS_JPEG: usize = 7;
const DEFLATE: usize = 8;
const LOSSY_JPEG: usize = 34892;
const JPEG_XL: usize = 52546;

/// Predictors of floats: bytes by significance, less that of the sample one, two or four before.
const FLOAT_PREDICTORS: [usize; 3] = [3, 34894, 34895];

/// The first directory's place, and what is added to the file: as the decoder shall see it.
pub(super) struct Shown {
    first: [u8; 4],
    added: Vec<u8>,
}

impl Shown {
    /// Makes a file what the decoder shall see.
    pub fn to(&self, file: &mut Vec<u8>) {
        file[4..8].copy_from_slice(&self.first);
        file.extend(&self.added);
    }
}

/// How the numbers are laid out in the file.
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

/// The strips or tiles that a picture is cut into.
struct Segments {
    are_tiles: bool,
    size: Dim2,
    offsets: Vec<usize>,
    lengths: Vec<usize>,
}

impl Layout {
    /// # Errors
    /// [`Error::Picture`] if that is none that the decoder unpacks rightly, or the file is cut short.
    pub fn read(path: &Path, tiff: Tiff, directory: &Directory) -> Result<Self> {
        let number = |tag, default: usize| directory.number(tag).map_or(default, |number| number as usize);
        let size = Dim2::new(number(tag::WIDTH, 0), number(tag::HEIGHT, 0));
        let samples = number(tag::SAMPLES, 1);
        check_size(path, size, samples)?;
        let all_bits = directory.numbers(tag::BITS).unwrap_or_else(|| vec![1.0]);
        let formats = directory.numbers(tag::SAMPLE_FORMAT).unwrap_or_else(|| vec![1.0]);
        let differ = |numbers: &[f64]| numbers.windows(2).any(|pair| pair[0] as usize != pair[1] as usize);
        if differ(&all_bits) || differ(&formats) {
            return Err(unread(path, "whose samples differ in their bits or format"));
        }
        let layout = Self {
            size,
            samples,
            bits: all_bits[0] as usize,
            is_float: formats[0] as usize == 3,
            compression: number(tag::COMPRESSION, UNCOMPRESSED),
            predictor: number(tag::PREDICTOR, 1),
            interleave: tag::INTERLEAVE.map(|tag| number(tag, 1)),
            segments: Segments::read(path, directory, size, samples)?,
        };
        let sub_tile = directory.numbers(tag::SUB_TILE).unwrap_or_default();
        let planar = samples > 1 && number(tag::PLANAR, 1) != 1;
        let oddity = if !layout.is_float && formats[0] as usize != 1 {
            Some("of signed numbers")
        } else if planar {
            Some("whose colours are stored one after another (PlanarConfiguration 2)")
        } else if number(tag::FILL_ORDER, 1) != 1 {
            Some("whose bits are stored in reversed order (FillOrder 2)")
        } else if number(tag::FILTERS_LAYOUT, 1) != 1 {
            Some("whose colour filters stand in staggered rows or columns (CFALayout above 1)")
        } else if sub_tile.iter().any(|size| *size as usize != 1) {
            Some("whose numbers are stored in blocks (SubTileBlockSize)")
        } else if ![[1, 1], [2, 2]].contains(&layout.interleave) {
            Some("whose rows or columns are interleaved by other factors than 2 and 2")
        } else {
            None
        };
        if let Some(what) = oddity {
            return Err(unread(path, what));
        }
        layout.check_compression(path, tiff, directory)?;
        Ok(layout)
    }

    /// # Errors
    /// [`Error::Picture`] if its decoder would fail, or unpack other numbers.
    fn check_compression(&self, path: &Path, tiff: Tiff, directory: &Directory) -> Result<()> {
        let Self { bits, is_float, segments, .. } = self;
        let row_bits = self.row_bits();
        let is_read = match self.compression {
            UNCOMPRESSED if *is_float => [16, 24, 32].contains(bits),
            UNCOMPRESSED => (1..=16).contains(bits) && row_bits.is_multiple_of(8),
            LOSSLESS_JPEG => !is_float,
            DEFLATE => *is_float && FLOAT_PREDICTORS.contains(&self.predictor) && [16, 24, 32].contains(bits),
            JPEG_XL if directory.number(tag::JXL_DISTANCE).is_none_or(|distance| distance.abs() > 0.0) => {
                return Err(unread(path, "compressed as lossy JPEG XL"));
            }
            JPEG_XL => !is_float && [8, 16].contains(bits),
            LOSSY_JPEG => return Err(unread(path, "compressed as lossy JPEG")),
            _ => false,
        };
        if !is_read {
            let kind = if *is_float { "floats" } else { "integers" };
            let what = format!(
                "of {kind} of {bits} bits, compression {}, predictor {}",
                self.compression, self.predictor
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
            if self.compression == LOSSLESS_JPEG {
                self.check_jpeg(path, bytes, rows)?;
            }
        }
        Ok(())
    }

    /// Bits of a row of a strip or tile, uncompressed.
    fn row_bits(&self) -> usize {
        self.segments.size.w * self.samples * self.bits
    }

    /// Its decoder takes the numbers of a segment row by row, in whatever rows JPEG has them.
    fn check_jpeg(&self, path: &Path, bytes: &[u8], rows: usize) -> Result<()> {
        const LOSSLESS: u8 = 0xc3;
        let frame = Jpeg(bytes).frame();
        let frame = frame.ok_or_else(|| damaged(path, "a part of it that should be JPEG is none"))?;
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

    /// A directory of the layout, and of what the camera wrote, at the end of the file.
    ///
    /// Strips that follow one another the decoder takes for one. Compressed ones are shown as tiles, therefore, and of others no more than their
    /// numbers take.
    pub fn shown(&self, tiff: Tiff, root: &Directory) -> Shown {
        let Self { size, segments, .. } = self;
        let are_tiles = segments.are_tiles || self.compression != UNCOMPRESSED;
        let (offsets, lengths) =
            if are_tiles { (tag::TILES[0], tag::TILES[1]) } else { (tag::STRIPS[0], tag::STRIPS[1]) };
        let length = |n: usize| match self.compression {
            UNCOMPRESSED => segments.rows(n, *size) * self.row_bits() / 8,
            _ => segments.lengths[n],
        };
        let mut numbers = vec![
            (tag::WIDTH, vec![size.w]),
            (tag::HEIGHT, vec![size.h]),
            (tag::BITS, vec![self.bits]),
            (tag::COMPRESSION, vec![self.compression]),
            (tag::PHOTOMETRIC, vec![LINEAR]),
            (tag::SAMPLES, vec![self.samples]),
            (tag::PREDICTOR, vec![self.predictor]),
            (tag::SAMPLE_FORMAT, vec![if self.is_float { 3 } else { 1 }]),
            (tag::INTERLEAVE[0], vec![self.interleave[0]]),
            (tag::INTERLEAVE[1], vec![self.interleave[1]]),
            (offsets, segments.offsets.clone()),
            (lengths, (0..segments.lengths.len()).map(length).collect()),
        ];
        if are_tiles {
            numbers.push((tag::TILE_SIZE[0], vec![segments.size.w]));
            numbers.push((tag::TILE_SIZE[1], vec![segments.size.h]));
        } else {
            numbers.push((tag::ROWS_PER_STRIP, vec![segments.size.h]));
        }
        let of_camera = OF_CAMERA.into_iter().filter_map(|tag| Some((tag, root.stored(tag)?)));
        let mut entries: Vec<_> = of_camera.map(|(tag, entry)| (tag, entry.to_vec())).collect();
        // directories begin at even places
        let pad = tiff.file().len() % 2;
        let at = tiff.file().len() + pad;
        let mut beyond = Vec::new();
        let arrays = at + 2 + 12 * (entries.len() + numbers.len()) + 4;
        for (tag, numbers) in numbers {
            const LONG: u16 = 4;
            let values = numbers.iter().flat_map(|number| tiff.long(*number as u32));
            let count = tiff.long(numbers.len() as u32);
            let place = tiff.long((arrays + beyond.len()) as u32);
            let value: Vec<u8> = if numbers.len() == 1 {
                values.collect()
            } else {
                beyond.extend(values);
                place.to_vec()
            };
            entries.push((tag, [&tiff.short(tag)[..], &tiff.short(LONG), &count, &value].concat()));
        }
        entries.sort_by_key(|(tag, _)| *tag);
        let mut bytes = vec![0; pad];
        bytes.extend(tiff.short(entries.len() as u16));
        bytes.extend(entries.into_iter().flat_map(|(_, entry)| entry));
        bytes.extend([0; 4]);
        bytes.extend(beyond);
        Shown { first: tiff.long(at as u32), added: bytes }
    }
}

impl Segments {
    fn read(path: &Path, directory: &Directory, picture: Dim2, samples: usize) -> Result<Self> {
        let whole = |tag: u16| -> Vec<usize> {
            directory.numbers(tag).unwrap_or_default().into_iter().map(|number| number as usize).collect()
        };
        let first = |tag: u16, default: usize| whole(tag).first().copied().unwrap_or(default);
        let are_tiles = directory.has_tag(tag::TILES[0]);
        let [offsets, lengths] = if are_tiles { tag::TILES } else { tag::STRIPS }.map(whole);
        let size = if are_tiles {
            Dim2::new(first(tag::TILE_SIZE[0], 0), first(tag::TILE_SIZE[1], 0))
        } else {
            Dim2::new(picture.w, first(tag::ROWS_PER_STRIP, picture.h).min(picture.h))
        };
        if size.w == 0 || size.h == 0 {
            return Err(damaged(path, "its strips or tiles have no size"));
        }
        let (columns, rows) = (picture.w.div_ceil(size.w), picture.h.div_ceil(size.h));
        check_size(path, Dim2::new(columns * size.w, rows * size.h), samples)?;
        let count = columns * rows;
        if offsets.len() != count || lengths.len() != count {
            let problem = format!(
                "{} strips or tiles, of {count} that make up its picture",
                offsets.len().min(lengths.len())
            );
            return Err(damaged(path, problem));
        }
        Ok(Self { are_tiles, size, offsets, lengths })
    }

    /// The rows of numbers in one of them; tiles are whole, the last strip need not be.
    fn rows(&self, segment: usize, picture: Dim2) -> usize {
        if self.are_tiles { self.size.h } else { self.size.h.min(picture.h - segment * self.size.h) }
    }
}
