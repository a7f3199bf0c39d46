//! The layout of a page's samples in its file, and why it cannot be read.

use std::path::Path;

use image::ColorType;

use super::directory::Directory;
use super::tags::{
    BITS_PER_SAMPLE, COMPRESSION, EXTRA_SAMPLES, FILL_ORDER, HEIGHT, JPEG_TABLES, PHOTOMETRIC,
    PLANAR_CONFIGURATION, PREDICTOR, ROWS_PER_STRIP, SAMPLE_FORMAT, SAMPLES_PER_PIXEL, STRIP_BYTE_COUNTS,
    STRIP_OFFSETS, TILE_BYTE_COUNTS, TILE_LENGTH, TILE_OFFSETS, TILE_WIDTH, WIDTH,
};
use crate::error::counted;
use crate::image::reading::refused::{MAX_SIDE, damaged, inks};
use crate::{Error, Result};

/// The type of a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    U8,
    U16,
    F16,
    F32,
    F64,
}

impl Kind {
    /// Bytes per sample as stored.
    pub fn stored(self) -> usize {
        match self {
            Self::U8 => 1,
            Self::U16 | Self::F16 => 2,
            Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    pub fn is_float(self) -> bool {
        !matches!(self, Self::U8 | Self::U16)
    }
}

/// The division of a page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cut {
    /// Into strips of this many rows.
    Strips(u64),
    /// Into tiles of this width and height, px.
    Tiles(u64, u64),
}

/// The layout of a page's samples in its file.
pub(super) struct Layout {
    pub is_little: bool,
    pub width: u32,
    pub height: u32,
    pub kind: Kind,
    /// Samples per pixel.
    pub samples: usize,
    /// Colours per pixel, 1 or 3, which come first.
    colours: usize,
    /// The sample that is alpha.
    alpha: Option<usize>,
    /// Whether colours are stored multiplied by alpha.
    pub is_multiplied: bool,
    /// Whether 0 is white.
    pub is_inverted: bool,
    /// Whether each sample has its own plane.
    pub is_planar: bool,
    pub cut: Cut,
    pub compression: u64,
    pub predictor: u64,
    pub jpeg_tables: Option<Vec<u8>>,
    /// Offsets and lengths of strips or tiles, plane by plane.
    pub chunks: Vec<(u64, u64)>,
}

const NONE: u64 = 1;
const LZW: u64 = 5;
const JPEG: u64 = 7;
const DEFLATE: u64 = 8;
const PACK_BITS: u64 = 32773;
const OLD_DEFLATE: u64 = 32946;
/// Unsupported compressions, by name.
const UNREAD_COMPRESSIONS: [(u64, &str); 11] = [
    (2, "CCITT RLE (fax)"),
    (3, "CCITT group 3 (fax)"),
    (4, "CCITT group 4 (fax)"),
    (6, "old-style JPEG"),
    (32909, "PixarLog"),
    (34676, "SGILog"),
    (34712, "JPEG 2000"),
    (34887, "LERC"),
    (34925, "LZMA"),
    (50000, "Zstandard"),
    (50001, "WebP"),
];

impl Layout {
    /// # Errors
    /// [`Error::Picture`] if it contradicts itself, or has unsupported properties.
    pub fn of(path: &Path, page: &Directory, length: u64) -> Result<Self> {
        let (Some(width), Some(height)) = (page.number(WIDTH), page.number(HEIGHT)) else {
            return Err(damaged(path, "it does not state the size of its picture"));
        };
        if width == 0 || height == 0 {
            let problem = format!("the picture is {width} x {height} px");
            return Err(Error::picture(path, problem, "copy the file again"));
        }
        if width.max(height) > MAX_SIDE.into() {
            let problem = format!("{width} x {height} px");
            let remedy = "crop the picture to the sheet; at most 65536 px a side and 2 GiB are read";
            return Err(Error::picture(path, problem, remedy));
        }
        let (colours, is_inverted) = colours(path, page)?;
        let kind = kind(path, page)?;
        let samples = page.number(SAMPLES_PER_PIXEL).unwrap_or(1) as usize;
        let (alpha, is_multiplied) = alpha(path, page, samples, colours)?;
        let compression = compression(path, page)?;
        let is_planar = match page.number(PLANAR_CONFIGURATION).unwrap_or(1) {
            1 => false,
            2 => samples > 1,
            other => return Err(damaged(path, format!("its PlanarConfiguration is {other}"))),
        };
        let layout = Self {
            is_little: page.is_little,
            width: width as u32,
            height: height as u32,
            kind,
            samples,
            colours,
            alpha,
            is_multiplied,
            is_inverted,
            is_planar,
            cut: cut(path, page, height)?,
            compression,
            predictor: predictor(path, page, (compression, kind))?,
            jpeg_tables: page.bytes(JPEG_TABLES).map(<[u8]>::to_vec),
            chunks: Vec::new(),
        };
        if kind.is_float() && colours == 1 {
            return Err(unread(path, "grey pictures of floats", "save it with 16 bits, or as RGB"));
        }
        let chunks = layout.find_chunks(path, page, length)?;
        Ok(Self { chunks, ..layout })
    }

    /// Indices of the colours and alpha to be read among a pixel's samples.
    pub fn wanted(&self) -> impl Iterator<Item = usize> {
        (0..self.colours).chain(self.alpha)
    }

    /// Whether the file's samples are those of the picture, byte by byte.
    pub fn is_as_wanted(&self) -> bool {
        !self.is_planar
            && matches!(self.cut, Cut::Strips(_))
            && self.wanted().eq(0..self.samples)
            && matches!(self.kind, Kind::U8 | Kind::U16 | Kind::F32)
    }

    /// Colours, alpha and depth of the resulting picture.
    pub fn color_type(&self) -> ColorType {
        match (self.kind, self.colours, self.alpha.is_some()) {
            (Kind::U8, 1, false) => ColorType::L8,
            (Kind::U8, 1, true) => ColorType::La8,
            (Kind::U8, _, false) => ColorType::Rgb8,
            (Kind::U8, _, true) => ColorType::Rgba8,
            (Kind::U16, 1, false) => ColorType::L16,
            (Kind::U16, 1, true) => ColorType::La16,
            (Kind::U16, _, false) => ColorType::Rgb16,
            (Kind::U16, _, true) => ColorType::Rgba16,
            (_, _, false) => ColorType::Rgb32F,
            (_, _, true) => ColorType::Rgba32F,
        }
    }

    /// Width and height covered by strips or tiles: tiles extend beyond the picture.
    pub fn size_with_margins(&self) -> (u64, u64) {
        let (width, height) = (u64::from(self.width), u64::from(self.height));
        match self.cut {
            Cut::Strips(_) => (width, height),
            Cut::Tiles(columns, rows) => (width.next_multiple_of(columns), height.next_multiple_of(rows)),
        }
    }

    fn pixels(&self) -> u64 {
        u64::from(self.width) * u64::from(self.height)
    }

    /// Bytes of the resulting picture.
    pub fn bytes(&self) -> u64 {
        self.pixels() * u64::from(self.color_type().bytes_per_pixel())
    }

    /// Bytes of all samples.
    pub fn stored_bytes(&self) -> u64 {
        self.bytes().max(self.pixels().saturating_mul((self.samples * self.kind.stored()) as u64))
    }

    /// Bytes of a strip or tile decoded into a separate buffer before its samples are selected.
    pub fn other_bytes(&self) -> u64 {
        let rows = match self.cut {
            Cut::Strips(rows) => rows.min(self.height.into()),
            Cut::Tiles(_, rows) => rows,
        };
        if self.is_as_wanted() { 0 } else { self.row_bytes().saturating_mul(rows) }
    }

    /// Samples per pixel in a strip or tile.
    pub fn samples_together(&self) -> usize {
        if self.is_planar { 1 } else { self.samples }
    }

    /// Bytes per row of a strip or tile.
    fn row_bytes(&self) -> u64 {
        let columns = match self.cut {
            Cut::Strips(_) => self.width.into(),
            Cut::Tiles(width, _) => width,
        };
        columns.saturating_mul((self.samples_together() * self.kind.stored()) as u64)
    }

    /// Number of strips or tiles in a plane, and rows in the nth of them.
    fn plane(&self) -> (u64, impl Fn(u64) -> u64) {
        let height = u64::from(self.height);
        let (across, rows) = match self.cut {
            Cut::Strips(rows) => (1, rows),
            Cut::Tiles(width, rows) => (u64::from(self.width).div_ceil(width), rows),
        };
        let is_tiled = matches!(self.cut, Cut::Tiles(..));
        let rows_of =
            move |n: u64| if is_tiled { rows } else { rows.min(height - rows * (n % height.div_ceil(rows))) };
        (across * height.div_ceil(rows), rows_of)
    }

    /// Offsets and lengths of strips or tiles, each entirely within a file of this length.
    fn find_chunks(&self, path: &Path, page: &Directory, length: u64) -> Result<Vec<(u64, u64)>> {
        let (offsets, counts, what) = match self.cut {
            Cut::Strips(_) => (STRIP_OFFSETS, STRIP_BYTE_COUNTS, "strip"),
            Cut::Tiles(..) => (TILE_OFFSETS, TILE_BYTE_COUNTS, "tile"),
        };
        let (in_a_plane, rows_of) = self.plane();
        let wanted = in_a_plane * if self.is_planar { self.samples as u64 } else { 1 };
        let bytes_of = |n: u64| self.row_bytes().saturating_mul(rows_of(n));
        let offsets = page.numbers(offsets).unwrap_or_default();
        let counts = match page.numbers(counts) {
            // some old writers omit them
            None if self.compression == NONE => (0..wanted.min(offsets.len() as u64)).map(bytes_of).collect(),
            counts => counts.unwrap_or_default(),
        };
        if (offsets.len().min(counts.len()) as u64) < wanted {
            let (there, width, height) = (offsets.len().min(counts.len()), self.width, self.height);
            let wanted = counted(wanted, what);
            let problem =
                format!("inconsistent sizes: {width} x {height} px need {wanted}, but it has {there}");
            return Err(damaged(path, problem));
        }
        let chunks: Vec<_> = offsets.into_iter().zip(counts).take(wanted as usize).collect();
        for (n, (offset, count)) in (0..).zip(&chunks) {
            if offset + count > length {
                return Err(damaged(path, format!("one of its {what}s ends beyond the end of the file")));
            }
            if *count == 0 || self.compression == NONE && *count < bytes_of(n) {
                return Err(damaged(path, format!("one of its {what}s has {}", counted(count, "byte"))));
            }
        }
        Ok(chunks)
    }
}

/// Number of colours, and whether 0 is white.
fn colours(path: &Path, page: &Directory) -> Result<(usize, bool)> {
    let what = match page.number(PHOTOMETRIC) {
        Some(0) => return Ok((1, true)),
        Some(1) => return Ok((1, false)),
        Some(2) => return Ok((3, false)),
        Some(5) => return Err(inks(path)),
        Some(3) => "colours of a palette",
        Some(4) => "masks",
        Some(6) => "colours as JPEG has them (YCbCr)",
        Some(8..=10) => "CIELAB",
        Some(32844 | 32845) => "LogLuv",
        Some(other) => {
            let what = format!("PhotometricInterpretation {other}");
            return Err(unread(path, &what, "save it as RGB"));
        }
        None => return Err(damaged(path, "it does not say whether it is grey or RGB")),
    };
    Err(unread(path, what, "save it as RGB"))
}

/// The type common to all samples.
fn kind(path: &Path, page: &Directory) -> Result<Kind> {
    const INTEGERS: u64 = 1;
    const SIGNED: u64 = 2;
    const FLOATS: u64 = 3;
    const UNDEFINED: u64 = 4;
    let alike = |tag: u16, default: u64| {
        let all = page.numbers(tag).unwrap_or_else(|| vec![default]);
        if all.iter().all(|one| *one == all[0]) { Ok(all[0]) } else { Err(all) }
    };
    let unlike = |what: &str, all: Vec<u64>| {
        let all = all.iter().map(u64::to_string).collect::<Vec<_>>().join(", ");
        unread(path, &format!("samples of different {what} ({all})"), "save it with 16 bits in every sample")
    };
    let bits = alike(BITS_PER_SAMPLE, 1).map_err(|all| unlike("bits", all))?;
    let format = alike(SAMPLE_FORMAT, INTEGERS).map_err(|all| unlike("formats", all))?;
    match (format, bits) {
        (INTEGERS | UNDEFINED, 8) => Ok(Kind::U8),
        (INTEGERS | UNDEFINED, 16) => Ok(Kind::U16),
        (FLOATS, 16) => Ok(Kind::F16),
        (FLOATS, 32) => Ok(Kind::F32),
        (FLOATS, 64) => Ok(Kind::F64),
        (INTEGERS | UNDEFINED, bits) => {
            let what = format!("integers of {}", counted(bits, "bit"));
            Err(unread(path, &what, "save it again with 16 bits, or as floats"))
        }
        (SIGNED, _) => Err(unread(path, "signed integers", "save it again with 16 bits, or as floats")),
        (FLOATS, bits) => {
            let what = format!("floats of {}", counted(bits, "bit"));
            Err(unread(path, &what, "save it again with 32 bits"))
        }
        _ => Err(unread(path, "complex numbers", "save it again with 16 bits, or as floats")),
    }
}

/// The alpha sample, as `ExtraSamples` states, or by default the only sample other than the colours; and
/// whether colours are stored multiplied by it.
fn alpha(path: &Path, page: &Directory, samples: usize, colours: usize) -> Result<(Option<usize>, bool)> {
    const ASSOCIATED: u64 = 1;
    const UNASSOCIATED: u64 = 2;
    if !(colours..=u16::MAX.into()).contains(&samples) {
        let problem =
            format!("it has {} a pixel for {}", counted(samples, "sample"), counted(colours, "colour"));
        return Err(damaged(path, problem));
    }
    let extra = page.numbers(EXTRA_SAMPLES);
    let is_alpha = |kind: &u64| matches!(*kind, ASSOCIATED | UNASSOCIATED);
    let alpha = match &extra {
        Some(extra_samples) => extra_samples.iter().position(is_alpha),
        None => (samples == colours + 1).then_some(0),
    };
    if colours == 1 && samples - usize::from(alpha.is_some()) > 1 {
        let problem =
            format!("it is grey, but has {samples} samples per pixel, and does not state which are colours");
        return Err(Error::picture(path, problem, "save it as RGB"));
    }
    // where there are several, some writers call the first alpha, whatever it is
    let is_multiplied = extra.is_some_and(|extra| extra == [ASSOCIATED]) && samples == colours + 1;
    Ok((alpha.map(|alpha| colours + alpha).filter(|alpha| *alpha < samples), is_multiplied))
}

fn compression(path: &Path, page: &Directory) -> Result<u64> {
    const REMEDY: &str = "save it uncompressed, or compressed by Deflate or LZW";
    let compression = page.number(COMPRESSION).unwrap_or(NONE);
    if page.number(FILL_ORDER).unwrap_or(1) != 1 {
        return Err(unread(path, "bits in reversed order (FillOrder 2)", REMEDY));
    }
    if matches!(compression, NONE | LZW | JPEG | DEFLATE | PACK_BITS | OLD_DEFLATE) {
        return Ok(compression);
    }
    let name = UNREAD_COMPRESSIONS.iter().find(|(number, _)| *number == compression);
    let name = name.map_or_else(|| format!("number {compression}"), |(_, name)| (*name).to_owned());
    Err(unread(path, &format!("the compression {name}"), REMEDY))
}

/// The predictor applied before compression; meaningless for other compressions.
fn predictor(path: &Path, page: &Directory, (compression, kind): (u64, Kind)) -> Result<u64> {
    const DIFFERENCES: u64 = 2;
    const OF_FLOATS: u64 = 3;
    if !matches!(compression, LZW | DEFLATE | OLD_DEFLATE) {
        return Ok(1);
    }
    match page.number(PREDICTOR).unwrap_or(1) {
        known @ (1 | DIFFERENCES) => Ok(known),
        OF_FLOATS if kind.is_float() => Ok(OF_FLOATS),
        other => Err(damaged(path, format!("its Predictor is {other}"))),
    }
}

fn cut(path: &Path, page: &Directory, height: u64) -> Result<Cut> {
    if !page.has(TILE_OFFSETS) {
        let rows = page.number(ROWS_PER_STRIP).unwrap_or(height).min(height);
        return if rows > 0 { Ok(Cut::Strips(rows)) } else { Err(damaged(path, "its strips have no rows")) };
    }
    let side = |tag| page.number(tag).filter(|px| (1..=u64::from(MAX_SIDE)).contains(px));
    match (side(TILE_WIDTH), side(TILE_LENGTH)) {
        (Some(width), Some(length)) => Ok(Cut::Tiles(width, length)),
        _ => Err(damaged(path, "its tiles have no size")),
    }
}

/// For an unsupported property of an undamaged file.
fn unread(path: &Path, what: &str, remedy: &str) -> Error {
    Error::picture(path, format!("this vfold does not read TIFF with {what}"), remedy)
}

#[cfg(test)]
mod tests {
    use super::super::directory::{file, read_all};
    use super::super::tags::{LONG, SHORT};
    use super::*;

    /// `SamplesPerPixel` has sixteen bits, of which these are three.
    #[test]
    fn more_samples_than_there_may_be_are_damage() {
        let entries = [
            (WIDTH, SHORT, 1, 4),
            (HEIGHT, SHORT, 1, 4),
            (BITS_PER_SAMPLE, SHORT, 1, 8),
            (PHOTOMETRIC, SHORT, 1, 2),
            (SAMPLES_PER_PIXEL, LONG, 1, (1 << 16) + 3),
        ];
        let bytes = file(&[&entries]);
        let pages = read_all(&mut std::io::Cursor::new(&bytes), bytes.len() as u64).unwrap();
        let Err(error) = Layout::of(Path::new("a.tif"), &pages[0], bytes.len() as u64) else {
            panic!("it was read")
        };
        let message = error.to_string();
        assert!(message.contains("65539 samples a pixel") && message.contains("damaged"), "{message}");
    }
}
