//! The spectrum of a folded sheet from one photograph, through the library:
//! `cargo run --release --example spectrum`.

use std::error::Error;
use std::io::{Write, stdout};
use std::path::Path;

use vfold::image::{Photograph, Point, ReadOptions};
use vfold::measure::{Setup, sheet};

/// Corners of the panels, px: crease end 0, crease end 1, outer end 1, outer end 0.
const PANELS: [[(f64, f64); 4]; 2] = [
    [(332.1, 462.5), (345.3, 77.1), (121.9, 11.9), (103.9, 442.2)],
    [(332.1, 462.5), (345.3, 77.1), (484.9, 16.7), (472.0, 453.4)],
];

fn main() -> Result<(), Box<dyn Error>> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/photos/a_ideal_magenta_50.exr");
    let photograph = Photograph::open(&file, &ReadOptions::default())?;
    let corners = PANELS.map(|panel| panel.map(|(x, y)| Point::new(x, y)));
    // a sheet that was folded to 50°; camera and light are needed where the file does not name them
    let setup =
        Setup { camera: Some("canon-5d-mark-ii"), illuminant: Some("D65"), ..Setup::new(50.0, corners)? };
    let measured = sheet(&photograph, &setup)?;

    let mut out = stdout().lock();
    writeln!(out, "{}", measured.verdict)?;
    for finding in &measured.estimate.findings {
        writeln!(out, "allowed for: {} ({})", finding.what, finding.remedy)?;
    }
    writeln!(out, "exposure {:.3}", measured.estimate.exposure)?;
    let sd = measured.estimate.reflectance_sd().unwrap_or_default();
    let spectrum = measured.wavelengths_nm.iter().zip(&measured.estimate.reflectance).zip(sd);
    for ((nm, reflectance), sd) in spectrum {
        writeln!(out, "{nm} nm  {reflectance:.3} ± {sd:.3}")?;
    }
    Ok(())
}
