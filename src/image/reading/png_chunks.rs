//! The chunks of a PNG file around its pixels, wherever they stand: statements on its numbers, EXIF, and the
//! shape of its pixels.
//!
//! The decoder of the pixels omits what it cannot read of these, or what stands behind the pixels.

use std::io::{self, Read, Seek, SeekFrom};

use super::code_points;
use super::primaries::are_srgb;
use super::stated::{OTHER_COLOURS, OTHER_CURVE, Statement, UNREADABLE};
use crate::image::numbers::Transfer;

/// The gAMA that writers use for sRGB, whose curve has no such number (PNG, third edition, 11.3.2.5).
const GAMMA_OF_SRGB: f64 = 0.45455;
/// Tolerance within which gAMA equals a number.
const SAME_GAMMA: f64 = 5e-4;
/// The unit of gAMA and cHRM.
const UNIT: f64 = 1e-5;
/// Bytes before the first chunk.
const SIGNATURE_BYTES: u64 = 8;

const END: [u8; 4] = *b"IEND";
const EXIF: [u8; 4] = *b"eXIf";
const PROFILE: [u8; 4] = *b"iCCP";
const PIXEL_SIZE: [u8; 4] = *b"pHYs";
/// The chunks that state a curve or colours, and what each says; an ICC profile is the decoder's to unpack.
const STATEMENTS: [([u8; 4], &str, Reading); 4] = [
    (*b"cICP", "chunk cICP", points),
    (*b"sRGB", "chunk sRGB", intent),
    (*b"gAMA", "chunk gAMA", gamma),
    (*b"cHRM", "chunk cHRM", corners),
];

/// What a chunk says of the curve, perhaps nothing; an error if nothing known here.
type Says = Result<Option<Transfer>, String>;
/// From the content of a chunk.
type Reading = fn(&[u8]) -> Says;

/// The chunks of a file that are read here.
#[derive(Default)]
pub(super) struct Chunks(Vec<Chunk>);

struct Chunk {
    kind: [u8; 4],
    /// None if its checksum is another.
    content: Option<Vec<u8>>,
}

impl Chunks {
    /// Reads up to the end of the picture, or to the first chunk that is cut short.
    pub fn read(file: &mut (impl Read + Seek)) -> Self {
        let mut chunks = Self::default();
        if file.seek(SeekFrom::Start(SIGNATURE_BYTES)).is_ok() {
            while let Ok(chunk) = Chunk::read(file) {
                chunks.0.extend(chunk);
            }
        }
        chunks
    }

    /// Statements of all chunks but those of a readable ICC profile and EXIF.
    pub fn statements(&self) -> Vec<Statement> {
        let of_tables = STATEMENTS.into_iter().flat_map(|(kind, by, reading)| {
            self.of(kind).filter_map(move |content| {
                let says = content.map_or_else(unreadable, reading).transpose()?;
                Some(Statement { by, says })
            })
        });
        let is_damaged = self.of(EXIF).any(|content| content.is_none());
        let exif = is_damaged.then(|| Statement { by: "chunk eXIf", says: Err(UNREADABLE.to_owned()) });
        of_tables.chain(exif).collect()
    }

    /// Whether there is an ICC profile, readable or not.
    pub fn has_profile(&self) -> bool {
        self.of(PROFILE).next().is_some()
    }

    /// The EXIF block.
    pub fn exif(&self) -> Option<Vec<u8>> {
        self.of(EXIF).flatten().next().map(<[u8]>::to_vec)
    }

    /// Pixels per unit of length, across and down.
    pub fn density(&self) -> Option<[f64; 2]> {
        let (across, rest) = self.of(PIXEL_SIZE).flatten().next()?.split_first_chunk()?;
        Some([*across, *rest.first_chunk()?].map(|number| u32::from_be_bytes(number).into()))
    }

    /// The contents of the chunks of a kind.
    fn of(&self, kind: [u8; 4]) -> impl Iterator<Item = Option<&[u8]>> {
        self.0.iter().filter(move |chunk| chunk.kind == kind).map(|chunk| chunk.content.as_deref())
    }
}

impl Chunk {
    /// The next chunk, none if it is of a kind that is not read here; an error at the end.
    fn read(file: &mut (impl Read + Seek)) -> io::Result<Option<Self>> {
        const CHECKSUM_BYTES: usize = 4;
        let mut head = [0; 8];
        file.read_exact(&mut head)?;
        let [a, b, c, d, kind @ ..] = head;
        let length = u64::from(u32::from_be_bytes([a, b, c, d]));
        if kind == END {
            return Err(io::ErrorKind::UnexpectedEof.into());
        }
        let is_read = STATEMENTS.iter().any(|(other, ..)| *other == kind)
            || [EXIF, PROFILE, PIXEL_SIZE].contains(&kind);
        if !is_read {
            file.seek(SeekFrom::Current((length + CHECKSUM_BYTES as u64) as i64))?;
            return Ok(None);
        }
        let mut content = Vec::new();
        file.take(length + CHECKSUM_BYTES as u64).read_to_end(&mut content)?;
        let Some((_, checksum)) = content.split_last_chunk::<CHECKSUM_BYTES>() else {
            return Err(io::ErrorKind::UnexpectedEof.into());
        };
        let checksum = u32::from_be_bytes(*checksum);
        content.truncate(content.len() - CHECKSUM_BYTES);
        let is_intact = checksum == crc32(kind, &content);
        Ok(Some(Self { kind, content: is_intact.then_some(content) }))
    }
}

/// The checksum of a chunk.
fn crc32(kind: [u8; 4], content: &[u8]) -> u32 {
    let mut hasher = crc32fast::Hasher::new();
    hasher.update(&kind);
    hasher.update(content);
    hasher.finalize()
}

fn points(content: &[u8]) -> Says {
    let &[primaries, transfer, matrix, range] = content else { return unreadable() };
    code_points::transfer([primaries, transfer, matrix], range == 1).map(Some)
}

/// A rendering intent, of which there are four.
fn intent(content: &[u8]) -> Says {
    if matches!(content, [0..=3]) { Ok(Some(Transfer::Srgb)) } else { unreadable() }
}

fn gamma(content: &[u8]) -> Says {
    let &[gamma] = &numbers(content)[..] else { return unreadable() };
    let is = |number: f64| (gamma - number).abs() < SAME_GAMMA;
    match () {
        () if is(1.0) => Ok(Some(Transfer::Linear)),
        () if is(GAMMA_OF_SRGB) => Ok(Some(Transfer::Srgb)),
        () => Err(format!("{gamma:.5}, {OTHER_CURVE}")),
    }
}

/// White, red, green and blue.
fn corners(content: &[u8]) -> Says {
    let &[wx, wy, rx, ry, gx, gy, bx, by] = &numbers(content)[..] else { return unreadable() };
    let corners = [[rx, ry], [gx, gy], [bx, by], [wx, wy]];
    if are_srgb(&corners) { Ok(None) } else { Err(format!("a colour space {OTHER_COLOURS}")) }
}

fn unreadable() -> Says {
    Err(UNREADABLE.to_owned())
}

/// The numbers of gAMA and cHRM; none if they do not fill the chunk.
fn numbers(content: &[u8]) -> Vec<f64> {
    let (numbers, rest) = content.as_chunks::<4>();
    if !rest.is_empty() {
        return Vec::new();
    }
    numbers.iter().map(|number| UNIT * f64::from(u32::from_be_bytes(*number))).collect()
}
