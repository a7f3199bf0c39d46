//! How a camera was held: the eight orientations of EXIF, as permutations of an array's axes.

use ndarray::{ArrayBase, Axis, Dimension, RawData};

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
    pub(super) fn upright<S: RawData, D: Dimension>(self, mut stored: ArrayBase<S, D>) -> ArrayBase<S, D> {
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

    /// The orientation that undoes this one.
    pub(super) fn inverse(self) -> Self {
        // quarter turns to either side; the others undo themselves
        match self.0 {
            6 => Self(8),
            8 => Self(6),
            other => Self(other),
        }
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

#[cfg(test)]
mod tests {
    use super::*;
    use ndarray::array;

    #[test]
    fn inverses_undo() {
        let stored = array![[1, 2, 3], [4, 5, 6]];
        for orientation in (1..=8).filter_map(Orientation::from_exif) {
            let upright = orientation.upright(stored.clone());
            assert_eq!(orientation.inverse().upright(upright), stored, "{orientation:?}");
        }
    }
}
