//! How orthogonal Lanczos' vectors are, as rounding has it: what three vectors in a row have to do with each
//! other tells it without a look at the others.
//!
//! ## Reference
//! H. D. Simon, *The Lanczos algorithm with partial reorthogonalization*, Mathematics of Computation 42
//! (1984), p. 115.

/// Vectors that are less orthogonal are made so again. Up to the root of the rounding (1e-8) poles and
/// residues would not suffer.
const LEAST_ORTHOGONAL: f64 = 1e-10;
/// Rounding of a step, of vectors of length 1 and an exchange of norm 1 at most.
const ROUNDING: f64 = 1e-15;

/// What the last two vectors of a basis have to do with it.
pub struct Orthogonality {
    /// Products of the last vector but one, and of the last, with the vectors up to themselves.
    products: [Vec<f64>; 2],
    /// Whether the last vector was made orthogonal: the next is also made of the one before, which was not.
    restored: bool,
}

impl Orthogonality {
    /// Of a basis of one vector.
    pub fn new() -> Self {
        Self { products: [vec![], vec![1.0]], restored: false }
    }

    /// Whether the next vector, which will be divided by `length`, is to be made orthogonal to the basis; it
    /// is then taken to be.
    pub fn is_lost(&mut self, diagonal: &[f64], off_diagonal: &[f64], length: f64) -> bool {
        let last = diagonal.len() - 1;
        let [before, now] = &self.products;
        let product = |n: usize| {
            let below = if n > 0 { off_diagonal[n - 1] * now[n - 1] } else { 0.0 };
            let sum = off_diagonal[n] * now[n + 1] + (diagonal[n] - diagonal[last]) * now[n] + below
                - off_diagonal[last - 1] * before[n];
            // Rounding of a step adds to what the steps before have left.
            (sum + ROUNDING.copysign(sum)) / length
        };
        let mut next: Vec<f64> = (0..last).map(product).collect();
        // The vectors beside each other are made so by every step.
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
