//! A reduced copy of a photograph, in which folds are found as well as in millions of pixels.

use rayon::prelude::*;

use super::plane::Plane;
use crate::Result;
use crate::image::photograph::{Photograph, Pixel};

/// Longest side of a reduced picture, px.
const LONGEST_PX: usize = 960;
/// Fraction of the pixels darker than the light that counts as 1, for each channel, because illuminant and
/// camera scale them differently.
const DARKER_THAN_ONE: f64 = 0.99;
/// It is taken from every fourth pixel.
const LOOKED_AT: usize = 4;
/// Light below this fraction of the brightest counts as noise.
const DARK: f32 = 0.004;
/// Light is limited to this.
const BRIGHT: f32 = 4.0;

/// A photograph's light in blocks of pixels.
pub(super) struct Reduced {
    pub width: usize,
    pub height: usize,
    /// Its pixels' width in pixels of the photograph.
    pub scale: usize,
    /// Light row by row, each channel relative to its brightest pixels.
    pub light: Vec<[f32; 3]>,
    /// Light that counts as 1 in each channel, relative to the photograph's white level.
    pub one: [f32; 3],
}

impl Reduced {
    /// The mean light of square blocks; a margin narrower than a block is dropped.
    pub fn of(photograph: &Photograph) -> Self {
        let scale = photograph.width().max(photograph.height()).div_ceil(LONGEST_PX);
        let [width, height] = [photograph.width(), photograph.height()].map(|side| (side / scale).max(1));
        let mut light = vec![[0.0; 3]; width * height];
        light.par_chunks_mut(width).enumerate().for_each(|(y, row)| match scale {
            1 => row.iter_mut().enumerate().for_each(|(x, light)| *light = of_pixel(photograph.pixel(x, y))),
            _ => add_blocks(photograph, y, scale, row),
        });
        let one = [0, 1, 2].map(|channel| one(&light, channel));
        light.par_iter_mut().for_each(|light| *light = [0, 1, 2].map(|k| light[k] / one[k]));
        Self { width, height, scale, light, one }
    }

    /// A picture of half the size: means over two by two pixels.
    pub fn halved(&self) -> Self {
        let [width, height] = [self.width, self.height].map(|side| (side / 2).max(1));
        let pixel = |k: usize| {
            let at = |x: usize, y: usize| {
                self.light[(2 * (k / width) + y).min(self.height - 1) * self.width
                    + (2 * (k % width) + x).min(self.width - 1)]
            };
            let four = [at(0, 0), at(1, 0), at(0, 1), at(1, 1)];
            [0, 1, 2].map(|n| four.iter().map(|light| light[n]).sum::<f32>() / 4.0)
        };
        let light = (0..width * height).into_par_iter().map(pixel).collect();
        Self { width, height, scale: 2 * self.scale, light, one: self.one }
    }

    /// The reduced picture as a photograph.
    ///
    /// # Errors
    /// None: it has three numbers per pixel.
    pub fn photograph(&self) -> Result<Photograph> {
        Photograph::from_light(self.width, self.height, self.light.iter().flatten().copied().collect())
    }

    /// Square roots of light, which make noise uniform and give dark edges the weight of bright ones.
    pub fn even(&self) -> [Plane; 3] {
        self.planes(|light| (light.clamp(0.0, BRIGHT) + DARK).sqrt())
    }

    /// A function of each channel's light.
    pub fn planes(&self, of_light: impl Fn(f32) -> f32 + Sync) -> [Plane; 3] {
        [0, 1, 2].map(|channel| Plane {
            width: self.width,
            values: self.light.par_iter().map(|light| of_light(light[channel])).collect(),
        })
    }
}

/// Row `y` of blocks of `scale` x `scale` pixels.
fn add_blocks(photograph: &Photograph, y: usize, scale: usize, row: &mut [[f32; 3]]) {
    let width = row.len() * scale;
    let layers: Vec<_> = photograph.layers().collect();
    for (colour, layer) in layers.iter().enumerate() {
        // each layer of a mosaic has one colour
        let own = if layers.len() > 1 { colour..colour + 1 } else { 0..3 };
        let mut counts = vec![0.0_f32; row.len()];
        for y in y * scale..((y + 1) * scale).min(photograph.height()) {
            layer.visit(0..width.min(photograph.width()), y, |x, pixel| {
                let light = of_pixel(pixel);
                own.clone().for_each(|k| row[x / scale][k] += light[k]);
                counts[x / scale] += 1.0;
            });
        }
        for (block, count) in row.iter_mut().zip(counts) {
            own.clone().for_each(|k| block[k] /= count.max(1.0));
        }
    }
}

/// A pixel's light; a clipped one counts as 1.
pub(super) fn of_pixel(pixel: Pixel) -> [f32; 3] {
    match pixel {
        Pixel::Light(light) => light.map(|light| light as f32),
        Pixel::Clipped => [1.0; 3],
        Pixel::NotFinite => [0.0; 3],
    }
}

/// The light that counts as 1 in a channel.
fn one(light: &[[f32; 3]], channel: usize) -> f32 {
    let mut some: Vec<f32> = light.iter().step_by(LOOKED_AT).map(|light| light[channel]).collect();
    let darker = (some.len() as f64 * DARKER_THAN_ONE) as usize;
    let (_, one, _) = some.select_nth_unstable_by(darker, f32::total_cmp);
    if *one > 0.0 { *one } else { 1.0 }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // a test stops at the first surprise

    use super::*;
    use crate::image::Mosaic;

    #[test]
    fn blocks_have_the_mean_light_of_their_pixels() {
        let (width, height) = (2000, 30);
        let light = (0..width * height).map(|k| (k % width) as f32 / width as f32 + 0.1).collect();
        let reduced = Reduced::of(&Photograph::from_light(width, height, light).unwrap());
        assert_eq!((reduced.width, reduced.height, reduced.scale), (666, 10, 3));
        let ratio = reduced.light[600][0] / reduced.light[60][0];
        assert!((ratio - (0.1 + 1801.0 / 2000.0) / (0.1 + 181.0 / 2000.0)).abs() < 1e-4, "{ratio}");
    }

    #[test]
    fn colours_of_a_mosaic_are_kept_apart() {
        let (width, height) = (1000, 8);
        let light = (0..width * height).map(|k| [[0.5, 0.25], [0.25, 0.125]][k / width % 2][k % 2]).collect();
        let raw = Photograph::from_mosaic(Mosaic::new("RGGB").unwrap(), width, height, light).unwrap();
        // each channel is relative to its brightest
        assert!(Reduced::of(&raw).light.iter().flatten().all(|light| (light - 1.0).abs() < 1e-6));
    }
}
