//! Linear maps from the terms of the reflectance to compressed data, one per channel and source.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

/// The maps from the terms to one channel's compressed data, and the camera's weights per waveband: one of
/// each per source.
#[derive(Clone)]
pub struct ChannelModel {
    pub sources: Vec<DMatrix<f64>>,
    pub weights: Vec<DVector<f64>>,
}

/// The channels, whose data follow one another.
#[derive(Clone)]
pub struct Channels(pub Vec<ChannelModel>);

impl Channels {
    /// Number of compressed data.
    fn len(&self) -> usize {
        self.0.iter().map(|channel| channel.sources[0].nrows()).sum()
    }

    fn sources(&self) -> usize {
        self.0[0].sources.len()
    }

    /// Model of the compressed data at exposure 1 for each source in amount 1: datum by source.
    pub fn parts_of(&self, terms: &DMatrix<f64>) -> DMatrix<f64> {
        let mut parts = DMatrix::zeros(self.len(), self.sources());
        self.each_part(|rows, source, compressed, weights| {
            let mut part = parts.view_mut((rows.start, source), (rows.len(), 1));
            part.gemm(1.0, compressed, &terms.tr_mul(weights), 0.0);
        });
        parts
    }

    /// Contribution of each waveband, summed over the sources in these amounts: datum by waveband, followed
    /// by `more` columns of zeros.
    pub fn columns_of(&self, terms: &DMatrix<f64>, amounts: &DVector<f64>, more: usize) -> DMatrix<f64> {
        let mut columns = DMatrix::zeros(self.len(), terms.nrows() + more);
        let terms = terms.transpose();
        self.each_part(|rows, source, compressed, weights| {
            let mut part = compressed * &terms;
            part.column_iter_mut()
                .zip(weights.iter())
                .for_each(|(mut column, weight)| column *= amounts[source] * weight);
            let mut target = columns.view_mut((rows.start, 0), part.shape());
            target += part;
        });
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
        self.each_part(|rows, source, compressed, weights| {
            let by_term = amounts[source] * compressed.tr_mul(&multipliers.rows(rows.start, rows.len()));
            along += (of_terms * by_term).component_mul(weights);
        });
        along
    }

    /// Visits every channel under every source: its rows of the compressed data, the source, the map from the
    /// terms to the rows, and the camera's weights per waveband.
    fn each_part(&self, mut visit: impl FnMut(Range<usize>, usize, &DMatrix<f64>, &DVector<f64>)) {
        let mut start = 0;
        for channel in &self.0 {
            let end = start + channel.sources[0].nrows();
            for (source, compressed) in channel.sources.iter().enumerate() {
                visit(start..end, source, compressed, &channel.weights[source]);
            }
            start = end;
        }
    }
}
