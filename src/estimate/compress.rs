//! Compresses measured facets, in units of their noise, to as few numbers as hold all that a reflectance can
//! do to them.

use nalgebra::{DMatrix, DVector};

use super::measured::Measured;
use crate::forward::{FacetModel, FacetValues};
use crate::solve::Eigen;

/// One channel of the usable facets in units of their noise: the data, and the weights of the terms for each
/// light.
pub fn weighted(
    model: &FacetModel,
    measured: &Measured,
    usable: &[usize],
    channel: usize,
) -> (DVector<f64>, Vec<DMatrix<f64>>) {
    let column = |of: &FacetValues, facet: usize| of.get(facet, channel).unwrap_or(f64::NAN);
    let weight: Vec<f64> = usable.iter().map(|facet| column(measured.sd, *facet).recip()).collect();
    let data = usable.iter().zip(&weight).map(|(facet, weight)| weight * column(measured.rgb, *facet));
    let entry = |facets: &DMatrix<f64>, row: usize, term| weight[row] * facets[(usable[row], term)];
    let sources = model.sources().iter().map(|source| {
        DMatrix::from_fn(usable.len(), model.terms(), |row, term| entry(&source.facets, row, term))
    });
    (DVector::from_iterator(usable.len(), data), sources.collect())
}

pub fn sum_of_rows(matrix: &DMatrix<f64>, rows: &[usize]) -> DVector<f64> {
    rows.iter().fold(DVector::zeros(matrix.ncols()), |sum, row| sum + matrix.row(*row).transpose())
}

/// The terms over all reflectances: term by sample. Reflectances are Chebyshev points of [0, 1], shuffled
/// over the wavebands, so that a card's spectrum meets dark and bright ones everywhere.
pub fn sample_terms(model: &FacetModel) -> DMatrix<f64> {
    let bands = model.bands();
    // 37 has no factor in common with the usual numbers of wavebands.
    let place = |band: usize| (37 * band % bands) as f64 + 0.5;
    let chebyshev = |band: usize| (std::f64::consts::FRAC_PI_2 * place(band) / bands as f64).sin().powi(2);
    model.terms_of(&(0..bands).map(chebyshev).collect::<Vec<_>>()).transpose()
}

/// Projects data and models onto the directions in which a reflectance can move them by more than the noise.
pub fn compress(
    data: &DVector<f64>,
    sources: &[DMatrix<f64>],
    samples: &DMatrix<f64>,
    cutoff: f64,
) -> (DVector<f64>, Vec<DMatrix<f64>>) {
    // Skies of different colours light the facets alike.
    let mut distinct: Vec<&DMatrix<f64>> = Vec::new();
    for source in sources {
        if !distinct.contains(&source) {
            distinct.push(source);
        }
    }
    // First onto the span of the terms, then onto the span of their values over all reflectances.
    let columns: Vec<_> = distinct.iter().flat_map(|source| source.column_iter()).collect();
    // There are far fewer terms than facets, so what follows is small.
    let q = DMatrix::from_columns(&columns).qr().q();
    let reach = distinct.iter().map(|source| q.transpose() * *source * samples);
    let square = reach.map(|reach| &reach * reach.transpose()).sum::<DMatrix<f64>>();
    // A principal component analysis: a direction in which no reflectance moves the facets carries no
    // information. As data are in units of their noise, a reach below `cutoff` is lost in it.
    let directions = Eigen::of_symmetric(square);
    // Squared singular values below this share of the largest are rounding errors.
    let largest = directions.values.iter().copied().fold(0.0, f64::max);
    let least = (cutoff * cutoff).max(1e-15 * largest);
    let kept: Vec<_> = directions
        .values
        .iter()
        .zip(directions.vectors.column_iter())
        .filter(|(square, _)| **square > least)
        .map(|(_, direction)| direction)
        .collect();
    // A matrix needs at least one column.
    if kept.is_empty() {
        return (DVector::zeros(0), sources.iter().map(|source| source.rows(0, 0).into_owned()).collect());
    }
    let rotation = (q * DMatrix::from_columns(&kept)).transpose();
    (&rotation * data, sources.iter().map(|source| &rotation * source).collect())
}
