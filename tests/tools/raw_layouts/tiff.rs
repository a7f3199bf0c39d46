//! A writer of TIFF files with any directories.

/// Tags and their values.
pub type Directory = Vec<(u16, Value)>;

#[derive(Clone)]
pub enum Value {
    Byte(Vec<u8>),
    Ascii(&'static str),
    Short(Vec<u16>),
    Long(Vec<u32>),
    Rational(Vec<[u32; 2]>),
    SignedRational(Vec<[i32; 2]>),
    Undefined(Vec<u8>),
    /// Where these bytes are: strips or tiles.
    Pieces(Vec<Vec<u8>>),
    /// Where these directories are.
    Directories(Vec<Directory>),
}

/// Tags of a picture's strips or tiles, and their contents.
pub fn pieces([offsets, lengths]: [u16; 2], pieces: Vec<Vec<u8>>) -> Directory {
    let sizes = pieces.iter().map(|piece| piece.len() as u32).collect();
    vec![(offsets, Value::Pieces(pieces)), (lengths, Value::Long(sizes))]
}

/// The file whose first directory is this one.
pub fn tiff(first: Directory, is_big: bool) -> Vec<u8> {
    let mut file = Writer { bytes: if is_big { b"MM\0*".to_vec() } else { b"II*\0".to_vec() }, is_big };
    file.bytes.extend([0; 4]);
    let at = file.put(first);
    let at = file.long(at);
    file.bytes[4..8].copy_from_slice(&at);
    file.bytes
}

struct Writer {
    bytes: Vec<u8>,
    is_big: bool,
}

impl Writer {
    fn short(&self, number: u16) -> [u8; 2] {
        if self.is_big { number.to_be_bytes() } else { number.to_le_bytes() }
    }

    fn long(&self, number: u32) -> [u8; 4] {
        if self.is_big { number.to_be_bytes() } else { number.to_le_bytes() }
    }

    /// Puts bytes at the end, at an even place, and says where.
    fn append(&mut self, bytes: &[u8]) -> u32 {
        self.bytes.resize(self.bytes.len().next_multiple_of(2), 0);
        let at = self.bytes.len() as u32;
        self.bytes.extend(bytes);
        at
    }

    /// Puts a directory and all that it leads to at the end, and says where it is.
    fn put(&mut self, mut directory: Directory) -> u32 {
        directory.sort_by_key(|(tag, _)| *tag);
        let mut entries = self.short(directory.len() as u16).to_vec();
        for (tag, value) in directory {
            let (kind, size, mut data) = self.encoded(value);
            let count = (data.len() / size) as u32;
            if data.len() > 4 {
                let at = self.append(&data);
                data = self.long(at).to_vec();
            }
            data.resize(4, 0);
            entries.extend(self.short(tag).into_iter().chain(self.short(kind)));
            entries.extend(self.long(count).into_iter().chain(data));
        }
        entries.extend([0; 4]);
        self.append(&entries)
    }

    /// Type, size of one value, and bytes of all.
    fn encoded(&mut self, value: Value) -> (u16, usize, Vec<u8>) {
        let longs = |file: &Self, numbers: Vec<u32>| -> Vec<u8> {
            numbers.into_iter().flat_map(|number| file.long(number)).collect()
        };
        match value {
            Value::Byte(bytes) => (1, 1, bytes),
            Value::Ascii(text) => (2, 1, [text.as_bytes(), &[0]].concat()),
            Value::Short(numbers) => {
                (3, 2, numbers.into_iter().flat_map(|number| self.short(number)).collect())
            }
            Value::Long(numbers) => (4, 4, longs(self, numbers)),
            Value::Rational(ratios) => (5, 8, longs(self, ratios.concat())),
            Value::SignedRational(ratios) => {
                (10, 8, longs(self, ratios.concat().into_iter().map(i32::cast_unsigned).collect()))
            }
            Value::Undefined(bytes) => (7, 1, bytes),
            Value::Pieces(pieces) => {
                let places = pieces.iter().map(|piece| self.append(piece)).collect();
                (4, 4, longs(self, places))
            }
            Value::Directories(directories) => {
                let places = directories.into_iter().map(|directory| self.put(directory)).collect();
                (4, 4, longs(self, places))
            }
        }
    }
}
