//! Pairs of strips along the crease: the kernel depends only on the shift between two points.

use nalgebra::DMatrix;

use super::nodes::Nodes;
use super::strips::polynomials;
use crate::kernel::quadrature::{Lagrange, Rule, bernstein_rho};

/// Ratio of the ends of a Gauss panel graded towards the kernel's peak at z = 0, for which ρ is 2.09.
const PEAK_GRADING: f64 = 8.0;

/// Integrals `∫∫ P_b(x) P_d(y) q³/(q² + (x − y)²)² dx dy` over pairs of strips, for all distances q.
///
/// Between shifts at which ends of the two strips coincide, their overlap is a polynomial in the shift,
/// determined by its values at a few shifts. The kernel's peak, which needs many more points, is integrated
/// against the polynomials through those few.
pub(super) struct Correlation<'a> {
    orders: [usize; 2],
    nodes: &'a Nodes,
    distances: &'a [f64],
    /// As many points as determine an overlap.
    overlap: Rule,
    through_overlap: Lagrange,
    /// Integrates the product of two polynomials.
    product: Rule,
}

impl<'a> Correlation<'a> {
    /// For strips with these numbers of polynomials, at these `distances`, the smallest first.
    pub(super) fn new(orders: [usize; 2], nodes: &'a Nodes, distances: &'a [f64]) -> Self {
        let points = orders[0] + orders[1];
        let overlap = Rule::gauss_legendre(points);
        Self {
            orders,
            nodes,
            distances,
            through_overlap: Lagrange::new(&overlap.nodes),
            overlap,
            product: Rule::gauss_legendre(points.div_ceil(2)),
        }
    }

    /// For strips `e` and `f`: distance by pair (b, d), b varying fastest. `mirror` reverses the polynomials
    /// of `f`.
    pub(super) fn integrals(&self, e: [f64; 2], f: [f64; 2], mirror: bool) -> DMatrix<f64> {
        let mut kinks = [e[0] - f[1], e[0] - f[0], e[1] - f[1], e[1] - f[0]];
        kinks.sort_by(f64::total_cmp);
        let mut sum = DMatrix::zeros(self.distances.len(), self.orders[0] * self.orders[1]);
        for piece in kinks.windows(2).filter(|piece| piece[1] > piece[0]) {
            sum.gemm(1.0, &self.moments(piece), &self.overlaps(e, f, mirror, piece), 1.0);
        }
        sum
    }

    /// Overlaps of the polynomials at the shifts of a piece: shift by pair.
    fn overlaps(&self, e: [f64; 2], f: [f64; 2], mirror: bool, piece: &[f64]) -> DMatrix<f64> {
        let [order_e, order_f] = self.orders;
        let shifts: Vec<_> = self.overlap.on(piece[0], piece[1]).map(|(z, _)| z).collect();
        let products = shifts.iter().map(|z| self.product.on(e[0].max(f[0] + z), e[1].min(f[1] + z)));
        // Shift by point.
        let (points, weights): (Vec<_>, Vec<_>) = products.flatten().unzip();
        let points = DMatrix::from_vec(self.product.nodes.len(), shifts.len(), points).transpose();
        let weights = DMatrix::from_vec(self.product.nodes.len(), shifts.len(), weights).transpose();
        let of_e = polynomials(e, points.as_slice(), order_e);
        let shifted: Vec<_> = points.iter().zip(shifts.iter().cycle()).map(|(x, z)| x - z).collect();
        let mut of_f = polynomials(f, &shifted, order_f);
        for (d, mut of_f) in of_f.column_iter_mut().enumerate() {
            // Legendre polynomials of odd degree are odd.
            let sign = if mirror && d % 2 == 1 { -1.0 } else { 1.0 };
            of_f.iter_mut().zip(&weights).for_each(|(of_f, weight)| *of_f *= sign * weight);
        }
        let mut overlaps = DMatrix::zeros(shifts.len(), order_e * order_f);
        for (bd, mut overlaps) in overlaps.column_iter_mut().enumerate() {
            let (of_e, of_f) = (of_e.column(bd % order_e), of_f.column(bd / order_e));
            let of_points = of_e.as_slice().chunks_exact(shifts.len());
            for (of_e, of_f) in of_points.zip(of_f.as_slice().chunks_exact(shifts.len())) {
                let products = of_e.iter().zip(of_f).map(|(of_e, of_f)| of_e * of_f);
                overlaps.iter_mut().zip(products).for_each(|(sum, product)| *sum += product);
            }
        }
        overlaps
    }

    /// The kernel integrated against the polynomials through the shifts of a piece: distance by shift.
    fn moments(&self, piece: &[f64]) -> DMatrix<f64> {
        let nearest = self.distances[0];
        let (mut shifts, mut weights) = (Vec::new(), Vec::new());
        // The width of the kernel's peak is half the least distance.
        for panel in towards_peak(piece[0], piece[1], 0.5 * nearest) {
            let points = self.nodes.points(bernstein_rho(panel, [0.0, nearest]));
            let rule = Rule::kept_legendre(self.overlap.nodes.len().div_ceil(4) + points);
            for (shift, weight) in rule.on(panel[0], panel[1]) {
                shifts.push(shift);
                weights.push(weight);
            }
        }
        let place = |z: &f64| (2.0 * z - piece[0] - piece[1]) / (piece[1] - piece[0]);
        let mut through = DMatrix::zeros(shifts.len(), self.overlap.nodes.len());
        self.through_overlap.at_all(&shifts.iter().map(place).collect::<Vec<_>>(), through.as_mut_slice());
        let mut kernel = DMatrix::zeros(self.distances.len(), shifts.len());
        for ((mut kernel, z), weight) in kernel.column_iter_mut().zip(&shifts).zip(&weights) {
            for (kernel, q) in kernel.as_mut_slice().iter_mut().zip(self.distances) {
                let r2 = q * q + z * z;
                *kernel = weight * q * q * q / (r2 * r2);
            }
        }
        kernel * through
    }
}

/// Divides `[low, high]` at 0 and, towards 0, in geometric steps down to the width of the peak.
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
