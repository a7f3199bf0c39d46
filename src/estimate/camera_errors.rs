//! Facets seen by another camera of the stated model, the sensitivities of which are slightly different.
//!
//! Computed facets are taken to be those of the stated camera. If that asks for an improbable spectrum,
//! errors of its sensitivities, which photographs always have, are as probable as statements are wrong.

use nalgebra::DVector;

use super::data::FacetData;
use super::facets::Facets;
use super::photograph::priors::Priors;
use super::prior::Prior;
use super::search::Search;
use super::searched::{Lit, Searched, Trace};
use crate::solve::posterior::Model;

/// Facets no further from what is expected than this, in standard deviations, are those of the stated camera.
pub const SURPRISE: f64 = 2.0;
/// Those of another count if they have at least these log odds under all spectra as one.
const LN_ODDS_LEAST: f64 = -2.0;

/// The mean of all modes of the facets of a sheet without emission if another camera saw them; `None` if that
/// is improbable, or does not explain them either. No other camera is known well enough for facets more
/// precise than those at which hypotheses are sorted.
///
/// # Arguments
/// - `w`, `ln_evidence`: their mode under all spectra with the stated camera.
pub fn seen_by_another<'a>(
    data: &FacetData<'a>,
    (w, ln_evidence): (DVector<f64>, f64),
    prior: &Prior,
    trace: &mut Trace,
) -> Option<Searched<'a>> {
    let noise = Search::new(data, prior).tempering();
    let facets = Facets { data, gaussian: prior.broad() };
    let w = w.resize_vertically(facets.unknowns(), 0.0);
    let (reflectance, (_, unknowns)) = (facets.reflectance_at(&w), facets.split(&w));
    let data = data.with_camera_errors(noise, (&reflectance, unknowns.as_slice()))?;
    // evidence at more noise than facets have leaves out what all hypotheses share
    let least = ln_evidence - data.size().0 as f64 * noise.ln() + LN_ODDS_LEAST;
    let mut search = Search::new(&data, prior);
    let share = ((), -Priors::USUAL.ln_odds_of_statement());
    let sorted = search.sort(share, Some(w), least).filter(|one| one.ln_weight() >= least)?;
    trace.append(&mut search.trace);
    let lit = Lit { light: 0, data: data.clone(), sorted };
    Searched::among(vec![lit], prior, trace).filter(|found| found.mixture.best.surprise < SURPRISE)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::CameraResponse;
    use crate::estimate::Exposure;
    use crate::estimate::measured::Measured;
    use crate::estimate::noise::deviations;
    use crate::estimate::photograph::eye::{errors, shares_of};
    use crate::estimate::unknowns::SceneModel;
    use crate::forward::{FacetModel, FacetValues, Lighting};
    use crate::geometry::{FacetGrid, Fold, Light};
    use crate::kernel::mesh::respond;
    use crate::spectrum::{Outside, WavelengthGrid, camera};

    /// Facets seen with an error of one standard deviation are no further than that from the truth.
    #[test]
    fn an_error_of_the_camera_is_no_surprise() {
        let grid = WavelengthGrid::uniform(400.0, 700.0, 10.0).unwrap();
        let curves = camera("canon-5d-mark-ii").unwrap().channels;
        let curves: Vec<_> = curves.iter().map(|curve| curve.on(&grid, Outside::Zero).unwrap()).collect();
        let fold = Fold::new(45.0, 1.0, 1.0, FacetGrid { rows: 4, cols: 2 }).unwrap();
        let (response, _) = respond(&fold, 1e-4).unwrap();
        let light = Light::new(&fold, 0.0, 0.0, 0.0).unwrap();
        let seen_by = |curves: &[Vec<f64>]| {
            let eye = CameraResponse::new(&grid, curves, &vec![1.0; grid.len()]).unwrap();
            FacetModel::one_sheet(&response, &Lighting { light, sun: eye.clone(), sky: eye })
        };
        let all = errors(&curves, grid.wavelengths_nm(), &vec![1.0; grid.len()], &Priors::USUAL);
        let scene = SceneModel::known(seen_by(&curves));
        let scene = scene.seen_with(shares_of(&curves, grid.wavelengths_nm(), &Priors::USUAL));
        let red: Vec<f64> = (0..grid.len()).map(|band| if band < 18 { 0.1 } else { 0.7 }).collect();
        // blue, in which white is not 1
        for (channel, error) in all.iter().filter(|(channel, _)| *channel == 2) {
            let mut off = curves.clone();
            off[*channel].iter_mut().zip(error).for_each(|(value, error)| *value += error);
            let rgb = FacetValues::from(&seen_by(&off).facet_rgb(&red));
            let sd = deviations(&rgb, |_| 1e-6, 0.0);
            let measured = Measured { rgb: &rgb, sd: &sd };
            let data = FacetData::new(&scene, &measured, Exposure::Known(1.0), 1e-2).unwrap();
            let distance = |data: &FacetData| data.residuals(&red, &[]).residuals.norm();
            let allowed = data.with_camera_errors(1.0, (&red, &[])).unwrap();
            assert!(distance(&data) > 50.0 && distance(&allowed) < 1.01, "{}", distance(&allowed));
        }
    }
}
