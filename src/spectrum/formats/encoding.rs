//! Bytes of a file as text: in which encoding they are, and what is no text at all.

use super::{Place, Result};

/// What programs put before text or, compressed or in a form of their own, in its place: first bytes, what the file is, and the way out.
const NO_TEXT: [(&[u8], &str, &str); 8] = [
    (b"\x1f\x8b", "compressed with gzip", UNPACK),
    (b"\x28\xb5\x2f\xfd", "compressed with Zstandard", UNPACK),
    (b"BZh", "compressed with bzip2", UNPACK),
    (b"\xfd7zXZ", "compressed with XZ", UNPACK),
    (b"PK\x03\x04", "a spreadsheet (XLSX, ODS) or another ZIP archive", EXPORT),
    (b"\xd0\xcf\x11\xe0", "a spreadsheet (XLS)", EXPORT),
    (b"%PDF", "a PDF document", EXPORT),
    (b"\xff\xfe\0\0", "text in UTF-32", EXPORT),
];
const UNPACK: &str = "unpack it first";
const EXPORT: &str = "save the table as CSV in UTF-8";

/// The text of a file, its lines ended by `\n`.
pub(super) struct Text {
    pub text: String,
    /// Whether its encoding is known: if not, no letter beyond ASCII is.
    pub is_unicode: bool,
}

impl Text {
    /// UTF-8 or UTF-16, either with or without a byte order mark; else an encoding of eight bits a letter.
    ///
    /// # Errors
    /// [`crate::Error::Table`] with what the file is, if it is no text.
    pub fn decode(path: &str, bytes: &[u8]) -> Result<Self> {
        let at = Place { path, line: 1 };
        if let Some((_, what, remedy)) = NO_TEXT.iter().find(|(start, ..)| bytes.starts_with(start)) {
            return Err(at.fails(format!("the file is {what}"), *remedy));
        }
        let (text, is_unicode) = match utf_16(bytes) {
            Some(order) => (from_utf_16(bytes, order), true),
            None => (String::from_utf8_lossy(bytes).into_owned(), std::str::from_utf8(bytes).is_ok()),
        };
        if text.contains('\0') {
            return Err(at.fails("the file is no text", EXPORT));
        }
        let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
        Ok(Self { text: text.replace("\r\n", "\n").replace('\r', "\n"), is_unicode })
    }
}

/// How to read two bytes as a number.
type ByteOrder = fn([u8; 2]) -> u16;

/// The byte order of UTF-16: by its mark, else by the zeros that letters of ASCII have in it.
fn utf_16(bytes: &[u8]) -> Option<ByteOrder> {
    /// So much is looked at.
    const START: usize = 256;
    match bytes {
        [0xff, 0xfe, ..] => Some(u16::from_le_bytes),
        [0xfe, 0xff, ..] => Some(u16::from_be_bytes),
        _ => {
            let pairs = bytes[..bytes.len().min(START)].chunks_exact(2);
            let zeros = |at: usize| pairs.clone().filter(|pair| pair[at] == 0).count();
            match (zeros(0), zeros(1)) {
                (0, second) if 2 * second > pairs.len() => Some(u16::from_le_bytes),
                (first, 0) if 2 * first > pairs.len() => Some(u16::from_be_bytes),
                _ => None,
            }
        }
    }
}

fn from_utf_16(bytes: &[u8], order: ByteOrder) -> String {
    let units = bytes.chunks_exact(2).map(|pair| order([pair[0], pair[1]]));
    char::decode_utf16(units).map(|letter| letter.unwrap_or(char::REPLACEMENT_CHARACTER)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decoded(bytes: &[u8]) -> (String, bool) {
        let Text { text, is_unicode } = Text::decode("x.csv", bytes).unwrap();
        (text, is_unicode)
    }

    /// As `iconv` of the GNU C library encodes the text.
    #[test]
    fn unicode_is_known_by_its_mark_or_its_zeros() {
        let wanted = ("µm,r\n1,2\n".to_owned(), true);
        for bytes in [
            &b"\xc2\xb5m,r\r\n1,2\r\n"[..],
            b"\xef\xbb\xbf\xc2\xb5m,r\r1,2\r",
            b"\xff\xfe\xb5\0m\0,\0r\0\n\x001\0,\x002\0\n\0",
            b"\xfe\xff\0\xb5\0m\0,\0r\0\n\x001\0,\x002\0\n",
            b"\xb5\0m\0,\0r\0\n\x001\0,\x002\0\n\0",
            b"\0\xb5\0m\0,\0r\0\n\x001\0,\x002\0\n",
        ] {
            assert_eq!(decoded(bytes), wanted, "{bytes:?}");
        }
        assert_eq!(decoded(b"\xb5m,r\n"), ("\u{fffd}m,r\n".to_owned(), false));
        assert_eq!(decoded(b""), (String::new(), true));
    }

    #[test]
    fn what_is_no_text_is_named() {
        for (bytes, want) in [
            (&b"\x1f\x8b\x08\0"[..], "x.csv:1: the file is compressed with gzip; unpack it first"),
            (
                b"PK\x03\x04\x14\0",
                "x.csv:1: the file is a spreadsheet (XLSX, ODS) or another ZIP archive; save",
            ),
            (b"\xff\xfe\0\0n\0\0\0", "x.csv:1: the file is text in UTF-32; save"),
            (b"\x7fELF\x02\x01\x01\0\0\0\0\0", "x.csv:1: the file is no text; save"),
        ] {
            let message = Text::decode("x.csv", bytes).err().unwrap().to_string();
            assert!(message.starts_with(want), "{message}");
        }
    }
}
