//! Arrays as NPY files, written.

use std::fs::File;
use std::io::{BufWriter, Read, Seek, SeekFrom, Write};
use std::path::Path;

use ndarray::ArrayViewD;
use npyz::WriterBuilder;

use crate::error::{Error, Result};
use crate::files::Saved;

/// Arrays of equal shape, stacked along a new first axis as samples pass, without keeping them in memory.
pub struct ArrayStack {
    saved: Saved,
    data: File,
    shape: Option<Vec<usize>>,
    count: usize,
}

impl ArrayStack {
    /// A stack that will be written to `path`.
    ///
    /// # Errors
    /// [`Error::File`] if the folder cannot be written.
    pub fn new(path: &Path) -> Result<Self> {
        let data = tempfile::tempfile().map_err(spilled)?;
        Ok(Self { saved: Saved::new(path)?, data, shape: None, count: 0 })
    }

    /// Adds one array.
    ///
    /// # Errors
    /// [`Error::Array`] if its shape differs from that of the previous arrays.
    pub fn push(&mut self, array: ArrayViewD<f64>) -> Result<()> {
        let shape = array.shape();
        let first = self.shape.get_or_insert_with(|| shape.to_vec());
        if first != shape {
            let problem = format!("record {} has shape {shape:?}, those before it {first:?}", self.count);
            return Err(Error::Array { path: self.saved.path().display().to_string(), problem });
        }
        let bytes: Vec<u8> = array.iter().flat_map(|value| value.to_le_bytes()).collect();
        self.data.write_all(&bytes).map_err(spilled)?;
        self.count += 1;
        Ok(())
    }

    /// Writes the stack and renames the file.
    ///
    /// # Errors
    /// [`Error::Array`] if nothing was pushed, [`Error::File`] if it cannot be written.
    pub fn finish(mut self) -> Result<()> {
        let path = self.saved.path().display().to_string();
        let Some(shape) = self.shape else {
            return Err(Error::Array {
                path,
                problem: "no record has the field to save; check --save FIELD".to_owned(),
            });
        };
        let shape: Vec<usize> = std::iter::once(self.count).chain(shape).collect();
        let failed = |e| Error::file(&path, e);
        self.data.seek(SeekFrom::Start(0)).map_err(failed)?;
        let mut bytes = Vec::new();
        let mut out = BufWriter::new(self.saved.file_mut());
        let mut writer = begin(&shape, &mut out).map_err(failed)?;
        // in pieces, so that memory use does not depend on the number of records
        while (&mut self.data).take(1 << 20).read_to_end(&mut bytes).map_err(failed)? > 0 {
            let values =
                bytes.chunks_exact(8).map(|chunk| f64::from_le_bytes(std::array::from_fn(|i| chunk[i])));
            writer.extend(values).map_err(failed)?;
            bytes.clear();
        }
        writer.finish().map_err(failed)?;
        out.flush().map_err(failed)?;
        drop(out);
        self.saved.keep()
    }
}

/// Values are stored in the system's folder for temporary files until their number is known.
fn spilled(source: std::io::Error) -> Error {
    Error::file(std::env::temp_dir().display(), source)
}

/// Writes a matrix with only one row in memory at a time.
///
/// # Errors
/// [`Error::File`] if it cannot be written.
pub fn write_matrix(path: &Path, rows: usize, cols: usize, row: impl Fn(usize) -> Vec<f64>) -> Result<()> {
    let mut saved = Saved::new(path)?;
    let failed = |e| Error::file(path.display(), e);
    let mut out = BufWriter::new(saved.file_mut());
    let mut writer = begin(&[rows, cols], &mut out).map_err(failed)?;
    for index in 0..rows {
        writer.extend(row(index)).map_err(failed)?;
    }
    writer.finish().map_err(failed)?;
    out.flush().map_err(failed)?;
    drop(out);
    saved.keep()
}

fn begin<W: Write>(shape: &[usize], out: W) -> std::io::Result<npyz::NpyWriter<f64, W>> {
    let shape: Vec<u64> = shape.iter().map(|extent| *extent as u64).collect();
    npyz::WriteOptions::new().default_dtype().shape(&shape).writer(out).begin_nd()
}
