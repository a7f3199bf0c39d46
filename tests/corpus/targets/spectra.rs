//! Files of spectra.

use vfold::spectrum::formats::{Measured, write};
use vfold::spectrum::{Outside, Spectrum, WavelengthGrid};
use vfold::stream::specs;

use super::{assert_close, assert_finite, taken, with_file};

pub fn csv(bytes: &[u8]) {
    read_as("csv", bytes);
}

pub fn cgats(bytes: &[u8]) {
    read_as("sp", bytes);
}

pub fn tm27(bytes: &[u8]) {
    read_as("spdx", bytes);
}

pub fn json(bytes: &[u8]) {
    read_as("json", bytes);
}

/// Reads a file as whatever a flag may name.
fn read_as(ending: &str, bytes: &[u8]) {
    with_file(&format!("a.{ending}"), bytes, |path| {
        let spec = path.to_str().unwrap();
        if let Some(illuminant) = taken(specs().illuminant(spec)) {
            check(&illuminant);
            assert!(illuminant.values().iter().all(|power| *power >= 0.0));
        }
        if let Some(camera) = taken(specs().camera(spec)) {
            camera.channels.iter().for_each(check);
        }
        if let Some(spectra) = taken(specs().reflectances(spec)) {
            spectra.iter().for_each(check);
            check_reflectances(&spectra);
        }
    });
}

fn check(spectrum: &Spectrum) {
    let nm = spectrum.wavelengths_nm();
    assert_finite("wavelengths", nm);
    assert_finite("values", spectrum.values());
    assert!(nm.len() >= 2 && nm.len() == spectrum.values().len() && nm.is_sorted_by(|a, b| a < b));
    let (first, last) = spectrum.range_nm();
    // any grid within, one that does not fall on the samples
    if let Ok(grid) = WavelengthGrid::uniform(first, last, (last - first) / 7.3) {
        assert_finite("interpolated", &spectrum.on(&grid, Outside::Refuse).unwrap());
    }
}

/// What is written of reflectances is read again as it was.
fn check_reflectances(spectra: &[Spectrum]) {
    let measured: Vec<_> = spectra.iter().map(measured).collect();
    assert!(measured.iter().flat_map(|one| &one.reflectance).all(|r| (0.0..=1.0).contains(r)));
    for (name, samples) in
        [("b.csv", &measured[..]), ("b.sp", &measured[..]), ("b.spdx", &measured[..measured.len().min(1)])]
    {
        with_file(name, &[], |path| {
            if taken(write(path, samples)).is_none() {
                return;
            }
            let again = specs().reflectances(path.to_str().unwrap()).unwrap();
            assert_eq!(again.len(), samples.len(), "{name}");
            for (again, sample) in again.iter().zip(samples) {
                assert_close(name, again.wavelengths_nm(), &sample.wavelengths_nm);
                assert_close(name, again.values(), &sample.reflectance);
            }
        });
    }
}

fn measured(spectrum: &Spectrum) -> Measured {
    Measured {
        name: spectrum.name().to_owned(),
        wavelengths_nm: spectrum.wavelengths_nm().to_vec(),
        reflectance: spectrum.values().to_vec(),
        reflectance_sd: None,
    }
}
