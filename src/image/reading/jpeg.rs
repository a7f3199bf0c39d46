//! The markers of a JPEG file, for information that its decoder omits: whether it is complete, and its
//! components.

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

const END: u8 = 0xd9;

impl Jpeg<'_> {
    /// Whether it reaches its end marker; the decoder silently fills missing parts with grey.
    pub fn is_complete(&self) -> bool {
        self.markers().any(|(marker, _)| marker == END)
    }

    /// Number of components per pixel: 1 grey, 3 colours, 4 inks; none without a frame.
    pub fn components(&self) -> Option<u8> {
        self.frame().map(|frame| frame.components)
    }

    /// Its first frame's header.
    pub fn frame(&self) -> Option<Frame> {
        let is_frame = |marker| matches!(marker, 0xc0..=0xcf) && !matches!(marker, 0xc4 | 0xc8 | 0xcc);
        let (marker, at) = self.markers().find(|(marker, _)| is_frame(*marker))?;
        // after marker and length
        let header: [u8; 6] = *self.0.get(at + 4..)?.first_chunk()?;
        let [bits, height_high, height_low, width_high, width_low, components] = header;
        let number = |high, low| usize::from(u16::from_be_bytes([high, low]));
        Some(Frame {
            marker,
            bits,
            height: number(height_high, height_low),
            width: number(width_high, width_low),
            components,
        })
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
