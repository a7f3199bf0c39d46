//! The layout and meaning of a sensor's numbers in a DNG.
//!
//! The decoder only unpacks them: it is shown a directory that contains their layout alone. Everything else
//! is taken from the file's own tags.
//!
//! # Source
//! Adobe, *Digital Negative Specification* 1.7, chapters 2, 4 and 5.

use std::path::Path;

use ndarray::Array3;
use rawler::imgop::{Dim2, Point, Rect};

use super::layout::{Layout, Shown};
use super::levels::Levels;
use super::opcodes::Opcodes;
use super::refused::{ELSEWHERE, damaged, unread};
use super::tiff_directories::{Directory, Tiff};
use crate::image::photograph::Mosaic;
use crate::image::reading::pixel_shape;
use crate::image::reading::tiff::tags::{DNG_VERSION, NEW_SUBFILE_TYPE, PHOTOMETRIC};
use crate::{Error, Result};

/// Description of a sensor's numbers in a DNG.
pub(super) struct Dng {
    /// Columns and rows of the whole sensor.
    pub size: Dim2,
    pub samples: usize,
    /// `16-bit` or `float`.
    pub kind: String,
    /// The part of the sensor that forms the picture.
    pub area: Rect,
    /// Starting at that part's corner; none if every site has all colours.
    pub mosaic: Option<Mosaic>,
    pub levels: Levels,
    /// Meaning of stored numbers, by number; empty if they are linear.
    pub linearization: Vec<f64>,
    pub opcodes: Opcodes,
    /// What the decoder sees of the file.
    pub shown: Shown,
}

/// Rows and columns of the repeated filter pattern, and its colours.
const FILTERS: [u16; 2] = [33421, 33422];
/// The oldest version whose readers can read the file.
const BACKWARD_VERSION: u16 = 50707;
const LINEARIZATION: u16 = 50712;
/// Factors across and down that make pixels square.
const DEFAULT_SCALE: u16 = 50718;
/// Origin and size.
const CROP: [u16; 2] = [50719, 50720];
const ACTIVE_AREA: u16 = 50829;

/// Values of [`PHOTOMETRIC`].
const MOSAIC: usize = 32803;
const LINEAR: usize = 34892;
const GREY: usize = 1;

/// The newest version supported here.
const VERSION: [f64; 2] = [1.0, 7.0];

impl Dng {
    /// None if the file is not a DNG.
    ///
    /// # Errors
    /// [`Error::Picture`] if it contradicts itself, is cut short, or contains something unsupported.
    pub fn read(path: &Path, tiff: Tiff) -> Result<Option<Self>> {
        let directories = tiff.directories();
        let Some(root) = directories.iter().find(|directory| directory.has_tag(DNG_VERSION)) else {
            return Ok(None);
        };
        let version = root.numbers(BACKWARD_VERSION).unwrap_or_default();
        if version.len() > 1 && version[..2] > VERSION[..] {
            return Err(unread(path, &format!("of version {}.{}", version[0], version[1])));
        }
        let directory = sensor(path, &directories)?;
        let layout = Layout::read(path, tiff, directory)?;
        if let Some([across, down]) = directory.numbers(DEFAULT_SCALE).as_deref()
            && let Some(problem) = pixel_shape::objection("DefaultScale", across / down)
        {
            return Err(Error::picture(path, problem, "convert it to linear TIFF of square pixels"));
        }
        let active = active_area(path, directory, layout.size)?;
        let area = crop(path, directory, active, layout.size)?;
        let mosaic = if number(directory, PHOTOMETRIC) == Some(MOSAIC) {
            Some(mosaic(path, directory)?)
        } else {
            None
        };
        let full_scale = if layout.is_float { 1.0 } else { 2_f64.powi(layout.bits as i32) - 1.0 };
        let linearization = directory.numbers(LINEARIZATION).filter(|_| !layout.is_float);
        Ok(Some(Self {
            size: layout.size,
            samples: layout.samples,
            kind: if layout.is_float { "float".to_owned() } else { format!("{}-bit", layout.bits) },
            area,
            mosaic: mosaic.map(|mosaic| mosaic.starting_at(area.p.x - active.p.x, area.p.y - active.p.y)),
            levels: Levels::of_dng(path, directory, active, layout.samples, full_scale)?,
            linearization: linearization.unwrap_or_default(),
            opcodes: Opcodes::read(path, directory, active)?,
            shown: layout.shown(tiff, root),
        }))
    }
}

fn number(directory: &Directory, tag: u16) -> Option<usize> {
    directory.number(tag).map(|number| number as usize)
}

/// The directory of the sensor's numbers: no preview, mask, depth map, or picture processed from them.
fn sensor<'a, 'b>(path: &Path, directories: &'b [Directory<'a>]) -> Result<&'b Directory<'a>> {
    let is = |directory: &Directory, photometric: &[usize]| {
        number(directory, NEW_SUBFILE_TYPE).unwrap_or(0) == 0
            && number(directory, PHOTOMETRIC).is_some_and(|of| photometric.contains(&of))
    };
    let find = |photometric: &[usize]| -> Vec<_> {
        directories.iter().filter(|directory| is(directory, photometric)).collect()
    };
    let mut found = find(&[MOSAIC, LINEAR]);
    if found.is_empty() {
        found = find(&[GREY]);
    }
    match found[..] {
        [directory] => Ok(directory),
        [] => Err(unread(
            path,
            "without a picture of a sensor's mosaic, linear colours or grey as its main one",
        )),
        _ => Err(unread(path, &format!("with {} main pictures", found.len()))),
    }
}

/// The part of the sensor exposed to light.
fn active_area(path: &Path, directory: &Directory, size: Dim2) -> Result<Rect> {
    let Some(sides) = directory.numbers(ACTIVE_AREA) else {
        return Ok(Rect::new(Point::zero(), size));
    };
    let sides: Vec<usize> = sides.into_iter().map(|side| side as usize).collect();
    match sides[..] {
        [top, left, bottom, right] if top < bottom && left < right && bottom <= size.h && right <= size.w => {
            Ok(Rect::new(Point::new(left, top), Dim2::new(right - left, bottom - top)))
        }
        _ => Err(Error::picture(path, "its active area lies outside the sensor", ELSEWHERE)),
    }
}

/// The crop of the active area recommended by the camera.
fn crop(path: &Path, directory: &Directory, active: Rect, size: Dim2) -> Result<Rect> {
    let [origin, extent] = CROP.map(|tag| directory.numbers(tag).unwrap_or_default());
    let ([x, y], [w, h]) = (&origin[..], &extent[..]) else { return Ok(active) };
    let [x, y, w, h] = [x, y, w, h].map(|number| number.round() as usize);
    let corner = Point::new(active.p.x.saturating_add(x), active.p.y.saturating_add(y));
    let fits = corner.x.saturating_add(w) <= size.w && corner.y.saturating_add(h) <= size.h;
    if !fits || w == 0 || h == 0 {
        return Err(Error::picture(path, "the picture lies outside the sensor", ELSEWHERE));
    }
    Ok(Rect::new(corner, Dim2::new(w, h)))
}

/// The colour filters, starting at the active area's corner.
fn mosaic(path: &Path, directory: &Directory) -> Result<Mosaic> {
    let filters = directory.numbers(FILTERS[1]).unwrap_or_default();
    let repeat = directory.numbers(FILTERS[0]).unwrap_or_else(|| vec![2.0, 2.0]);
    let [rows, columns] = repeat[..] else {
        return Err(damaged(path, "its CFARepeatPatternDim does not have two numbers"));
    };
    let filters = Array3::from_shape_vec((rows as usize, columns as usize, 1), filters);
    let filters = filters.ok().filter(|filters| (1..=144).contains(&filters.len()));
    let filters = filters
        .ok_or_else(|| damaged(path, format!("its CFAPattern is not of {rows} x {columns} filters")))?;
    let (rows, columns, _) = filters.dim();
    // a square that contains whole repetitions of both
    let side =
        (1..=rows).map(|n| n * columns).find(|side| side.is_multiple_of(rows)).unwrap_or(rows * columns);
    let letter = |at: usize| match filters[[at / side % rows, at % side % columns, 0]] as usize {
        0 => 'R',
        1 => 'G',
        2 => 'B',
        _ => '?',
    };
    let letters: String = (0..side * side).map(letter).collect();
    Mosaic::new(&letters)
        .ok_or_else(|| Error::picture(path, "its colour filters are not red, green and blue", ELSEWHERE))
}
