//! Compresses measured facets, in units of their noise, to as few numbers as hold all that a reflectance can
//! do to them.

use nalgebra::{DMatrix, DVector};

use super::measured::Measured;
use crate::forward::{FacetModel, FacetValues, Source};
use crate::solve::Eigen;

/// A channel of measured facets, in units of their noise, compressed.
pub struct Compressed {
    /// What reflectances can move.
    pub data: DVector<f64>,
    /// Map from the terms to these data for each source: datum by term.
    pub maps: Vec<DMatrix<f64>>,
    /// Sum of squares of the rest.
    pub outside: f64,
    /// The brightest facet.
    pub peak: f64,
}

impl Compressed {
    /// The `usable` facets of a channel, without directions in which no reflectance moves them by more than
    /// `cutoff` at brightness 1; `of_all`: the reach of all facets if all are known equally well.
    pub fn channel<'r>(
        model: &FacetModel,
        of_all: impl FnOnce() -> &'r Reach,
        (measured, usable, channel): (&Measured, &[usize], usize),
        cutoff: f64,
    ) -> Self {
        let column = |of: &FacetValues| {
            let value = |facet: &usize| of.get(*facet, channel).unwrap_or(f64::NAN);
            DVector::from_iterator(usable.len(), usable.iter().map(value))
        };
        let weights = column(measured.sd).map(f64::recip);
        let all = column(measured.rgb).component_mul(&weights);
        let is_uniform = weights.max() <= weights.min();
        let (data, maps) = if is_uniform && usable.len() == measured.rgb.len() {
            of_all().compressed(&all, weights[0], cutoff)
        } else {
            let weighted = |source: &Source| {
                let mut facets = source.facets.select_rows(usable);
                facets.column_iter_mut().for_each(|mut term| term.component_mul_assign(&weights));
                facets
            };
            let sources: Vec<_> = model.sources().iter().map(weighted).collect();
            Reach::of(model, &sources.iter().collect::<Vec<_>>()).compressed(&all, 1.0, cutoff)
        };
        Self { outside: all.norm_squared() - data.norm_squared(), peak: all.max(), data, maps }
    }
}

/// Sum of some rows, as a column.
pub fn sum_of_rows(matrix: &DMatrix<f64>, rows: &[usize]) -> DVector<f64> {
    rows.iter().fold(DVector::zeros(matrix.ncols()), |sum, row| sum + matrix.row(*row).transpose())
}

/// How far reflectances can move facets, and in which directions.
#[derive(Debug)]
pub struct Reach {
    /// Orthonormal directions: direction by facet.
    directions: DMatrix<f64>,
    /// Sum of squared distances along each, over all reflectances at brightness 1.
    squares: Vec<f64>,
    /// Map from the terms to the directions for each source: direction by term.
    maps: Vec<DMatrix<f64>>,
}

impl Reach {
    /// For facets with these weights of the terms for each source of the model, facet by term.
    pub fn of(model: &FacetModel, sources: &[&DMatrix<f64>]) -> Self {
        // Skies of different colours light the facets alike.
        let mut distinct: Vec<&DMatrix<f64>> = Vec::new();
        for source in sources {
            if !distinct.contains(source) {
                distinct.push(source);
            }
        }
        // First onto the span of the terms, then onto the span of their values over all reflectances.
        let columns: Vec<_> = distinct.iter().flat_map(|source| source.column_iter()).collect();
        // There are far fewer terms than facets, so what follows is small.
        let q = DMatrix::from_columns(&columns).qr().q();
        let samples = sample_terms(model);
        let reach = distinct.iter().map(|source| q.transpose() * *source * &samples);
        let square = reach.map(|reach| &reach * reach.transpose()).sum::<DMatrix<f64>>();
        // A principal component analysis: a direction in which no reflectance moves the facets carries no
        // information.
        let Eigen { values, vectors } = Eigen::of_symmetric(square);
        let directions = (q * vectors).transpose();
        let maps = sources.iter().map(|source| &directions * *source).collect();
        Self { directions, squares: values.as_slice().to_vec(), maps }
    }

    /// Data in units of their noise, projected onto the directions in which a reflectance can move them by
    /// more than `cutoff` at brightness 1, and the map to them for each source.
    ///
    /// # Arguments
    /// - `weight`: weight of all facets here, in addition to their weights in [`Reach::of`].
    pub fn compressed(
        &self,
        data: &DVector<f64>,
        weight: f64,
        cutoff: f64,
    ) -> (DVector<f64>, Vec<DMatrix<f64>>) {
        // Squared singular values below this share of the largest are rounding errors.
        let largest = self.squares.iter().copied().fold(0.0, f64::max);
        let least = (cutoff / weight).powi(2).max(1e-15 * largest);
        let kept: Vec<_> = (0..self.squares.len()).filter(|n| self.squares[*n] > least).collect();
        let maps = self.maps.iter().map(|map| weight * map.select_rows(&kept)).collect();
        (self.directions.select_rows(&kept) * data, maps)
    }
}

/// The terms over all reflectances: term by sample. Reflectances are Chebyshev points of [0, 1], shuffled
/// over the wavebands, so that a card's spectrum meets dark and bright ones everywhere.
fn sample_terms(model: &FacetModel) -> DMatrix<f64> {
    let bands = model.bands();
    // 37 has no factor in common with the usual numbers of wavebands.
    let place = |band: usize| (37 * band % bands) as f64 + 0.5;
    let chebyshev = |band: usize| (std::f64::consts::FRAC_PI_2 * place(band) / bands as f64).sin().powi(2);
    model.terms_of(&(0..bands).map(chebyshev).collect::<Vec<_>>()).transpose()
}
