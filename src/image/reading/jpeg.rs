//! The markers of a JPEG file, for information that its decoder omits: its kind and components, whether it is
//! complete, the shape of its pixels, and whether it has an ICC profile.

/// A JPEG file's bytes.
pub(super) struct Jpeg<'a>(pub &'a [u8]);

/// The header of a frame.
#[cfg_attr(not(feature = "raw"), allow(dead_code, reason = "the reader of RAW files looks at more of it"))]
pub(super) struct Frame {
    /// `0xc0` for baseline, `0xc3` for lossless.
    pub marker: u8,
    pub bits: u8,
    pub height: usize,
    pub width: usize,
    pub components: u8,
}

/// The frame of JPEG-LS, which is another method in the same container.
const JPEG_LS: u8 = 0xf7;
const START: u8 = 0xd8;
const END: u8 = 0xd9;
/// The markers of JFIF and of a part of an ICC profile, and how these begin.
const JFIF: (u8, &[u8]) = (0xe0, b"JFIF\0");
const PROFILE: (u8, &[u8]) = (0xe2, b"ICC_PROFILE\0");

/// The header of a scan.
pub(super) struct Scan {
    /// By name.
    pub components: Vec<u8>,
    /// One bit for each of 64 frequencies: whether it contains their last bit.
    pub frequencies: u64,
}

/// The frequencies from the first to the last of a progressive scan if it contains their last bit. `bits` is
/// the position before it and, in the lower half, that up to which it refines them.
fn last_bits(first: u8, last: u8, bits: u8) -> u64 {
    match last.checked_sub(first) {
        Some(more) if last < 64 && bits & 0xf == 0 => (u64::MAX >> (63 - more)) << first,
        _ => 0,
    }
}

impl Frame {
    /// The kind of JPEG, if its decoder does not read it.
    pub fn other_kind(&self) -> Option<&'static str> {
        match (self.marker, self.bits) {
            (0xc0..=0xc2, 12) => Some("JPEG of 12 bits"),
            (0xc0..=0xc2, _) => None,
            (0xc3 | 0xc7 | 0xcb | 0xcf, _) => Some("lossless JPEG"),
            (JPEG_LS, _) => Some("JPEG-LS"),
            (0xc9 | 0xca, _) => Some("JPEG with arithmetic coding"),
            _ => Some("hierarchical JPEG"),
        }
    }
}

impl Jpeg<'_> {
    /// Whether it reaches its end marker before another picture, such as a preview, starts.
    pub fn is_complete(&self) -> bool {
        self.end().is_some()
    }

    /// Whether it has an ICC profile, readable or not.
    pub fn has_profile(&self) -> bool {
        self.application(PROFILE).is_some()
    }

    /// Pixels per unit of length, across and down; the unit may be any.
    pub fn density(&self) -> Option<[f64; 2]> {
        let &[_, _, _, a, b, c, d] = self.application(JFIF)?.first_chunk()?;
        Some([[a, b], [c, d]].map(|number| u16::from_be_bytes(number).into()))
    }

    /// What follows the beginning of an application's data.
    fn application(&self, (marker, beginning): (u8, &[u8])) -> Option<&[u8]> {
        // after marker and length
        self.of_picture()
            .find_map(|(other, at)| self.0.get(at + 4..).filter(|_| other == marker)?.strip_prefix(beginning))
    }

    /// Number of components per pixel: 1 grey, 3 colours, 4 inks; none without a frame.
    pub fn components(&self) -> Option<u8> {
        self.frame().map(|frame| frame.components)
    }

    /// Its first frame's header.
    pub fn frame(&self) -> Option<Frame> {
        let (marker, header) = self.frame_header()?;
        let [bits, height_high, height_low, width_high, width_low, components] = *header.first_chunk()?;
        let number = |high, low| usize::from(u16::from_be_bytes([high, low]));
        Some(Frame {
            marker,
            bits,
            height: number(height_high, height_low),
            width: number(width_high, width_low),
            components,
        })
    }

    /// The numbers by which scans refer to the components.
    pub fn component_names(&self) -> Vec<u8> {
        let Some((_, [_, _, _, _, _, count, components @ ..])) = self.frame_header() else {
            return Vec::new();
        };
        components.chunks_exact(3).take((*count).into()).map(|component| component[0]).collect()
    }

    /// The headers of its scans.
    pub fn scans(&self) -> impl Iterator<Item = Scan> {
        const SCAN: u8 = 0xda;
        const PROGRESSIVE: u8 = 0xc2;
        let is_progressive = self.frame().is_some_and(|frame| frame.marker == PROGRESSIVE);
        self.of_picture().filter(|(marker, _)| *marker == SCAN).filter_map(move |(_, at)| {
            let (count, rest) = self.0.get(at + 4..)?.split_first()?;
            let (components, rest) = rest.split_at_checked(2 * usize::from(*count))?;
            let components = components.chunks_exact(2).map(|component| component[0]).collect();
            let &[first, last, bits] = rest.first_chunk()?;
            let frequencies = if is_progressive { last_bits(first, last, bits) } else { u64::MAX };
            Some(Scan { components, frequencies })
        })
    }

    /// Offset of its end marker.
    pub fn end(&self) -> Option<usize> {
        let mut ends = self.markers().filter(|(marker, _)| matches!(*marker, START | END));
        ends.next().filter(|(marker, _)| *marker == END).map(|(_, at)| at)
    }

    /// The marker of its first frame, and what follows its length.
    fn frame_header(&self) -> Option<(u8, &[u8])> {
        let is_frame =
            |marker| matches!(marker, 0xc0..=0xc3 | 0xc5..=0xc7 | 0xc9..=0xcb | 0xcd..=0xcf | JPEG_LS);
        let (marker, at) = self.markers().find(|(marker, _)| is_frame(*marker))?;
        Some((marker, self.0.get(at + 4..)?))
    }

    /// The markers before its end, and their offsets.
    fn of_picture(&self) -> impl Iterator<Item = (u8, usize)> {
        self.markers().take_while(|(marker, _)| *marker != END)
    }

    /// Its markers, and their offsets.
    fn markers(&self) -> impl Iterator<Item = (u8, usize)> {
        let bytes = self.0;
        let mut next = 2;
        std::iter::from_fn(move || {
            let at = next;
            let Some(&[0xff, marker]) = bytes.get(at..at + 2) else { return None };
            next += match marker {
                0x00 | 0x01 | 0xd0..=0xd7 => 2,
                0xff => 1,
                _ => {
                    let length = bytes.get(at + 2..at + 4);
                    2 + length.map_or(0, |length| usize::from(length[0]) << 8 | usize::from(length[1]))
                }
            };
            // a scan's header is followed by its data, up to the next marker
            let data = bytes.get(next..).and_then(|rest| rest.iter().position(|byte| *byte == 0xff));
            next += data.unwrap_or(bytes.len());
            Some((marker, at))
        })
    }
}
