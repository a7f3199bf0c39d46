//! How a camera was held: the eight orientations of EXIF, as permutations of an array's axes.

use ndarray::{Array, Axis, Dimension};

/// The orientation of a stored picture, 1 to 8 (EXIF 2.32, tag 274).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Orientation(u32);

impl Default for Orientation {
    fn default() -> Self {
        Self::UPRIGHT
    }
}

impl Orientation {
    /// Stored upright.
    pub const UPRIGHT: Self = Self(1);

    /// The orientation with this EXIF number, if it is from 1 to 8.
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

    /// Turns a stored picture upright without moving pixels in memory: its first axis is the rows, its second
    /// the columns.
    pub(super) fn upright<T, D: Dimension>(self, mut stored: Array<T, D>) -> Array<T, D> {
        let (rows, columns) = (Axis(0), Axis(1));
        if self.mirrors_rows() {
            stored.invert_axis(rows);
        }
        if self.mirrors_columns() {
            stored.invert_axis(columns);
        }
        if self.transposed() {
            stored.swap_axes(rows.index(), columns.index());
        }
        stored
    }

    /// Whether the upright picture begins with the last stored column.
    pub(super) fn mirrors_columns(self) -> bool {
        matches!(self.0, 2 | 3 | 7 | 8)
    }

    /// Whether the upright picture begins with the last stored row.
    pub(super) fn mirrors_rows(self) -> bool {
        matches!(self.0, 3 | 4 | 6 | 7)
    }

    fn transposed(self) -> bool {
        self.0 >= 5
    }
}
