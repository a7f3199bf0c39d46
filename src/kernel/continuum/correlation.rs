//! Pairs of strips along the crease: the kernel depends on the shift between two points alone.

use nalgebra::{DMatrix, DVector};

use super::strips::polynomials;
use crate::kernel::quadrature::Rule;

/// Ratio of the ends of a Gauss panel that is graded towards the kernel's peak at z = 0.
const PEAK_GRADING: f64 = 3.0;

/// `∫∫ P_b(x) P_d(y) g(x − y) dx dy` as a rule over the shift: squared shifts and, for each, weights of all pairs: d by b.
pub(super) struct Correlation {
    order: usize,
    shift2: Vec<f64>,
    weights: Vec<DMatrix<f64>>,
}

impl Correlation {
    pub(super) fn new(order: usize) -> Self {
        Self { order, shift2: Vec::new(), weights: Vec::new() }
    }

    /// Adds strips `e` and `f`; `mirror` reverses the polynomials of `f`. The kernel's peak at z = 0 has width `peak`.
    pub(super) fn add(&mut self, e: [f64; 2], f: [f64; 2], mirror: bool, peak: f64) {
        // The overlap of one strip with the other, shifted by z, is a polynomial between the shifts at which their ends meet.
        let mut kinks = [e[0] - f[1], e[0] - f[0], e[1] - f[1], e[1] - f[0]];
        kinks.sort_by(f64::total_cmp);
        // On the overlap there is a product of two polynomials, which `order` Gauss points integrate exactly; over z the kernel
        // comes in, which needs some to spare.
        let (rule, exact) = (Rule::gauss_legendre(self.order + 6), Rule::gauss_legendre(self.order));
        for piece in kinks.windows(2) {
            for [low, high] in towards_peak(piece[0], piece[1], peak) {
                for (z, w) in rule.on(low, high) {
                    self.add_shift(e, f, mirror, z, w, &exact);
                }
            }
        }
    }

    fn add_shift(&mut self, e: [f64; 2], f: [f64; 2], mirror: bool, z: f64, weight: f64, exact: &Rule) {
        let mut weights = DMatrix::zeros(self.order, self.order);
        let (mut of_e, mut of_f) = (DVector::zeros(self.order), DVector::zeros(self.order));
        for (x, w) in exact.on(e[0].max(f[0] + z), e[1].min(f[1] + z)) {
            polynomials(e, x, of_e.as_mut_slice());
            polynomials(f, x - z, of_f.as_mut_slice());
            if mirror {
                // Legendre polynomials of odd degree are odd.
                of_f.iter_mut().skip(1).step_by(2).for_each(|value| *value = -*value);
            }
            weights.ger(weight * w, &of_f, &of_e, 1.0);
        }
        self.shift2.push(z * z);
        self.weights.push(weights);
    }

    /// The integrals with `g = q³/(q² + z²)²`: pair (b, d), d fast, by distance q.
    pub(super) fn integrals(self, distances: &[f64]) -> DMatrix<f64> {
        let shifts = self.shift2.len();
        let weights = self.weights.iter().flat_map(|weights| weights.iter().copied());
        let weights = DMatrix::from_iterator(self.order.pow(2), shifts, weights);
        let g = |z: usize, q: usize| distances[q].powi(3) / (distances[q].powi(2) + self.shift2[z]).powi(2);
        weights * DMatrix::from_fn(shifts, distances.len(), g)
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
