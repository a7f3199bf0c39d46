//! A picture for the eye of any photograph: small, bright enough, sRGB.

use std::path::Path;

use ndarray::Array2;

use super::write::write_srgb_png_with_text;
use crate::Result;
use crate::colorimetry::encode_srgb;
use crate::image::photograph::{Photograph, Pixel};

/// Longest side of a preview, px: it fills a screen.
const LONGEST_PX: usize = 1600;
/// Part of the pixels that are darker than the one shown as white.
const DARKER_THAN_WHITE: f64 = 0.995;
/// Keyword of the PNG text that tells the photograph's own size, as `6000x4000`; `share/picker.html` reads it.
const SIZE_KEYWORD: &str = "vfold photograph size";

/// A picture to look at and draw on.
#[derive(Debug, Clone)]
pub(super) struct Canvas {
    /// Its pixels for one of the photograph.
    pub scale: f64,
    /// By row and column, encoded for display, in [0, 1].
    pub rgb: Array2<[f64; 3]>,
    /// Width and height of the photograph, px.
    photographed: [usize; 2],
}

impl Canvas {
    /// The photograph's light averaged over each pixel of the canvas, `scale` of which there are for one of its own.
    pub fn new(photograph: &Photograph, scale: f64) -> Self {
        let photographed = [photograph.width(), photograph.height()];
        let [width, height] = photographed.map(|side| ((side as f64 * scale).round() as usize).max(1));
        let light = |(y, x)| mean_light(photograph, [x, y], [width, height]);
        let light = Array2::from_shape_fn((height, width), light);
        let white = white(&light);
        let rgb = light.mapv_into(|rgb| rgb.map(|y| encode_srgb(y / white)));
        Self { scale, rgb, photographed }
    }

    /// Writes it as PNG that tells the photograph's size.
    pub fn write(&self, path: &Path) -> Result<()> {
        let size = self.photographed.map(|side| side.to_string()).join("x");
        let (height, width) = self.rgb.dim();
        let rgb: Vec<f64> = self.rgb.iter().flatten().copied().collect();
        write_srgb_png_with_text(path, [width, height], &rgb, [SIZE_KEYWORD, &size])
    }
}

/// Writes a small picture of a photograph for the eye, as PNG: at most 1600 px per side, its brightest parts white.
///
/// The PNG tells the photograph's size in a text chunk, so that corners found in it can be given in the photograph's pixels.
///
/// # Errors
/// [`Error::File`](crate::Error::File) if the file cannot be written.
///
/// # Example
/// ```
/// use vfold::image::{Photograph, ReadOptions, write_linear, write_preview};
/// let folder = tempfile::tempdir().unwrap();
/// let (path, preview) = (folder.path().join("wide.tif"), folder.path().join("preview.png"));
/// write_linear(&path, 3200, 2, &vec![0.1; 3200 * 2 * 3])?;
/// write_preview(&preview, &Photograph::open(&path, &ReadOptions::default())?)?;
/// assert_eq!(Photograph::open(&preview, &ReadOptions::default())?.width(), 1600);
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn write_preview(path: &Path, photograph: &Photograph) -> Result<()> {
    let longest = photograph.width().max(photograph.height());
    Canvas::new(photograph, (LONGEST_PX as f64 / longest as f64).min(1.0)).write(path)
}

/// Mean light of the photograph's pixels that pixel `at` of a canvas of this `size` shows; clipped ones count as white.
fn mean_light(photograph: &Photograph, at: [usize; 2], size: [usize; 2]) -> [f64; 3] {
    let range = |at: usize, size: usize, photographed: usize| {
        let first = at * photographed / size;
        first..((at + 1) * photographed / size).max(first + 1)
    };
    let (mut sum, mut count) = ([0.0; 3], 0.0);
    for y in range(at[1], size[1], photograph.height()) {
        for x in range(at[0], size[0], photograph.width()) {
            let light = match photograph.pixel(x, y) {
                Pixel::Light(light) => light,
                Pixel::Clipped => [1.0; 3],
                Pixel::NotFinite => continue,
            };
            count += 1.0;
            sum.iter_mut().zip(light).for_each(|(sum, y)| *sum += y);
        }
    }
    sum.map(|sum| if count > 0.0 { sum / count } else { 0.0 })
}

/// The light to be shown as white.
fn white(light: &Array2<[f64; 3]>) -> f64 {
    let mut strongest: Vec<f64> = light.iter().map(|rgb| rgb[0].max(rgb[1]).max(rgb[2])).collect();
    let darker = ((strongest.len() as f64 * DARKER_THAN_WHITE) as usize).min(strongest.len() - 1);
    let (_, white, _) = strongest.select_nth_unstable_by(darker, f64::total_cmp);
    if *white > 0.0 { *white } else { 1.0 }
}
