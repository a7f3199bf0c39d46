//! The bytes of a picture, with random access.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Cursor, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use super::refused::{MAX_BYTES, TOO_LARGE};
use crate::image::photograph::FileStamp;
use crate::{Error, Result};

/// A file opened once. Files without random access, such as a named pipe or a shell's `<(...)`, are read into
/// memory.
#[derive(Debug)]
pub struct PictureFile {
    path: PathBuf,
    length: u64,
    stamp: Option<FileStamp>,
    bytes: Bytes,
}

#[derive(Debug)]
enum Bytes {
    Stored(BufReader<File>),
    Read(Cursor<Vec<u8>>),
}

impl PictureFile {
    /// Opens a file of any content, at most 2 GiB.
    ///
    /// # Errors
    /// [`Error::File`] if it cannot be opened, or is a pipe that cannot be read; [`Error::Picture`] if it is
    /// a folder or too large.
    ///
    /// # Example
    /// ```
    /// use vfold::image::{Photograph, PictureFile, ReadOptions, is_for_the_eye, write_linear};
    /// let folder = tempfile::tempdir().unwrap();
    /// let path = folder.path().join("pixel.exr");
    /// write_linear(&path, 1, 1, &[0.25, 0.5, 2.0])?;
    /// let mut file = PictureFile::open(&path)?;
    /// assert!(!is_for_the_eye(&mut file));
    /// assert_eq!(Photograph::read(file, &ReadOptions::default())?.width(), 1);
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn open(path: &Path) -> Result<Self> {
        let failed = |source| Error::file(path.display(), source);
        let file = File::open(path).map_err(failed)?;
        let metadata = file.metadata().map_err(failed)?;
        if metadata.is_dir() {
            return Err(Error::picture(path, "this is a folder", "name the photographs in it"));
        }
        let (length, bytes) = if metadata.is_file() {
            (metadata.len(), Bytes::Stored(BufReader::new(file)))
        } else {
            let mut read = Vec::new();
            let length = file.take(MAX_BYTES + 1).read_to_end(&mut read).map_err(failed)?;
            (length as u64, Bytes::Read(Cursor::new(read)))
        };
        if length > MAX_BYTES {
            return Err(Error::picture(path, "the file is larger than 2 GiB", TOO_LARGE));
        }
        Ok(Self { path: path.to_owned(), length, stamp: FileStamp::of(&metadata), bytes })
    }

    /// Its name.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Its size and time, if it is a regular file.
    pub(super) fn stamp(&self) -> Option<FileStamp> {
        self.stamp
    }

    /// Its size, bytes.
    pub(super) fn length(&self) -> u64 {
        self.length
    }

    /// All of its bytes.
    pub(super) fn into_bytes(self) -> Result<Vec<u8>> {
        match self.bytes {
            Bytes::Read(bytes) => Ok(bytes.into_inner()),
            Bytes::Stored(mut file) => {
                let mut bytes = Vec::with_capacity(self.length as usize);
                let read = file.rewind().and_then(|()| file.read_to_end(&mut bytes));
                read.map_err(|source| Error::file(self.path.display(), source))?;
                Ok(bytes)
            }
        }
    }
}

impl Read for PictureFile {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        match &mut self.bytes {
            Bytes::Stored(file) => file.read(buffer),
            Bytes::Read(bytes) => bytes.read(buffer),
        }
    }
}

impl BufRead for PictureFile {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        match &mut self.bytes {
            Bytes::Stored(file) => file.fill_buf(),
            Bytes::Read(bytes) => bytes.fill_buf(),
        }
    }

    fn consume(&mut self, count: usize) {
        match &mut self.bytes {
            Bytes::Stored(file) => file.consume(count),
            Bytes::Read(bytes) => bytes.consume(count),
        }
    }
}

impl Seek for PictureFile {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        match &mut self.bytes {
            Bytes::Stored(file) => file.seek(to),
            Bytes::Read(bytes) => bytes.seek(to),
        }
    }
}
