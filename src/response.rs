//! Light on a fold, bounced for every reflectance at once.
//!
//! With one reflectance r, eq. (16) is `L = (r/π)(I − rK)⁻¹E₀`. Lanczos on K from E₀ turns it into a few poles and
//! residues, `L = (r/π) Σ A_k/(1 − r g_k)`, the same for every wavelength: eqs. (26) to (28) without the modes that the
//! light does not excite. For two equal panels the poles of one panel's exchange F with its twin give everything, since
//! K = [0 F; F 0]: unequal panels, a tilted sun, and the sky, whose light on a panel is `1 − F·1`.

use nalgebra::{DMatrix, SymmetricEigen};

use crate::error::{Error, Result};
use crate::kernel::panel::PanelOperator;

/// Most Lanczos steps: a 1° fold takes about 230.
const STEPS_MAX: usize = 400;

/// Poles and residues of one panel under even light.
///
/// The irradiance of facet i under unit irradiance on both panels, both of reflectance r, is
/// `Σ_k residues[i][k] / (1 − r·poles[k])`.
#[derive(Clone, Debug, PartialEq)]
pub struct Response {
    poles: Vec<f64>,
    /// Facet by pole, facets row by row from the crease.
    residues: Vec<f64>,
}

impl Response {
    /// Reduces `operator` to the poles and residues that reach `tolerance` for every reflectance in [0, 1].
    ///
    /// # Source
    /// Deeb et al., eqs. (16) and (26) to (28); Lanczos' method with full reorthogonalisation (Golub and Van Loan, *Matrix
    /// Computations*, section 10.3); the residual of the system at r = 1, the slowest to converge, stops it.
    ///
    /// # Errors
    /// [`Error::Numeric`] if the light does not leave the fold: an operator that hands on all it receives.
    pub fn lanczos(operator: &impl PanelOperator, tolerance: f64) -> Result<Self> {
        let start = operator.uniform();
        let norm = dot(&start, &start).sqrt();
        let mut basis: Vec<Vec<f64>> = vec![start.iter().map(|x| x / norm).collect()];
        let (mut diagonal, mut beside) = (Vec::new(), Vec::new());
        loop {
            let mut next = vec![0.0; start.len()];
            let last = &basis[basis.len() - 1];
            operator.apply(last, &mut next);
            diagonal.push(dot(last, &next));
            orthogonalise(&mut next, &basis);
            let length = dot(&next, &next).sqrt();
            let Some(residual) = residual_at_one(&diagonal, &beside, length) else {
                return Err(Error::Numeric(
                    "the fold hands on more light than it receives: refine the mesh".to_owned(),
                ));
            };
            if residual <= tolerance || basis.len() == start.len() || basis.len() == STEPS_MAX {
                break;
            }
            next.iter_mut().for_each(|x| *x /= length);
            beside.push(length);
            basis.push(next);
        }
        Ok(Self::from_tridiagonal(operator, norm, &basis, &diagonal, &beside))
    }

    /// Poles are the eigenvalues of the tridiagonal matrix, residues its modes seen as facet means.
    fn from_tridiagonal(
        operator: &impl PanelOperator,
        norm: f64,
        basis: &[Vec<f64>],
        diagonal: &[f64],
        beside: &[f64],
    ) -> Self {
        let eigen = SymmetricEigen::new(tridiagonal(diagonal, beside));
        let steps = diagonal.len();
        let means: Vec<Vec<f64>> = basis.iter().map(|x| operator.facet_means(x)).collect();
        let facets = means[0].len();
        let mut residues = vec![0.0; facets * steps];
        for (facet, residues) in residues.chunks_exact_mut(steps).enumerate() {
            for (k, residue) in residues.iter_mut().enumerate() {
                let mode: f64 = (0..steps).map(|l| means[l][facet] * eigen.eigenvectors[(l, k)]).sum();
                *residue = norm * eigen.eigenvectors[(0, k)] * mode;
            }
        }
        Self { poles: eigen.eigenvalues.as_slice().to_vec(), residues }
    }

    /// A response from its parts, `residues` facet by pole.
    ///
    /// # Errors
    /// [`Error::Field`] if the shapes disagree or a pole is not inside (−1, 1).
    pub fn new(poles: Vec<f64>, residues: Vec<f64>) -> Result<Self> {
        if poles.is_empty() || residues.is_empty() || !residues.len().is_multiple_of(poles.len()) {
            return Err(Error::field("response.residues", "needs one row a facet with one number a pole"));
        }
        if !poles.iter().all(|g| g.abs() < 1.0) {
            return Err(Error::field("response.poles", "a pole outside (-1, 1): the bounces would not end"));
        }
        // Without a bounce, even light is even.
        if !residues.chunks_exact(poles.len()).all(|facet| (facet.iter().sum::<f64>() - 1.0).abs() < 1e-3) {
            return Err(Error::field(
                "response.residues",
                "those of a facet do not add up to 1: make the scene again",
            ));
        }
        Ok(Self { poles, residues })
    }

    /// Poles g, in (−1, 1): eigenvalues of the panel's exchange that even light excites.
    #[must_use]
    pub fn poles(&self) -> &[f64] {
        &self.poles
    }

    /// Residues of one facet of a panel, a number a pole.
    #[must_use]
    pub fn facet_residues(&self, facet: usize) -> &[f64] {
        &self.residues[facet * self.poles.len()..][..self.poles.len()]
    }

    /// Facets on one panel.
    #[must_use]
    pub fn facets(&self) -> usize {
        self.residues.len() / self.poles.len()
    }

    /// Irradiance of a facet for a light that gives `own` and `other` to the modes of the facet's panel and of the other
    /// one, whose reflectances are `r_own` and `r_other`, all bounces included.
    ///
    /// The two panels' equations `E₁ = e₁ + r₂FE₂`, `E₂ = e₂ + r₁FE₁` solved in the modes of F.
    #[must_use]
    pub fn irradiance(&self, facet: usize, light: ModeLight, r_own: f64, r_other: f64) -> f64 {
        let modes = self.facet_residues(facet).iter().zip(&self.poles);
        modes
            .map(|(residue, g)| {
                let (own, other) = light.on_mode(*g);
                residue * (own + r_other * other * g) / (1.0 - r_own * r_other * g * g)
            })
            .sum()
    }
}

/// A light as the modes of a facet's own panel and the other panel receive it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ModeLight {
    /// Parallel light: irradiance on the own panel and on the other.
    Sun([f64; 2]),
    /// A uniform sky with this irradiance on an unobstructed plane: each panel gets what the other does not hide.
    Sky(f64),
}

impl ModeLight {
    fn on_mode(self, pole: f64) -> (f64, f64) {
        match self {
            Self::Sun([own, other]) => (own, other),
            Self::Sky(sky) => (sky * (1.0 - pole), sky * (1.0 - pole)),
        }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Removes from `x` its parts along the basis, twice: once leaves rounding behind.
fn orthogonalise(x: &mut [f64], basis: &[Vec<f64>]) {
    for direction in basis.iter().chain(basis) {
        let along = dot(x, direction);
        x.iter_mut().zip(direction).for_each(|(x, d)| *x -= along * d);
    }
}

fn tridiagonal(diagonal: &[f64], beside: &[f64]) -> DMatrix<f64> {
    DMatrix::from_fn(diagonal.len(), diagonal.len(), |i, j| match i.abs_diff(j) {
        0 => diagonal[i],
        1 => beside[i.min(j)],
        _ => 0.0,
    })
}

/// Residual norm of (I − F)x = 1 in the Lanczos basis, relative to the right-hand side; none if a pole is 1 or more.
fn residual_at_one(diagonal: &[f64], beside: &[f64], next: f64) -> Option<f64> {
    // LDLᵀ of I − T, carrying the last component of the solution.
    let mut pivot = 1.0 - diagonal[0];
    let mut last = 1.0 / pivot;
    let mut positive = pivot > 0.0;
    for (a, b) in diagonal[1..].iter().zip(beside) {
        let coupling = b / pivot;
        pivot = 1.0 - a - b * coupling;
        last *= b / pivot;
        positive &= pivot > 0.0;
    }
    positive.then_some(next * last.abs())
}
