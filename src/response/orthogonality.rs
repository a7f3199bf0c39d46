//! Estimates how rounding degrades the orthogonality of Lanczos vectors, from the three-term recurrence
//! alone.
//!
//! ## Reference
//! H. D. Simon, *The Lanczos algorithm with partial reorthogonalization*, Mathematics of Computation 42
//! (1984), p. 115.

/// Vectors less orthogonal than this are reorthogonalised. Poles and residues would tolerate the root of the
/// rounding error (1e-8).
const LEAST_ORTHOGONAL: f64 = 1e-10;
/// Rounding error of a step, for unit vectors and an exchange of norm at most 1.
const ROUNDING: f64 = 1e-15;

/// Dot products of the last two vectors with the basis.
pub struct Orthogonality {
    /// Products of the last vector but one, and of the last, with all vectors up to and including themselves.
    products: [Vec<f64>; 2],
    /// True if the last vector was reorthogonalised: the next also depends on the one before, which was not.
    restored: bool,
}

impl Orthogonality {
    /// For a basis of one vector.
    pub fn new() -> Self {
        Self { products: [vec![], vec![1.0]], restored: false }
    }

    /// True if the next vector, which will be divided by `length`, must be orthogonalised against the basis.
    /// The caller is assumed to do so.
    pub fn is_lost(&mut self, diagonal: &[f64], off_diagonal: &[f64], length: f64) -> bool {
        let last = diagonal.len() - 1;
        let [before, now] = &self.products;
        let product = |n: usize| {
            let below = if n > 0 { off_diagonal[n - 1] * now[n - 1] } else { 0.0 };
            let sum = off_diagonal[n] * now[n + 1] + (diagonal[n] - diagonal[last]) * now[n] + below
                - off_diagonal[last - 1] * before[n];
            // The rounding error of this step adds to the loss inherited from earlier steps.
            (sum + ROUNDING.copysign(sum)) / length
        };
        let mut next: Vec<f64> = (0..last).map(product).collect();
        // Every step makes adjacent vectors orthogonal.
        next.push(ROUNDING / length);
        let lost = next.iter().any(|product| product.abs() > LEAST_ORTHOGONAL || product.is_nan());
        let restore = lost || self.restored;
        self.restored = lost && !self.restored;
        if restore {
            next.fill(f64::EPSILON);
        }
        next.push(1.0);
        self.products.rotate_left(1);
        self.products[1] = next;
        restore
    }
}
