//! Derivatives of facets of a sheet that sends out light itself, beside differences.

use nalgebra::DVector;
use vfold::camera::CameraResponse;
use vfold::estimate::Exposure;
use vfold::estimate::data::FacetData;
use vfold::estimate::emission::Backing;
use vfold::estimate::measured::Measured;
use vfold::estimate::noise::deviations;
use vfold::estimate::unknowns::{Normal, SceneModel};
use vfold::forward::{FacetModel, FacetValues, Lighting};
use vfold::geometry::{FacetGrid, Fold, Light};
use vfold::kernel::mesh::respond;
use vfold::spectrum::{Outside, WavelengthGrid, camera, illuminant};

const STEP: f64 = 1e-5;

#[test]
fn facets_of_a_sheet_that_fluoresces_have_their_derivatives() {
    let grid = WavelengthGrid::uniform(400.0, 700.0, 10.0).unwrap();
    let fold = Fold::new(50.0, 1.0, 1.0, FacetGrid { rows: 4, cols: 4 }).unwrap();
    let (response, _) = respond(&fold, 1e-5).unwrap();
    let (eye, sun) = (camera("nikon-d5100").unwrap(), illuminant("D65").unwrap());
    let power = sun.on(&grid, Outside::Refuse).unwrap();
    let curves: Vec<_> = eye.channels.iter().map(|curve| curve.on(&grid, Outside::Zero).unwrap()).collect();
    let eye = CameraResponse::new(&grid, &curves, &power).unwrap();
    // from the side, so that panels are lit unevenly
    let lighting = Lighting { light: Light::new(&fold, 10.0, 0.0, 0.2).unwrap(), sun: eye.clone(), sky: eye };
    let scene = SceneModel::known(FacetModel::one_sheet(&response, &lighting)).under(
        grid.wavelengths_nm(),
        &power,
        Backing::Unknown,
    );
    let reflectance: Vec<f64> = (0..grid.len()).map(|n| 0.6 + 0.3 * (n as f64 / 5.0).sin()).collect();
    let rgb = FacetValues::from(&scene.facets().facet_rgb(&reflectance));
    let sd = deviations(&rgb, |_| 1e-3, 0.0);
    let expected = Exposure::Expected(Normal { mean: 0.1, sd: 0.2 });
    for exposure in [Exposure::Known(1.2), expected] {
        let plain = FacetData::new(&scene, &Measured { rgb: &rgb, sd: &sd }, exposure, 1e-2).unwrap();
        for emission in &scene.emissions()[1..4] {
            let data = plain.emitting(emission).unwrap();
            // all but the fall, which moves logits
            let (w, moved_unknowns) = ([0.2, -0.4, 0.3, 0.0, -0.6], [0, 1, 2, 4]);
            let at = data.linearise(&reflectance, &w);
            let multipliers = DVector::from_fn(at.residuals.len(), |n, _| (n as f64 + 0.5).cos());
            let bend = data.curvature(&at.second, &multipliers);
            for k in (0..grid.len()).chain(moved_unknowns.map(|unknown| grid.len() + unknown)) {
                let moved = |by: f64| {
                    let (mut r, mut w) = (reflectance.clone(), w);
                    match k.checked_sub(grid.len()) {
                        None => r[k] += by,
                        Some(unknown) => w[unknown] += by,
                    }
                    data.linearise(&r, &w)
                };
                let [below, above] = [moved(-STEP), moved(STEP)];
                // by variable projection derivatives leave out what an exposure that is found undoes
                if exposure == Exposure::Known(1.2) {
                    let slope = (&below.residuals - &above.residuals) / (2.0 * STEP);
                    let off = (at.jacobian.column(k) - &slope).norm();
                    assert!(off < 1e-5 * (1.0 + slope.norm()), "{k}: {off} of {}", slope.norm());
                    let by = (above.jacobian.tr_mul(&multipliers) - below.jacobian.tr_mul(&multipliers))
                        / (2.0 * STEP);
                    for unknown in moved_unknowns {
                        let own = match k.checked_sub(grid.len()) {
                            None => bend.mixed[(k, unknown)],
                            Some(k) => bend.unknowns[(k, unknown)],
                        };
                        let want = by[grid.len() + unknown];
                        assert!(
                            (own - want).abs() < 1e-4 * (1.0 + want.abs()),
                            "{k} {unknown}: {own} {want}"
                        );
                    }
                } else {
                    let gradient = at.jacobian.tr_mul(&at.residuals)[k];
                    let cost = |one: &DVector<f64>| -0.5 * one.norm_squared();
                    let want = (cost(&above.residuals) - cost(&below.residuals)) / (2.0 * STEP);
                    assert!((gradient - want).abs() < 1e-4 * (1.0 + want.abs()), "{k}: {gradient} {want}");
                }
            }
        }
    }
}

/// Beside a card the model of what is sent out does not hold.
#[test]
fn nothing_is_asked_beside_a_card() {
    let fold = Fold::new(60.0, 1.0, 1.0, FacetGrid { rows: 2, cols: 2 }).unwrap();
    let (response, _) = respond(&fold, 1e-4).unwrap();
    let eye = CameraResponse::from_weights(vec![vec![0.5; 2]]);
    let lighting = Lighting { light: Light::new(&fold, 0.0, 0.0, 0.0).unwrap(), sun: eye.clone(), sky: eye };
    let families_with_card = FacetModel::with_card(&response, &lighting, 1, vec![0.9; 2]);
    let rgb = FacetValues::from(&families_with_card.facet_rgb(&[0.5; 2]));
    let sd = deviations(&rgb, |_| 1e-3, 0.0);
    let scene = SceneModel::known(families_with_card).under(&[430.0, 600.0], &[1.0, 1.0], Backing::Unknown);
    let measured = Measured { rgb: &rgb, sd: &sd };
    let data = FacetData::new(&scene, &measured, Exposure::Known(1.0), 1e-2).unwrap();
    assert!(data.emitting(&scene.emissions()[1]).is_none());
}
