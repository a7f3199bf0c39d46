//! What speaks against the estimate of a photograph: how it was taken, and what its facets show.

use vfold::Result;
use vfold::estimate::Estimate;
use vfold::estimate::noise::Noise;
use vfold::estimate::shading::Shading;
use vfold::estimate::unknowns::Unknown;
use vfold::estimate::verdict::{Doubt, Level, unusual_exposure, unusual_findings};
use vfold::forward::FacetValues;
use vfold::image::Processing;
use vfold::scene::FoldSetting;
use vfold::spectrum::library::{What, is_built_in};
use vfold::spectrum::{have_one_peak, is_other_camera};
use vfold::stream::{CameraRecord, Making, Sample, Scene};

use super::context::Context;
use super::estimator::Estimator;

/// What speaks against an estimate from how the photograph was taken.
pub fn doubts_of_taking(record: &Scene, sample: &Sample) -> Result<Vec<Doubt>> {
    let (camera, making) = (record.camera()?, sample.making()?);
    let all = [
        developed(&making),
        processed(&making),
        black(&making),
        open_sides(&making),
        scaled(&camera),
        stand_in(&camera),
        another_camera(&camera, &making),
    ];
    Ok(all.into_iter().flatten().collect())
}

fn developed(making: &Making) -> Option<Doubt> {
    making.is_developed.then(|| Doubt {
        level: Level::Wrong,
        because: "this picture was developed for the eye, and neither white balance nor matrix was undone"
            .to_owned(),
        remedy:
            "take the RAW file, or give vextract --undo, or --transfer if its numbers are the camera's own"
                .to_owned(),
    })
}

fn processed(making: &Making) -> Option<Doubt> {
    let because = |processing| match processing {
        Processing::Curve => {
            "noise falls as brightness rises: the picture's numbers have a curve such as sRGB's"
        }
        Processing::Matrix => {
            "the noise of the channels goes opposite ways: a matrix mixed them, as programs do that develop RAW files"
        }
    };
    making.processing.map(|processing| Doubt {
        level: Level::Wrong,
        because: because(processing).to_owned(),
        remedy: "take the RAW file, or a linear TIFF in the camera's own colours".to_owned(),
    })
}

fn black(making: &Making) -> Option<Doubt> {
    making.unsubtracted_black.map(|part| {
        let percent = 100.0 * part;
        Doubt::new(
            format!("the darkest pixels are {percent:.2} % of white in all channels alike: black was not subtracted, it seems"),
            "give vextract --black-level auto, or the camera's black level",
        )
    })
}

fn open_sides(making: &Making) -> Option<Doubt> {
    let sides = making.open_sides.join(", ");
    (!sides.is_empty()).then(|| {
        Doubt::new(
            format!("no edge of the sheet lies along {sides}: it goes on beyond the corners, or does not reach them"),
            "mark the corners of the whole panels, as vextract --overlay shows them",
        )
    })
}

/// Curves scaled one by one have lost what one channel's light is of another's. Of built-in cameras that were published so (docs/spectra.md) the
/// verdict says it without a doubt: the paper, and samples simulated by them, take them as they are.
fn scaled(camera: &CameraRecord) -> Option<Doubt> {
    let has_one_peak = have_one_peak(camera.sensitivities.iter().map(Vec::as_slice));
    (has_one_peak && !is_built_in(What::Cameras, &camera.name)).then(|| {
        Doubt::new(
            format!("all channels of the camera {} have the same peak: scaled one by one, they have lost their ratios", camera.name),
            "give curves on one scale, or make them of a photograph of a colour chart (vextract --save-camera)",
        )
    })
}

fn stand_in(camera: &CameraRecord) -> Option<Doubt> {
    camera.stands_in.as_ref().map(|one| {
        Doubt::new(
            format!("nobody measured the curves of {}: another camera's stand in for them", one.camera),
            "make them of a photograph of a colour chart (vextract --save-camera)",
        )
    })
}

/// A camera that EXIF says is another than the one that was stated.
fn another_camera(camera: &CameraRecord, making: &Making) -> Option<Doubt> {
    let (make, model) = &making.taken_by;
    let is_other = camera.stands_in.is_none() && is_other_camera(&camera.name, make, model);
    is_other.then(|| {
        let took = format!("{make} {model}");
        Doubt::new(
            format!("EXIF says that {} took the picture, not {}", took.trim(), camera.name),
            "give the camera that took it (vextract --camera)",
        )
    })
}

impl Estimator<'_> {
    /// What the facets of a photograph show to speak against its estimate.
    pub fn doubts_of_facets(
        &self,
        context: &Context,
        sample: &Sample,
        (rgb, noise): (&FacetValues, &Noise),
        estimate: &Estimate,
    ) -> Result<Vec<Doubt>> {
        let stated = self.exposure_of(sample)?.known();
        let is_by_chart = sample.fields.has("calibration");
        let mut doubts = unusual_findings(estimate);
        if let Some(record) = &context.record {
            let model = &context.told;
            let sd = noise.deviations(model.facets(), rgb)?;
            let found = |unknown: &Unknown| {
                let one = estimate.fitted.iter().find(|one| one.unknown == unknown);
                one.map(|one| one.value)
            };
            let ideal = model.with_found(found).facet_rgb(&estimate.reflectance);
            let grid = FoldSetting::of(record)?.fold().facets();
            let shading = Shading::new(grid, rgb, &sd, &ideal);
            doubts.extend(shading.into_iter().flat_map(|shading| shading.doubts()));
        }
        if !is_by_chart {
            doubts.extend(unusual_exposure(estimate, stated));
        }
        Ok(doubts)
    }
}
