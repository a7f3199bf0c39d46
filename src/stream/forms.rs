//! Files that hold lines of JSON in another form than as text in UTF-8.

/// What some programs put before text in UTF-8.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// How other forms begin, the longer of two alike first: what they are, and what makes lines of JSON of them.
const FORMS: [(&[u8], &str, &str); 13] = [
    (b"\x1f\x8b", "compressed by gzip", "gzip -dc"),
    (b"\x28\xb5\x2f\xfd", "compressed by zstd", "zstd -dc"),
    (b"\xfd7zXZ\0", "compressed by xz", "xz -dc"),
    (b"BZh", "compressed by bzip2", "bzip2 -dc"),
    (b"PK\x03\x04", "a zip archive", "unzip -p"),
    (b"\xff\xfe\0\0", "text in UTF-32", "iconv -f UTF-32 -t UTF-8"),
    (b"\0\0\xfe\xff", "text in UTF-32", "iconv -f UTF-32 -t UTF-8"),
    (b"{\0\0\0", "text in UTF-32", "iconv -f UTF-32LE -t UTF-8"),
    (b"\0\0\0{", "text in UTF-32", "iconv -f UTF-32BE -t UTF-8"),
    (b"\xff\xfe", "text in UTF-16", "iconv -f UTF-16 -t UTF-8"),
    (b"\xfe\xff", "text in UTF-16", "iconv -f UTF-16 -t UTF-8"),
    (b"{\0", "text in UTF-16", "iconv -f UTF-16LE -t UTF-8"),
    (b"\0{", "text in UTF-16", "iconv -f UTF-16BE -t UTF-8"),
];

/// What the first bytes of a file say that it is, where that is no text in UTF-8, and what to do about it.
pub(super) fn other_form(bytes: &[u8]) -> Option<(String, String)> {
    let (_, form, command) = FORMS.iter().find(|(beginning, ..)| bytes.starts_with(beginning))?;
    Some((format!("{form}, not lines of JSON in UTF-8"), format!("put it through {command} first")))
}

/// Text without the mark before it.
pub(super) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes)
}
