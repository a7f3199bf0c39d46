//! A photograph as linear light per pixel, however it was stored.

mod camera_notes;
mod darkest;
mod ends;
mod file_stamp;
mod flat_field;
mod info;
mod interleaved;
mod limits;
mod mosaic;
mod orientation;
mod pixel;
mod pixels;
mod sampled;
mod sites;
mod taken;

pub use camera_notes::{CameraNotes, camera_name};
pub use file_stamp::FileStamp;
pub use flat_field::FlatField;
pub use info::{PhotographInfo, SensorInfo};
pub(in crate::image) use interleaved::Interleaved;
pub use mosaic::Mosaic;
pub use orientation::Orientation;
pub use pixel::Pixel;
pub use taken::{OtherLight, Taken};

use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use ndarray::{Array2, Array3};

use self::pixels::Pixels;
use self::sites::Sites;
use crate::error::counted;
use crate::{Error, Result};

/// A decoded, upright photograph.
#[derive(Debug, Clone)]
pub struct Photograph {
    pixels: Pixels,
    flat_field: Option<Arc<FlatField>>,
    info: PhotographInfo,
}

impl Photograph {
    /// The photograph of a sensor under a mosaic of colour filters, each pixel having one colour.
    ///
    /// [`measure`](crate::image::measure) averages each colour's pixels at their own positions, without
    /// interpolation.
    ///
    /// # Arguments
    /// - `mosaic`: the colours, starting at the top left pixel.
    /// - `width`, `height`: px, at least 3.
    /// - `light`: row by row from the top, width x height numbers, infinite where clipped.
    ///
    /// # Errors
    /// [`Error::Numeric`] if the picture is smaller or the count of numbers differs.
    ///
    /// # Example
    /// ```
    /// use vfold::image::{Mosaic, Photograph, Pixel};
    /// let light = vec![1.0, 0.5, 1.0, 0.5, 0.25, 0.5, 1.0, 0.5, 1.0];
    /// let photograph = Photograph::from_mosaic(Mosaic::new("RGGB").unwrap(), 3, 3, light)?;
    /// assert_eq!(photograph.pixel(1, 1), Pixel::Light([1.0, 0.5, 0.25]));
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn from_mosaic(mosaic: Mosaic, width: usize, height: usize, light: Vec<f32>) -> Result<Self> {
        let info = PhotographInfo::new(CameraNotes::default(), (width, height), "mosaic, float".to_owned());
        let light = Array2::from_shape_vec((height, width), light).ok();
        light.and_then(|light| Self::from_sites(light, &mosaic, info)).ok_or_else(|| {
            Error::Numeric(format!("not as many numbers as a mosaic of {width} x {height} px has"))
        })
    }

    /// From the light of a sensor's sites by row and column as stored; none if smaller than 3 x 3.
    pub(in crate::image) fn from_sites(
        light: Array2<f32>,
        mosaic: &Mosaic,
        info: PhotographInfo,
    ) -> Option<Self> {
        let sites = Sites::new(light, mosaic, info.camera.orientation)?;
        Some(Self { pixels: Pixels::Sites(sites), flat_field: None, info })
    }

    /// The same, from a file of this size and time.
    pub(in crate::image) fn of_file(mut self, file: Option<FileStamp>) -> Self {
        self.info.file = file;
        self
    }

    /// A photograph from linear light in memory.
    ///
    /// # Arguments
    /// - `width`, `height`: px, at least 1.
    /// - `light`: row by row from the top, one number per pixel or three, infinite where clipped.
    ///
    /// # Errors
    /// [`Error::Numeric`] if the count of numbers differs.
    ///
    /// # Example
    /// ```
    /// use vfold::image::{Photograph, Pixel};
    /// let photograph = Photograph::from_light(1, 2, vec![0.25, 0.5, 0.75, 0.5, f32::INFINITY, 0.25])?;
    /// assert_eq!(photograph.pixel(0, 0), Pixel::Light([0.25, 0.5, 0.75]));
    /// assert_eq!(photograph.pixel(0, 1), Pixel::Clipped);
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn from_light(width: usize, height: usize, light: Vec<f32>) -> Result<Self> {
        let channels = if width.checked_mul(height) == Some(light.len()) { 1 } else { 3 };
        let info = PhotographInfo::new(CameraNotes::default(), (width, height), "linear, float".to_owned());
        match Array3::from_shape_vec((height, width, channels), light) {
            Ok(light) if !light.is_empty() => Ok(Self::from_stored_light(light, info)),
            _ => {
                let problem = format!("not one number or three for each of {width} x {height} px");
                Err(Error::Numeric(problem))
            }
        }
    }

    /// From linear light by row, column and channel as stored, of 1 or 3 channels.
    pub(in crate::image) fn from_stored_light(light: Array3<f32>, info: PhotographInfo) -> Self {
        let upright = info.camera.orientation.upright(light);
        Self::from_interleaved(Interleaved::from_light(upright), info)
    }

    /// From pixels with interleaved colours.
    pub(in crate::image) fn from_interleaved(pixels: Interleaved, info: PhotographInfo) -> Self {
        Self { pixels: Pixels::Interleaved(Box::new(pixels)), flat_field: None, info }
    }

    /// Makes a flat field from a photograph of a uniformly coloured sheet; `path` is for errors.
    ///
    /// # Errors
    /// [`Error::Picture`] if it was developed for the eye, more than half of its pixels are unusable, or a
    /// channel has no light.
    ///
    /// # Example
    /// ```
    /// use vfold::image::{Photograph, Pixel};
    /// let sheet = Photograph::from_light(2, 1, vec![0.25, 0.25, 0.25, 0.75, 0.75, 0.75])?; // mean 0.5
    /// let path = std::path::Path::new("sheet.exr");
    /// let flat_field = sheet.clone().into_flat_field(path)?;
    /// assert_eq!(sheet.with_flat_field(flat_field.into(), path)?.pixel(0, 0), Pixel::Light([0.5; 3]));
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn into_flat_field(self, path: &Path) -> Result<FlatField> {
        FlatField::new(self, path)
    }

    /// The same photograph in uniform light: each pixel divided by that of a flat field normalised to a mean
    /// of 1; `path` is for errors. Pixels of one place of the sensor belong together, however the camera
    /// noted that it was held.
    ///
    /// # Errors
    /// [`Error::Picture`] if the flat field differs in size, colours or camera.
    pub fn with_flat_field(self, flat_field: Arc<FlatField>, path: &Path) -> Result<Self> {
        if let Some(problem) = flat_field.unlike(&self) {
            return Err(Error::picture(path, problem, "take both with the same camera and framing"));
        }
        let held = self.info.camera.orientation;
        let is_alike = flat_field.photograph().info.camera.orientation == held;
        let flat_field = if is_alike { flat_field } else { Arc::new(flat_field.held(held)) };
        Ok(Self { flat_field: Some(flat_field), ..self })
    }

    /// If it is divided by a flat field, the same photograph without it, and that of the flat field, held
    /// alike.
    pub(in crate::image) fn before_division(&self) -> Option<(Self, &Self)> {
        let flat_field = self.flat_field.as_ref()?;
        Some((Self { flat_field: None, ..self.clone() }, flat_field.photograph()))
    }

    /// The same sensor's picture, as if its camera had been held in this orientation.
    fn held(&self, orientation: Orientation) -> Self {
        let (width, height) = orientation.upright_size(self.info.stored_size());
        let camera = CameraNotes { orientation, ..self.info.camera.clone() };
        Self {
            pixels: self.pixels.turned(self.info.camera.orientation.inverse()).turned(orientation),
            flat_field: self.flat_field.as_ref().map(|flat_field| Arc::new(flat_field.held(orientation))),
            info: PhotographInfo { camera, width, height, ..self.info.clone() },
        }
    }

    /// Width of the upright picture, px.
    #[must_use]
    pub fn width(&self) -> usize {
        self.info.width
    }

    /// Height of the upright picture, px.
    #[must_use]
    pub fn height(&self) -> usize {
        self.info.height
    }

    /// Number of colours per pixel: 3, or 1 for a grey picture.
    #[must_use]
    pub fn channels(&self) -> usize {
        self.pixels.channels()
    }

    /// Whether its channels have different numbers.
    fn has_colours(&self) -> bool {
        self.channels() > 1 && !self.info.is_grey
    }

    /// What is wrong with the colours of the picture, if it is to be one by a camera with this many channels.
    ///
    /// # Example
    /// ```
    /// use vfold::image::Photograph;
    /// let photograph = Photograph::from_light(1, 1, vec![0.25, 0.5, 0.75])?;
    /// assert_eq!(photograph.unlike_camera(3), None);
    /// let unlike = photograph.unlike_camera(1);
    /// assert_eq!(unlike.as_deref(), Some("an RGB picture, but the scene's camera has 1 channel"));
    /// # Ok::<(), vfold::Error>(())
    /// ```
    #[must_use]
    pub fn unlike_camera(&self, channels: usize) -> Option<String> {
        let kind = match (self.channels(), self.info.is_grey) {
            (1, _) if channels != 1 => "a grey picture",
            (2.., true) => "a grey picture saved as RGB",
            (own, _) if own != channels => "an RGB picture",
            _ => return None,
        };
        Some(format!("{kind}, but the scene's camera has {}", counted(channels, "channel")))
    }

    /// Properties of the photograph other than its pixels.
    #[must_use]
    pub fn info(&self) -> &PhotographInfo {
        &self.info
    }

    /// The pixel in column `x` and row `y` of the upright picture, both below its size; in a mosaic the mean
    /// of each colour over the nine pixels around it.
    #[must_use]
    #[inline]
    pub fn pixel(&self, x: usize, y: usize) -> Pixel {
        let pixel = self.pixels.pixel(x, y);
        self.flat_field.as_ref().map_or(pixel, |flat| flat.divide(x, y, pixel))
    }

    /// The photograph's layers: three grey ones with holes for a mosaic, one otherwise.
    pub(in crate::image) fn layers(&self) -> impl Iterator<Item = Layer<'_>> {
        let colours = match self.pixels {
            Pixels::Interleaved(_) => 0..1,
            Pixels::Sites(_) => 0..3,
        };
        colours.map(|colour| Layer { photograph: self, colour })
    }
}

/// One of a photograph's layers.
#[derive(Clone, Copy)]
pub(in crate::image) struct Layer<'a> {
    photograph: &'a Photograph,
    /// In a mosaic, the colour whose sites are shown.
    colour: usize,
}

impl Layer<'_> {
    /// Width and height, px.
    pub fn size(self) -> (usize, usize) {
        (self.photograph.width(), self.photograph.height())
    }

    /// Number of colours that its pixels have.
    pub fn channels(self) -> usize {
        match &self.photograph.pixels {
            Pixels::Interleaved(pixels) => pixels.channels(),
            Pixels::Sites(_) => 1,
        }
    }

    /// Which of a pixel's three numbers its layer defines; a grey pixel has all three, equal.
    fn numbers(self) -> Range<usize> {
        match self.photograph.pixels {
            Pixels::Interleaved(_) => 0..3,
            Pixels::Sites(_) => self.colour..self.colour + 1,
        }
    }

    /// Visits its pixels in `columns` of row `y` in order, with their columns.
    #[inline]
    pub fn visit(self, columns: Range<usize>, y: usize, mut visitor: impl FnMut(usize, Pixel)) {
        match &self.photograph.flat_field {
            None => self.visit_stored(columns, y, visitor),
            Some(flat) => self.visit_stored(columns, y, |x, pixel| {
                visitor(x, self.of_own_colour(flat.divide(x, y, pixel)));
            }),
        }
    }

    /// The same, without the flat field.
    #[inline]
    fn visit_stored(self, columns: Range<usize>, y: usize, visitor: impl FnMut(usize, Pixel)) {
        match &self.photograph.pixels {
            Pixels::Interleaved(pixels) => pixels.visit(columns, y, visitor),
            Pixels::Sites(sites) => sites.visit(self.colour, columns, y, visitor),
        }
    }

    /// A site has its own colour's light in place of all three.
    fn of_own_colour(self, pixel: Pixel) -> Pixel {
        match (&self.photograph.pixels, pixel) {
            (Pixels::Sites(_), Pixel::Light(light)) => Pixel::Light([light[self.colour]; 3]),
            (_, other) => other,
        }
    }
}
