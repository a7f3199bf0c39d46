//! Lanczos' method: the modes of a symmetric exchange excited by a light.

use nalgebra::{DMatrix, DVector};

use super::ModeSet;
use super::orthogonality::Orthogonality;
use crate::error::{Error, Result};
use crate::solve::{Eigen, dot};

/// Maximum number of Lanczos steps: an undivided fold of 1° takes about 600.
const STEPS_MAX: usize = 1000;
/// Poles nearer to zero are replaced by this value, because their light is divided by the pole. Such weak
/// modes have no noticeable bounces.
const LEAST_POLE: f64 = 1e-9;
/// A surface that loses no more than this share of its light is closed, up to rounding.
const CLOSED: f64 = 1e-12;

/// A symmetric operator, the light it starts from, and functions that read its vectors.
pub struct Excited<A, M> {
    pub start: Vec<f64>,
    pub apply: A,
    /// Facet means of a vector.
    pub means: M,
    /// Facet means of the light itself, if `means` reads the operator's product with a vector, which is more
    /// accurate than the vector.
    pub direct: Option<Vec<f64>>,
}

impl<A: Fn(&[f64], &mut [f64]), M: Fn(&[f64]) -> Vec<f64>> Excited<A, M> {
    /// Iterates until the residual at r = 1 is within `tolerance`; returns the modes and the residual
    /// reached.
    pub fn lanczos(&self, tolerance: f64) -> Result<(ModeSet, f64)> {
        let mut lanczos = Lanczos::new(&self.start, tolerance);
        loop {
            let mut product = vec![0.0; self.start.len()];
            (self.apply)(lanczos.last(), &mut product);
            if let Some(residual) = lanczos.take(product)? {
                return Ok((lanczos.modes(&self.means, self.direct.as_deref()), residual));
            }
        }
    }
}

/// State of the iteration.
pub struct Lanczos {
    tolerance: f64,
    /// Norm of the light.
    norm: f64,
    basis: Vec<Vec<f64>>,
    /// The tridiagonal matrix.
    diagonal: Vec<f64>,
    off_diagonal: Vec<f64>,
    orthogonality: Orthogonality,
}

impl Lanczos {
    /// Starts from the light, and iterates until the residual at r = 1 is within `tolerance`.
    pub fn new(start: &[f64], tolerance: f64) -> Self {
        let norm = dot(start, start).sqrt();
        Self {
            tolerance,
            norm,
            basis: vec![start.iter().map(|x| x / norm).collect()],
            diagonal: Vec::new(),
            off_diagonal: Vec::new(),
            orthogonality: Orthogonality::new(),
        }
    }

    /// The vector to be multiplied by the operator next.
    pub fn last(&self) -> &[f64] {
        &self.basis[self.basis.len() - 1]
    }

    /// Takes that product; returns the residual if it was the last.
    ///
    /// # Errors
    /// [`Error::Numeric`] if light does not leave the surface.
    pub fn take(&mut self, product: Vec<f64>) -> Result<Option<f64>> {
        let (mut next, last) = (product, self.last());
        let along = dot(last, &next);
        subtract(&mut next, last, along);
        self.diagonal.push(along);
        if let (Some(length), [.., previous, _]) = (self.off_diagonal.last(), self.basis.as_slice()) {
            subtract(&mut next, previous, *length);
        }
        if self.orthogonality.is_lost(&self.diagonal, &self.off_diagonal, dot(&next, &next).sqrt()) {
            // The component along the basis is so small that projecting it out once is enough.
            project_out(&mut next, &self.basis);
        }
        let length = dot(&next, &next).sqrt();
        let Some(residual) = residual_at_one(&self.diagonal, &self.off_diagonal, length) else {
            return Err(Error::Numeric(
                "no light escapes this surface: open it, or refine the mesh".to_owned(),
            ));
        };
        if residual <= self.tolerance || self.basis.len() == next.len() || self.basis.len() == STEPS_MAX {
            return Ok(Some(residual));
        }
        next.iter_mut().for_each(|x| *x /= length);
        self.off_diagonal.push(length);
        self.basis.push(next);
        Ok(None)
    }

    /// The poles are the eigenvalues of the tridiagonal matrix, the residues its eigenvectors as facet means;
    /// `direct` as in [`Excited`].
    pub fn modes(&self, means: impl Fn(&[f64]) -> Vec<f64>, direct: Option<&[f64]>) -> ModeSet {
        let means: Vec<_> = self.basis.iter().map(|x| DVector::from_vec(means(x))).collect();
        // The light is a multiple of the first basis vector.
        let mut rows = DMatrix::from_columns(&means).insert_row(0, 0.0);
        rows[(0, 0)] = self.norm;
        let Eigen { values: poles, vectors } = Eigen::seen(rows, &self.diagonal, &self.off_diagonal);
        let in_start = vectors.row(0);
        let mut residues = vectors.rows_range(1..).into_owned();
        residues
            .column_iter_mut()
            .zip(in_start.iter())
            .for_each(|(mut of_mode, in_start)| of_mode *= *in_start);
        match direct {
            None => ModeSet { poles, residues },
            Some(direct) => after_a_bounce(direct, poles, residues),
        }
    }
}

/// Removes the components of `x` along the basis, twice: once leaves rounding errors behind.
pub fn orthogonalise(x: &mut [f64], basis: &[Vec<f64>]) {
    project_out(x, basis);
    project_out(x, basis);
}

/// Removes the components of `x` along the basis.
fn project_out(x: &mut [f64], basis: &[Vec<f64>]) {
    for direction in basis {
        let along = dot(x, direction);
        subtract(x, direction, along);
    }
}

/// `x − along·direction`, in place.
fn subtract(x: &mut [f64], direction: &[f64], along: f64) {
    x.iter_mut().zip(direction).for_each(|(x, d)| *x -= along * d);
}

/// Modes of `direct + Σ_k r·light_k/(1 − r·pole_k)`, where `light_k` is what mode k sends to the facets.
///
/// Since `r/(1 − rg) = (1/(1 − rg) − 1)/g`, the modes keep their poles, and the part independent of r becomes
/// a mode of pole 0, which does not bounce.
fn after_a_bounce(direct: &[f64], mut poles: Vec<f64>, light: DMatrix<f64>) -> ModeSet {
    let unbounced = light.ncols();
    let mut residues = light;
    for (mut of_mode, pole) in residues.column_iter_mut().zip(&mut poles) {
        if pole.abs() < LEAST_POLE {
            *pole = LEAST_POLE;
        }
        of_mode /= *pole;
    }
    let rest = DVector::from_column_slice(direct) - residues.column_sum();
    let mut residues = residues.insert_column(unbounced, 0.0);
    residues.set_column(unbounced, &rest);
    poles.push(0.0);
    ModeSet { poles, residues }
}

/// Residual norm of (I − F)x = 1 in the Lanczos basis, relative to the right-hand side; `None` if a pole is 1
/// or more.
fn residual_at_one(diagonal: &[f64], off_diagonal: &[f64], next: f64) -> Option<f64> {
    // LDLᵀ of I − T, tracking the last component of the solution.
    let mut pivot = 1.0 - diagonal[0];
    let mut last = 1.0 / pivot;
    let mut positive = pivot > CLOSED;
    for (a, b) in diagonal[1..].iter().zip(off_diagonal) {
        let coupling = b / pivot;
        pivot = 1.0 - a - b * coupling;
        last *= b / pivot;
        positive &= pivot > CLOSED;
    }
    positive.then_some(next * last.abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The pole −0.9 is isolated: it converges long before the last step, and rounding would introduce it
    /// again.
    #[test]
    fn vectors_stay_orthogonal_without_being_made_so_every_time() {
        let size = 1500;
        let mut poles: Vec<f64> =
            (0..size).map(|n| 0.9998 * (1.0 - n as f64 / size as f64).powi(3)).collect();
        poles[0] = -0.9;
        let apply = |x: &[f64], out: &mut [f64]| {
            out.iter_mut().zip(x).zip(&poles).for_each(|((out, x), pole)| *out = pole * x);
        };
        let light = Excited { start: vec![1.0; size], apply, means: <[f64]>::to_vec, direct: None };
        let (modes, residual) = light.lanczos(1e-13).unwrap();
        assert!(residual <= 1e-13, "{residual}");
        let mut found = modes.poles.clone();
        found.sort_by(f64::total_cmp);
        assert!(found.windows(2).all(|two| two[1] - two[0] > 1e-5), "{found:?}");
        for r in [0.5, 0.9, 1.0] {
            let found =
                &modes.residues * DVector::from_vec(modes.poles.clone()).map(|pole| 1.0 / (1.0 - r * pole));
            for (pole, found) in poles.iter().zip(&found) {
                assert!((found * (1.0 - r * pole) - 1.0).abs() < 1e-8, "pole {pole} at {r}: {found}");
            }
        }
    }
}
