//! A glance at a misfit beside the estimate that it stands for.

use nalgebra::DMatrix;
use vfold::camera::CameraResponse;
use vfold::estimate::data::FacetData;
use vfold::estimate::map::CAUTION;
use vfold::estimate::measured::Measured;
use vfold::estimate::prior::Prior;
use vfold::estimate::unknowns::SceneModel;
use vfold::estimate::{Exposure, map};
use vfold::forward::{FacetModel, FacetValues, Lighting};
use vfold::geometry::{FacetGrid, Fold, Light};
use vfold::kernel::mesh::{Mesh, respond};
use vfold::spectrum::{Outside, WavelengthGrid, camera, illuminant, reflectances};

const NOISE_SD: f64 = 1e-3;

/// No estimate leaves less than the glance says, but for a quarter of it; where facets away from the crease are brighter by a tenth, as those of
/// gloss are, it says that none explains them.
#[test]
fn no_estimate_leaves_less_than_the_glance_says() {
    let grid = WavelengthGrid::uniform(400.0, 700.0, 5.0).unwrap();
    let (eye, sun) = (camera("canon-5d-mark-ii").unwrap(), illuminant("D65").unwrap());
    let curves: Vec<_> = eye.channels.iter().map(|curve| curve.on(&grid, Outside::Zero).unwrap()).collect();
    let eye = CameraResponse::new(&grid, &curves, &sun.on(&grid, Outside::Refuse).unwrap()).unwrap();
    let fold = Fold::new(50.0, 1.0, 1.0, FacetGrid { rows: 6, cols: 3 }).unwrap();
    let (response, _) = respond(&fold, Mesh::Auto, 1e-5).unwrap();
    let light = Light::new(&fold, 0.0, 0.0, 0.0).unwrap();
    let scene =
        SceneModel::known(FacetModel::one_sheet(&response, &Lighting { light, sun: eye.clone(), sky: eye }));
    let prior = Prior::built_in(grid.wavelengths_nm()).unwrap();
    let mut worst = 0.0_f64;
    for spectrum in reflectances("munsell").unwrap().iter().step_by(25) {
        let facets = scene.facets().facet_rgb(&spectrum.on(&grid, Outside::Refuse).unwrap());
        for gloss in [0.0, 0.1, 0.2] {
            let value = |facet: usize, channel: usize| {
                let shine = 1.0 + gloss * (facet % 18 / 3) as f64 / 5.0;
                // what noise would make, and the same in every run
                let noise = (12.9898 * facet as f64 + 78.233 * channel as f64).sin() * 2.0_f64.sqrt();
                (facets[(facet, channel)] * shine + NOISE_SD * noise).max(1e-6)
            };
            let rgb = FacetValues::from(&DMatrix::from_fn(36, 3, value));
            let sd = rgb.map(|_, _| NOISE_SD);
            for exposure in [Exposure::Known(1.0), Exposure::Free] {
                let data = FacetData::new(&scene, &Measured { rgb: &rgb, sd: &sd }, exposure, 1e-2).unwrap();
                let (least, left) =
                    (map::least_misfit(&data, &prior), map::estimate(&data, &prior, None).residual_rms);
                let name = spectrum.name();
                worst = worst.max(least / left);
                assert!(
                    least < CAUTION * left,
                    "{name}, gloss {gloss}, {exposure:?}: {left} left, {least} said"
                );
                let is_bright = facets.max() > 0.1;
                if gloss > 0.0 && is_bright && exposure == Exposure::Known(1.0) {
                    assert!(least > 0.5 * left, "{name}: {left} left, {least} said");
                }
            }
        }
    }
    println!("the glance says at most {worst:.2} times what an estimate leaves");
}
