//! DNG's lists of what is still to be done to a sensor's numbers.
//!
//! What multiplies light, or names pixels that saw none, is done, also where the file leaves it to the reader. Curves are not: such a file is
//! refused. So is one that insists on anything else; what it leaves to the reader beyond that, such as the distortion of the lens, stays undone.
//!
//! # Source
//! Adobe, *Digital Negative Specification* 1.7, chapter 7.

use std::ops::Range;
use std::path::Path;

use ndarray::{Array3, Axis, Slice};
use rawler::imgop::{Point, Rect};
use rayon::prelude::*;

use super::tiff_directories::Directory;
use super::{ELSEWHERE, damaged};
use crate::image::photograph::Mosaic;
use crate::{Error, Result};

/// `OpcodeList1` is for numbers as stored, the second for light, the third for light after demosaicing.
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

/// Those without which numbers are not in proportion to light, so that none is passed over. Of the deltas readers differ about the unit.
const CHANGE_LIGHT: [u32; 8] = [3, 7, 8, 9, 10, 11, 12, 13];

/// A sensor has a map of gains for each colour of its mosaic, sixteen at most, and little more.
const OPCODES_MAX: u32 = 64;

/// What is to be done, in this order.
#[derive(Default)]
pub(super) struct Opcodes(Vec<Opcode>);

struct Opcode {
    /// Column and row of the sensor from which it counts.
    origin: Point,
    /// Whether it is for all colours of each pixel.
    is_demosaiced: bool,
    does: Does,
}

enum Does {
    /// Sites that stored this number saw nothing.
    LeaveOutNumber(f64),
    /// Sites in these rows and columns saw nothing.
    LeaveOut(Vec<[Range<usize>; 2]>),
    Multiply(Area, Factor),
}

/// The sites that an opcode is for.
struct Area {
    rows: Range<usize>,
    columns: Range<usize>,
    planes: Range<usize>,
    /// From row to row and from column to column.
    pitch: [usize; 2],
}

enum Factor {
    Map(GainMap),
    /// One for each row of the area,
    Rows(Vec<f32>),
    /// or for each of its columns.
    Columns(Vec<f32>),
    Radial(Radial),
}

/// Gains at points of a grid, in parts of the picture's height and width; between them by two straight lines.
struct GainMap {
    /// By row, column and plane.
    gains: Array3<f32>,
    origin: [f64; 2],
    spacing: [f64; 2],
    /// Height and width of the picture.
    size: [f64; 2],
}

/// A polynomial of the square of the distance from the lens's axis, 1 in the farthest corner.
struct Radial {
    coefficients: [f64; 5],
    /// Row and column of the axis.
    centre: [f64; 2],
    farthest_squared: f64,
}

/// Numbers of an opcode, big end first.
struct Parameters<'a>(&'a [u8]);

impl Opcodes {
    /// The lists of a sensor's directory; those for light count from its active area's corner.
    ///
    /// # Errors
    /// [`Error::Picture`] if a list is damaged, or has an opcode that cannot be done and must not be passed over.
    pub fn read(path: &Path, directory: &Directory, active: Rect) -> Result<Self> {
        let mut opcodes = Vec::new();
        for (tag, stage) in LISTS.into_iter().zip(1..) {
            if let Some(list) = directory.bytes(tag) {
                opcodes.extend(read_list(path, Parameters(list), stage, active)?);
            }
        }
        Ok(Self(opcodes))
    }

    /// Whether sites that stored this number saw nothing.
    pub fn leaves_out(&self, stored: f64) -> bool {
        self.0
            .iter()
            .any(|opcode| matches!(opcode.does, Does::LeaveOutNumber(number) if same(number, stored)))
    }

    /// Does what is to be done to light, of which the first row and column are those at `corner` of the sensor; the mosaic begins there, too.
    pub fn apply(&self, light: &mut Array3<f32>, corner: Point, mosaic: Option<&Mosaic>) {
        for Opcode { origin, is_demosaiced, does } in &self.0 {
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

/// Stored numbers are whole.
fn same(a: f64, b: f64) -> bool {
    (a - b).abs() < 0.5
}

/// A list is a count, and for each opcode its number, version, flags, length and parameters.
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
            let senseless = || damaged(path, format!("its {name} in OpcodeList{stage} makes no sense"));
            let does = Does::read(parameters, id, active).ok_or_else(senseless)?;
            let origin = if stage == 1 { Point::zero() } else { active.p };
            opcodes.push(Opcode { origin, is_demosaiced: stage == 3, does });
        } else if CHANGE_LIGHT.contains(&id) || !is_optional {
            let problem = format!(
                "it asks for {name} in OpcodeList{stage}, one of DNG's opcodes, which this vfold does not apply"
            );
            return Err(Error::picture(path, problem, ELSEWHERE));
        }
    }
    Ok(opcodes)
}

/// Whether an opcode of a list is one of those that are done.
fn is_done(id: u32, stage: u32) -> bool {
    match id {
        5 => true,
        4 => stage == 1,
        3 | 9 | 12 | 13 => stage > 1,
        _ => false,
    }
}

impl Does {
    /// None if the parameters make no sense.
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

/// Points and rectangles of sites that saw nothing; none if they are more than the sensor has.
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

impl<'a> Parameters<'a> {
    fn take(&mut self, bytes: usize) -> Option<Parameters<'a>> {
        let (taken, rest) = self.0.split_at_checked(bytes)?;
        self.0 = rest;
        Some(Parameters(taken))
    }

    fn long(&mut self) -> Option<u32> {
        self.take(4).and_then(|bytes| Some(u32::from_be_bytes(*bytes.0.first_chunk()?)))
    }

    fn size(&mut self) -> Option<usize> {
        self.long().map(|size| size as usize)
    }

    fn double(&mut self) -> Option<f64> {
        let bytes = self.take(8)?;
        Some(f64::from_be_bytes(*bytes.0.first_chunk()?)).filter(|double| double.is_finite())
    }

    /// So many floats that light can be multiplied by.
    fn gains(&mut self, count: usize) -> Option<Vec<f32>> {
        let floats = self.take(count.checked_mul(4)?)?;
        let gains =
            floats.0.chunks_exact(4).filter_map(|bytes| Some(f32::from_be_bytes(*bytes.first_chunk()?)));
        let gains: Vec<f32> = gains.collect();
        gains.iter().all(|gain| *gain >= 0.0 && gain.is_finite()).then_some(gains)
    }

    /// The same behind their number, which must be `count`.
    fn factors(&mut self, count: usize) -> Option<Vec<f32>> {
        (self.size()? == count).then(|| self.gains(count))?
    }
}

impl Area {
    fn read(of: &mut Parameters) -> Option<Self> {
        let [top, left, bottom, right] = [of.size()?, of.size()?, of.size()?, of.size()?];
        let [plane, planes, row_pitch, column_pitch] = [of.size()?, of.size()?, of.size()?, of.size()?];
        let makes_sense = top < bottom && left < right && row_pitch > 0 && column_pitch > 0;
        makes_sense.then(|| Self {
            rows: top..bottom,
            columns: left..right,
            planes: plane..plane + planes,
            pitch: [row_pitch, column_pitch],
        })
    }

    fn has_row(&self, row: usize) -> bool {
        self.rows.contains(&row) && (row - self.rows.start).is_multiple_of(self.pitch[0])
    }

    fn has_column(&self, column: usize) -> bool {
        self.columns.contains(&column) && (column - self.columns.start).is_multiple_of(self.pitch[1])
    }
}

impl GainMap {
    fn read(of: &mut Parameters, active: Rect) -> Option<Self> {
        let points = [of.size()?, of.size()?];
        let spacing = [of.double()?, of.double()?];
        let origin = [of.double()?, of.double()?];
        let planes = of.size()?;
        let gains = of.gains(points[0].checked_mul(points[1])?.checked_mul(planes)?)?;
        let gains = Array3::from_shape_vec((points[0], points[1], planes), gains).ok()?;
        // of a single point neither says anything
        let makes_sense = !gains.is_empty() && (0..2).all(|axis| points[axis] == 1 || spacing[axis] > 0.0);
        makes_sense.then(|| Self { gains, origin, spacing, size: [active.d.h as f64, active.d.w as f64] })
    }

    fn at(&self, row: usize, column: usize, plane: usize) -> f64 {
        let plane = plane.min(self.gains.dim().2 - 1);
        let (above, down) = self.place(0, row);
        let (left, right) = self.place(1, column);
        let gain = |row: usize, column: usize| {
            let (rows, columns, _) = self.gains.dim();
            f64::from(self.gains[[row.min(rows - 1), column.min(columns - 1), plane]])
        };
        let along = |row| (1.0 - right) * gain(row, left) + right * gain(row, left + 1);
        (1.0 - down) * along(above) + down * along(above + 1)
    }

    /// The point of the grid before a pixel's middle, and how far that is behind it; beyond the grid, its edge.
    fn place(&self, axis: usize, pixel: usize) -> (usize, f64) {
        let last = self.gains.shape()[axis] - 1;
        if last == 0 {
            return (0, 0.0);
        }
        let place = ((pixel as f64 + 0.5) / self.size[axis] - self.origin[axis]) / self.spacing[axis];
        let place = place.clamp(0.0, last as f64);
        (place as usize, place.fract())
    }
}

impl Radial {
    fn read(of: &mut Parameters, active: Rect) -> Option<Self> {
        let coefficients = [of.double()?, of.double()?, of.double()?, of.double()?, of.double()?];
        let [height, width] = [active.d.h as f64, active.d.w as f64];
        let (x, y) = (width * of.double()?, height * of.double()?);
        let farthest_squared = x.max(width - x).powi(2) + y.max(height - y).powi(2);
        Some(Self { coefficients, centre: [y, x], farthest_squared })
    }

    fn at(&self, row: usize, column: usize) -> f64 {
        let [y, x] = self.centre;
        let squared =
            ((row as f64 + 0.5 - y).powi(2) + (column as f64 + 0.5 - x).powi(2)) / self.farthest_squared;
        1.0 + squared * self.coefficients.iter().rev().fold(0.0, |sum, k| sum * squared + k)
    }
}

/// Marks sites as having no light; `top` and `left` are where the light begins, counted as the sites are.
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

/// Multiplies an area's light; `top` and `left` are where the light begins, counted as the area is. Of a mosaic each site is of its colour's
/// plane, if there is one; else of the first.
fn multiply(
    light: &mut Array3<f32>,
    [top, left]: [usize; 2],
    area: &Area,
    factor: &Factor,
    mosaic: Option<&Mosaic>,
) {
    light.outer_iter_mut().into_par_iter().enumerate().for_each(|(row, mut light)| {
        let y = top + row;
        if !area.has_row(y) {
            return;
        }
        for ((column, sample), light) in light.indexed_iter_mut() {
            let x = left + column;
            let plane = mosaic.map_or(sample, |mosaic| mosaic.colour(column, row));
            if area.has_column(x) && area.planes.contains(&plane) {
                let factor = match factor {
                    Factor::Map(map) => map.at(y, x, plane),
                    Factor::Rows(factors) => factors[(y - area.rows.start) / area.pitch[0]].into(),
                    Factor::Columns(factors) => factors[(x - area.columns.start) / area.pitch[1]].into(),
                    Factor::Radial(radial) => radial.at(y, x),
                };
                *light = (f64::from(*light) * factor) as f32;
            }
        }
    });
}

#[cfg(test)]
mod tests {
    use rawler::imgop::Dim2;

    use super::*;

    const ACTIVE: Rect = Rect { p: Point { x: 1, y: 2 }, d: Dim2 { w: 8, h: 6 } };

    fn list(opcodes: &[(u32, u32, Vec<u8>)]) -> Vec<u8> {
        let mut bytes = (opcodes.len() as u32).to_be_bytes().to_vec();
        for (id, flags, parameters) in opcodes {
            let head = [*id, 0x0103_0000, *flags, parameters.len() as u32];
            bytes.extend(head.into_iter().flat_map(u32::to_be_bytes));
            bytes.extend(parameters);
        }
        bytes
    }

    fn longs(longs: &[u32]) -> Vec<u8> {
        longs.iter().flat_map(|long| long.to_be_bytes()).collect()
    }

    fn read(stage: u32, opcodes: &[(u32, u32, Vec<u8>)]) -> Result<Opcodes> {
        read_list(Path::new("a.dng"), Parameters(&list(opcodes)), stage, ACTIVE).map(Opcodes)
    }

    /// What is left of even light; the picture is the active area without its first row and column.
    fn light(stage: u32, opcodes: &[(u32, u32, Vec<u8>)], mosaic: Option<&Mosaic>) -> Array3<f32> {
        let mut light = Array3::from_elem((5, 7, 1), 0.5);
        read(stage, opcodes).unwrap().apply(&mut light, Point::new(2, 3), mosaic);
        light
    }

    #[test]
    fn what_is_not_done_is_named() {
        let refusal = |stage, opcodes: &[(u32, u32, Vec<u8>)]| match read(stage, opcodes) {
            Ok(_) => String::new(),
            Err(error) => error.to_string(),
        };
        for (id, name) in (1..).zip(NAMES).filter(|(id, _)| !is_done(*id, 3)) {
            assert!(refusal(3, &[(5, 0, longs(&[0; 3])), (id, 0, vec![0; 8])]).contains(name), "{name}");
            let passed_over = refusal(3, &[(id, 1, vec![0; 8])]).is_empty();
            assert_eq!(passed_over, !CHANGE_LIGHT.contains(&id), "{name}");
        }
        assert!(refusal(2, &[(99, 0, vec![])]).contains("opcode 99"));
        assert!(refusal(1, &[(9, 1, vec![])]).contains("GainMap in OpcodeList1"));
    }

    #[test]
    fn what_makes_no_sense_is_damaged() {
        let whole = list(&[(9, 0, vec![0; 76])]);
        for bytes in [&whole[..], &whole[..40], &[], &u32::MAX.to_be_bytes().repeat(9)] {
            assert!(read_list(Path::new("a.dng"), Parameters(bytes), 2, ACTIVE).is_err());
        }
        assert!(read(1, &[(5, 0, longs(&[0, 0, 1, 0, 0, 1000, 1000]))]).is_err());
    }

    #[test]
    fn bad_sites_have_no_light() {
        // a point of the picture, one before it and one behind; a rectangle that reaches beyond
        let sites = longs(&[0, 3, 1, 4, 3, 0, 0, 90, 90, 5, 7, 8, 12]);
        let light = light(1, &[(5, 0, sites)], None);
        let missing = light.indexed_iter().filter(|(_, light)| light.is_nan()).map(|((y, x, _), _)| (y, x));
        assert_eq!(missing.collect::<Vec<_>>(), [(1, 1), (2, 5), (2, 6), (3, 5), (3, 6), (4, 5), (4, 6)]);
        let constant = read(1, &[(4, 1, longs(&[7, 0]))]).unwrap();
        assert!(constant.leaves_out(7.0) && !constant.leaves_out(8.0));
    }

    #[test]
    fn rows_and_columns_have_factors_of_their_own() {
        let factors = |area: &[u32], factors: &[f32]| {
            let floats = factors.iter().flat_map(|factor| factor.to_be_bytes());
            [longs(area), longs(&[factors.len() as u32]), floats.collect()].concat()
        };
        // every other row from the active area's second on, all columns but the last
        let rows = factors(&[1, 0, 6, 7, 0, 1, 2, 1], &[2.0, 3.0, 4.0]);
        let columns = factors(&[0, 1, 6, 3, 0, 1, 1, 1], &[10.0, 100.0]);
        let light = light(2, &[(12, 0, rows), (13, 1, columns)], None);
        let row = |row: usize| [0, 1, 2, 3].map(|column| light[[row, column, 0]]);
        assert_eq!([row(0), row(1)], [[10.0, 100.0, 1.0, 1.0], [5.0, 50.0, 0.5, 0.5]]);
        assert_eq!((light[[2, 6, 0]], light[[2, 5, 0]], light[[4, 5, 0]]), (0.5, 1.5, 2.0));
    }

    /// The axis in the middle, light twice as bright in the farthest corner, by the distance's square.
    #[test]
    fn vignetting_grows_from_the_axis() {
        let doubles = [1.0, 0.0, 0.0, 0.0, 0.0, 0.5, 0.5].into_iter().flat_map(f64::to_be_bytes);
        let light = light(3, &[(3, 1, doubles.collect())], None);
        // half a pixel from the axis both ways, and 3.5 and 2.5 px; the corner is 5 px off
        for (site, factor) in [([1, 2, 0], 1.02), ([4, 6, 0], 1.74)] {
            assert!((light[site] - 0.5 * factor).abs() < 1e-6, "{site:?}: {}", light[site]);
        }
    }

    /// After demosaicing a site's plane is its colour.
    #[test]
    fn planes_are_colours_after_demosaicing() {
        let one_gain = |plane: u32| {
            let map = [
                longs(&[0, 0, 6, 8, plane, 1, 1, 1, 1, 1]),
                vec![0; 32],
                longs(&[1]),
                3_f32.to_be_bytes().to_vec(),
            ];
            vec![(9, 0, map.concat())]
        };
        let mosaic = Mosaic::new("RGGB").unwrap();
        let corner = |light: &Array3<f32>| (light[[0, 0, 0]], light[[0, 1, 0]], light[[1, 1, 0]]);
        assert_eq!(corner(&light(3, &one_gain(1), Some(&mosaic))), (0.5, 1.5, 0.5));
        assert_eq!(corner(&light(2, &one_gain(0), Some(&mosaic))), (1.5, 1.5, 1.5));
        assert_eq!(corner(&light(2, &one_gain(1), Some(&mosaic))), (0.5, 0.5, 0.5));
    }
}
