//! A small, sufficiently bright sRGB picture of any photograph.

use std::path::Path;

use ndarray::Array2;

use super::balance::Balance;
use super::write::{Texts, write_srgb_png_with_texts};
use crate::Result;
use crate::colorimetry::encode_srgb;
use crate::image::photograph::{Photograph, Pixel};

/// Longest side of a preview, px: fills a screen.
const LONGEST_PX: usize = 1600;
/// Fraction of the pixels that are darker than the one shown as white.
const DARKER_THAN_WHITE: f64 = 0.995;
/// Keywords of the PNG texts that hold the photograph's own size, as `6000x4000`, its file, and the caption;
/// `share/picker.html` reads them. Words on the picture would hide corners, and a line below it would shift
/// them in programs that know only its size.
const SIZE_KEYWORD: &str = "vfold photograph size";
const NAME_KEYWORD: &str = "vfold photograph name";
pub(super) const CAPTION_KEYWORD: &str = "vfold caption";

/// A picture to look at and draw on.
#[derive(Debug, Clone)]
pub(super) struct Canvas {
    /// Its pixels per pixel of the photograph.
    pub scale: f64,
    /// By row and column, encoded for display, in [0, 1].
    pub rgb: Array2<[f64; 3]>,
    /// Width and height of the photograph, px.
    photographed: [usize; 2],
    /// Describes how colours are shown.
    caption: String,
}

impl Canvas {
    /// The photograph's light, balanced and averaged over each pixel of the canvas, which has `scale` pixels
    /// per pixel of the photograph.
    pub fn new(photograph: &Photograph, scale: f64, balance: &Balance) -> Self {
        let photographed = [photograph.width(), photograph.height()];
        let [width, height] = photographed.map(|side| ((side as f64 * scale).round() as usize).max(1));
        let light = |(y, x)| {
            let [r, g, b] = mean_light(photograph, [x, y], [width, height]);
            [r * balance.gains[0], g * balance.gains[1], b * balance.gains[2]]
        };
        let light = Array2::from_shape_fn((height, width), light);
        let white = white(&light);
        let rgb = light.mapv_into(|rgb| rgb.map(|y| encode_srgb(y / white)));
        Self { scale, rgb, photographed, caption: balance.caption.clone() }
    }

    /// Writes it as PNG, with texts for the photograph's size and the caption.
    pub fn write(&self, path: &Path) -> Result<()> {
        self.write_naming(path, None)
    }

    /// As [`Self::write`], also naming the photograph's file, if known.
    fn write_naming(&self, path: &Path, photograph: Option<&Path>) -> Result<()> {
        let size = self.photographed.map(|side| side.to_string()).join("x");
        let name = photograph.map(|photograph| (NAME_KEYWORD, photograph.display().to_string()));
        let caption = (CAPTION_KEYWORD, self.caption.clone());
        let texts = Texts {
            plain: Some((SIZE_KEYWORD, size)),
            international: name.into_iter().chain([caption]).collect(),
        };
        let (height, width) = self.rgb.dim();
        let rgb: Vec<f64> = self.rgb.iter().flatten().copied().collect();
        write_srgb_png_with_texts(path, [width, height], &rgb, texts)
    }
}

/// Writes a small picture of a photograph for the eye, as PNG: at most 1600 px per side, its brightest parts
/// white.
///
/// Text chunks hold the photograph's size, so that corners found in the PNG can be stated in the photograph's
/// pixels, its file `name`, and how colours are shown.
///
/// # Errors
/// [`Error::File`](crate::Error::File) if the file cannot be written.
///
/// # Example
/// ```
/// use vfold::image::{
///     Balance, Photograph, PictureFile, ReadOptions, is_for_the_eye, write_linear, write_preview,
/// };
/// let folder = tempfile::tempdir().unwrap();
/// let (path, preview) = (folder.path().join("wide.tif"), folder.path().join("preview.png"));
/// write_linear(&path, 3200, 2, &vec![0.1; 3200 * 2 * 3])?;
/// let photograph = Photograph::open(&path, &ReadOptions::default())?;
/// write_preview(&preview, &photograph, &path, &Balance::of(&photograph, None))?;
/// assert!(is_for_the_eye(&mut PictureFile::open(&preview)?));
/// assert!(!is_for_the_eye(&mut PictureFile::open(&path)?));
/// assert_eq!(Photograph::open(&preview, &ReadOptions::default())?.width(), 1600);
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn write_preview(path: &Path, photograph: &Photograph, name: &Path, balance: &Balance) -> Result<()> {
    let longest = photograph.width().max(photograph.height());
    let canvas = Canvas::new(photograph, (LONGEST_PX as f64 / longest as f64).min(1.0), balance);
    canvas.write_naming(path, Some(name))
}

/// Mean light of the photograph's pixels that pixel `at` of a canvas of this `size` shows; clipped ones count
/// as white.
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
