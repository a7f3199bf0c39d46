//! How a camera was held: the eight orientations of EXIF, as a map of pixel indices.

/// The orientation of a stored picture, 1 to 8 (EXIF 2.32, tag 274).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Orientation(u32);

impl Default for Orientation {
    fn default() -> Self {
        Self::UPRIGHT
    }
}

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
    pub(in crate::image) fn upright_size(
        self,
        (stored_width, stored_height): (usize, usize),
    ) -> (usize, usize) {
        if self.transposed() { (stored_height, stored_width) } else { (stored_width, stored_height) }
    }

    /// Where the pixels of the upright picture are stored, row by row.
    pub(in crate::image) fn layout(self, (stored_width, stored_height): (usize, usize)) -> Layout {
        let mirrored_columns = matches!(self.0, 2 | 3 | 7 | 8);
        let mirrored_rows = matches!(self.0, 3 | 4 | 6 | 7);
        let column = if mirrored_columns { -1 } else { 1 };
        let row = if mirrored_rows { -(stored_width as isize) } else { stored_width as isize };
        let first_column = if mirrored_columns { stored_width - 1 } else { 0 };
        let first_row = if mirrored_rows { stored_height - 1 } else { 0 };
        let (x, y) = if self.transposed() { (row, column) } else { (column, row) };
        Layout { first: (first_row * stored_width + first_column) as isize, x, y }
    }

    fn transposed(self) -> bool {
        self.0 >= 5
    }
}

/// The pixel (x, y) of the upright picture is the stored pixel number `first` + x `x` + y `y`.
#[derive(Debug, Clone, Copy)]
pub(in crate::image) struct Layout {
    first: isize,
    x: isize,
    y: isize,
}

impl Layout {
    /// Number of the stored pixel, for (x, y) in the picture.
    pub fn stored(self, x: usize, y: usize) -> usize {
        (self.first + x as isize * self.x + y as isize * self.y) as usize
    }
}
