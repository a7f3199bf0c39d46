//! Checksums that identify files.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use sha2::{Digest, Sha256};

use crate::error::{Error, Result};

/// Bytes read at once.
const PIECE: usize = 1 << 16;

/// The SHA-256 checksum of a file, 64 hexadecimal digits, as `sha256sum` prints it.
///
/// # Errors
/// [`Error::File`] if it cannot be read.
///
/// # Source
/// FIPS 180-4.
///
/// # Example
/// ```
/// // the standard's own example
/// let folder = tempfile::tempdir().unwrap();
/// let path = folder.path().join("abc");
/// std::fs::write(&path, "abc").unwrap();
/// let expected = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
/// assert_eq!(vfold::files::sha256(&path)?, expected);
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn sha256(path: &Path) -> Result<String> {
    let digest = File::open(path).and_then(digest).map_err(|source| Error::file(path.display(), source))?;
    Ok(digest.iter().map(|byte| format!("{byte:02x}")).collect())
}

fn digest(mut file: File) -> io::Result<[u8; 32]> {
    let (mut hash, mut piece) = (Sha256::new(), vec![0; PIECE]);
    loop {
        match file.read(&mut piece) {
            Ok(0) => return Ok(hash.finalize().into()),
            Ok(read) => hash.update(&piece[..read]),
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
}
