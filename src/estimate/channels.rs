//! Linear maps from the terms of the reflectance to compressed data, by channel and source.

use std::iter::repeat_n;
use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use crate::camera::CameraResponse;
use crate::solve::dense::{add_product, dot_products, product, product_with_transposed};

/// Light of a source on the surface.
#[derive(Clone)]
struct Lit {
    /// Map from the terms to the compressed data of all channels, which follow one another.
    compressed: DMatrix<f64>,
    /// The camera's weights: waveband by channel.
    weights: DMatrix<f64>,
    /// The weights of each datum's channel: datum by waveband.
    of_data: DMatrix<f64>,
}

impl Lit {
    /// Light to which a camera responds, given the data of its channels.
    fn seen_by(camera: &CameraResponse, compressed: DMatrix<f64>, channels: &[Range<usize>]) -> Self {
        let weights = weights(camera);
        let of_datum = channels.iter().enumerate().flat_map(|(channel, rows)| repeat_n(channel, rows.len()));
        let of_data = weights.select_columns(&of_datum.collect::<Vec<_>>()).transpose();
        Self { compressed, weights, of_data }
    }
}

/// The channels, whose data follow one another.
#[derive(Clone)]
pub struct Channels {
    /// Data of each channel.
    rows: Vec<Range<usize>>,
    sources: Vec<Lit>,
}

impl Channels {
    /// The maps from the terms to each channel's data for every source, `[channel][source]`, and the camera's
    /// responses to each source.
    pub fn new<'c>(maps: &[&[DMatrix<f64>]], cameras: impl Iterator<Item = &'c CameraResponse>) -> Self {
        let ends = maps.iter().scan(0, |end, of_channel| {
            let start = *end;
            *end += of_channel[0].nrows();
            Some(start..*end)
        });
        let rows: Vec<_> = ends.collect();
        let data = rows.last().map_or(0, |last| last.end);
        let lit = |(source, camera): (usize, &CameraResponse)| {
            let mut compressed = DMatrix::zeros(data, maps[0][source].ncols());
            for (rows, of_channel) in rows.iter().zip(maps) {
                compressed.rows_mut(rows.start, rows.len()).copy_from(&of_channel[source]);
            }
            Lit::seen_by(camera, compressed, &rows)
        };
        let sources = cameras.enumerate().map(lit).collect();
        Self { rows, sources }
    }

    /// The same surface in another light.
    pub fn in_light(&self, camera: &CameraResponse) -> Self {
        let lit = |Lit { compressed, .. }: &Lit| Lit::seen_by(camera, compressed.clone(), &self.rows);
        Self { rows: self.rows.clone(), sources: self.sources.iter().map(lit).collect() }
    }

    /// Their number.
    pub fn count(&self) -> usize {
        self.rows.len()
    }

    /// Number of compressed data.
    fn len(&self) -> usize {
        self.rows.last().map_or(0, |last| last.end)
    }

    /// Model of the compressed data at exposure 1 for each source in amount 1: datum by source.
    pub fn parts_of(&self, terms: &DMatrix<f64>) -> DMatrix<f64> {
        let mut parts = DMatrix::zeros(self.len(), self.sources.len());
        for (Lit { compressed, weights, .. }, mut part) in self.sources.iter().zip(parts.column_iter_mut()) {
            // every channel's weights on the data of all: few numbers, and fewer products than one by one
            let seen = product(compressed, &dot_products(terms, weights));
            for (rows, seen) in self.rows.iter().zip(seen.column_iter()) {
                part.rows_mut(rows.start, rows.len()).copy_from(&seen.rows(rows.start, rows.len()));
            }
        }
        parts
    }

    /// Contribution of each waveband, summed over the sources in these amounts: datum by waveband, followed
    /// by `more` columns of zeros.
    pub fn columns_of(&self, terms: &DMatrix<f64>, amounts: &DVector<f64>, more: usize) -> DMatrix<f64> {
        let mut columns = DMatrix::zeros(self.len(), terms.nrows() + more);
        for (Lit { compressed, of_data, .. }, amount) in self.sources.iter().zip(amounts) {
            // every channel's weights on the data of that channel alone, after one product for all
            let seen = product_with_transposed(compressed, terms);
            let values = seen.as_slice().iter().zip(of_data.as_slice());
            let columns = columns.as_mut_slice();
            columns.iter_mut().zip(values).for_each(|(sum, (value, weight))| *sum += amount * weight * value);
        }
        columns
    }

    /// `Σ λᵢmᵢ` per waveband, without forming the model's columns.
    pub fn along(
        &self,
        multipliers: &DVector<f64>,
        of_terms: &DMatrix<f64>,
        amounts: &DVector<f64>,
    ) -> DVector<f64> {
        let mut along = DVector::zeros(of_terms.nrows());
        for (Lit { compressed, weights, .. }, amount) in self.sources.iter().zip(amounts) {
            let mut by_term = DMatrix::zeros(of_terms.ncols(), self.rows.len());
            for (rows, mut by_term) in self.rows.iter().zip(by_term.column_iter_mut()) {
                let multipliers = multipliers.rows(rows.start, rows.len());
                by_term.gemv_tr(*amount, &compressed.rows(rows.start, rows.len()), &multipliers, 0.0);
            }
            let mut by_band = DMatrix::zeros(of_terms.nrows(), self.rows.len());
            add_product(&mut by_band, of_terms, &by_term);
            by_band.component_mul_assign(weights);
            by_band.column_iter().for_each(|of_channel| along += of_channel);
        }
        along
    }

    /// The maps and data in other coordinates, in which data have independent errors of 1 if their noise is
    /// `noise` and the camera's response has these `errors`, shares of it by channel and waveband; and the
    /// logarithm of the determinant of the change.
    pub fn whitened(
        &self,
        data: &DVector<f64>,
        (terms, amounts): (&DMatrix<f64>, &DVector<f64>),
        (noise, errors): (f64, &[(usize, DVector<f64>)]),
    ) -> Option<(Self, DVector<f64>, f64)> {
        let (mut all, mut data, mut ln_determinant) = (self.clone(), data.clone(), 0.0);
        for (channel, rows) in self.rows.iter().enumerate() {
            let mut covariance = DMatrix::from_diagonal_element(rows.len(), rows.len(), noise * noise);
            for (_, error) in errors.iter().filter(|(of, _)| *of == channel) {
                let mut off = DVector::zeros(rows.len());
                for (Lit { compressed, weights, .. }, amount) in self.sources.iter().zip(amounts) {
                    let light = terms.tr_mul(&weights.column(channel).component_mul(error));
                    off.gemv(*amount, &compressed.rows(rows.start, rows.len()), &light, 1.0);
                }
                covariance.ger(1.0, &off, &off, 1.0);
            }
            let lower = covariance.cholesky()?.unpack();
            ln_determinant -= lower.diagonal().map(f64::ln).sum();
            lower.solve_lower_triangular_mut(&mut data.rows_mut(rows.start, rows.len()));
            for Lit { compressed, .. } in &mut all.sources {
                lower.solve_lower_triangular_mut(&mut compressed.rows_mut(rows.start, rows.len()));
            }
        }
        Some((all, data, ln_determinant))
    }

    /// The sum over channels and sources in these amounts, per waveband, given what each source's sum is of
    /// the terms.
    pub fn sum_of(
        &self,
        terms: &DMatrix<f64>,
        of_sources: &[DVector<f64>],
        amounts: &DVector<f64>,
    ) -> DVector<f64> {
        let mut sum = DVector::zeros(terms.nrows());
        for ((Lit { weights, .. }, amount), of_terms) in self.sources.iter().zip(amounts).zip(of_sources) {
            sum += (terms * (*amount * of_terms)).component_mul(&weights.column_sum());
        }
        sum
    }
}

/// A camera's responses: waveband by channel.
fn weights(camera: &CameraResponse) -> DMatrix<f64> {
    let channels: Vec<_> =
        (0..camera.channels()).map(|n| DVector::from_column_slice(camera.channel(n))).collect();
    DMatrix::from_columns(&channels)
}
