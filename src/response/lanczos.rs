//! Lanczos' method: the modes of a symmetric exchange that a light excites.

use nalgebra::{DMatrix, DVector};

use super::ModeSet;
use crate::error::{Error, Result};
use crate::solve::{Eigen, dot};

/// Most Lanczos steps: an undivided fold of 1° takes about 600.
const STEPS_MAX: usize = 1000;
/// A surface that keeps all but this share of its light is closed but for rounding.
const CLOSED: f64 = 1e-12;

/// A symmetric operator, the light it starts from, and how its vectors are read.
pub struct Excited<A, M> {
    pub start: Vec<f64>,
    pub apply: A,
    pub means: M,
}

impl<A: Fn(&[f64], &mut [f64]), M: Fn(&[f64]) -> Vec<f64>> Excited<A, M> {
    /// Steps until the residual at r = 1 is within `tolerance`; the modes and the residual reached.
    pub fn lanczos(&self, tolerance: f64) -> Result<(ModeSet, f64)> {
        let norm = dot(&self.start, &self.start).sqrt();
        let mut basis: Vec<Vec<f64>> = vec![self.start.iter().map(|x| x / norm).collect()];
        let (mut diagonal, mut beside) = (Vec::new(), Vec::new());
        loop {
            let mut next = vec![0.0; self.start.len()];
            let last = &basis[basis.len() - 1];
            (self.apply)(last, &mut next);
            diagonal.push(dot(last, &next));
            orthogonalise(&mut next, &basis);
            let length = dot(&next, &next).sqrt();
            let Some(residual) = residual_at_one(&diagonal, &beside, length) else {
                return Err(Error::Numeric(
                    "the surface hands on all light that it receives: open it, or refine the mesh".to_owned(),
                ));
            };
            if residual <= tolerance || basis.len() == self.start.len() || basis.len() == STEPS_MAX {
                return Ok((self.modes(norm, &basis, &diagonal, &beside), residual));
            }
            next.iter_mut().for_each(|x| *x /= length);
            beside.push(length);
            basis.push(next);
        }
    }

    /// Poles are the eigenvalues of the tridiagonal matrix, residues its modes seen as facet means.
    fn modes(&self, norm: f64, basis: &[Vec<f64>], diagonal: &[f64], beside: &[f64]) -> ModeSet {
        let Eigen { values: poles, vectors } = Eigen::of_tridiagonal(diagonal, beside);
        let means: Vec<_> = basis.iter().map(|x| DVector::from_vec((self.means)(x))).collect();
        let mut residues = DMatrix::from_columns(&means) * &vectors;
        for (mut of_mode, in_start) in residues.column_iter_mut().zip(vectors.row(0).iter()) {
            // The light starts along the first vector of the basis.
            of_mode *= norm * in_start;
        }
        ModeSet { poles, residues }
    }
}

/// Removes from `x` its parts along the basis, twice: once leaves rounding behind.
pub fn orthogonalise(x: &mut [f64], basis: &[Vec<f64>]) {
    for direction in basis.iter().chain(basis) {
        let along = dot(x, direction);
        x.iter_mut().zip(direction).for_each(|(x, d)| *x -= along * d);
    }
}

/// Residual norm of (I − F)x = 1 in the Lanczos basis, relative to the right-hand side; none if a pole is 1 or more.
fn residual_at_one(diagonal: &[f64], beside: &[f64], next: f64) -> Option<f64> {
    // LDLᵀ of I − T, carrying the last component of the solution.
    let mut pivot = 1.0 - diagonal[0];
    let mut last = 1.0 / pivot;
    let mut positive = pivot > CLOSED;
    for (a, b) in diagonal[1..].iter().zip(beside) {
        let coupling = b / pivot;
        pivot = 1.0 - a - b * coupling;
        last *= b / pivot;
        positive &= pivot > CLOSED;
    }
    positive.then_some(next * last.abs())
}
