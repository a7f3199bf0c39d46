//! `--resume FILE`: keeps what an interrupted run wrote, and appends the rest.
//!
//! A run produces all lines as usual; [`Resumed`] compares those already in the file and appends the others,
//! so that the file finally equals that of a single run. Expensive tools reuse results from [`Kept`] instead
//! of recomputing them.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use super::{Fields, Reader, Record, Sample};
use crate::error::{Error, Result};
use crate::files::Claim;

/// The beginning of every record.
const BEGINNING: &[u8] = b"{\"kind\":";

/// The records written by an interrupted run, in the order in which this run produces them.
pub struct Kept {
    records: Option<Reader>,
    /// Whether the next valid sample must be recomputed, the only test that the same command wrote it.
    is_unknown: bool,
}

impl Kept {
    /// No records.
    #[must_use]
    pub fn none() -> Self {
        Self { records: None, is_unknown: false }
    }

    /// The same, without recomputing any sample.
    #[must_use]
    pub fn all_known(self) -> Self {
        Self { is_unknown: false, ..self }
    }

    /// The same, with the first valid sample recomputed, because the same command may read other files.
    #[must_use]
    pub fn to_be_checked(self) -> Self {
        Self { is_unknown: true, ..self }
    }

    /// Skips the record of a scene.
    ///
    /// # Errors
    /// As [`Reader::read`].
    pub fn pass(&mut self) -> Result<()> {
        self.next().map(drop)
    }

    /// The next sample, if present and accepted by `is_its` as the result for the input.
    ///
    /// # Errors
    /// As [`Reader::read`].
    pub fn sample(&mut self, is_its: impl Fn(&Sample) -> bool) -> Result<Option<Sample>> {
        match self.next()? {
            Some(Record::Sample(sample)) if is_its(&sample) => {
                let is_made_again = sample.error()?.is_none() && std::mem::take(&mut self.is_unknown);
                Ok(Some(sample).filter(|_| !is_made_again))
            }
            _ => Ok(None),
        }
    }

    fn next(&mut self) -> Result<Option<Record>> {
        self.records.as_mut().map_or(Ok(None), Reader::read)
    }
}

/// A file to which missing lines are appended.
pub struct Resumed {
    file: File,
    path: PathBuf,
    /// Existing lines still to be compared.
    written: BufReader<io::Take<File>>,
    line: usize,
    /// Bytes in complete lines.
    whole: u64,
    is_cut: bool,
    has_history: bool,
    _claim: Claim,
}

impl Resumed {
    /// Opens or creates a file and locks it against other runs; `has_history` is true if its scenes record
    /// how they were made.
    ///
    /// # Errors
    /// [`Error::Usage`] for standard output, [`Error::File`] if it cannot be read or written,
    /// [`Error::Record`] if it ends in anything other than part of a record.
    pub fn open(path: &Path, has_history: bool) -> Result<Self> {
        let failed = |e| Error::file(path.display(), e);
        if path == Path::new("-") {
            return Err(Error::usage("--resume", "standard output cannot be read again", "name a file"));
        }
        let mut file =
            File::options().read(true).write(true).create(true).truncate(false).open(path).map_err(failed)?;
        if !file.metadata().map_err(failed)?.is_file() {
            return Err(failed(io::Error::other("not a regular file: it cannot be resumed")));
        }
        #[cfg(unix)]
        rustix::fs::flock(&file, rustix::fs::FlockOperation::NonBlockingLockExclusive)
            .map_err(|_| failed(io::Error::other("another run is writing it")))?;
        let (lines, whole) = whole_lines(&file).map_err(failed)?;
        let mut rest = Vec::new();
        file.seek(SeekFrom::Start(whole)).map_err(failed)?;
        (&file).take(BEGINNING.len() as u64).read_to_end(&mut rest).map_err(failed)?;
        if !BEGINNING.starts_with(&rest) {
            return Err(wrong(path, lines + 1, "the last line is not part of a record"));
        }
        let written = BufReader::new(File::open(path).map_err(failed)?.take(whole));
        let claim = Claim::new(&path.canonicalize().map_err(failed)?)?;
        let path = path.to_owned();
        Ok(Self { file, path, written, line: 0, whole, is_cut: false, has_history, _claim: claim })
    }

    /// The file's contents as records.
    ///
    /// # Errors
    /// [`Error::File`] if it cannot be reopened.
    pub fn kept(&self) -> Result<Kept> {
        let file = File::open(&self.path).map_err(|e| Error::file(self.path.display(), e))?;
        let source = BufReader::new(file.take(self.whole));
        let records = Reader::new(Box::new(source), &self.path.display().to_string());
        Ok(Kept { records: Some(records), is_unknown: !self.has_history })
    }

    /// Keeps at most this many lines of the file; to be called before any is compared.
    ///
    /// # Errors
    /// [`Error::File`] if it cannot be reread.
    pub fn keep(&mut self, lines: usize) -> Result<()> {
        let reopened = || File::open(&self.path).map_err(|e| self.failed(e));
        let mut kept = BufReader::new(reopened()?.take(self.whole));
        let mut bytes = 0;
        for _ in 0..lines {
            bytes += kept.skip_until(b'\n').map_err(|e| self.failed(e))? as u64;
        }
        self.written = BufReader::new(reopened()?.take(bytes));
        self.whole = bytes;
        Ok(())
    }

    /// Compares a line with the existing one, or appends it.
    ///
    /// # Errors
    /// [`Error::Record`] if the existing line differs, [`Error::File`] if the file cannot be read or written.
    pub fn write(&mut self, line: &[u8]) -> Result<()> {
        let mut there = Vec::new();
        let read = self.written.read_until(b'\n', &mut there);
        self.line += 1;
        match read.map_err(|e| self.failed(e))? {
            0 => self.append(line),
            _ if there == line => Ok(()),
            _ => Err(wrong(&self.path, self.line, &difference(&there, line))),
        }
    }

    fn append(&mut self, line: &[u8]) -> Result<()> {
        self.cut()?;
        self.file.write_all(line).map_err(|e| self.failed(e))
    }

    /// Removes an incomplete last line.
    fn cut(&mut self) -> Result<()> {
        if !self.is_cut {
            self.file.set_len(self.whole).map_err(|e| self.failed(e))?;
            self.file.seek(SeekFrom::Start(self.whole)).map_err(|e| self.failed(e))?;
            self.is_cut = true;
        }
        Ok(())
    }

    /// Checks that the file contains nothing but the lines written, and flushes it to disk.
    ///
    /// # Errors
    /// [`Error::Record`] if it has more lines, [`Error::File`] if it cannot be read or truncated.
    pub fn finish(mut self) -> Result<()> {
        match self.written.fill_buf().map_err(|e| Error::file(self.path.display(), e))? {
            [] => self.cut().and_then(|()| self.file.sync_data().map_err(|e| self.failed(e))),
            _ => Err(wrong(&self.path, self.line + 1, "more records than this run makes")),
        }
    }

    fn failed(&self, source: io::Error) -> Error {
        Error::file(self.path.display(), source)
    }
}

/// Number of complete lines, and their bytes.
fn whole_lines(file: &File) -> io::Result<(usize, u64)> {
    let (mut reader, mut lines, mut whole, mut read) = (BufReader::new(file), 0, 0, 0);
    loop {
        let bytes = reader.fill_buf()?;
        if bytes.is_empty() {
            return Ok((lines, whole));
        }
        lines += bytes.iter().filter(|byte| **byte == b'\n').count();
        if let Some(last) = bytes.iter().rposition(|byte| *byte == b'\n') {
            whole = read + last as u64 + 1;
        }
        let taken = bytes.len();
        read += taken as u64;
        reader.consume(taken);
    }
}

fn wrong(path: &Path, line: usize, problem: &str) -> Error {
    Error::Record {
        path: path.display().to_string(),
        line,
        problem: problem.to_owned(),
        remedy: "--resume continues what the same command wrote from the same input; give another file"
            .to_owned(),
    }
}

/// Describes the difference between two records.
fn difference(there: &[u8], made: &[u8]) -> String {
    let fields = |line| serde_json::from_slice::<Fields>(line).ok();
    let (Some(there), Some(made)) = (fields(there), fields(made)) else {
        return "not the line that this run writes".to_owned();
    };
    let id = |fields: &Fields| fields.get::<String>("id").ok().flatten().unwrap_or_default();
    let name = |fields: &Fields| format!("{} '{}'", fields.kind(), id(fields));
    if name(&there) != name(&made) {
        return format!("{}, where this run makes {}", name(&there), name(&made));
    }
    match made.names().chain(there.names()).find(|field| there.text(field) != made.text(field)) {
        Some(field) => format!("the '{field}' of {} is not what this run makes", name(&there)),
        None => format!("{} is written differently by this run", name(&there)),
    }
}
