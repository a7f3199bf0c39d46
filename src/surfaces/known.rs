//! Light on a surface with some parts of known reflectance, in one waveband.
//!
//! With R the known reflectances and x = rE the exitance of the unknown parts, the known ones receive `E_k =
//! (I − T_kk·R)⁻¹(b_k + T_ku·x)`. Eliminating them from eq. (24) leaves an exchange and a light for the
//! unknown parts alone, with their own poles.

use nalgebra::{DMatrix, DVector};

use super::ReducedExchange;
use crate::error::{Error, Result};
use crate::response::{Excited, ModeSet};
use crate::solve::dot;

/// The result for one light: facets of reflectance r emit `known + Σ_k r·residue_k/(1 − r·pole_k)`, as do
/// those of known reflectance.
#[derive(Clone, Debug, PartialEq)]
pub struct WithKnown {
    /// Radiance of every facet times π, if the unknown parts were black.
    pub known: DVector<f64>,
    /// Modes of the unknown parts; residues are exitances of all facets.
    pub modes: ModeSet,
}

impl ReducedExchange {
    /// Poles and residues for every light in a waveband, with these `reflectances` of the parts, in [0, 1],
    /// and none where unknown.
    ///
    /// # Errors
    /// [`Error::Numeric`] if no light escapes the surface.
    ///
    /// # Source
    /// Deeb et al., eq. (24).
    ///
    /// # Example
    /// ```
    /// use nalgebra::dmatrix;
    /// use vfold::surfaces::{DenseExchange, ReducedExchange};
    /// // Two like patches hand half of their light to each other; one of them is lit and of reflectance 0.8.
    /// let exchange = DenseExchange::new(&dmatrix![0.0, 0.5; 0.5, 0.0], &[1.0, 1.0], vec![0, 1]);
    /// let reduced = ReducedExchange::new(&exchange, &[0, 1], &[vec![1.0, 0.0]], 1e-12)?;
    /// let light = &reduced.with_known(&[Some(0.8), None])?[0];
    /// assert!((light.known[0] - 0.8).abs() < 1e-14);
    /// assert!((light.modes.poles[0] - 0.2).abs() < 1e-14); // half of 0.8 of half of the light comes back
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn with_known(&self, reflectances: &[Option<f64>]) -> Result<Vec<WithKnown>> {
        let of = |function: &usize| reflectances[self.part_of[*function]];
        let (known, unknown): (Vec<usize>, Vec<usize>) =
            (0..self.part_of.len()).partition(|function| of(function).is_some());
        let r: DVector<f64> = DVector::from_iterator(known.len(), known.iter().filter_map(of));
        let reflect = |of_known: DMatrix<f64>| DMatrix::from_diagonal(&r) * of_known;
        let [from_known, from_unknown] = [&known, &unknown].map(|from| self.exchange.select_columns(from));
        let system = || {
            let returned = from_known.select_rows(&known) * DMatrix::from_diagonal(&r);
            (DMatrix::identity(r.len(), r.len()) - returned).lu()
        };
        // if no light reaches known parts there is nothing to solve: a decomposition needs a row
        let system = (!known.is_empty()).then(system);
        let solve = |right: DMatrix<f64>| {
            let Some(system) = &system else { return Ok(right) };
            system
                .solve(&right)
                .map(reflect)
                .ok_or_else(|| Error::Numeric("no light escapes the known parts: open them".to_owned()))
        };
        // exitances of the known parts: in direct light, and for one unit of each unknown function
        let own = solve(self.lights.select_rows(&known))?;
        let returned = solve(from_unknown.select_rows(&known))?;
        let to_unknown = from_known.select_rows(&unknown);
        let exchange = from_unknown.select_rows(&unknown) + &to_unknown * &returned;
        let lights = self.lights.select_rows(&unknown) + &to_unknown * &own;
        let means_of_known = self.means.select_columns(&known);
        let means = self.means.select_columns(&unknown) + &means_of_known * returned;
        let modes = |light: DVector<f64>| modes(&exchange, light, &means, self.tolerance);
        let constant = means_of_known * own;
        let of_light = |(n, known): (usize, nalgebra::DVectorView<f64>)| {
            Ok(WithKnown { known: known.into_owned(), modes: modes(lights.column(n).into_owned())? })
        };
        constant.column_iter().enumerate().map(of_light).collect()
    }
}

/// Modes of the remaining exchange; none if it receives no light.
fn modes(
    exchange: &DMatrix<f64>,
    light: DVector<f64>,
    means: &DMatrix<f64>,
    tolerance: f64,
) -> Result<ModeSet> {
    if dot(light.as_slice(), light.as_slice()) <= 0.0 {
        return Ok(ModeSet::none(means.nrows()));
    }
    let excited = Excited {
        start: light.as_slice().to_vec(),
        apply: |x: &[f64], out: &mut [f64]| {
            out.copy_from_slice((exchange * DVector::from_column_slice(x)).as_slice());
        },
        means: |x: &[f64]| (means * DVector::from_column_slice(x)).as_slice().to_vec(),
        direct: None,
    };
    Ok(excited.lanczos(tolerance)?.0)
}
