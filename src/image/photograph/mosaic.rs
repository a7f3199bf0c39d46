//! Which colour each site of a sensor sees.

use super::orientation::Orientation;

/// The colour filters before a sensor's sites: a square of them, repeated over the picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mosaic {
    side: usize,
    /// 0, 1 or 2 for red, green or blue, row by row.
    colours: Vec<usize>,
}

const LETTERS: &str = "RGB";

impl Mosaic {
    /// The mosaic whose square reads `letters` row by row, as `RGGB`; none if they fill no square or one of R, G and B is missing.
    ///
    /// # Example
    /// ```
    /// use vfold::image::Mosaic;
    /// let bayer = Mosaic::new("RGGB").unwrap();
    /// assert_eq!([bayer.colour(0, 0), bayer.colour(3, 4), bayer.colour(5, 5)], [0, 1, 2]);
    /// assert_eq!(Mosaic::new("RGB"), None);
    /// ```
    #[must_use]
    pub fn new(letters: &str) -> Option<Self> {
        let colours: Vec<_> = letters.chars().map(|letter| LETTERS.find(letter)).collect::<Option<_>>()?;
        let side = colours.len().isqrt();
        let has_all = (0..LETTERS.len()).all(|colour| colours.contains(&colour));
        (side * side == colours.len() && has_all).then_some(Self { side, colours })
    }

    /// The colour of the site in column `x` and row `y`: 0, 1 or 2 for red, green or blue.
    #[must_use]
    #[inline]
    pub fn colour(&self, x: usize, y: usize) -> usize {
        self.colours[y % self.side * self.side + x % self.side]
    }

    /// Width and height of its square, sites.
    #[must_use]
    pub fn side(&self) -> usize {
        self.side
    }

    /// Its letters, row by row.
    #[must_use]
    pub fn letters(&self) -> String {
        self.colours.iter().map(|&colour| &LETTERS[colour..=colour]).collect()
    }

    /// The mosaic that begins `x` columns and `y` rows later.
    #[must_use]
    pub fn starting_at(&self, x: usize, y: usize) -> Self {
        self.mapped(|column, row| self.colour(column + x, row + y))
    }

    /// The mosaic of the upright picture, for one stored in this size and orientation.
    pub(super) fn upright(&self, orientation: Orientation, stored_size: (usize, usize)) -> Self {
        // whole squares added to the size leave room to look backwards in small pictures, and the colours where they are
        let (width, height) = (stored_size.0 + self.side * self.side, stored_size.1 + self.side * self.side);
        let layout = orientation.layout((width, height));
        self.mapped(|x, y| {
            let stored = layout.stored(x, y);
            self.colour(stored % width, stored / width)
        })
    }

    fn mapped(&self, colour: impl Fn(usize, usize) -> usize) -> Self {
        let colours = (0..self.colours.len()).map(|k| colour(k % self.side, k / self.side)).collect();
        Self { side: self.side, colours }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_squares_of_three_colours_are_mosaics() {
        for letters in ["", "R", "RGGBR", "GGGG", "RGGW", "rggb"] {
            assert_eq!(Mosaic::new(letters), None, "{letters}");
        }
        assert_eq!(Mosaic::new("GRBG").unwrap().letters(), "GRBG");
    }

    #[test]
    fn a_crop_may_begin_anywhere() {
        let bayer = Mosaic::new("RGGB").unwrap();
        assert_eq!(bayer.starting_at(1, 0).letters(), "GRBG");
        assert_eq!(bayer.starting_at(3, 5).letters(), "BGGR");
    }

    /// Turned by hand: the corner that is upright at the top left, then along the first upright row.
    #[test]
    fn a_turned_picture_begins_with_another_corner() {
        let upright = |exif, width, height| {
            Mosaic::new("RGGB")
                .unwrap()
                .upright(Orientation::from_exif(exif).unwrap(), (width, height))
                .letters()
        };
        assert_eq!([1, 2, 3, 4].map(|exif| upright(exif, 4, 2)), ["RGGB", "GRBG", "BGGR", "GBRG"]);
        assert_eq!([5, 6, 7, 8].map(|exif| upright(exif, 4, 2)), ["RGGB", "GRBG", "BGGR", "GBRG"]);
        // in an odd number of columns the last is the first's colour
        assert_eq!([2, 8].map(|exif| upright(exif, 3, 2)), ["RGGB", "RGGB"]);
        assert_eq!(upright(3, 1, 1), "RGGB");
    }
}
