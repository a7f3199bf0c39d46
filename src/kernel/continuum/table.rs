//! Integrals for all pairs of strips along the crease, tabulated over the distance across it.
//!
//! The distances between all pairs of rows lie within common bounds. In ln q the integrals are analytic up to
//! `Im ln q = ±π/2`, where the kernel's peak meets the path of integration, so a few Gauss nodes per e-fold
//! determine them. Multiplied by q³ they tend to a constant for small q.

use nalgebra::DMatrix;
use rayon::prelude::*;

use super::correlation::Correlation;
use super::nodes::Nodes;
use super::strips::Strips;

/// Integrals over all pairs of strips on the first half of a crease of this width, mirror images included,
/// times q³: pair of functions of `of` and `with`, by node. The functions are in the order of
/// [`super::space::Space`]: strip of `of`, degree on `of`, strip of `with`, degree on `with`, the first
/// varying fastest.
pub(super) fn tabulate(of: &Strips, with: &Strips, width: f64, nodes: &Nodes) -> DMatrix<f64> {
    let distances = nodes.distances();
    let correlation = Correlation::new([of.order, with.order], nodes, &distances);
    let integrals = |[e, f]: [usize; 2]| {
        let (e, [low, high]) = (of.ends[e], with.ends[f]);
        let mirror = [width - high, width - low];
        correlation.integrals(e, [low, high], false) + correlation.integrals(e, mirror, true)
    };
    // For identical strips the integrals are symmetric.
    let alike = of == with;
    let pairs: Vec<_> = (0..with.ends.len())
        .flat_map(|f| (0..if alike { f + 1 } else { of.ends.len() }).map(move |e| [e, f]))
        .collect();
    let of_pairs: Vec<_> = pairs.par_iter().map(|pair| integrals(*pair)).collect();
    let mut table = DMatrix::zeros(of.len() * with.len(), nodes.len());
    let row = |[e, f]: [usize; 2], [b, d]: [usize; 2]| {
        ((d * with.ends.len() + f) * of.order + b) * of.ends.len() + e
    };
    for (pair, integrals) in pairs.into_iter().zip(of_pairs) {
        for (bd, integrals) in integrals.column_iter().enumerate() {
            let (degrees, [e, f]) = ([bd % of.order, bd / of.order], pair);
            table.row_mut(row(pair, degrees)).tr_copy_from(&integrals);
            if alike && e < f {
                table.row_mut(row([f, e], [degrees[1], degrees[0]])).tr_copy_from(&integrals);
            }
        }
    }
    table
}
