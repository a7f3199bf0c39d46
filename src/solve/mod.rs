//! Solvers: eigenvalues, and smooth problems with a Gaussian prior; nothing here knows about optics or
//! colour.

pub mod dense;
mod dot;
mod eigen;
pub mod forecast;
mod ln_sum;
pub mod posterior;

pub use dot::dot;
pub use eigen::Eigen;
pub use ln_sum::ln_sum;

/// Why a solver stopped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Termination {
    /// The optimality conditions hold to the required tolerance.
    Converged {
        /// Their residual: the norm of the gradient, or the largest violation under bounds.
        gradient_norm: f64,
    },
    /// The iteration limit was reached.
    IterationLimit,
    /// No step along the search direction lowered the cost any further, because of rounding, or none would
    /// lower it enough.
    NoProgress {
        /// Norm of the remaining gradient.
        gradient_norm: f64,
    },
}
