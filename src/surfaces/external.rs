//! A kernel made elsewhere: its requirements, and the areas derived from it.

use nalgebra::DMatrix;

use super::dense::DenseExchange;
use crate::error::{Error, Result};

/// Largest deviation of a kernel from reciprocity, relative to a facet's light.
const RECIPROCITY: f64 = 1e-6;

impl DenseExchange {
    /// From K of eq. (10) between facets, one patch each: entry ij is the fraction of the light of facet i
    /// that reaches facet j. Areas, in any unit, are derived from the kernel unless stated.
    ///
    /// # Errors
    /// [`Error::Field`] for an entry that is not a valid fraction, a facet that passes on all its light or
    /// more, an area that is not positive, or a deviation from `areaᵢ·kernelᵢⱼ = areaⱼ·kernelⱼᵢ` by more than
    /// 1e-6 of a facet's light.
    ///
    /// # Example
    /// ```
    /// use nalgebra::dmatrix;
    /// use vfold::surfaces::{DenseExchange, Exchange};
    /// // What hands on a tenth and gets four tenths back is four times as large.
    /// let exchange = DenseExchange::from_kernel(&dmatrix![0.0, 0.1; 0.4, 0.0], None)?;
    /// assert!((exchange.root_areas()[0] / exchange.root_areas()[1] - 2.0).abs() < 1e-15);
    /// assert!(DenseExchange::from_kernel(&dmatrix![0.0, 0.1; 0.4, 0.0], Some(&[1.0, 1.0])).is_err());
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn from_kernel(kernel: &DMatrix<f64>, areas: Option<&[f64]>) -> Result<Self> {
        for (i, row) in kernel.row_iter().enumerate() {
            if let Some(entry) = row.iter().find(|entry| !(0.0..1.0).contains(*entry)) {
                let problem =
                    format!("{entry} in row {i} is not a share of a facet's light; give numbers from 0 to 1");
                return Err(Error::field("kernel", problem));
            }
            if row.sum() >= 1.0 {
                let problem = format!("row {i} passes on {} of its light: bounces would not end", row.sum());
                return Err(Error::field("kernel", problem));
            }
        }
        let areas = match areas {
            Some(areas) => areas.to_vec(),
            None => areas_of(kernel),
        };
        if let Some(area) = areas.iter().find(|area| !(1e-150..1e150).contains(*area)) {
            return Err(Error::field("areas", format!("{area} is not an area; give numbers above 0")));
        }
        check_reciprocity(kernel, &areas)?;
        Ok(Self::new(kernel, &areas, (0..areas.len()).collect()))
    }
}

fn check_reciprocity(kernel: &DMatrix<f64>, areas: &[f64]) -> Result<()> {
    for i in 0..areas.len() {
        for j in 0..i {
            let (there, back) = (areas[i] * kernel[(i, j)], areas[j] * kernel[(j, i)]);
            let off = (there - back).abs() / areas[i].min(areas[j]);
            if off > RECIPROCITY {
                let problem = format!(
                    "facets {j} and {i} break reciprocity by {off:.1e}: \
                     area times entry must be the same in both directions"
                );
                return Err(Error::field("kernel", problem));
            }
        }
    }
    Ok(())
}

/// Areas relative to the first facet of each set of mutually visible facets.
///
/// Each is derived from the known facet with which it exchanges most, as in Prim's minimum spanning tree.
fn areas_of(kernel: &DMatrix<f64>) -> Vec<f64> {
    let count = kernel.nrows();
    let both = |i: usize, j: usize| kernel[(i, j)].min(kernel[(j, i)]);
    let mut areas = vec![0.0; count];
    // for each unknown facet, its largest exchange with a known one, and that facet
    let mut best: Vec<(f64, usize)> = (0..count).map(|facet| (0.0, facet)).collect();
    let mut unknown: Vec<usize> = (0..count).collect();
    while let Some((n, facet)) =
        unknown.iter().copied().enumerate().max_by(|(_, a), (_, b)| best[*a].0.total_cmp(&best[*b].0))
    {
        unknown.swap_remove(n);
        let (exchanged, from) = best[facet];
        areas[facet] =
            if exchanged > 0.0 { areas[from] * kernel[(from, facet)] / kernel[(facet, from)] } else { 1.0 };
        for other in &unknown {
            if both(facet, *other) > best[*other].0 {
                best[*other] = (both(facet, *other), facet);
            }
        }
    }
    areas
}
