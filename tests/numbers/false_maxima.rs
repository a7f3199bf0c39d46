//! How many estimates of facets without noise end in a maximum that is not the true one.

use nalgebra::DVector;
use vfold::camera::CameraResponse;
use vfold::estimate::data::FacetData;
use vfold::estimate::measured::Measured;
use vfold::estimate::noise::deviations;
use vfold::estimate::prior::Prior;
use vfold::estimate::unknowns::SceneModel;
use vfold::estimate::{Exposure, map};
use vfold::forward::{FacetModel, FacetValues, Lighting};
use vfold::geometry::{FacetGrid, Fold, Light};
use vfold::kernel::mesh::respond;
use vfold::score::rmse;
use vfold::spectrum::{Outside, WavelengthGrid, camera, illuminant, reflectances};

use crate::common::is_there;

const SETS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data/reflectance");
const SETTINGS: [(&str, &str, Exposure); 2] =
    [("canon-5d-mark-ii", "D65", Exposure::Known(1.0)), ("nikon-d5100", "A", Exposure::Free)];

/// An estimate has ended in a false maximum if it is further from the truth than the one that sets out from
/// there, by 0.01 of RMSE and twice.
#[test]
fn few_estimates_end_in_a_false_maximum() {
    let grid = WavelengthGrid::uniform(400.0, 700.0, 5.0).unwrap();
    let prior = Prior::built_in(grid.wavelengths_nm()).unwrap();
    let names = ["colorchecker_sg140", "vrhel_dupont_paint120", "vrhel_nature79", "vrhel_objects_nocloth129"];
    let names = if is_there(SETS) { &names[..] } else { &[] };
    let files = names.iter().map(|name| format!("{SETS}/{name}.csv"));
    let sets = std::iter::once("cc24".to_owned()).chain(files);
    let spectra: Vec<_> = sets.flat_map(|set| reflectances(&set).unwrap()).collect();
    let fold = Fold::new(45.0, 1.0, 1.0, FacetGrid { rows: 10, cols: 10 }).unwrap();
    let (response, _) = respond(&fold, 1e-5).unwrap();
    let (mut estimates, mut wrong) = (0, Vec::new());
    for (eye, sun, exposure) in SETTINGS {
        let (eye, sun) = (camera(eye).unwrap(), illuminant(sun).unwrap());
        let curves: Vec<_> =
            eye.channels.iter().map(|curve| curve.on(&grid, Outside::Zero).unwrap()).collect();
        let eye = CameraResponse::new(&grid, &curves, &sun.on(&grid, Outside::Refuse).unwrap()).unwrap();
        let light = Light::new(&fold, 0.0, 0.0, 0.0).unwrap();
        let lighting = Lighting { light, sun: eye.clone(), sky: eye };
        let scene = SceneModel::known(FacetModel::one_sheet(&response, &lighting));
        for spectrum in &spectra {
            let truth = spectrum.on(&grid, Outside::Refuse).unwrap();
            // it fluoresces, or was scaled wrongly
            if DVector::from_column_slice(&truth).max() > 1.0 {
                continue;
            }
            let rgb = FacetValues::from(&scene.facets().facet_rgb(&truth));
            let sd = deviations(&rgb, |_| 0.0, 0.0);
            let data = FacetData::new(&scene, &Measured { rgb: &rgb, sd: &sd }, exposure, 1e-2).unwrap();
            let off = |start| rmse(&truth, &map::estimate(&data, &prior, start).unwrap().reflectance);
            let (found, from_truth) = (off(None), off(Some(&truth[..])));
            estimates += 1;
            if found > from_truth + 0.01 && found > 2.0 * from_truth {
                wrong.push(format!("{} {exposure:?}: {found:.4}, {from_truth:.4}", spectrum.name()));
            }
        }
    }
    println!("{} of {estimates} estimates end in a false maximum: {wrong:#?}", wrong.len());
    // none of 984 with all sets; other processors round otherwise
    assert!(wrong.len() <= 1, "{} of {estimates}: {wrong:#?}", wrong.len());
}
