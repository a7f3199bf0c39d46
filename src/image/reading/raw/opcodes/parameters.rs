//! The numbers of an opcode.

/// Numbers of an opcode, big-endian.
pub(super) struct Parameters<'a>(pub &'a [u8]);

impl<'a> Parameters<'a> {
    /// The next `bytes` bytes; like all that follow, none if fewer are left.
    pub fn take(&mut self, bytes: usize) -> Option<Parameters<'a>> {
        let (taken, rest) = self.0.split_at_checked(bytes)?;
        self.0 = rest;
        Some(Parameters(taken))
    }

    pub fn long(&mut self) -> Option<u32> {
        self.take(4).and_then(|bytes| Some(u32::from_be_bytes(*bytes.0.first_chunk()?)))
    }

    pub fn size(&mut self) -> Option<usize> {
        self.long().map(|size| size as usize)
    }

    pub fn double(&mut self) -> Option<f64> {
        let bytes = self.take(8)?;
        Some(f64::from_be_bytes(*bytes.0.first_chunk()?)).filter(|double| double.is_finite())
    }

    /// The next `count` floats, if they are valid factors of light.
    pub fn gains(&mut self, count: usize) -> Option<Vec<f32>> {
        let floats = self.take(count.checked_mul(4)?)?;
        let gains =
            floats.0.chunks_exact(4).filter_map(|bytes| Some(f32::from_be_bytes(*bytes.first_chunk()?)));
        let gains: Vec<f32> = gains.collect();
        gains.iter().all(|gain| *gain >= 0.0 && gain.is_finite()).then_some(gains)
    }

    /// The same, preceded by their number, which must be `count`.
    pub fn factors(&mut self, count: usize) -> Option<Vec<f32>> {
        (self.size()? == count).then(|| self.gains(count))?
    }
}
