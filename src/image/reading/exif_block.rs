//! The block that holds EXIF, which has the layout of a TIFF file; a TIFF file is its own block.

use std::collections::BTreeSet;
use std::io::{self, Read, Seek, SeekFrom};

use super::tiff::tags::{DIRECTORIES_MAX, ENTRY_BYTES, LONG, SHORT, value_bytes};

/// Pointers to the directories of EXIF, GPS and interoperability.
const POINTERS: [u16; 3] = [0x8769, 0x8825, 0xa005];
/// Type of pointers as libtiff writes them.
const IFD: u16 = 13;
/// More bytes than a value of the camera's notes has; pictures and notes of makers are longer.
const VALUE_BYTES_MAX: u64 = 1 << 16;
/// Bytes before the first directory.
const HEADER_BYTES: usize = 8;

/// The directories and their short values, all in their places. What lies in between, such as pixels, is left
/// blank: a large file is not read as a whole.
pub(super) fn block(file: &mut (impl Read + Seek)) -> io::Result<Vec<u8>> {
    let length = file.seek(SeekFrom::End(0))?;
    let mut block = Block { bytes: vec![0; length as usize], is_little: true };
    block.fill(file, 0, HEADER_BYTES)?;
    block.is_little = block.bytes.starts_with(b"II");
    let (mut places, mut done) = (vec![block.long(4)], BTreeSet::new());
    // values may share their bytes, so a small file could claim any number of them
    let mut left = length;
    while let Some(place) = places.pop() {
        if done.len() == DIRECTORIES_MAX || !done.insert(place) {
            continue;
        }
        let table = place as usize + 2;
        block.fill(file, place as usize, 2)?;
        let end = table + ENTRY_BYTES * usize::from(block.short(place as usize));
        block.fill(file, table, end + 4 - table)?;
        places.extend(Some(block.long(end)).filter(|next| *next != 0));
        for entry in (table..end).step_by(ENTRY_BYTES) {
            let (kind, count) = (block.short(entry + 2), block.long(entry + 4));
            let size = value_bytes(kind) * u64::from(count);
            if POINTERS.contains(&block.short(entry)) {
                places.push(block.pointer(entry));
            } else if size > 4 && size <= VALUE_BYTES_MAX.min(left) {
                block.fill(file, block.long(entry + 8) as usize, size as usize)?;
                left -= size;
            }
        }
    }
    Ok(block.bytes)
}

struct Block {
    bytes: Vec<u8>,
    is_little: bool,
}

impl Block {
    /// Reads a part of it, as far as the file reaches.
    fn fill(&mut self, file: &mut (impl Read + Seek), from: usize, count: usize) -> io::Result<()> {
        let to = from.saturating_add(count).min(self.bytes.len());
        let Some(part) = self.bytes.get_mut(from..to) else { return Ok(()) };
        file.seek(SeekFrom::Start(from as u64))?;
        file.read_exact(part)
    }

    /// The number of two bytes at a place; 0 beyond the end.
    fn short(&self, at: usize) -> u16 {
        let Some(&[a, b]) = self.bytes.get(at..at + 2) else { return 0 };
        if self.is_little { u16::from_le_bytes([a, b]) } else { u16::from_be_bytes([a, b]) }
    }

    /// The same of four bytes.
    fn long(&self, at: usize) -> u32 {
        let Some(&[a, b, c, d]) = self.bytes.get(at..at + 4) else { return 0 };
        if self.is_little { u32::from_le_bytes([a, b, c, d]) } else { u32::from_be_bytes([a, b, c, d]) }
    }

    /// Where the pointer of an entry leads. Its type becomes LONG if it is IFD: both have four bytes, and the
    /// parser knows only the former.
    fn pointer(&mut self, entry: usize) -> u32 {
        let kind = self.short(entry + 2);
        if kind == IFD {
            let long = if self.is_little { LONG.to_le_bytes() } else { LONG.to_be_bytes() };
            self.bytes[entry + 2..entry + 4].copy_from_slice(&long);
        }
        if kind == SHORT { self.short(entry + 8).into() } else { self.long(entry + 8) }
    }
}
