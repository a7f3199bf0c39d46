//! Reads arrays from NPY files: no values are read unless the header agrees with the requirements and the
//! file's length.

use std::fs::File;
use std::io::{self, BufReader, Cursor, Read};
use std::path::Path;

use nalgebra::DMatrix;
use ndarray::{Array2, ShapeBuilder};
use npyz::{NpyFile, Order};

use crate::error::{Error, Result, counted};

/// Largest number of facets of a kernel; one of this size takes 3 GB.
const SQUARE_MAX: u64 = 20_000;
/// Longest header, as in NumPy.
const HEADER_MAX: u64 = 10_000;
/// Most brackets in a header: that of a plain array opens two, and the parser's time doubles with each level
/// of nesting.
const BRACKETS_MAX: usize = 8;

/// Reads a matrix of double precision numbers with the numbers of rows and columns in `shape`, which also
/// names them, in the singular.
///
/// # Errors
/// [`Error::File`] if it cannot be read, [`Error::Array`] if it is not such a matrix.
pub fn read_matrix(path: &Path, shape: [(usize, &str); 2]) -> Result<DMatrix<f64>> {
    let [(rows, row), (cols, col)] = shape;
    let needed = format!("{} by {} are needed", counted(rows, row), counted(cols, col));
    read(path, &needed, |shape| (shape == [rows as u64, cols as u64]).then_some([rows, cols])).map(matrix)
}

/// Reads a square matrix of double precision numbers.
///
/// # Errors
/// As [`read_matrix`].
pub fn read_square(path: &Path) -> Result<DMatrix<f64>> {
    let needed = format!("a square matrix of 1 to {SQUARE_MAX} rows is needed");
    read(path, &needed, |shape| match shape {
        [rows, cols] if rows == cols && (1..=SQUARE_MAX).contains(rows) => Some([*rows as usize; 2]),
        _ => None,
    })
    .map(matrix)
}

/// Reads a row of `cols` double precision numbers, or several rows.
///
/// # Errors
/// As [`read_matrix`].
pub fn read_rows(path: &Path, cols: usize) -> Result<Array2<f64>> {
    let needed = format!("a row of {} is needed, or up to 1000 such rows", counted(cols, "number"));
    read(path, &needed, |shape| match shape {
        [only] if *only == cols as u64 => Some([1, cols]),
        [rows @ 1..=1000, of] if *of == cols as u64 => Some([*rows as usize, cols]),
        _ => None,
    })
}

/// The same numbers in the type of the linear algebra library.
fn matrix(rows: Array2<f64>) -> DMatrix<f64> {
    let (height, width) = rows.dim();
    DMatrix::from_iterator(height, width, rows.reversed_axes())
}

/// Reads an array; `extents` converts its shape to numbers of rows and columns.
fn read(path: &Path, needed: &str, extents: impl Fn(&[u64]) -> Option<[usize; 2]>) -> Result<Array2<f64>> {
    let failed = |e| Error::file(path.display(), e);
    let wrong = |problem| Error::Array { path: path.display().to_string(), problem };
    let mut file = BufReader::new(File::open(path).map_err(failed)?);
    let length = file.get_ref().metadata().map_err(failed)?;
    let is_plain =
        |header: &Vec<u8>| header.iter().filter(|byte| b"([{".contains(byte)).count() <= BRACKETS_MAX;
    let Some(header) = header(&mut file).map_err(failed)?.filter(is_plain) else {
        return Err(wrong("its header is not that of a plain NPY array; save float64 numbers".to_owned()));
    };
    let array = NpyFile::new(Cursor::new(&header).chain(file)).map_err(failed)?;
    let Some([rows, cols]) = extents(array.shape()) else {
        let got = array.shape();
        return Err(wrong(format!("an array of shape {got:?}, but {needed}")));
    };
    let order = array.order();
    let numbers = array.data::<f64>().map_err(|e| wrong(format!("{e}; save float64 numbers")))?;
    if length.is_file() && length.len() < header.len() as u64 + 8 * (rows * cols) as u64 {
        let problem = format!("its header says {rows} x {cols} numbers, but it holds fewer; save it again");
        return Err(wrong(problem));
    }
    let values: Vec<f64> = numbers.collect::<io::Result<_>>().map_err(failed)?;
    let shape = (rows, cols).set_f(order == Order::Fortran);
    Array2::from_shape_vec(shape, values).map_err(|e| wrong(format!("{e}; save it again")))
}

/// The bytes before the numbers of an array; none if longer than any valid header.
fn header(file: &mut impl Read) -> io::Result<Option<Vec<u8>>> {
    let mut header = Vec::new();
    file.take(12).read_to_end(&mut header)?;
    // version 1 has two bytes for the length of the rest, later versions four
    let length = match header[..] {
        [.., 1, _, a, b, _, _] => 10 + u64::from(u16::from_le_bytes([a, b])),
        [.., a, b, c, d] => 12 + u64::from(u32::from_le_bytes([a, b, c, d])),
        _ => 0,
    };
    file.take(length.min(HEADER_MAX).saturating_sub(12)).read_to_end(&mut header)?;
    Ok((length <= HEADER_MAX).then_some(header))
}
