//! Streams of records, and what the tools make of them.

use vfold::colorimetry::{Colorimeter, Observer};
use vfold::estimate::data::FacetData;
use vfold::estimate::measured::Measured;
use vfold::estimate::noise::{deviations, unexplained};
use vfold::estimate::prior::Prior;
use vfold::estimate::unknowns::{SKY, SceneModel, TILT};
use vfold::estimate::{Exposure, map};
use vfold::forward::FacetValues;
use vfold::scene::Setting;
use vfold::spectrum::{Outside, Spectrum, WavelengthGrid, illuminant, reflectances};
use vfold::stream::{NewEstimate, Output, Reader, Record, Sample, Scene};
use vfold::{Error, Result};

use super::{assert_finite, taken, with_file};

/// Most wavebands of a scene in which samples are estimated.
const MAX_BANDS: usize = 32;

pub fn stream(bytes: &[u8]) {
    let records = read(bytes);
    let mut model = None;
    for record in &records {
        match record {
            Record::Scene(scene) => model = taken(look_at(scene)),
            Record::Sample(sample) => {
                taken(look_at_sample(sample));
                model.as_ref().map(|model| taken(estimate(model, sample)));
            }
            Record::Other(_) => {}
        }
    }
    assert_eq!(read(&written(&records)), records);
}

/// The records up to the first that is none.
pub fn read(bytes: &[u8]) -> Vec<Record> {
    with_file("a.ndjson", bytes, |path| {
        let mut reader = Reader::open(path.to_str().unwrap()).unwrap();
        std::iter::from_fn(|| taken(reader.read()).flatten()).collect()
    })
}

fn written(records: &[Record]) -> Vec<u8> {
    with_file("b.ndjson", &[], |path| {
        let mut out = Output::to(Some(path), &[]).unwrap();
        for record in records {
            match record {
                // a sample whose `error` is no text is refused
                Record::Sample(sample) => out.fields(&sample.fields),
                other => out.record(other),
            }
            .unwrap();
        }
        out.finish().unwrap();
        std::fs::read(path).unwrap()
    })
}

/// What samples need of a scene.
fn look_at(scene: &Scene) -> Result<(WavelengthGrid, SceneModel)> {
    let setting = Setting::of(scene)?;
    for unknown in [&TILT, &SKY] {
        taken(setting.model_to_fit(&[unknown]));
    }
    taken(setting.open_light());
    taken(scene.materials());
    let (grid, model) = (scene.grid()?, setting.model()?);
    for reflectance in [0.0, 0.5, 1.0] {
        let rgb = model.facet_rgb(&vec![reflectance; grid.len()]);
        Sample::new("scene", "id")?.set_facets(&FacetValues::from(&rgb), None, 1)?;
    }
    Ok((grid, SceneModel::known(model)))
}

fn look_at_sample(sample: &Sample) -> Result<()> {
    taken(sample.scores());
    taken(sample.estimate().map(|estimate| estimate.map(|one| (one.doubts(), sample.curve(&one)))));
    let (Some(truth), Some(estimate)) = (sample.truth()?, sample.estimate()?) else { return Ok(()) };
    let of = |name, nm, values| Spectrum::new(name, nm, values).map(Spectrum::as_reflectance);
    let (truth, estimate) = (
        of("truth", truth.wavelengths_nm, truth.reflectance)?,
        of("estimate", estimate.wavelengths_nm, estimate.reflectance)?,
    );
    let grid = WavelengthGrid::uniform(400.0, 700.0, 50.0)?;
    let meter = Colorimeter::new(&grid, &illuminant("D65")?, Observer::Cie1964_10deg)?;
    let on = |spectrum: Spectrum| spectrum.on(&grid, Outside::Refuse);
    assert_finite("CIEDE2000", &[meter.delta_e_2000(&on(truth)?, &on(estimate)?)]);
    Ok(())
}

/// The estimate of a sample is a reflectance, or an error says why not.
fn estimate((grid, scene): &(WavelengthGrid, SceneModel), sample: &Sample) -> Result<()> {
    let rgb = sample.facet_rgb()?;
    let exposure = sample.exposure()?.map_or(Exposure::Free, Exposure::Known);
    if grid.len() > MAX_BANDS || rgb.len() > 64 {
        return Ok(());
    }
    let on_grid = |spectrum: &Spectrum| spectrum.on(grid, Outside::Refuse);
    let spectra: Vec<_> = reflectances("cc24")?.iter().map(on_grid).collect::<Result<_>>()?;
    let prior = Prior::from_spectra(grid.wavelengths_nm(), &spectra, Some(&[0; 24]))?;
    let noise = unexplained(scene.facets(), &rgb);
    let sd = deviations(&rgb, |[_, channel]| noise.get(channel).copied().unwrap_or(0.0), 1e-3);
    let data = FacetData::new(scene, &Measured { rgb: &rgb, sd: &sd }, exposure, 1e-2)?;
    let estimate = map::estimate(&data, &prior, None)?;
    let mut sample = sample.clone();
    let new = NewEstimate {
        method: "interreflection",
        prior: "cc24",
        wavelengths_nm: grid.wavelengths_nm(),
        estimate: &estimate,
        noise: None,
        joined: &[],
        verdict: None,
        with_covariance: true,
    };
    match sample.set_estimate(&new) {
        Ok(_) => assert!(estimate.reflectance.iter().all(|r| (0.0..=1.0).contains(r))),
        Err(error) => return Err(Error::field("estimate", error)),
    }
    Ok(())
}
