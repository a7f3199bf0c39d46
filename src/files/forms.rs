//! Files of text, and their form by the first bytes: UTF-8 or UTF-16, or another known format.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use crate::{Error, Result};

/// A form other than text in UTF-8.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Form {
    /// Describes a file of this form.
    pub name: &'static str,
    /// A command that converts it to text in UTF-8; none for a document.
    command: Option<&'static str>,
}

impl Form {
    const fn undone_by(name: &'static str, command: &'static str) -> Self {
        Self { name, command: Some(command) }
    }

    const fn document(name: &'static str) -> Self {
        Self { name, command: None }
    }

    /// The remedy, if a command converts it to text.
    pub fn way_out(&self) -> Option<String> {
        self.command.map(|command| format!("run it through {command} first"))
    }
}

/// First bytes of forms other than text in UTF-8 or UTF-16; without a mark, the encoding of the beginning of
/// JSON.
const FORMS: [(&[u8], Form); 11] = [
    (b"\x1f\x8b", Form::undone_by("compressed by gzip", "gzip -dc")),
    (b"\x28\xb5\x2f\xfd", Form::undone_by("compressed by zstd", "zstd -dc")),
    (b"\xfd7zXZ\0", Form::undone_by("compressed by xz", "xz -dc")),
    (b"BZh", Form::undone_by("compressed by bzip2", "bzip2 -dc")),
    (b"PK\x03\x04", Form::undone_by("a zip archive, as spreadsheets are (XLSX, ODS)", "unzip -p")),
    (b"\xd0\xcf\x11\xe0", Form::document("a spreadsheet (XLS)")),
    (b"%PDF", Form::document("a PDF document")),
    (b"\xff\xfe\0\0", Form::undone_by(UTF_32, "iconv -f UTF-32 -t UTF-8")),
    (b"\0\0\xfe\xff", Form::undone_by(UTF_32, "iconv -f UTF-32 -t UTF-8")),
    (b"{\0\0\0", Form::undone_by(UTF_32, "iconv -f UTF-32LE -t UTF-8")),
    (b"\0\0\0{", Form::undone_by(UTF_32, "iconv -f UTF-32BE -t UTF-8")),
];
const UTF_32: &str = "text in UTF-32";
const NO_TEXT: Form = Form::document("not text");

/// Some programs put this before text in UTF-8.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// Text without the byte order mark.
pub(crate) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes)
}

/// The form of a JSON file by its first bytes, if it is not text in UTF-8.
pub(crate) fn other_form(bytes: &[u8]) -> Option<Form> {
    let in_utf_16 = || {
        let (order, command) = utf_16(bytes)?;
        let first = from_utf_16(&bytes[..bytes.len().min(2)], order);
        first.starts_with(['\u{feff}', '{']).then_some(Form::undone_by("text in UTF-16", command))
    };
    no_text(bytes).or_else(in_utf_16)
}

/// The form of a file that contains no readable text.
fn no_text(bytes: &[u8]) -> Option<Form> {
    FORMS.iter().find(|(beginning, _)| bytes.starts_with(beginning)).map(|(_, form)| *form)
}

/// The text of a file, with lines ended by `\n`.
pub(crate) struct Text {
    pub text: String,
    /// Whether its encoding is known: if not, letters beyond ASCII are unknown.
    pub is_unicode: bool,
}

impl Text {
    /// UTF-8 or UTF-16, with or without a byte order mark; otherwise an encoding of eight bits per letter.
    ///
    /// # Errors
    /// The form of the file, if it is not text.
    pub fn decode(bytes: &[u8]) -> std::result::Result<Self, Form> {
        if let Some(form) = no_text(bytes) {
            return Err(form);
        }
        let (text, is_unicode) = match utf_16(bytes) {
            Some((order, _)) => (from_utf_16(bytes, order), true),
            None => (String::from_utf8_lossy(bytes).into_owned(), std::str::from_utf8(bytes).is_ok()),
        };
        if text.contains('\0') {
            return Err(NO_TEXT);
        }
        let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
        Ok(Self { text: text.replace("\r\n", "\n").replace('\r', "\n"), is_unicode })
    }
}

/// Larger than any table of spectra, or a list of regions for a hundred thousand photographs.
const MAX_BYTES: u64 = 64 << 20;
/// Describes a file that is larger.
pub(crate) const TOO_LARGE: &str = "the file is larger than 64 MiB";

/// All of a file, none if it is larger than 64 MiB; `-` is standard input.
///
/// # Errors
/// [`Error::File`] if it cannot be read.
pub(crate) fn bytes(path: &Path) -> Result<Option<Vec<u8>>> {
    let failed = |source| Error::file(path.display(), source);
    let file: Box<dyn Read> = if path == Path::new("-") {
        Box::new(io::stdin())
    } else {
        Box::new(File::open(path).map_err(failed)?)
    };
    let mut bytes = Vec::new();
    file.take(MAX_BYTES + 1).read_to_end(&mut bytes).map_err(failed)?;
    Ok((bytes.len() as u64 <= MAX_BYTES).then_some(bytes))
}

/// The lines of a text in UTF-8 or UTF-16; `-` is standard input.
///
/// # Errors
/// [`Error::File`] if it cannot be read, is larger than 64 MiB or is no such text.
///
/// # Example
/// ```
/// let folder = tempfile::tempdir().unwrap();
/// let path = folder.path().join("list.txt");
/// std::fs::write(&path, "\u{feff}a.tif\r\nb.tif\r\n").unwrap();
/// assert_eq!(vfold::files::lines(&path)?, ["a.tif", "b.tif"]);
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn lines(path: &Path) -> Result<Vec<String>> {
    let other = |what: String| Error::file(path.display(), io::Error::new(io::ErrorKind::InvalidData, what));
    let bytes = bytes(path)?.ok_or_else(|| other(TOO_LARGE.to_owned()))?;
    let Text { text, is_unicode } = Text::decode(&bytes).map_err(|form| {
        let remedy = form.way_out().map(|remedy| format!("; {remedy}"));
        other(format!("the file is {}{}", form.name, remedy.unwrap_or_default()))
    })?;
    if !is_unicode {
        return Err(other("not text in UTF-8".to_owned()));
    }
    Ok(text.lines().map(str::to_owned).collect())
}

/// Converts two bytes to a number.
type ByteOrder = fn([u8; 2]) -> u16;

/// The byte order of UTF-16, by its mark or else by the zeros in its ASCII letters; and a command that
/// converts it to UTF-8.
fn utf_16(bytes: &[u8]) -> Option<(ByteOrder, &'static str)> {
    /// Number of bytes examined.
    const START: usize = 256;
    const BY_ITS_MARK: &str = "iconv -f UTF-16 -t UTF-8";
    match bytes {
        [0xff, 0xfe, ..] => Some((u16::from_le_bytes, BY_ITS_MARK)),
        [0xfe, 0xff, ..] => Some((u16::from_be_bytes, BY_ITS_MARK)),
        _ => {
            let pairs = bytes[..bytes.len().min(START)].chunks_exact(2);
            let zeros = |at: usize| pairs.clone().filter(|pair| pair[at] == 0).count();
            match (zeros(0), zeros(1)) {
                (0, second) if 2 * second > pairs.len() => {
                    Some((u16::from_le_bytes, "iconv -f UTF-16LE -t UTF-8"))
                }
                (first, 0) if 2 * first > pairs.len() => {
                    Some((u16::from_be_bytes, "iconv -f UTF-16BE -t UTF-8"))
                }
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
        let Text { text, is_unicode } = Text::decode(bytes).ok().unwrap();
        (text, is_unicode)
    }

    /// As encoded by `iconv` of the GNU C library.
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
        for (bytes, name, way_out) in [
            (&b"\x1f\x8b\x08\0"[..], "compressed by gzip", Some("run it through gzip -dc first")),
            (b"\x28\xb5\x2f\xfd\x04", "compressed by zstd", Some("run it through zstd -dc first")),
            (b"\xff\xfe\0\0n\0\0\0", "text in UTF-32", Some("run it through iconv -f UTF-32 -t UTF-8 first")),
            (b"\xd0\xcf\x11\xe0\xa1", "a spreadsheet (XLS)", None),
            (b"\x7fELF\x02\x01\x01\0\0\0\0\0", "not text", None),
        ] {
            let form = Text::decode(bytes).err().unwrap();
            assert_eq!((form.name, form.way_out().as_deref()), (name, way_out));
        }
    }

    #[test]
    fn no_more_is_read_than_a_text_may_hold() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("list.txt");
        let file = File::create(&path).unwrap();
        file.set_len(MAX_BYTES).unwrap();
        assert!(bytes(&path).unwrap().is_some());
        file.set_len(MAX_BYTES + 1).unwrap();
        assert!(bytes(&path).unwrap().is_none());
        assert!(lines(&path).unwrap_err().to_string().contains(TOO_LARGE));
    }

    /// Lines read one by one must be in UTF-8.
    #[test]
    fn lines_in_utf_16_are_named() {
        for (bytes, encoding) in [
            (&b"\xff\xfe{\0}\0\n"[..], "UTF-16"),
            (b"\xfe\xff\0{\0}\0\n", "UTF-16"),
            (b"{\0}\0\n", "UTF-16LE"),
            (b"\0{\0}\0\n", "UTF-16BE"),
        ] {
            let form = other_form(bytes).unwrap();
            let way_out = format!("run it through iconv -f {encoding} -t UTF-8 first");
            assert_eq!((form.name, form.way_out()), ("text in UTF-16", Some(way_out)));
        }
        assert!(other_form(b"{}\n").is_none() && other_form(b"\0\xff\n").is_none());
    }
}
