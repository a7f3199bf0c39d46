//! Pixels of one colour each, behind a sensor's colour filters.
//!
//! Nothing is interpolated: a measurement takes the sites of each colour at their own positions. Averages of
//! two by two sites would shift red and blue by half a pixel against each other, which changes the mean of a
//! panel by 0.17 % where light falls off along it.

use std::ops::Range;

use ndarray::{ArcArray2, Array2};
use rayon::prelude::*;

use super::mosaic::Mosaic;
use super::orientation::Orientation;
use super::pixel::Pixel;
use crate::image::numbers::Scale;

/// The sites of a sensor under a mosaic of colour filters.
#[derive(Debug, Clone)]
pub(super) struct Sites {
    /// Linear light of the upright picture by row and column, infinite where clipped.
    light: ArcArray2<f32>,
    /// That of the upright picture.
    mosaic: Mosaic,
}

/// Width and height of a square in which every colour occurs, whatever its position.
const NEIGHBOURS: usize = 3;

impl Sites {
    /// The sites of a picture, with light by row and column and mosaic as stored; none if smaller than 3 x 3.
    pub fn new(light: Array2<f32>, mosaic: &Mosaic, orientation: Orientation) -> Option<Self> {
        let (height, width) = light.dim();
        let mosaic = mosaic.upright(orientation, (width, height));
        let light = orientation.upright(light.into_shared());
        (width.min(height) >= NEIGHBOURS).then_some(Self { light, mosaic })
    }

    /// The same sites, turned.
    pub fn turned(&self, by: Orientation) -> Self {
        let (height, width) = self.light.dim();
        Self { light: by.upright(self.light.clone()), mosaic: self.mosaic.upright(by, (width, height)) }
    }

    /// Visits the sites of one colour in `columns` of row `y`, with their columns.
    #[inline]
    pub fn visit(
        &self,
        colour: usize,
        columns: Range<usize>,
        y: usize,
        mut visitor: impl FnMut(usize, Pixel),
    ) {
        for x in columns.filter(|x| self.mosaic.colour(*x, y) == colour) {
            visitor(x, Pixel::new([self.site(x, y); 3], false));
        }
    }

    /// The mean of each colour over the nine sites around (x, y).
    pub fn pixel(&self, x: usize, y: usize) -> Pixel {
        let around = |at: usize, size: usize| {
            let first = at.saturating_sub(NEIGHBOURS / 2).min(size - NEIGHBOURS);
            first..first + NEIGHBOURS
        };
        let (height, width) = self.light.dim();
        let (mut sums, mut counts) = ([0.0; 3], [0.0; 3]);
        for y in around(y, height) {
            for x in around(x, width) {
                let colour = self.mosaic.colour(x, y);
                sums[colour] += self.site(x, y);
                counts[colour] += 1.0;
            }
        }
        Pixel::new([0, 1, 2].map(|colour| sums[colour] / counts[colour]), false)
    }

    /// The finite light of a colour's sites in `columns` of row `y`, or of the next row that has any.
    pub fn stored(&self, colour: usize, columns: Range<usize>, y: usize) -> Vec<f32> {
        let is_of_colour = |x: &usize, y: usize| self.mosaic.colour(*x, y) == colour;
        let rows = y..(y + self.mosaic.side()).min(self.light.nrows());
        let of_row =
            |y: usize| columns.clone().filter(move |x| is_of_colour(x, y)).map(move |x| self.light[[y, x]]);
        let mut rows = rows.map(|y| of_row(y).filter(|light| light.is_finite()).collect());
        rows.find(|row: &Vec<f32>| row.len() > 1).unwrap_or_default()
    }

    /// Changes the scale of each colour.
    pub fn rescale(&mut self, change: impl Fn(usize, Scale) -> Scale) {
        let scales = [0, 1, 2].map(|colour| change(colour, Scale::LINEAR));
        let mosaic = &self.mosaic;
        self.light.outer_iter_mut().into_par_iter().enumerate().for_each(|(y, mut row)| {
            for (x, light) in row.iter_mut().enumerate().filter(|(_, light)| light.is_finite()) {
                *light = scales[mosaic.colour(x, y)].linear((*light).into()) as f32;
            }
        });
    }

    fn site(&self, x: usize, y: usize) -> f64 {
        self.light[[y, x]].into()
    }
}
