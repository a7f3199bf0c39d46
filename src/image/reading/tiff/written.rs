//! A directory in the form of a file.

use super::tags::{ENTRY_BYTES, LONG, SHORT};

/// A directory at offset `at`, from entries by tag, type and numbers, and from entries copied from another
/// directory of the file, by tag and bytes; values that do not fit into their entries follow it.
pub(in crate::image::reading) fn written(
    is_little: bool,
    entries: &[(u16, u16, Vec<u64>)],
    copied: &[(u16, [u8; ENTRY_BYTES])],
    at: u64,
) -> Vec<u8> {
    let count = entries.len() + copied.len();
    let behind_at = at + 2 + (ENTRY_BYTES * count) as u64 + 4;
    let mut behind = Vec::new();
    let mut all: Vec<(u16, Vec<u8>)> = copied.iter().map(|(tag, entry)| (*tag, entry.to_vec())).collect();
    for (tag, kind, numbers) in entries {
        let mut values: Vec<u8> = match *kind {
            SHORT => numbers.iter().flat_map(|number| short(is_little, *number)).collect(),
            LONG => numbers.iter().flat_map(|number| long(is_little, *number)).collect(),
            _ => numbers.iter().map(|number| *number as u8).collect(),
        };
        if values.len() > 4 {
            let place = long(is_little, behind_at + behind.len() as u64);
            behind.extend(values);
            values = place.to_vec();
        }
        values.resize(4, 0);
        let [tag_bytes, kind] = [*tag, *kind].map(|number| short(is_little, number.into()));
        let length = long(is_little, numbers.len() as u64);
        all.push((*tag, [&tag_bytes[..], &kind, &length, &values].concat()));
    }
    all.sort_by_key(|(tag, _)| *tag);
    let mut bytes = short(is_little, count as u64).to_vec();
    bytes.extend(all.into_iter().flat_map(|(_, entry)| entry));
    bytes.extend([0; 4]);
    bytes.extend(behind);
    bytes
}

fn short(is_little: bool, number: u64) -> [u8; 2] {
    if is_little { (number as u16).to_le_bytes() } else { (number as u16).to_be_bytes() }
}

/// The four bytes of a number, such as the offset of a directory.
pub(in crate::image::reading) fn long(is_little: bool, number: u64) -> [u8; 4] {
    if is_little { (number as u32).to_le_bytes() } else { (number as u32).to_be_bytes() }
}

#[cfg(test)]
mod tests {
    use super::super::directory::read_all;
    use super::super::tags::{HEIGHT, PROFILE, STRIP_OFFSETS, UNDEFINED, WIDTH};
    use super::*;

    #[test]
    fn what_is_written_is_read_again() {
        for is_little in [true, false] {
            let head = if is_little { *b"II*\0" } else { *b"MM\0*" };
            let copied = [&short(is_little, HEIGHT.into())[..], &short(is_little, LONG.into())].concat();
            let copied = [copied, [long(is_little, 1), long(is_little, 70_000)].concat()].concat();
            let entries = [
                (PROFILE, UNDEFINED, vec![7; 5]),
                (STRIP_OFFSETS, LONG, vec![70_000, 8]),
                (WIDTH, SHORT, vec![300]),
            ];
            let copied = [(HEIGHT, copied.try_into().unwrap())];
            let directory = written(is_little, &entries, &copied, 8);
            let file = [&head[..], &long(is_little, 8), &directory].concat();
            let read = read_all(&mut std::io::Cursor::new(&file), file.len() as u64).unwrap();
            assert_eq!(read[0].number(WIDTH), Some(300));
            assert_eq!(read[0].number(HEIGHT), Some(70_000));
            assert_eq!(read[0].numbers(STRIP_OFFSETS), Some(vec![70_000, 8]));
            assert_eq!(read[0].bytes(PROFILE), Some(&[7; 5][..]));
            // decoders may use binary search
            let tags = directory[2..].chunks_exact(ENTRY_BYTES).take(4).map(|entry| [entry[0], entry[1]]);
            let sorted = [WIDTH, HEIGHT, STRIP_OFFSETS, PROFILE].map(|tag| short(is_little, tag.into()));
            assert!(tags.eq(sorted));
        }
    }
}
