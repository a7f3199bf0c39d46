//! The colour of each site of a sensor.

use ndarray::Array2;

use super::orientation::Orientation;

/// The colour filters before a sensor's sites: a square pattern, repeated over the picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mosaic {
    /// 0, 1 or 2 for red, green or blue, by row and column; as many rows as columns.
    square: Array2<usize>,
}

const LETTERS: &str = "RGB";

impl Mosaic {
    /// The mosaic whose pattern reads `letters` row by row, such as `RGGB`; none if they fill no square or
    /// one of R, G and B is missing.
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
        let square = Array2::from_shape_vec((side, side), colours).ok()?;
        has_all.then_some(Self { square })
    }

    /// The colour of the site in column `x` and row `y`: 0, 1 or 2 for red, green or blue.
    #[must_use]
    #[inline]
    pub fn colour(&self, x: usize, y: usize) -> usize {
        self.square[[y % self.side(), x % self.side()]]
    }

    /// Width and height of its pattern, sites.
    #[must_use]
    pub fn side(&self) -> usize {
        self.square.nrows()
    }

    /// Its letters, row by row.
    #[must_use]
    pub fn letters(&self) -> String {
        self.square.iter().map(|&colour| &LETTERS[colour..=colour]).collect()
    }

    /// The mosaic that begins `x` columns to the right and `y` rows below.
    #[must_use]
    pub fn starting_at(&self, x: usize, y: usize) -> Self {
        let colour = |(row, column)| self.colour(column + x, row + y);
        Self { square: Array2::from_shape_fn(self.square.dim(), colour) }
    }

    /// The mosaic of the upright picture, for one stored in this size and orientation.
    pub(super) fn upright(&self, orientation: Orientation, (width, height): (usize, usize)) -> Self {
        // read back from the last column, the colours are those of the next pattern to the right, mirrored
        let x = if orientation.mirrors_columns() { width } else { 0 };
        let y = if orientation.mirrors_rows() { height } else { 0 };
        Self { square: orientation.upright(self.starting_at(x, y).square) }
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

    /// Turned by hand: the corner that is at the top left when upright, then along the first upright row.
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
        // with an odd number of columns the last has the first's colours
        assert_eq!([2, 8].map(|exif| upright(exif, 3, 2)), ["RGGB", "RGGB"]);
        assert_eq!(upright(3, 1, 1), "RGGB");
    }
}
