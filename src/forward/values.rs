//! Values of facets in each channel, or their standard deviations.

use nalgebra::DMatrix;
use ndarray::{Array2, ArrayView1, Axis};

/// Facet by channel, with the channels of several pictures side by side. Some facets may be unmeasured.
#[derive(Clone, Debug, PartialEq)]
pub struct FacetValues {
    /// 0 where unmeasured.
    values: Array2<f64>,
    is_measured: Vec<bool>,
}

impl FacetValues {
    /// From a list of facets, `None` for one that was not measured. Returns `None` if facets differ in their
    /// number of channels.
    ///
    /// # Example
    /// ```
    /// use vfold::forward::FacetValues;
    /// let values = FacetValues::of_rows(&[Some(vec![0.1, 0.2]), None]).unwrap();
    /// assert_eq!(
    ///     (values.len(), values.channels(), values.get(0, 1), values.get(1, 1)),
    ///     (2, 2, Some(0.2), None)
    /// );
    /// assert!(FacetValues::of_rows(&[Some(vec![0.1, 0.2]), Some(vec![0.3])]).is_none());
    /// ```
    #[must_use]
    pub fn of_rows(rows: &[Option<Vec<f64>>]) -> Option<Self> {
        let channels = rows.iter().flatten().next().map_or(0, Vec::len);
        if rows.iter().flatten().any(|row| row.len() != channels) {
            return None;
        }
        let mut values = Array2::zeros((rows.len(), channels));
        for (mut own, row) in values.outer_iter_mut().zip(rows) {
            row.iter().for_each(|row| own.assign(&ArrayView1::from(row)));
        }
        Some(Self { values, is_measured: rows.iter().map(Option::is_some).collect() })
    }

    /// As a list of facets, `None` for one that was not measured.
    #[must_use]
    pub fn rows(&self) -> Vec<Option<Vec<f64>>> {
        self.facets().map(|facet| facet.map(|values| values.to_vec())).collect()
    }

    /// Number of facets.
    #[must_use]
    pub fn len(&self) -> usize {
        self.is_measured.len()
    }

    /// True if there are no facets.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.is_measured.is_empty()
    }

    /// Number of channels in all pictures together; 0 if nothing was measured.
    #[must_use]
    pub fn channels(&self) -> usize {
        self.values.ncols()
    }

    /// The values of a facet; `None` if it was not measured.
    ///
    /// # Panics
    /// If there is no such facet.
    #[must_use]
    pub fn facet(&self, facet: usize) -> Option<ArrayView1<'_, f64>> {
        self.is_measured[facet].then(|| self.values.row(facet))
    }

    /// One value; `None` if it was not measured or the channel does not exist.
    ///
    /// # Panics
    /// If there is no such facet.
    #[must_use]
    pub fn get(&self, facet: usize, channel: usize) -> Option<f64> {
        self.facet(facet)?.get(channel).copied()
    }

    /// All facets, with `None` for those not measured.
    pub fn facets(&self) -> impl Iterator<Item = Option<ArrayView1<'_, f64>>> {
        self.values
            .axis_iter(Axis(0))
            .zip(&self.is_measured)
            .map(|(values, measured)| measured.then_some(values))
    }

    /// The same values with these facets marked as unmeasured.
    #[must_use]
    pub fn without(&self, facets: impl Iterator<Item = usize>) -> Self {
        let mut rest = self.clone();
        facets.for_each(|facet| rest.is_measured[facet] = false);
        rest
    }

    /// All measured values.
    pub fn measured(&self) -> impl Iterator<Item = f64> {
        self.facets().flatten().flat_map(|values| values.into_iter().copied())
    }

    /// The largest measured value; 0 if none is positive.
    #[must_use]
    pub fn greatest(&self) -> f64 {
        self.measured().fold(0.0, f64::max)
    }

    /// Maps each measured value, given its facet and channel.
    #[must_use]
    pub fn map(&self, of: impl Fn([usize; 2], f64) -> f64) -> Self {
        let mut mapped = self.clone();
        for ((facet, channel), value) in mapped.values.indexed_iter_mut() {
            if self.is_measured[facet] {
                *value = of([facet, channel], *value);
            }
        }
        mapped
    }
}

/// All facets measured, facet by channel.
impl From<&DMatrix<f64>> for FacetValues {
    fn from(values: &DMatrix<f64>) -> Self {
        let is_measured = vec![true; values.nrows()];
        Self { values: Array2::from_shape_fn(values.shape(), |place| values[place]), is_measured }
    }
}
