//! The directories of TIFF files, with which most RAW files begin: whether a decoder can read them.
//!
//! A decoder makes room for what an entry claims before it looks for it, and asking for more memory than there is gives no error to
//! catch: the program ends. A decoder that follows directories in a circle never ends.

/// Entries that lead to further directories: `SubIFDs`, EXIF and GPS.
const POINTERS: [u16; 3] = [330, 34665, 34853];
/// Bytes of a value, by type from 1 on.
const SIZES: [u64; 12] = [1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8];
/// A camera writes a dozen directories,
const DIRECTORIES_MAX: usize = 64;
/// and entries that lead out of the file are rare.
const ASTRAY_MAX: usize = 4;
const ENTRY_BYTES: usize = 12;

/// Why no decoder should see this file; none if it may, or is no TIFF.
pub(super) fn fault(file: &[u8]) -> Option<String> {
    if !(file.starts_with(b"II") || file.starts_with(b"MM")) {
        return None;
    }
    let tiff = Tiff { file, is_little: file.starts_with(b"II") };
    let mut waiting = vec![tiff.u32(4)?];
    let mut seen = 0;
    while let Some(directory) = waiting.pop() {
        seen += 1;
        if seen > DIRECTORIES_MAX {
            return Some(format!("more than {DIRECTORIES_MAX} directories"));
        }
        let mut astray = 0;
        for entry in tiff.entries(directory as usize) {
            if entry.bytes() > file.len() as u64 {
                return Some(format!("tag {} claims more than the file has", entry.tag));
            }
            astray += usize::from(!tiff.has(&entry));
            if POINTERS.contains(&entry.tag) {
                waiting.extend(tiff.longs(&entry));
            }
        }
        if astray > ASTRAY_MAX {
            return Some("a directory leads out of the file".to_owned());
        }
        waiting.extend(tiff.next(directory as usize));
    }
    None
}

struct Tiff<'a> {
    file: &'a [u8],
    is_little: bool,
}

struct Entry {
    tag: u16,
    kind: u16,
    count: u32,
    /// Where its values are, or lead to.
    values: usize,
}

impl Entry {
    fn bytes(&self) -> u64 {
        let size = SIZES.get(usize::from(self.kind).wrapping_sub(1)).unwrap_or(&1);
        size * u64::from(self.count)
    }
}

impl Tiff<'_> {
    fn u16(&self, at: usize) -> Option<u16> {
        let bytes = *self.file.get(at..)?.first_chunk()?;
        Some(if self.is_little { u16::from_le_bytes(bytes) } else { u16::from_be_bytes(bytes) })
    }

    fn u32(&self, at: usize) -> Option<u32> {
        let bytes = *self.file.get(at..)?.first_chunk()?;
        Some(if self.is_little { u32::from_le_bytes(bytes) } else { u32::from_be_bytes(bytes) })
    }

    fn entries(&self, directory: usize) -> impl Iterator<Item = Entry> {
        let count = self.u16(directory).unwrap_or(0);
        (0..usize::from(count)).map_while(move |n| {
            let at = directory + 2 + ENTRY_BYTES * n;
            Some(Entry {
                tag: self.u16(at)?,
                kind: self.u16(at + 2)?,
                count: self.u32(at + 4)?,
                values: at + 8,
            })
        })
    }

    /// Whether the values of an entry are in the file.
    fn has(&self, entry: &Entry) -> bool {
        let place = self.u32(entry.values).filter(|_| entry.bytes() > 4);
        place.is_none_or(|place| u64::from(place) + entry.bytes() <= self.file.len() as u64)
    }

    /// The numbers of an entry of LONG.
    fn longs(&self, entry: &Entry) -> impl Iterator<Item = u32> {
        let first = if entry.count > 1 { self.u32(entry.values) } else { Some(entry.values as u32) };
        let place = move |n: usize| Some(first? as usize + 4 * n);
        (0..entry.count as usize).take(DIRECTORIES_MAX + 1).map_while(move |n| self.u32(place(n)?))
    }

    /// The directory after this one.
    fn next(&self, directory: usize) -> Option<u32> {
        let count = usize::from(self.u16(directory)?);
        self.u32(directory + 2 + ENTRY_BYTES * count).filter(|next| *next != 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A directory of one entry, and what comes after it.
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
        assert_eq!(fault(&tiff(256, 4, 2, 1 << 30, &[])), None); // leads out of the file, alone
    }
}
