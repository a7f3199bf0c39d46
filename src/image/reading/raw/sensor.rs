//! What a sensor saw: light of each site between its black and white level.
//!
//! Nothing more is done to it: no white balance, no matrix, no demosaicing. The part of the sensor is the one that the
//! camera recommends, so that coordinates are those of other programs.

use std::path::Path;

use ndarray::{Array3, Axis};
use rawler::imgop::{Point, Rect};
use rawler::rawimage::RawPhotometricInterpretation;
use rawler::{RawImage, RawImageData};
use rayon::prelude::*;

use crate::image::numbers::{ReadOptions, Scale, Transfer};
use crate::image::photograph::{CameraNotes, Mosaic, Photograph, PhotographInfo, SensorInfo};
use crate::{Error, Result};

/// The numbers of a sensor and how they are to be understood.
pub(super) struct Sensor {
    image: RawImage,
    area: Rect,
    /// The colour filters from the area's corner on; none if every site has all colours.
    mosaic: Option<Mosaic>,
    /// One for each black level of the repeated pattern.
    scales: Vec<Scale>,
    /// Column and row of the whole sensor where that pattern begins.
    pattern_origin: Point,
}

/// What to do with a sensor that is not like others.
const CONVERT: &str = "convert the file to linear TIFF";

impl Sensor {
    /// The sensor of a decoded file.
    ///
    /// # Errors
    /// [`Error::Picture`] if its pixels have neither one of the colours red, green and blue, nor all three, nor none, or
    /// the picture lies outside the sensor; [`Error::Usage`] if the white level is not above the black level.
    pub fn new(path: &Path, image: RawImage, is_dng: bool, options: &ReadOptions) -> Result<Self> {
        let refused = |problem| Error::picture(path, problem, CONVERT);
        let area = area(&image).ok_or_else(|| refused("the picture lies outside the sensor"))?;
        let mosaic = match &image.photometric {
            RawPhotometricInterpretation::Cfa(filters) => {
                let mosaic = Mosaic::new(&filters.cfa.name);
                Some(mosaic.ok_or_else(|| refused("its colour filters are not red, green and blue"))?)
            }
            _ => None,
        };
        let mosaic = mosaic.map(|mosaic| mosaic.starting_at(area.p.x, area.p.y));
        if !matches!((&mosaic, image.cpp), (Some(_), 1) | (None, 1 | 3)) {
            return Err(refused("its pixels have neither one number nor three"));
        }
        // in a DNG the levels begin where the sensor sees light
        let pattern_origin = image.active_area.filter(|_| is_dng).map_or(Point::zero(), |area| area.p);
        Ok(Self { scales: scales(&image, options)?, image, area, mosaic, pattern_origin })
    }

    /// The photograph it took.
    ///
    /// # Errors
    /// [`Error::Picture`] if it is smaller than 3 x 3 px.
    pub fn photograph(self, path: &Path, camera: CameraNotes) -> Result<Photograph> {
        let light = match &self.image.data {
            RawImageData::Integer(data) => self.light(data),
            RawImageData::Float(data) => self.light(data),
        };
        let info = self.info(camera);
        match &self.mosaic {
            None => Ok(Photograph::from_stored_light(light, info)),
            Some(mosaic) => Photograph::from_sites(light.remove_axis(Axis(2)), mosaic, info)
                .ok_or_else(|| Error::picture(path, "the picture has less than 3 x 3 px", CONVERT)),
        }
    }

    /// Linear light of the area by row, column and channel, infinite where it is clipped.
    fn light<T: Copy + Into<f64> + Sync>(&self, data: &[T]) -> Array3<f32> {
        let (cpp, Rect { p: corner, d: size }) = (self.image.cpp, self.area);
        let mut light = Array3::zeros((size.h, size.w, cpp));
        light.outer_iter_mut().into_par_iter().enumerate().for_each(|(row, mut light)| {
            let y = corner.y + row;
            let stored = &data[(y * self.image.width + corner.x) * cpp..][..light.len()];
            for (((x, channel), light), stored) in light.indexed_iter_mut().zip(stored) {
                *light = self.scale(corner.x + x, y, channel).linear((*stored).into()) as f32;
            }
        });
        light
    }

    /// The scale of a number at a column and row of the whole sensor.
    #[inline]
    fn scale(&self, x: usize, y: usize, channel: usize) -> &Scale {
        let (levels, origin) = (&self.image.blacklevel, self.pattern_origin);
        let column = (x + levels.width - origin.x % levels.width) % levels.width;
        let row = (y + levels.height - origin.y % levels.height) % levels.height;
        &self.scales[(row * levels.width + column) * levels.cpp + channel]
    }

    fn info(&self, camera: CameraNotes) -> PhotographInfo {
        let Rect { p: corner, d: size } = self.area;
        let colours = match self.image.cpp {
            _ if self.mosaic.is_some() => "mosaic",
            1 => "grey",
            _ => "RGB",
        };
        PhotographInfo {
            black_level: self.levels(|scale| scale.black),
            white_level: self.levels(|scale| scale.white),
            sensor: Some(SensorInfo {
                mosaic: self.mosaic.as_ref().map(Mosaic::letters),
                area: [corner.x, corner.y, size.w, size.h],
            }),
            ..PhotographInfo::new(camera, (size.w, size.h), format!("RAW, {}-bit, {colours}", self.image.bps))
        }
    }

    /// The mean level of each channel.
    fn levels(&self, level: fn(&Scale) -> f64) -> Vec<f64> {
        let Some(mosaic) = &self.mosaic else {
            return (0..self.image.cpp).map(|channel| level(self.scale(0, 0, channel))).collect();
        };
        let (width, height) =
            (mosaic.side() * self.image.blacklevel.width, mosaic.side() * self.image.blacklevel.height);
        let mut sums = [(0.0, 0.0); 3];
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            let (sum, count) = &mut sums[mosaic.colour(x, y)];
            *sum += level(self.scale(self.area.p.x + x, self.area.p.y + y, 0));
            *count += 1.0;
        }
        sums.map(|(sum, count)| sum / count).into()
    }
}

/// The recommended area, or else the one that sees light; none if it is not on the sensor.
fn area(image: &RawImage) -> Option<Rect> {
    let whole = Rect::new(Point::zero(), image.dim());
    let area = image.crop_area.or(image.active_area).unwrap_or(whole);
    let fits = area.p.x.checked_add(area.d.w)? <= whole.d.w && area.p.y.checked_add(area.d.h)? <= whole.d.h;
    (fits && !area.is_empty()).then_some(area)
}

/// A scale for each black level of the repeated pattern; levels of the command line hold for all.
fn scales(image: &RawImage, options: &ReadOptions) -> Result<Vec<Scale>> {
    let white = |channel: usize| image.whitelevel.0.get(channel).or(image.whitelevel.0.first());
    let scale = |(k, black): (usize, f32)| {
        let levels = ReadOptions {
            transfer: Transfer::Linear,
            black_level: options.black_level.or(Some(black.into())),
            white_level: options.white_level.or(white(k % image.cpp).copied().map(f64::from)),
            development: None,
        };
        Scale::new(&levels, 16)
    };
    image.blacklevel.as_vec().into_iter().enumerate().map(scale).collect()
}
