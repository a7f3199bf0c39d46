//! A TIFF file presented with another directory.

use std::io::{self, Read, Seek, SeekFrom};

use super::layout::{Cut, Layout};
use super::tags::{
    BITS_PER_SAMPLE, COMPRESSION, HEIGHT, JPEG_TABLES, LONG, PHOTOMETRIC, PREDICTOR, ROWS_PER_STRIP,
    SAMPLE_FORMAT, SAMPLES_PER_PIXEL, SHORT, STRIP_BYTE_COUNTS, STRIP_OFFSETS, TILE_BYTE_COUNTS, TILE_LENGTH,
    TILE_OFFSETS, TILE_WIDTH, UNDEFINED, WIDTH,
};
use super::written::{long, written};

const HEAD_BYTES: u64 = 8;

/// A file whose first bytes point to a directory that appears to lie beyond its end, where no strip or tile
/// reaches.
pub(super) struct Described<R> {
    file: R,
    head: [u8; HEAD_BYTES as usize],
    directory: Vec<u8>,
    /// Offset of the directory.
    end: u64,
    at: u64,
}

impl<R: Read + Seek> Described<R> {
    /// A file of this length as grey pixels of a number of interleaved samples, in the strips or tiles of
    /// `chunks`. Tiles are complete: the decoder of LZW fails if one is read row by row.
    pub fn new(file: R, length: u64, layout: &Layout, chunks: &[(u64, u64)]) -> Self {
        // its first byte is read only after a seek, so that a strip cut short ends where the file does
        let end = length + 1;
        let directory = directory(layout, chunks, end);
        let mark = if layout.is_little { *b"II*\0" } else { *b"MM\0*" };
        let place = long(layout.is_little, end);
        let head = std::array::from_fn(|n| if n < 4 { mark[n] } else { place[n - 4] });
        Self { file, head, directory, end, at: 0 }
    }
}

impl<R: Read + Seek> Read for Described<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let ours = match self.at {
            at if at < HEAD_BYTES => &self.head[at as usize..],
            at if at >= self.end => self.directory.get((at - self.end) as usize..).unwrap_or_default(),
            _ => {
                let read = self.file.read(buffer)?;
                self.at += read as u64;
                return Ok(read);
            }
        };
        let read = ours.len().min(buffer.len());
        buffer[..read].copy_from_slice(&ours[..read]);
        self.seek(SeekFrom::Current(read as i64))?;
        Ok(read)
    }
}

impl<R: Read + Seek> Seek for Described<R> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let to = match to {
            SeekFrom::Start(to) => Some(to),
            SeekFrom::Current(by) => self.at.checked_add_signed(by),
            SeekFrom::End(by) => (self.end + self.directory.len() as u64).checked_add_signed(by),
        };
        self.at = to.ok_or(io::ErrorKind::InvalidInput)?;
        if self.at < self.end {
            self.file.seek(SeekFrom::Start(self.at))?;
        }
        Ok(self.at)
    }
}

/// A directory at offset `end`.
fn directory(layout: &Layout, chunks: &[(u64, u64)], end: u64) -> Vec<u8> {
    let (offsets, counts): (Vec<u64>, Vec<u64>) = chunks.iter().copied().unzip();
    let number = |tag: u16, number: u64| (tag, LONG, vec![number]);
    let (width, height) = layout.size_with_margins();
    let format = if layout.kind.is_float() { 3 } else { 1 };
    let mut entries = vec![
        number(WIDTH, width),
        number(HEIGHT, height),
        (BITS_PER_SAMPLE, SHORT, vec![8 * layout.kind.stored() as u64]),
        (COMPRESSION, SHORT, vec![layout.compression]),
        (PHOTOMETRIC, SHORT, vec![1]),
        (SAMPLES_PER_PIXEL, SHORT, vec![layout.samples_together() as u64]),
        (PREDICTOR, SHORT, vec![layout.predictor]),
        (SAMPLE_FORMAT, SHORT, vec![format]),
    ];
    match layout.cut {
        Cut::Strips(rows) => entries.extend([
            (STRIP_OFFSETS, LONG, offsets),
            number(ROWS_PER_STRIP, rows),
            (STRIP_BYTE_COUNTS, LONG, counts),
        ]),
        Cut::Tiles(width, length) => entries.extend([
            number(TILE_WIDTH, width),
            number(TILE_LENGTH, length),
            (TILE_OFFSETS, LONG, offsets),
            (TILE_BYTE_COUNTS, LONG, counts),
        ]),
    }
    let tables = layout.jpeg_tables.iter().flatten().map(|byte| u64::from(*byte)).collect::<Vec<_>>();
    if !tables.is_empty() {
        entries.push((JPEG_TABLES, UNDEFINED, tables));
    }
    written(layout.is_little, &entries, &[], end)
}
