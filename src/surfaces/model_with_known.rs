//! The facet model of a surface with parts of known reflectance: the terms differ in every waveband.

use nalgebra::DMatrix;
use rayon::prelude::*;

use super::{ReducedExchange, WithKnown};
use crate::camera::CameraResponse;
use crate::error::Result;
use crate::forward::{FacetModel, Source, Terms, seen_bands};

impl FacetModel {
    /// A surface whose `parts` state the reflectance per waveband where known, under the lights of
    /// `exchange`, each with a camera response.
    ///
    /// # Errors
    /// As [`ReducedExchange::with_known`].
    pub fn with_known(
        exchange: &ReducedExchange,
        parts: &[Option<Vec<f64>>],
        cameras: &[CameraResponse],
    ) -> Result<Self> {
        let of_band = |band: &usize| {
            let reflectances: Vec<_> = parts.iter().map(|part| part.as_ref().map(|r| r[*band])).collect();
            exchange.with_known(&reflectances).map(|lights| (*band, lights))
        };
        let seen = seen_bands(cameras.iter());
        let bands: Vec<_> = seen.par_iter().map(of_band).collect::<Result<_>>()?;
        let mut poles = vec![Vec::new(); cameras[0].bands()];
        for (band, lights) in &bands {
            poles[*band] = lights.iter().flat_map(|light| light.modes.poles.clone()).collect();
        }
        let terms = Terms::WithKnown(poles);
        let sources =
            cameras.iter().enumerate().map(|(n, camera)| source(&terms, &bands, n, camera)).collect();
        Ok(Self::of(terms, sources))
    }
}

/// One light, with the coefficients of its terms on every facet from the bands.
fn source(terms: &Terms, bands: &[(usize, Vec<WithKnown>)], light: usize, camera: &CameraResponse) -> Source {
    let count = bands.first().map_or(0, |(_, lights)| lights[light].known.len());
    let mut facets = DMatrix::zeros(count, terms.count());
    for (band, lights) in bands {
        let WithKnown { known, modes } = &lights[light];
        let first = terms.first(*band);
        facets.set_column(first, known);
        let before: usize = lights[..light].iter().map(|other| other.modes.poles.len()).sum();
        facets.columns_mut(first + 1 + before, modes.poles.len()).copy_from(&modes.residues);
    }
    Source { facets, camera: camera.clone() }
}
