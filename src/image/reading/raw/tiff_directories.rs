//! The directories of TIFF files, with which most RAW files begin: their contents, and whether they are safe
//! for a decoder.
//!
//! A decoder allocates memory for what an entry claims before looking for it, and an allocation beyond the
//! available memory aborts the program without an error to catch. A decoder that follows circular directories
//! never ends.

use crate::image::reading::tiff::tags::{DIRECTORIES_MAX, ENTRY_BYTES, SUB_DIRECTORIES, value_bytes};

/// Entries that point to further directories: sub-directories, EXIF and GPS.
const POINTERS: [u16; 3] = [SUB_DIRECTORIES, 34665, 34853];
/// Largest number of entries that point outside the file.
const ASTRAY_MAX: usize = 4;

/// A TIFF file with any mark.
#[derive(Clone, Copy)]
pub(super) struct Tiff<'a> {
    file: &'a [u8],
    is_little: bool,
}

/// One of its directories.
#[derive(Clone, Copy)]
pub(super) struct Directory<'a> {
    tiff: Tiff<'a>,
    at: usize,
}

struct Entry {
    tag: u16,
    kind: u16,
    count: u32,
    /// Offset of its values, or of the pointer to them.
    values: usize,
}

/// Why no decoder should see this file; none if it is safe, or is no TIFF.
pub(super) fn fault(file: &[u8]) -> Option<String> {
    let directories = Tiff::new(file)?.directories();
    if directories.len() > DIRECTORIES_MAX {
        return Some(format!("more than {DIRECTORIES_MAX} directories"));
    }
    directories.iter().find_map(Directory::fault)
}

impl<'a> Tiff<'a> {
    /// None if the file is no TIFF.
    pub fn new(file: &'a [u8]) -> Option<Self> {
        let is_little = file.starts_with(b"II");
        (is_little || file.starts_with(b"MM")).then_some(Self { file, is_little })
    }

    /// Its directories, starting with the first; one more than the limit if they are endless.
    pub fn directories(self) -> Vec<Directory<'a>> {
        let mut found = Vec::new();
        let mut waiting: Vec<u32> = self.u32(4).into_iter().collect();
        while let Some(at) = waiting.pop() {
            let directory = Directory { tiff: self, at: at as usize };
            found.push(directory);
            if found.len() > DIRECTORIES_MAX {
                break;
            }
            for entry in directory.entries().filter(|entry| POINTERS.contains(&entry.tag)) {
                // more are too many, and each visit of a directory that points to itself would add them again
                let room = (DIRECTORIES_MAX + 1).saturating_sub(waiting.len());
                waiting.extend(self.longs(&entry).take(room));
            }
            waiting.extend(directory.next());
        }
        found
    }

    /// The whole file.
    pub fn file(self) -> &'a [u8] {
        self.file
    }

    /// Whether it is little-endian.
    pub fn is_little(self) -> bool {
        self.is_little
    }

    fn u16(self, at: usize) -> Option<u16> {
        let bytes = *self.file.get(at..)?.first_chunk()?;
        Some(if self.is_little { u16::from_le_bytes(bytes) } else { u16::from_be_bytes(bytes) })
    }

    fn u32(self, at: usize) -> Option<u32> {
        let bytes = *self.file.get(at..)?.first_chunk()?;
        Some(if self.is_little { u32::from_le_bytes(bytes) } else { u32::from_be_bytes(bytes) })
    }

    fn u64(self, at: usize) -> Option<u64> {
        let bytes = *self.file.get(at..)?.first_chunk()?;
        Some(if self.is_little { u64::from_le_bytes(bytes) } else { u64::from_be_bytes(bytes) })
    }

    /// The number of this type at an offset.
    fn number(self, kind: u16, at: usize) -> Option<f64> {
        let signed = |at| self.u32(at).map(u32::cast_signed);
        Some(match kind {
            1 | 7 => (*self.file.get(at)?).into(),
            3 => self.u16(at)?.into(),
            4 | 13 => self.u32(at)?.into(),
            5 => f64::from(self.u32(at)?) / f64::from(self.u32(at + 4)?),
            6 => self.file.get(at)?.cast_signed().into(),
            8 => self.u16(at)?.cast_signed().into(),
            9 => signed(at)?.into(),
            10 => f64::from(signed(at)?) / f64::from(signed(at + 4)?),
            11 => f32::from_bits(self.u32(at)?).into(),
            12 => f64::from_bits(self.u64(at)?),
            _ => return None,
        })
    }

    /// The numbers of an entry of type LONG.
    fn longs(self, entry: &Entry) -> impl Iterator<Item = u32> {
        let first = if entry.count > 1 { self.u32(entry.values) } else { Some(entry.values as u32) };
        let place = move |n: usize| Some(first? as usize + 4 * n);
        (0..entry.count as usize).take(DIRECTORIES_MAX + 1).map_while(move |n| self.u32(place(n)?))
    }
}

impl Entry {
    fn bytes(&self) -> u64 {
        value_bytes(self.kind) * u64::from(self.count)
    }
}

impl<'a> Directory<'a> {
    /// The numbers of a tag; none if it is absent or empty, or they are not in the file.
    pub fn numbers(&self, tag: u16) -> Option<Vec<f64>> {
        let entry = self.filled(tag)?;
        let first = self.first(&entry)?;
        let at = |n: u32| first.checked_add(n as usize * value_bytes(entry.kind) as usize);
        (0..entry.count).map(|n| self.tiff.number(entry.kind, at(n)?)).collect()
    }

    /// The first number of a tag.
    pub fn number(&self, tag: u16) -> Option<f64> {
        let entry = self.filled(tag)?;
        self.tiff.number(entry.kind, self.first(&entry)?)
    }

    /// The bytes of a tag's values.
    pub fn bytes(&self, tag: u16) -> Option<&'a [u8]> {
        let entry = self.entry(tag)?;
        let first = self.first(&entry)?;
        self.tiff.file.get(first..first.checked_add(entry.bytes() as usize)?)
    }

    /// Whether it has a tag.
    pub fn has_tag(&self, tag: u16) -> bool {
        self.entry(tag).is_some()
    }

    /// A tag's entry as stored.
    pub fn stored(&self, tag: u16) -> Option<[u8; ENTRY_BYTES]> {
        let entry = self.entry(tag)?;
        self.tiff.file.get(entry.values - 8..)?.first_chunk().copied()
    }

    /// Why no decoder should see it.
    fn fault(&self) -> Option<String> {
        let size = self.tiff.file.len() as u64;
        if let Some(entry) = self.entries().find(|entry| entry.bytes() > size) {
            return Some(format!("tag {} claims more than the file has", entry.tag));
        }
        let astray = self.entries().filter(|entry| !self.has(entry)).count();
        (astray > ASTRAY_MAX).then(|| "a directory leads out of the file".to_owned())
    }

    /// The entry of a tag with values, all in the file.
    fn filled(&self, tag: u16) -> Option<Entry> {
        self.entry(tag).filter(|entry| self.has(entry) && entry.count > 0)
    }

    fn entry(&self, tag: u16) -> Option<Entry> {
        self.entries().find(|entry| entry.tag == tag)
    }

    fn entries(&self) -> impl Iterator<Item = Entry> + use<'a> {
        let Self { tiff, at } = *self;
        (0..usize::from(tiff.u16(at).unwrap_or(0))).map_while(move |n| {
            let at = at + 2 + ENTRY_BYTES * n;
            Some(Entry {
                tag: tiff.u16(at)?,
                kind: tiff.u16(at + 2)?,
                count: tiff.u32(at + 4)?,
                values: at + 8,
            })
        })
    }

    /// Offset of an entry's values: short ones are in the entry itself.
    fn first(&self, entry: &Entry) -> Option<usize> {
        if entry.bytes() > 4 { self.tiff.u32(entry.values).map(|at| at as usize) } else { Some(entry.values) }
    }

    /// Whether the values of an entry are in the file.
    fn has(&self, entry: &Entry) -> bool {
        let place = self.tiff.u32(entry.values).filter(|_| entry.bytes() > 4);
        place.is_none_or(|place| u64::from(place) + entry.bytes() <= self.tiff.file.len() as u64)
    }

    /// The next directory.
    fn next(&self) -> Option<u32> {
        let count = usize::from(self.tiff.u16(self.at)?);
        self.tiff.u32(self.at + 2 + ENTRY_BYTES * count).filter(|next| *next != 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A directory of one entry, followed by `after`.
    fn tiff(tag: u16, kind: u16, count: u32, value: u32, after: &[u8]) -> Vec<u8> {
        let mut bytes = b"II*\0\x08\0\0\0\x01\0".to_vec();
        bytes.extend(tag.to_le_bytes().into_iter().chain(kind.to_le_bytes()));
        bytes.extend(count.to_le_bytes().into_iter().chain(value.to_le_bytes()));
        bytes.extend([0; 4]);
        bytes.extend(after);
        bytes
    }

    #[test]
    fn more_than_the_file_has_is_found_wherever_it_is() {
        assert_eq!(fault(&tiff(256, 4, 1, 640, &[])), None);
        assert!(fault(&tiff(256, 12, 1 << 30, 8, &[])).unwrap().contains("tag 256"));
        let inner = &tiff(37510, 4, 1000, 8, &[])[8..];
        assert!(fault(&tiff(330, 4, 1, 26, inner)).unwrap().contains("tag 37510"));
        assert!(fault(&tiff(34665, 4, 1, 26, inner)).unwrap().contains("tag 37510"));
    }

    #[test]
    fn circles_are_found() {
        assert!(fault(&tiff(330, 4, 1, 8, &[])).unwrap().contains("more than 64"));
        let mut circle = tiff(256, 4, 1, 640, &[]);
        circle[22] = 8;
        assert!(fault(&circle).unwrap().contains("more than 64"));
    }

    #[test]
    fn what_is_no_directory_is_passed_over() {
        assert_eq!(fault(b"II*\0\xff\xff\xff\xff"), None);
        assert_eq!(fault(b"FUJI"), None);
        assert_eq!(fault(&tiff(256, 4, 2, 1 << 30, &[])), None); // only one points outside the file
    }
}
