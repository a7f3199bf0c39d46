//! Pairs of strips along the crease: the kernel depends on the shift between two points alone.

use nalgebra::DMatrix;

use super::strips::polynomials;
use super::table::Nodes;
use crate::kernel::quadrature::{Lagrange, Rule};

/// Ratio of the ends of a Gauss panel that is graded towards the kernel's peak at z = 0, and the ρ that this leaves.
const PEAK_GRADING: f64 = 4.0;
const PEAK_RHO: f64 = 3.0;

/// Integrals `∫∫ P_b(x) P_d(y) q³/(q² + (x − y)²)² dx dy` over pairs of strips, for all distances q.
///
/// Between the shifts at which the ends of two strips meet, their overlap is a polynomial of the shift: its values at a few shifts tell
/// all of it, and the kernel's peak, which takes many more, is integrated against the polynomials through those few.
pub(super) struct Correlation<'a> {
    orders: [usize; 2],
    distances: &'a [f64],
    /// As many points as determine an overlap.
    overlap: Rule,
    through_overlap: Lagrange,
    /// Integrates the product of two polynomials.
    product: Rule,
    peak: Rule,
}

impl<'a> Correlation<'a> {
    /// Of strips with so many polynomials, at these `distances`, the nearest being the first.
    pub(super) fn new(orders: [usize; 2], nodes: &Nodes, distances: &'a [f64]) -> Self {
        let points = orders[0] + orders[1];
        let overlap = Rule::gauss_legendre(points);
        Self {
            orders,
            distances,
            through_overlap: Lagrange::new(&overlap.nodes),
            overlap,
            product: Rule::gauss_legendre(points.div_ceil(2)),
            peak: Rule::gauss_legendre(points.div_ceil(4) + nodes.points(PEAK_RHO)),
        }
    }

    /// Strips `e` and `f`: pair (b, d), b fast, by distance. `mirror` reverses the polynomials of `f`.
    pub(super) fn integrals(&self, e: [f64; 2], f: [f64; 2], mirror: bool) -> DMatrix<f64> {
        let mut kinks = [e[0] - f[1], e[0] - f[0], e[1] - f[1], e[1] - f[0]];
        kinks.sort_by(f64::total_cmp);
        let mut sum = DMatrix::zeros(self.orders[0] * self.orders[1], self.distances.len());
        for piece in kinks.windows(2).filter(|piece| piece[1] > piece[0]) {
            sum.gemm(1.0, &self.overlaps(e, f, mirror, piece), &self.moments(piece), 1.0);
        }
        sum
    }

    /// Overlaps of the polynomials at the points of a piece: pair by point.
    fn overlaps(&self, e: [f64; 2], f: [f64; 2], mirror: bool, piece: &[f64]) -> DMatrix<f64> {
        let [order_e, order_f] = self.orders;
        let mut overlaps = DMatrix::zeros(order_e * order_f, self.overlap.nodes.len());
        let (mut of_e, mut of_f) = (vec![0.0; order_e], vec![0.0; order_f]);
        for (mut overlaps, (z, _)) in overlaps.column_iter_mut().zip(self.overlap.on(piece[0], piece[1])) {
            for (x, weight) in self.product.on(e[0].max(f[0] + z), e[1].min(f[1] + z)) {
                polynomials(e, x, &mut of_e);
                polynomials(f, x - z, &mut of_f);
                if mirror {
                    // Legendre polynomials of odd degree are odd.
                    of_f.iter_mut().skip(1).step_by(2).for_each(|value| *value = -*value);
                }
                for (overlaps, of_f) in overlaps.as_mut_slice().chunks_exact_mut(order_e).zip(&of_f) {
                    overlaps.iter_mut().zip(&of_e).for_each(|(sum, of_e)| *sum += weight * of_e * of_f);
                }
            }
        }
        overlaps
    }

    /// The kernel integrated against the polynomials through the points of a piece: point by distance.
    fn moments(&self, piece: &[f64]) -> DMatrix<f64> {
        // Half the least distance is the width of the kernel's peak.
        let panels = towards_peak(piece[0], piece[1], 0.5 * self.distances[0]);
        let shifts: Vec<_> = panels.into_iter().flat_map(|[low, high]| self.peak.on(low, high)).collect();
        let mut through = DMatrix::zeros(self.overlap.nodes.len(), shifts.len());
        for (mut through, (z, weight)) in through.column_iter_mut().zip(&shifts) {
            let x = (2.0 * z - piece[0] - piece[1]) / (piece[1] - piece[0]);
            self.through_overlap.at(x, through.as_mut_slice());
            through *= *weight;
        }
        let shifts2: Vec<_> = shifts.iter().map(|(z, _)| z * z).collect();
        let mut kernel = DMatrix::zeros(shifts.len(), self.distances.len());
        for (mut kernel, q) in kernel.column_iter_mut().zip(self.distances) {
            for (kernel, z2) in kernel.as_mut_slice().iter_mut().zip(&shifts2) {
                let r2 = q * q + z2;
                *kernel = q * q * q / (r2 * r2);
            }
        }
        through * kernel
    }
}

/// Cuts `[low, high]` at 0 and, towards 0, in geometric steps down to the width of the peak.
fn towards_peak(low: f64, high: f64, peak: f64) -> Vec<[f64; 2]> {
    if low < 0.0 && high > 0.0 {
        return [towards_peak(low, 0.0, peak), towards_peak(0.0, high, peak)].concat();
    }
    if high <= 0.0 && low < 0.0 {
        return towards_peak(-high, -low, peak).into_iter().map(|[a, b]| [-b, -a]).collect();
    }
    let mut pieces = Vec::new();
    let mut end = high;
    while end > low {
        let start = if end <= peak { low } else { low.max(end / PEAK_GRADING) };
        pieces.push([start, end]);
        end = start;
    }
    pieces
}
