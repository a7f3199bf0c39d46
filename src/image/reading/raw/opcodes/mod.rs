//! DNG's lists of operations to be applied to a sensor's numbers.
//!
//! Factors of the light and lists of defective sites are applied, even if optional. Curves are not supported:
//! such a file is refused, as is one with any other mandatory opcode. Other optional ones, such as lens
//! distortion, are skipped.
//!
//! # Source
//! Adobe, *Digital Negative Specification* 1.7, chapter 7.

mod factor;
mod parameters;

use std::ops::Range;
use std::path::Path;

use ndarray::{Array3, Axis, Slice};
use rawler::imgop::{Point, Rect};

use self::factor::{Area, Factor, GainMap, Radial, multiply};
use self::parameters::Parameters;
use super::refused::{ELSEWHERE, damaged};
use super::tiff_directories::Directory;
use crate::image::photograph::Mosaic;
use crate::{Error, Result};

/// `OpcodeList1` applies to numbers as stored, the second to light, the third to light after demosaicing.
const LISTS: [u16; 3] = [51008, 51009, 51022];

const NAMES: [&str; 14] = [
    "WarpRectilinear",
    "WarpFisheye",
    "FixVignetteRadial",
    "FixBadPixelsConstant",
    "FixBadPixelsList",
    "TrimBounds",
    "MapTable",
    "MapPolynomial",
    "GainMap",
    "DeltaPerRow",
    "DeltaPerColumn",
    "ScalePerRow",
    "ScalePerColumn",
    "WarpRectilinear2",
];

/// Opcodes without which numbers are not proportional to light, and which are never skipped. Readers disagree
/// on the unit of the deltas.
const CHANGE_LIGHT: [u32; 8] = [3, 7, 8, 9, 10, 11, 12, 13];

/// A sensor has a gain map for each colour of its mosaic, sixteen at most, and few others.
const OPCODES_MAX: u32 = 64;

/// The operations to be applied.
#[derive(Default)]
pub(super) struct Opcodes {
    /// In order.
    list: Vec<Opcode>,
    /// Numbers that mark defective sites, tested site by site.
    constants: Vec<f64>,
}

struct Opcode {
    /// Column and row of the sensor that are its origin.
    origin: Point,
    /// Whether it applies to all colours of each pixel.
    is_demosaiced: bool,
    does: Does,
}

enum Does {
    /// Sites that stored this number are defective.
    LeaveOutNumber(f64),
    /// Sites in these rows and columns are defective.
    LeaveOut(Vec<[Range<usize>; 2]>),
    Multiply(Area, Factor),
}

impl Opcodes {
    /// The lists in a sensor's directory; those for light are relative to its active area's corner.
    ///
    /// # Errors
    /// [`Error::Picture`] if a list is damaged, or has an unsupported opcode that must not be skipped.
    pub fn read(path: &Path, directory: &Directory, active: Rect) -> Result<Self> {
        let mut opcodes = Vec::new();
        for (tag, stage) in LISTS.into_iter().zip(1..) {
            if let Some(list) = directory.bytes(tag) {
                opcodes.extend(read_list(path, Parameters(list), stage, active)?);
            }
        }
        Ok(Self::new(opcodes))
    }

    fn new(list: Vec<Opcode>) -> Self {
        let constants = list.iter().filter_map(|opcode| match opcode.does {
            Does::LeaveOutNumber(number) => Some(number),
            _ => None,
        });
        Self { constants: constants.collect(), list }
    }

    /// Whether sites that stored this number are defective.
    #[inline]
    pub fn leaves_out(&self, stored: f64) -> bool {
        self.constants.iter().any(|number| same(*number, stored))
    }

    /// Applies the operations to light whose first row and column are at `corner` of the sensor, where the
    /// mosaic begins, too.
    pub fn apply(&self, light: &mut Array3<f32>, corner: Point, mosaic: Option<&Mosaic>) {
        for Opcode { origin, is_demosaiced, does } in &self.list {
            let [top, left] = [corner.y - origin.y, corner.x - origin.x];
            match does {
                Does::LeaveOutNumber(_) => {}
                Does::LeaveOut(sites) => leave_out(light, [top, left], sites),
                Does::Multiply(area, factor) => {
                    multiply(light, [top, left], area, factor, mosaic.filter(|_| *is_demosaiced));
                }
            }
        }
    }
}

/// Whether two stored numbers are equal; they are integers.
fn same(a: f64, b: f64) -> bool {
    (a - b).abs() < 0.5
}

/// A list is a count, followed by number, version, flags, length and parameters of each opcode.
fn read_list(path: &Path, mut list: Parameters, stage: u32, active: Rect) -> Result<Vec<Opcode>> {
    let cut = || damaged(path, format!("its OpcodeList{stage} is cut short"));
    let count = list.long().ok_or_else(cut)?;
    if count > OPCODES_MAX {
        return Err(damaged(path, format!("its OpcodeList{stage} has more than {OPCODES_MAX} opcodes")));
    }
    let mut opcodes = Vec::new();
    for _ in 0..count {
        let head = [list.long(), list.long(), list.long(), list.long()];
        let [Some(id), Some(_), Some(flags), Some(length)] = head else { return Err(cut()) };
        let parameters = list.take(length as usize).ok_or_else(cut)?;
        let name = NAMES
            .get((id as usize).wrapping_sub(1))
            .map_or_else(|| format!("opcode {id}"), ToString::to_string);
        let is_optional = flags & 1 == 1;
        if is_done(id, stage) {
            let senseless = || damaged(path, format!("its {name} in OpcodeList{stage} is invalid"));
            let does = Does::read(parameters, id, active).ok_or_else(senseless)?;
            let origin = if stage == 1 { Point::zero() } else { active.p };
            opcodes.push(Opcode { origin, is_demosaiced: stage == 3, does });
        } else if CHANGE_LIGHT.contains(&id) || !is_optional {
            let problem = format!(
                "it asks for {name} in OpcodeList{stage}, one of DNG's opcodes, \
                 which this vfold does not apply"
            );
            return Err(Error::picture(path, problem, ELSEWHERE));
        }
    }
    Ok(opcodes)
}

/// Whether an opcode of a list is supported.
fn is_done(id: u32, stage: u32) -> bool {
    match id {
        5 => true,
        4 => stage == 1,
        3 | 9 | 12 | 13 => stage > 1,
        _ => false,
    }
}

impl Does {
    /// None if the parameters are inconsistent.
    fn read(mut parameters: Parameters, id: u32, active: Rect) -> Option<Self> {
        let of = &mut parameters;
        match id {
            4 => return of.long().map(|number| Self::LeaveOutNumber(number.into())),
            5 => return bad_sites(of, active).map(Self::LeaveOut),
            3 => {
                let everywhere =
                    Area { rows: 0..active.d.h, columns: 0..active.d.w, planes: 0..3, pitch: [1, 1] };
                return Some(Self::Multiply(everywhere, Factor::Radial(Radial::read(of, active)?)));
            }
            _ => {}
        }
        let area = Area::read(of)?;
        let factor = match id {
            9 => Factor::Map(GainMap::read(of, active)?),
            12 => Factor::Rows(of.factors(area.rows.len().div_ceil(area.pitch[0]))?),
            _ => Factor::Columns(of.factors(area.columns.len().div_ceil(area.pitch[1]))?),
        };
        Some(Self::Multiply(area, factor))
    }
}

/// Points and rectangles of defective sites; none if they exceed the sensor.
fn bad_sites(of: &mut Parameters, active: Rect) -> Option<Vec<[Range<usize>; 2]>> {
    let _bayer_phase = of.long()?;
    let [points, rectangles] = [of.long()?, of.long()?];
    let mut sites = Vec::new();
    for _ in 0..points {
        let [row, column] = [of.size()?, of.size()?];
        sites.push([row..row + 1, column..column + 1]);
    }
    for _ in 0..rectangles {
        let [top, left, bottom, right] = [of.size()?, of.size()?, of.size()?, of.size()?];
        sites.push([top..bottom.max(top), left..right.max(left)]);
    }
    let count = sites.iter().map(|[rows, columns]| rows.len().saturating_mul(columns.len()));
    let count = count.fold(0, usize::saturating_add);
    (count <= active.d.w * active.d.h).then_some(sites)
}

/// Marks sites as having no light; `top` and `left` are the first row and column of the light in the sites'
/// coordinates.
fn leave_out(light: &mut Array3<f32>, [top, left]: [usize; 2], sites: &[[Range<usize>; 2]]) {
    let (height, width, _) = light.dim();
    let within = |range: &Range<usize>, first: usize, size: usize| {
        range.start.saturating_sub(first).min(size)..range.end.saturating_sub(first).min(size)
    };
    for [rows, columns] in sites {
        for row in within(rows, top, height) {
            let columns = within(columns, left, width);
            let mut row = light.index_axis_mut(Axis(0), row);
            row.slice_axis_mut(Axis(0), Slice::from(columns)).fill(f32::NAN);
        }
    }
}

#[cfg(test)]
mod tests;
