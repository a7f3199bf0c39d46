//! Solvers: eigenvalues, and smooth problems with a Gaussian prior; nothing here knows of optics or colour.

mod dot;
mod eigen;
pub mod forecast;
pub mod posterior;

pub use dot::dot;
pub use eigen::Eigen;

/// Why a solver stopped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Termination {
    /// The optimality conditions hold to the asked tolerance.
    Converged {
        /// What is left of them: the norm of the gradient, or the largest violation under bounds.
        gradient_norm: f64,
    },
    /// The limit on iterations came first.
    IterationLimit,
    /// No step along the search direction lowered the cost any more, where rounding is reached, or none would
    /// lower it enough.
    NoProgress {
        /// What is left of the gradient.
        gradient_norm: f64,
    },
}
