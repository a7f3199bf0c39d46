//! The exchange between strips of the two panels, exact to rounding.
//!
//! Eq. (10) with every facet averaged over its whole area; eq. (2) at facet centres, as printed, lets a fold
//! pass on more light than it receives. With s and t the distances from the crease and z the shift along it,
//! the kernel of eq. (2) is `sin²θ·s·t / (π r⁴)`, `r² = q² + z²`, `q² = s² + t² − 2st·cosθ`, so an entry
//! depends only on the two rows and the number of columns between the facets. Lengths are in units of the
//! facet's width along the crease.
//!
//! Near pairs: the shift and one row direction are integrated in closed form, the other by Gauss–Legendre
//! panels after `b = a·cosθ + a·sinθ·sinh u`, which moves every singularity to `Im u = ±π/2`. Far pairs:
//! Gauss–Legendre in all three directions, with the order demanded by the nearest singularity.

use std::f64::consts::PI;
use std::ops::Range;

use super::quadrature::Rule;
use crate::geometry::Fold;

/// Above this order of Gauss rule the near formula is cheaper.
const FAR_ORDER_MAX: usize = 14;
/// Points of a near panel, and the panel length that they integrate to rounding.
const NEAR_ORDER: usize = 13;
const NEAR_PANEL: f64 = 1.5;
/// Relative truncation error required of the far rules.
const FAR_TOLERANCE: f64 = 1e-15;
/// Range of shifts, relative to the distance of two facets, over which the far rules keep their orders.
const SAME_ORDERS: f64 = 0.15;

/// The opening angle of a fold and the rules that integrate over it.
pub struct Wedge {
    sin: f64,
    cos: f64,
    /// `1 − cosθ`, computed without cancellation for small θ.
    one_minus_cos: f64,
    /// Rules of order 1, 2, and so on.
    far: Vec<Rule>,
    /// Rules for the weight `1 − |z|`, the overlap of two facets along the crease.
    hats: Vec<Rule>,
}

impl Wedge {
    /// For `fold`.
    #[must_use]
    pub fn new(fold: &Fold) -> Self {
        let angle_rad = fold.angle_rad();
        let half_sin = (angle_rad / 2.0).sin();
        Self {
            // A flat sheet exchanges nothing with itself; sin π would leave 1e-16.
            sin: if fold.is_flat() { 0.0 } else { angle_rad.sin() },
            cos: angle_rad.cos(),
            one_minus_cos: 2.0 * half_sin * half_sin,
            far: (1..=FAR_ORDER_MAX).map(Rule::gauss_legendre).collect(),
            hats: (1..=FAR_ORDER_MAX).map(Rule::gauss_hat).collect(),
        }
    }

    /// Area times form factor of facets of width 1 in rows `s` and `t`, for shifts 0, 1, … along the crease.
    pub fn exchange(&self, s: &Range<f64>, t: &Range<f64>, shifts: &mut [f64]) {
        if self.sin == 0.0 {
            return shifts.fill(0.0);
        }
        let across = self.nearest(s, t);
        let mut k = 0;
        while k < shifts.len() {
            let gap = (k as f64 - 1.0).max(0.0);
            match self.far_orders(s, t, gap, across) {
                Some(orders) => {
                    // Orders fall slowly with distance: those computed here serve for the next few shifts.
                    let end = (k + 1 + (SAME_ORDERS * across.hypot(gap)) as usize).min(shifts.len());
                    self.far(s, t, k, orders, &mut shifts[k..end]);
                    k = end;
                }
                None => {
                    shifts[k] = self.near(s, t, k as f64);
                    k += 1;
                }
            }
        }
        let scale = self.sin * self.sin / PI;
        shifts.iter_mut().for_each(|value| *value *= scale);
    }

    /// `∫∫∫ (1 − |z|) s t / r⁴ dz ds dt`, with the shift and one row direction in closed form.
    fn near(&self, s: &Range<f64>, t: &Range<f64>, k: f64) -> f64 {
        self.side(s.end, t, k) - self.side(s.start, t, k) + self.side(t.end, s, k) - self.side(t.start, s, k)
    }

    /// `J(a) = a² ∫ b·W₂(q)/q⁴ db` over the other facet's row: the contribution of the side at distance `a`.
    fn side(&self, a: f64, row: &Range<f64>, k: f64) -> f64 {
        if a == 0.0 {
            return 0.0;
        }
        let u = |b: f64| (((b - a) + a * self.one_minus_cos) / (a * self.sin)).asinh();
        let (low, high) = (u(row.start), u(row.end));
        let panels = ((high - low) / NEAR_PANEL).ceil().max(1.0);
        let length = (high - low) / panels;
        let mut sum = 0.0;
        for panel in 0..panels as usize {
            let start = low + panel as f64 * length;
            for (u, weight) in self.far[NEAR_ORDER - 1].on(start, start + length) {
                let q = a * self.sin * u.cosh();
                let b = a * (self.cos + self.sin * u.sinh());
                sum += weight * b * shift_integral(q, k) / (q * q * q);
            }
        }
        a * a * sum
    }

    /// Orders of the Gauss rules in s, t and along the crease that reach rounding for facets whose columns
    /// are separated by `gap` and whose rows are `across` apart; `None` if one is too high.
    fn far_orders(&self, s: &Range<f64>, t: &Range<f64>, gap: f64, across: f64) -> Option<[usize; 3]> {
        // z runs over two widths from the nearer ends of the facets.
        let along_z = gauss_order(gap, gap + 2.0, across)?;
        Some([self.order_across(s, t, gap)?, self.order_across(t, s, gap)?, along_z])
    }

    /// Order for integrating over `row` with the other distance anywhere in `other`.
    ///
    /// The singularities lie at `d·cosθ ± i·√(d² sin²θ + gap²)` for a point `d` of the other row.
    fn order_across(&self, row: &Range<f64>, other: &Range<f64>, gap: f64) -> Option<usize> {
        let abreast = [row.start, 0.5 * (row.start + row.end), row.end].map(|b| b / self.cos);
        let mut worst = 0;
        for d in [other.start, other.end].into_iter().chain(abreast.into_iter().filter(|d| other.contains(d)))
        {
            let (re, im) = (d * self.cos, (d * self.sin).hypot(gap));
            worst = worst.max(gauss_order(row.start - re, row.end - re, im)?);
        }
        Some(worst)
    }

    /// Smallest distance across the crease between points of two rows.
    fn nearest(&self, s: &Range<f64>, t: &Range<f64>) -> f64 {
        let q = |a: f64, b: f64| ((a - b).powi(2) + 2.0 * a * b * self.one_minus_cos).sqrt();
        let clamp = |a: f64, row: &Range<f64>| (a * self.cos).clamp(row.start, row.end);
        let from_s = [s.start, s.end].map(|a| q(a, clamp(a, t)));
        let from_t = [t.start, t.end].map(|b| q(b, clamp(b, s)));
        from_s.into_iter().chain(from_t).fold(f64::INFINITY, f64::min)
    }

    /// The same integral by Gauss rules of the given orders, for shifts starting at `k`.
    fn far(&self, s: &Range<f64>, t: &Range<f64>, k: usize, orders: [usize; 3], shifts: &mut [f64]) {
        let [rule_s, rule_t, hat] =
            [&self.far[orders[0] - 1], &self.far[orders[1] - 1], &self.hats[orders[2] - 1]];
        shifts.fill(0.0);
        for (s, weight_s) in rule_s.on(s.start, s.end) {
            for (t, weight_t) in rule_t.on(t.start, t.end) {
                let q2 = (s - t).powi(2) + 2.0 * s * t * self.one_minus_cos;
                for (z, weight_z) in hat.nodes.iter().zip(&hat.weights) {
                    let weight = weight_s * s * weight_t * t * weight_z;
                    for (n, value) in shifts.iter_mut().enumerate() {
                        let r2 = q2 + ((k + n) as f64 + z).powi(2);
                        *value += weight / (r2 * r2);
                    }
                }
            }
        }
    }
}

/// Order of the Gauss rule that integrates, to [`FAR_TOLERANCE`], a function on `[low, high]` whose nearest
/// singularities are at `±i·im`; `None` if it exceeds [`FAR_ORDER_MAX`].
///
/// The error falls as ρ^(−2p), where ρ is the sum of the half axes of the Bernstein ellipse through the
/// singularity (Trefethen, *Approximation Theory and Approximation Practice*, theorem 19.3).
fn gauss_order(low: f64, high: f64, im: f64) -> Option<usize> {
    let axis = (low.hypot(im) + high.hypot(im)) / (high - low);
    let rho = axis + (axis * axis - 1.0).max(0.0).sqrt();
    let order = (-FAR_TOLERANCE.ln() / (2.0 * rho.ln())).ceil();
    (order <= FAR_ORDER_MAX as f64).then_some(order as usize)
}

/// Second difference over the shift `k` of `W(q, z) = ½[z·q·atan(z/q) + ½z²·ln(1 + q²/z²)]`, the kernel
/// integrated along both facets' widths (times 2 q⁴ over the area element).
///
/// Parts of W that are linear or constant in z vanish in the difference. Each branch omits those that would
/// dominate: `πzq/4 − q²/4` for small q, none for large q.
fn shift_integral(q: f64, k: f64) -> f64 {
    let close = |z: f64| if z == 0.0 { 0.25 * q * q } else { 0.5 * z * z * small_shift(q / z) };
    let distant = |z: f64| {
        if z == 0.0 { 0.0 } else { 0.5 * z * (q * (z / q).atan() + 0.5 * z * (q / z).powi(2).ln_1p()) }
    };
    if k == 0.0 {
        2.0 * distant(1.0)
    } else if q < k + 1.0 {
        (close(k + 1.0) - close(k)) - (close(k) - close(k - 1.0))
    } else {
        (distant(k + 1.0) - distant(k)) - (distant(k) - distant(k - 1.0))
    }
}

/// `½ ln(1 + x²) − x·atan x + ½x²`, by its series where the terms would cancel.
fn small_shift(x: f64) -> f64 {
    let x2 = x * x;
    if x2 > 0.04 {
        return 0.5 * x2.ln_1p() - x * x.atan() + 0.5 * x2;
    }
    // Σ (−1)ⁿ x²ⁿ / (2n(2n−1)), n ≥ 2: twelve terms reach rounding at x² = 0.04.
    let mut sum = 0.0;
    for n in (2..=12).rev() {
        let n = f64::from(n);
        sum = 1.0 / (2.0 * n * (2.0 * n - 1.0)) - x2 * sum;
    }
    x2 * x2 * sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::FacetGrid;

    #[test]
    fn near_and_far_formulas_agree_where_both_hold() {
        let mut compared = 0;
        for angle_deg in [5.0_f64, 45.0, 120.0, 170.0] {
            let wedge = Wedge::new(&Fold::new(angle_deg, 1.0, 1.0, FacetGrid { rows: 1, cols: 1 }).unwrap());
            for (s, t, k) in [(0.0..1.0, 5.0..6.0, 3), (2.0..3.0, 2.0..3.0, 4), (7.0..8.0, 3.0..4.0, 2)] {
                let across = wedge.nearest(&s, &t);
                let Some(orders) = wedge.far_orders(&s, &t, k as f64 - 1.0, across) else { continue };
                let mut far = [0.0];
                wedge.far(&s, &t, k, orders, &mut far);
                let near = wedge.near(&s, &t, k as f64);
                assert!((near - far[0]).abs() < 1e-11 * near, "{angle_deg}° {s:?} {t:?} {k}: {near} {far:?}");
                compared += 1;
            }
        }
        assert!(compared >= 10, "{compared} pairs have both");
    }
}
