//! How a camera was held: the eight orientations of EXIF, as a map of pixel indices.

/// The orientation of a stored picture, 1 to 8 (EXIF 2.32, tag 274).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Orientation(u32);

impl Orientation {
    /// Stored as it is to be seen.
    pub const UPRIGHT: Self = Self(1);

    /// The orientation with EXIF's number, if it is one of 1 to 8.
    ///
    /// # Example
    /// ```
    /// use vfold::image::Orientation;
    /// assert_eq!(Orientation::from_exif(1), Some(Orientation::UPRIGHT));
    /// assert_eq!(Orientation::from_exif(9), None);
    /// ```
    #[must_use]
    pub fn from_exif(number: u32) -> Option<Self> {
        (1..=8).contains(&number).then_some(Self(number))
    }

    /// EXIF's number, 1 to 8.
    #[must_use]
    pub fn exif(self) -> u32 {
        self.0
    }

    /// Width and height of the upright picture.
    pub(super) fn upright_size(self, (stored_width, stored_height): (usize, usize)) -> (usize, usize) {
        if self.transposed() { (stored_height, stored_width) } else { (stored_width, stored_height) }
    }

    /// Column and row at which the pixel (x, y) of the upright picture is stored.
    pub(super) fn stored(self, x: usize, y: usize, (width, height): (usize, usize)) -> (usize, usize) {
        let (column, row) = if self.transposed() { (y, x) } else { (x, y) };
        (
            if matches!(self.0, 2 | 3 | 7 | 8) { width - 1 - column } else { column },
            if matches!(self.0, 3 | 4 | 6 | 7) { height - 1 - row } else { row },
        )
    }

    fn transposed(self) -> bool {
        self.0 >= 5
    }
}
