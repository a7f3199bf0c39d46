//! Numbers drawn from bytes: whatever the bytes are, they are a case.

/// Bytes that still are to be drawn, and zeros after them.
pub struct Drawn<'a>(std::slice::Iter<'a, u8>);

impl<'a> Drawn<'a> {
    pub fn from(bytes: &'a [u8]) -> Self {
        Self(bytes.iter())
    }

    pub fn byte(&mut self) -> u8 {
        self.0.next().copied().unwrap_or(0)
    }

    pub fn below(&mut self, count: usize) -> usize {
        usize::from(self.byte()) % count
    }

    pub fn one_of<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.below(choices.len())]
    }

    /// One of 256 numbers, so that the same one comes again.
    pub fn coarse(&mut self, [least, most]: [f64; 2]) -> f64 {
        least + (most - least) * f64::from(self.byte()) / 255.0
    }

    pub fn fine(&mut self, [least, most]: [f64; 2]) -> f64 {
        let number = u32::from_le_bytes([self.byte(), self.byte(), self.byte(), self.byte()]);
        least + (most - least) * f64::from(number) / f64::from(u32::MAX)
    }
}
