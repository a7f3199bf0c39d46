//! Colours that are stored multiplied by alpha.

use std::path::Path;

use image::DynamicImage;

use crate::{Error, Result};

const WITHOUT_ALPHA: &str = "save it without alpha, as R, G and B";
/// Largest alpha of floats: halves round.
const OPAQUE: f32 = 1.001;

/// Divides colours by alpha, as OpenEXR always stores them multiplied, and TIFF where `ExtraSamples` says so.
/// Fully transparent pixels remain as they are: they count as missing.
///
/// # Errors
/// [`Error::Picture`] if what is called alpha cannot be: floats that are not between 0 and 1, or integers
/// below a colour.
pub(super) fn divide(path: &Path, picture: &mut DynamicImage) -> Result<()> {
    match picture {
        DynamicImage::ImageLumaA8(pixels) => integers::<u8, 2>(path, pixels),
        DynamicImage::ImageRgba8(pixels) => integers::<u8, 4>(path, pixels),
        DynamicImage::ImageLumaA16(pixels) => integers::<u16, 2>(path, pixels),
        DynamicImage::ImageRgba16(pixels) => integers::<u16, 4>(path, pixels),
        DynamicImage::ImageRgba32F(pixels) => floats(path, pixels),
        _ => Ok(()),
    }
}

/// Integers whose largest value is an opaque alpha.
trait Integer: Copy + Into<u32> {
    const FULL: u32;

    fn rounded(number: u32) -> Self;
}

impl Integer for u8 {
    const FULL: u32 = 0xff;

    fn rounded(number: u32) -> Self {
        Self::try_from(number).unwrap_or(Self::MAX)
    }
}

impl Integer for u16 {
    const FULL: u32 = 0xffff;

    fn rounded(number: u32) -> Self {
        Self::try_from(number).unwrap_or(Self::MAX)
    }
}

/// For pixels of `N` samples, the last of which is alpha.
fn integers<T: Integer, const N: usize>(path: &Path, samples: &mut [T]) -> Result<()> {
    for pixel in samples.as_chunks_mut::<N>().0 {
        let [colours @ .., alpha] = &mut pixel[..] else { continue };
        let alpha = (*alpha).into();
        if alpha == 0 || alpha == T::FULL {
            continue;
        }
        for colour in colours {
            if (*colour).into() > alpha {
                let problem = "a colour is above alpha, by which the file says that it was multiplied";
                return Err(Error::picture(path, problem, WITHOUT_ALPHA));
            }
            *colour = T::rounded(((*colour).into() * T::FULL + alpha / 2) / alpha);
        }
    }
    Ok(())
}

fn floats(path: &Path, samples: &mut [f32]) -> Result<()> {
    for [colours @ .., alpha] in samples.as_chunks_mut::<4>().0 {
        if !(0.0..=OPAQUE).contains(alpha) && !alpha.is_nan() {
            let problem = format!("its alpha is {alpha} somewhere, not between 0 and 1");
            return Err(Error::picture(path, problem, WITHOUT_ALPHA));
        }
        if *alpha > 0.0 || alpha.is_nan() {
            colours.iter_mut().for_each(|colour| *colour /= *alpha);
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{ImageBuffer, LumaA, Rgba};

    #[test]
    fn colours_are_divided_by_alpha() {
        let path = Path::new("a.tif");
        let mut half = DynamicImage::ImageRgba8(ImageBuffer::from_pixel(1, 1, Rgba([50, 100, 128, 128])));
        divide(path, &mut half).unwrap();
        assert_eq!(half.as_bytes(), [100, 199, 255, 128]);
        let mut above = DynamicImage::ImageRgba8(ImageBuffer::from_pixel(1, 1, Rgba([0, 129, 0, 128])));
        assert!(divide(path, &mut above).unwrap_err().to_string().contains("above alpha"));
        let mut grey = DynamicImage::ImageLumaA16(ImageBuffer::from_pixel(1, 1, LumaA([3, 0])));
        divide(path, &mut grey).unwrap();
        assert_eq!(grey, DynamicImage::ImageLumaA16(ImageBuffer::from_pixel(1, 1, LumaA([3, 0]))));
        let float = |alpha| {
            let pixel = Rgba([0.25, 0.5, 1.0, alpha]);
            let mut picture = DynamicImage::ImageRgba32F(ImageBuffer::from_pixel(1, 1, pixel));
            divide(path, &mut picture).map(|()| picture.into_rgba32f().into_raw())
        };
        assert_eq!(float(0.5).unwrap(), [0.5, 1.0, 2.0, 0.5]);
        assert_eq!(float(0.0).unwrap(), [0.25, 0.5, 1.0, 0.0]);
        assert!(float(f32::NAN).unwrap()[0].is_nan());
        assert!(float(255.0).unwrap_err().to_string().contains("alpha is 255 somewhere"));
    }
}
