//! Photographs of real sheets: what an ideal fold leaves out is estimated with the spectrum.

use vfold::Result;
use vfold::estimate::measured::Measured;
use vfold::estimate::noise::deviations;
use vfold::estimate::photograph::{Parts, estimate};
use vfold::estimate::prior::Prior;
use vfold::scene::{FoldSetting, PhotographedFold, Picture};
use vfold::spectrum::{Outside, Spectrum, WavelengthGrid, reflectances};
use vfold::stream::{Record, Sample, Scene};

use super::records::edited;
use super::stream::read;
use super::{assert_finite, taken};

/// A glossy sheet.
const STREAM: &str = include_str!("../streams/photograph.ndjson");

/// A photograph with edits, alone or, as the first byte says, with the same before the edits: an estimate, or
/// a reason why there is none.
pub fn sheet(bytes: &[u8]) {
    let (how, edits) = bytes.split_first().unwrap_or((&0, &[]));
    let beside = parts_of(STREAM).filter(|_| how % 4 == 0);
    let Some((parts, grid)) = parts_of(&edited(STREAM, edits)) else { return };
    let beside =
        beside.filter(|(_, other)| other.wavelengths_nm() == grid.wavelengths_nm()).map(|(parts, _)| parts);
    let photographs: Vec<Parts> = beside.into_iter().chain([parts]).collect();
    taken(look_at(&photographs, &grid));
}

/// The parts of the photograph in a stream, and the grid of its wavelengths.
fn parts_of(stream: &str) -> Option<(Parts, WavelengthGrid)> {
    let records = read(stream.as_bytes());
    let [Record::Scene(scene), Record::Sample(sample)] = &records[..] else { return None };
    taken(parts(scene, sample))?
}

fn parts(scene: &Scene, sample: &Sample) -> Result<Option<(Parts, WavelengthGrid)>> {
    let setting = FoldSetting::of(scene)?;
    let rgb = sample.facet_rgb()?;
    let sd = sample.facet_sd()?.unwrap_or_else(|| deviations(&rgb, |_| 1e-3, 0.0));
    let measured = Measured { rgb: &rgb, sd: &sd };
    let parts = PhotographedFold::of(&setting).parts(&Picture::of(sample, &measured, sample.exposure()?)?)?;
    Ok(parts.ok().zip(Some(scene.grid()?)))
}

fn look_at(photographs: &[Parts], grid: &WavelengthGrid) -> Result<()> {
    let chart = reflectances("cc24")?;
    let on_grid = |spectrum: &Spectrum| spectrum.on(grid, Outside::Refuse);
    let spectra: Vec<_> = chart.iter().map(on_grid).collect::<Result<_>>()?;
    let prior = Prior::from_spectra(grid.wavelengths_nm(), &spectra, Some(&[0; 24]))?;
    let sheet = estimate(photographs, &prior)?;
    assert!(!sheet.ln_evidence.is_nan(), "evidence");
    for estimate in &sheet.photographs {
        assert!(estimate.reflectance.iter().all(|r| (0.0..=1.0).contains(r)), "{:?}", estimate.reflectance);
        assert_finite("sd", &estimate.reflectance_sd().unwrap_or_default());
        assert_finite("exposure", &[estimate.exposure]);
        assert_finite("unknowns", estimate.fitted.iter().flat_map(|one| [&one.value, &one.sd]));
    }
    Ok(())
}
