//! The light of each site of a sensor, between its black and white level.
//!
//! No further processing is applied: no white balance, no matrix, no demosaicing. The area is the one
//! recommended by the camera, so that coordinates agree with other programs.

use std::path::Path;

use ndarray::{Array3, Axis};
use rawler::imgop::{Point, Rect};
use rawler::rawimage::RawPhotometricInterpretation;
use rawler::{RawImage, RawImageData};
use rayon::prelude::*;

use super::dng::Dng;
use super::levels::Levels;
use super::opcodes::Opcodes;
use super::refused::damaged;
use crate::error::counted;
use crate::image::numbers::ReadOptions;
use crate::image::photograph::{CameraNotes, Mosaic, Photograph, PhotographInfo, SensorInfo};
use crate::{Error, Result};

/// The numbers of a sensor and their interpretation.
pub(super) struct Sensor {
    numbers: RawImageData,
    /// Number of columns of the whole sensor.
    width: usize,
    /// Numbers per pixel.
    samples: usize,
    /// `16-bit` or `float`.
    kind: String,
    area: Rect,
    /// The colour filters, starting at the area's corner; none if every site has all colours.
    mosaic: Option<Mosaic>,
    levels: Levels,
    /// Meaning of stored numbers, by number; empty if they are linear.
    linearization: Vec<f64>,
    opcodes: Opcodes,
}

/// Remedy for an unusual sensor.
const CONVERT: &str = "convert the file to linear TIFF";

impl Sensor {
    /// The sensor of a decoded file other than DNG.
    ///
    /// # Errors
    /// [`Error::Picture`] unless its pixels have one of the colours red, green and blue, all three, or none,
    /// or if the picture lies outside the sensor; [`Error::Usage`] if the white level is not above the black
    /// level.
    pub fn of_camera(path: &Path, image: RawImage, options: &ReadOptions) -> Result<Self> {
        let refused = |problem| Error::picture(path, problem, CONVERT);
        let area = area(&image).ok_or_else(|| refused("the picture lies outside the sensor"))?;
        let mosaic = match &image.photometric {
            RawPhotometricInterpretation::Cfa(filters) => {
                let mosaic = Mosaic::new(&filters.cfa.name);
                Some(mosaic.ok_or_else(|| refused("its colour filters are not red, green and blue"))?)
            }
            _ => None,
        };
        let levels =
            Levels::of_camera(&image).ok_or_else(|| refused("its black or white level is not known"))?;
        Self {
            levels: levels.with_stated(options)?,
            width: image.width,
            samples: image.cpp,
            kind: format!("{}-bit", image.bps),
            area,
            mosaic: mosaic.map(|mosaic| mosaic.starting_at(area.p.x, area.p.y)),
            numbers: image.data,
            linearization: Vec::new(),
            opcodes: Opcodes::default(),
        }
        .checked(path)
    }

    /// The sensor of a DNG, whose numbers the decoder unpacked.
    ///
    /// # Errors
    /// As [`Sensor::of_camera`]; [`Error::Picture`] also if the decoder returned a picture of another size.
    pub fn of_dng(path: &Path, image: RawImage, dng: Dng, options: &ReadOptions) -> Result<Self> {
        let Dng { size, samples, kind, area, mosaic, levels, linearization, opcodes, .. } = dng;
        if (image.dim(), image.cpp) != (size, samples) {
            let RawImage { width, height, cpp, .. } = image;
            let problem = format!(
                "its decoder found {width} x {height} px of {}, its tags say {} x {} of {samples}",
                counted(cpp, "number"),
                size.w,
                size.h
            );
            return Err(damaged(path, problem));
        }
        let (numbers, width, levels) = (image.data, image.width, levels.with_stated(options)?);
        Self { numbers, width, samples, kind, area, mosaic, levels, linearization, opcodes }.checked(path)
    }

    fn checked(self, path: &Path) -> Result<Self> {
        if matches!((&self.mosaic, self.samples), (Some(_), 1) | (None, 1 | 3)) {
            return Ok(self);
        }
        Err(Error::picture(path, "its pixels have neither one number nor three", CONVERT))
    }

    /// Its photograph.
    ///
    /// # Errors
    /// [`Error::Picture`] if it is smaller than 3 x 3 px.
    pub fn photograph(self, path: &Path, camera: CameraNotes) -> Result<Photograph> {
        let mut light = match &self.numbers {
            RawImageData::Integer(data) => self.light(data),
            RawImageData::Float(data) => self.light(data),
        };
        self.opcodes.apply(&mut light, self.area.p, self.mosaic.as_ref());
        let info = self.info(camera);
        match &self.mosaic {
            None => Ok(Photograph::from_stored_light(light, info)),
            Some(mosaic) => Photograph::from_sites(light.remove_axis(Axis(2)), mosaic, info)
                .ok_or_else(|| Error::picture(path, "the picture has less than 3 x 3 px", CONVERT)),
        }
    }

    /// Linear light of the area by row, column and channel, infinite where clipped, NaN at defective sites.
    fn light<T: Copy + Into<f64> + Sync>(&self, data: &[T]) -> Array3<f32> {
        let Rect { p: corner, d: size } = self.area;
        let mut light = Array3::zeros((size.h, size.w, self.samples));
        let white_above_black: Vec<f64> = (0..self.samples)
            .map(|sample| self.levels.white(sample) - self.levels.highest_black(sample))
            .collect();
        light.outer_iter_mut().into_par_iter().enumerate().for_each(|(row, mut light)| {
            let y = corner.y + row;
            let stored = &data[(y * self.width + corner.x) * self.samples..][..light.len()];
            for (((column, sample), light), stored) in light.indexed_iter_mut().zip(stored) {
                let number = self.linear((*stored).into());
                *light = if number >= self.levels.white(sample) {
                    f32::INFINITY
                } else {
                    let above_black = number - self.levels.black(corner.x + column, y, sample);
                    (above_black / white_above_black[sample]) as f32
                };
            }
        });
        light
    }

    /// The linear value of a stored number; NaN at a defective site.
    #[inline]
    fn linear(&self, stored: f64) -> f64 {
        if !stored.is_finite() || self.opcodes.leaves_out(stored) {
            return f64::NAN;
        }
        match &self.linearization[..] {
            [] => stored,
            // numbers beyond the table map to its last entry
            table => table[(stored as usize).min(table.len() - 1)],
        }
    }

    fn info(&self, camera: CameraNotes) -> PhotographInfo {
        let Rect { p: corner, d: size } = self.area;
        let colours = match self.samples {
            _ if self.mosaic.is_some() => "mosaic",
            1 => "grey",
            _ => "RGB",
        };
        let [black_level, white_level] = self.levels();
        PhotographInfo {
            black_level,
            white_level,
            sensor: Some(SensorInfo {
                mosaic: self.mosaic.as_ref().map(Mosaic::letters),
                area: [corner.x, corner.y, size.w, size.h],
            }),
            ..PhotographInfo::new(camera, (size.w, size.h), format!("RAW, {}, {colours}", self.kind))
        }
    }

    /// For each channel, the mean black level over the area, and the white level.
    fn levels(&self) -> [Vec<f64>; 2] {
        let levels = &self.levels;
        let mean = |sample: usize, side: usize, counts: &dyn Fn(usize, usize) -> bool| {
            levels.mean_black(self.area, sample, side, counts)
        };
        match &self.mosaic {
            None => [
                (0..self.samples).map(|sample| mean(sample, 1, &|_, _| true)).collect(),
                (0..self.samples).map(|sample| levels.white(sample)).collect(),
            ],
            Some(mosaic) => [
                (0..3).map(|colour| mean(0, mosaic.side(), &|x, y| mosaic.colour(x, y) == colour)).collect(),
                vec![levels.white(0); 3],
            ],
        }
    }
}

/// The recommended area, or else the one exposed to light; none if it is not on the sensor.
fn area(image: &RawImage) -> Option<Rect> {
    let whole = Rect::new(Point::zero(), image.dim());
    let area = image.crop_area.or(image.active_area).unwrap_or(whole);
    let fits = area.p.x.checked_add(area.d.w)? <= whole.d.w && area.p.y.checked_add(area.d.h)? <= whole.d.h;
    (fits && !area.is_empty()).then_some(area)
}
