//! Contents of a TIFF file's directories, tag by tag.

use std::collections::BTreeMap;
use std::io::{self, Read, Seek, SeekFrom};

use super::tags::{
    BITS_PER_SAMPLE, BLACK_LEVEL, BYTE, COMPRESSION, DIRECTORIES_MAX, DNG_VERSION, DOUBLE, ENTRY_BYTES,
    EXTRA_SAMPLES, FILL_ORDER, FLOAT, HEIGHT, JPEG_TABLES, LONG, NEW_SUBFILE_TYPE, PHOTOMETRIC,
    PLANAR_CONFIGURATION, PREDICTOR, PRIMARIES, PROFILE, RATIONAL, REFERENCE_BLACK_WHITE, ROWS_PER_STRIP,
    SAMPLE_FORMAT, SAMPLES_PER_PIXEL, SHORT, STRIP_BYTE_COUNTS, STRIP_OFFSETS, SUB_DIRECTORIES,
    TILE_BYTE_COUNTS, TILE_LENGTH, TILE_OFFSETS, TILE_WIDTH, TRANSFER_FUNCTION, WHITE_LEVEL, WHITE_POINT,
    WIDTH, X_RESOLUTION, Y_RESOLUTION, value_bytes,
};

/// The tags whose values are read.
const READ: [u16; 30] = [
    NEW_SUBFILE_TYPE,
    WIDTH,
    HEIGHT,
    BITS_PER_SAMPLE,
    COMPRESSION,
    PHOTOMETRIC,
    FILL_ORDER,
    STRIP_OFFSETS,
    SAMPLES_PER_PIXEL,
    ROWS_PER_STRIP,
    STRIP_BYTE_COUNTS,
    X_RESOLUTION,
    Y_RESOLUTION,
    PLANAR_CONFIGURATION,
    TRANSFER_FUNCTION,
    PREDICTOR,
    WHITE_POINT,
    PRIMARIES,
    TILE_WIDTH,
    TILE_LENGTH,
    TILE_OFFSETS,
    TILE_BYTE_COUNTS,
    EXTRA_SAMPLES,
    SAMPLE_FORMAT,
    JPEG_TABLES,
    REFERENCE_BLACK_WHITE,
    PROFILE,
    DNG_VERSION,
    BLACK_LEVEL,
    WHITE_LEVEL,
];

/// The contents of a directory.
#[derive(Default)]
pub(super) struct Directory {
    pub is_little: bool,
    values: BTreeMap<u16, Values>,
    has_sub_directories: bool,
    next: u32,
}

/// The values of a tag; empty if they lie beyond the end of the file, or if those of all tags together would
/// exceed it.
struct Values {
    kind: u16,
    bytes: Vec<u8>,
}

/// The directories of a file of this length; at least the first must be readable.
pub(super) fn read_all(file: &mut (impl Read + Seek), length: u64) -> io::Result<Vec<Directory>> {
    let mut head = [0; 8];
    file.rewind()?;
    file.read_exact(&mut head)?;
    let is_little = head.starts_with(b"II");
    let mut place = u32_of(is_little, [head[4], head[5], head[6], head[7]]);
    let mut places = Vec::new();
    let mut directories = Vec::new();
    let mut taken = 0;
    while place != 0 && !places.contains(&place) && directories.len() < DIRECTORIES_MAX {
        places.push(place);
        match Directory::read(file, (length, &mut taken), is_little, place) {
            Ok(directory) => {
                place = directory.next;
                directories.push(directory);
            }
            Err(error) if directories.is_empty() => return Err(error),
            Err(_) => break,
        }
    }
    if directories.is_empty() { Err(io::ErrorKind::UnexpectedEof.into()) } else { Ok(directories) }
}

impl Directory {
    /// If a tag occurs twice, the first counts.
    fn read(
        file: &mut (impl Read + Seek),
        (length, taken): (u64, &mut u64),
        is_little: bool,
        place: u32,
    ) -> io::Result<Self> {
        file.seek(SeekFrom::Start(place.into()))?;
        let mut count = [0; 2];
        file.read_exact(&mut count)?;
        let mut table = vec![0; ENTRY_BYTES * usize::from(u16_of(is_little, count)) + 4];
        file.read_exact(&mut table)?;
        let (entries, next) = table.split_at(table.len() - 4);
        let next = u32_of(is_little, [next[0], next[1], next[2], next[3]]);
        let mut directory = Self { is_little, next, ..Self::default() };
        for entry in entries.chunks_exact(ENTRY_BYTES) {
            let tag = u16_of(is_little, [entry[0], entry[1]]);
            directory.has_sub_directories |= tag == SUB_DIRECTORIES;
            if READ.contains(&tag) && !directory.has(tag) {
                let kind = u16_of(is_little, [entry[2], entry[3]]);
                let count = u32_of(is_little, [entry[4], entry[5], entry[6], entry[7]]);
                let inline = [entry[8], entry[9], entry[10], entry[11]];
                let bytes = bytes(file, (length, &mut *taken), is_little, (kind, count), inline)?;
                directory.values.insert(tag, Values { kind, bytes });
            }
        }
        Ok(directory)
    }

    pub fn has(&self, tag: u16) -> bool {
        self.values.contains_key(&tag)
    }

    pub fn has_sub_directories(&self) -> bool {
        self.has_sub_directories
    }

    /// The bytes of a tag.
    pub fn bytes(&self, tag: u16) -> Option<&[u8]> {
        self.values.get(&tag).map(|values| values.bytes.as_slice())
    }

    /// The integers of a tag.
    pub fn numbers(&self, tag: u16) -> Option<Vec<u64>> {
        let Values { kind, bytes } = self.values.get(&tag)?;
        let numbers: Vec<u64> = match *kind {
            BYTE => bytes.iter().map(|byte| (*byte).into()).collect(),
            SHORT => {
                bytes.chunks_exact(2).map(|two| u16_of(self.is_little, [two[0], two[1]]).into()).collect()
            }
            LONG => self.longs(bytes).map(u64::from).collect(),
            _ => return None,
        };
        Some(numbers).filter(|numbers| !numbers.is_empty())
    }

    /// The first integer of a tag.
    pub fn number(&self, tag: u16) -> Option<u64> {
        self.numbers(tag)?.first().copied()
    }

    /// The numbers of a tag of a fractional type.
    pub fn reals(&self, tag: u16) -> Option<Vec<f64>> {
        let Values { kind, bytes } = self.values.get(&tag)?;
        match *kind {
            RATIONAL => {
                let longs: Vec<_> = self.longs(bytes).collect();
                Some(longs.chunks_exact(2).map(|ratio| f64::from(ratio[0]) / f64::from(ratio[1])).collect())
            }
            FLOAT => Some(self.longs(bytes).map(|bits| f32::from_bits(bits).into()).collect()),
            DOUBLE => {
                let longs: Vec<_> = self.longs(bytes).map(u64::from).collect();
                let (low, high) = if self.is_little { (0, 1) } else { (1, 0) };
                Some(longs.chunks_exact(2).map(|two| f64::from_bits(two[high] << 32 | two[low])).collect())
            }
            _ => Some(self.numbers(tag)?.into_iter().map(|number| number as f64).collect()),
        }
    }

    fn longs<'a>(&self, bytes: &'a [u8]) -> impl Iterator<Item = u32> + use<'a> {
        let is_little = self.is_little;
        bytes.chunks_exact(4).map(move |four| u32_of(is_little, [four[0], four[1], four[2], four[3]]))
    }
}

/// The bytes of a number of values of one type, which are in the entry itself if they fit. `taken` counts
/// those that are not: entries may share their values, so a small file could claim any number of them.
fn bytes(
    file: &mut (impl Read + Seek),
    (length, taken): (u64, &mut u64),
    is_little: bool,
    (kind, count): (u16, u32),
    inline: [u8; 4],
) -> io::Result<Vec<u8>> {
    let size = value_bytes(kind) * u64::from(count);
    if size <= 4 {
        return Ok(inline[..size as usize].to_vec());
    }
    let place = u64::from(u32_of(is_little, inline));
    if place + size > length || *taken + size > length {
        return Ok(Vec::new());
    }
    *taken += size;
    let mut bytes = vec![0; size as usize];
    file.seek(SeekFrom::Start(place))?;
    file.read_exact(&mut bytes)?;
    Ok(bytes)
}

fn u16_of(is_little: bool, bytes: [u8; 2]) -> u16 {
    if is_little { u16::from_le_bytes(bytes) } else { u16::from_be_bytes(bytes) }
}

fn u32_of(is_little: bool, bytes: [u8; 4]) -> u32 {
    if is_little { u32::from_le_bytes(bytes) } else { u32::from_be_bytes(bytes) }
}

/// A little-endian file of directories with these entries each: tag, type, count, value.
#[cfg(test)]
pub(super) fn file(directories: &[&[(u16, u16, u32, u32)]]) -> Vec<u8> {
    let mut bytes = b"II*\0\x08\0\0\0".to_vec();
    for (n, entries) in directories.iter().enumerate() {
        bytes.extend((entries.len() as u16).to_le_bytes());
        for (tag, kind, count, value) in *entries {
            bytes.extend(tag.to_le_bytes().into_iter().chain(kind.to_le_bytes()));
            bytes.extend(count.to_le_bytes().into_iter().chain(value.to_le_bytes()));
        }
        let next = if n + 1 < directories.len() { bytes.len() as u32 + 4 } else { 0 };
        bytes.extend(next.to_le_bytes());
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(bytes: &[u8]) -> io::Result<Vec<Directory>> {
        read_all(&mut io::Cursor::new(bytes), bytes.len() as u64)
    }

    #[test]
    fn values_lie_in_the_entry_or_elsewhere() {
        let mut whole =
            file(&[&[(WIDTH, SHORT, 1, 80), (BITS_PER_SAMPLE, SHORT, 3, 50), (PROFILE, 7, 99, 0)]]);
        assert_eq!(whole.len(), 50);
        whole.extend([16, 0, 16, 0, 16, 0]);
        let directories = read(&whole).unwrap();
        assert_eq!(directories[0].number(WIDTH), Some(80));
        assert_eq!(directories[0].numbers(BITS_PER_SAMPLE), Some(vec![16; 3]));
        assert_eq!(directories[0].bytes(PROFILE), Some(&[][..]), "it claims more than the file has");
        assert!(directories[0].numbers(HEIGHT).is_none());
    }

    #[test]
    fn values_are_no_longer_than_the_file() {
        // two directories of 30 and 18 bytes, the first with a tag twice; a file of 60 bytes
        let mut whole = file(&[&[(PROFILE, 7, 20, 0), (PROFILE, 7, 30, 0)], &[(PROFILE, 7, 30, 0)]]);
        whole.resize(60, 0);
        let lengths = |bytes: &[u8]| {
            let directories = read(bytes).unwrap();
            directories.iter().map(|directory| directory.bytes(PROFILE).unwrap().len()).collect::<Vec<_>>()
        };
        assert_eq!(lengths(&whole), [20, 30]);
        whole[14] = 31; // 31 and 30 bytes of 60
        assert_eq!(lengths(&whole)[1], 0);
    }

    #[test]
    fn chains_end() {
        let mut circle = file(&[&[(WIDTH, SHORT, 1, 1)], &[(WIDTH, SHORT, 1, 2)]]);
        assert_eq!(read(&circle).unwrap().len(), 2);
        let end = circle.len();
        circle[end - 4] = 8;
        assert_eq!(read(&circle).unwrap().len(), 2);
        circle[end - 4] = 200; // beyond the end
        assert_eq!(read(&circle).unwrap().len(), 2);
        assert!(
            read(b"II*\0\xff\xff\xff\xff").is_err()
                && read(b"II*\0\0\0\0\0").is_err()
                && read(b"II").is_err()
        );
    }
}
