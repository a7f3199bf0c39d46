//! What is fuzzed: functions that take any bytes, and panic if a reader does anything but take them or refuse
//! them in one plain line.
//!
//! `sheen/` calls them with new inputs, `tests/corpus` with those that were kept.

mod drawn;
mod flags;
mod kernels;
mod pictures;
mod placed;
pub mod records;
mod regions;
mod shapes;
mod sheets;
mod spectra;
mod stream;
mod surfaces;

use std::path::Path;

use tempfile::TempDir;
use vfold::{Result, cli};

/// Anything that takes bytes.
pub type Target = fn(&[u8]);

/// All of them, by the names of their folders.
pub const TARGETS: &[(&str, Target)] = &[
    ("stream", stream::stream),
    ("records", records::records),
    ("sheet", sheets::sheet),
    ("npy", kernels::npy),
    ("csv", spectra::csv),
    ("cgats", spectra::cgats),
    ("tm27", spectra::tm27),
    ("spectra_json", spectra::json),
    ("obj", shapes::obj),
    ("ply", shapes::ply),
    ("shape_json", shapes::json),
    ("regions", regions::regions),
    ("development", regions::development),
    ("picture", pictures::picture),
    #[cfg(feature = "raw")]
    ("raw", pictures::raw),
    ("refined", placed::refined),
    ("chart", placed::chart),
    ("surface", surfaces::surface),
    ("clusters", surfaces::clusters),
    ("spec", flags::spec),
    ("values", flags::values),
];

thread_local! {
    static FOLDER: TempDir = tempfile::tempdir().unwrap();
}

/// Shows `reader` a file of this name and content, in a folder of its own.
fn with_file<T>(name: &str, bytes: &[u8], reader: impl FnOnce(&Path) -> T) -> T {
    FOLDER.with(|folder| {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        reader(&path)
    })
}

/// What was read; or none, if it was refused in one plain line.
fn taken<T>(result: Result<T>) -> Option<T> {
    let error = match result {
        Ok(value) => return Some(value),
        Err(error) => error,
    };
    let line = cli::one_line(&error.to_string());
    assert!(line.len() > 10 && line.len() < 10_000 && !line.contains(char::is_control), "{line:?}");
    assert!(matches!(error.exit_status(), 1 | 2), "{line}");
    None
}

fn assert_finite<'a>(what: &str, numbers: impl IntoIterator<Item = &'a f64>) {
    if let Some(number) = numbers.into_iter().find(|number| !number.is_finite()) {
        panic!("{what}: {number} was taken");
    }
}

fn assert_close(what: &str, found: &[f64], wanted: &[f64]) {
    assert_eq!(found.len(), wanted.len(), "{what}");
    for (found, wanted) in found.iter().zip(wanted) {
        assert!((found - wanted).abs() <= 1e-12 * wanted.abs().max(1e-3), "{what}: {found} for {wanted}");
    }
}
