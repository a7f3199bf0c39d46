//! The exchange on a surface of several parts, reduced to the few functions that its lights excite.

use nalgebra::{DMatrix, DVector};

use super::Exchange;
use crate::error::{Error, Result};
use crate::response::orthogonalise;
use crate::solve::dot;

/// Most functions: their mutual products still fit into memory and take seconds.
const FUNCTIONS_MAX: usize = 2000;
/// Initial threshold of weight for a function, relative to the tolerance.
const LEAST_WEIGHT: f64 = 0.1;
/// Functions with less weight are rounding errors.
const ROUNDING: f64 = 1e-16;

/// The exchange between functions that are zero outside of one part each, by Galerkin's method: accurate for
/// every reflectance of the parts, so that the work per waveband hardly depends on the number of patches.
///
/// The functions span the light after every number of bounces, separated by parts: the Lanczos method,
/// modified to distinguish parts.
#[derive(Clone, Debug)]
pub struct ReducedExchange {
    /// Function by function, symmetric.
    pub(super) exchange: DMatrix<f64>,
    /// The part outside of which each function is zero.
    pub(super) part_of: Vec<usize>,
    /// Direct light, function by light.
    pub(super) lights: DMatrix<f64>,
    /// Facet means, facet by function.
    pub(super) means: DMatrix<f64>,
    /// Tolerance for the response in a waveband, relative to the light.
    pub(super) tolerance: f64,
}

impl ReducedExchange {
    /// Reduces `exchange` under `lights`, each a direct irradiance per patch, on a surface whose facets
    /// belong to the parts `part_of_facet`, from 0, until the residual in the system of eq. (24) is at most
    /// `tolerance`, relative to each light, with all reflectances equal to 1.
    ///
    /// # Source
    /// Galerkin's method on a Krylov space, as in the Lanczos method (Golub and Van Loan, *Matrix
    /// Computations*, section 10.3).
    ///
    /// # Errors
    /// [`Error::Numeric`] if a light does not fall on the surface, or no light escapes it, or the tolerance
    /// is not reached.
    pub fn new(
        exchange: &(impl Exchange + ?Sized),
        part_of_facet: &[usize],
        lights: &[Vec<f64>],
        tolerance: f64,
    ) -> Result<Self> {
        let part_of: Vec<usize> = exchange.facet_of().iter().map(|facet| part_of_facet[*facet]).collect();
        let starts: Vec<Vec<f64>> = lights.iter().map(|light| exchange.start(light)).collect();
        if starts.iter().any(|start| dot(start, start) <= 0.0) {
            return Err(Error::Numeric("no light falls on the surface: turn it to the light".to_owned()));
        }
        let mut least = LEAST_WEIGHT * tolerance;
        loop {
            let functions = Functions::of(exchange, &part_of, &starts, least)?;
            if functions.residual(&starts)? <= tolerance {
                return Ok(functions.reduce(exchange, &starts, tolerance));
            }
            if least < ROUNDING {
                let problem = format!(
                    "interreflections did not converge to {tolerance:e}; give vkernel a larger --tolerance"
                );
                return Err(Error::Numeric(problem));
            }
            least *= 0.1;
        }
    }
}

/// Orthonormal functions on the patches, with their images under the exchange.
struct Functions {
    of_patches: Vec<Vec<f64>>,
    images: Vec<Vec<f64>>,
    part_of: Vec<usize>,
}

impl Functions {
    /// The light after every number of bounces, separated by parts, as long as its new component weighs more
    /// than `least`.
    fn of(
        exchange: &(impl Exchange + ?Sized),
        part_of: &[usize],
        starts: &[Vec<f64>],
        least: f64,
    ) -> Result<Self> {
        let mut all = Self { of_patches: Vec::new(), images: Vec::new(), part_of: Vec::new() };
        let relative = |start: &Vec<f64>| cut(start, part_of, dot(start, start).sqrt().recip());
        let mut bounce: Vec<_> = starts.iter().flat_map(relative).collect();
        while !bounce.is_empty() {
            let mut next = Vec::new();
            for (part, mut light) in bounce {
                orthogonalise(&mut light, &all.of_patches);
                let weight = dot(&light, &light).sqrt();
                if weight <= least {
                    continue;
                }
                if all.of_patches.len() == FUNCTIONS_MAX {
                    let problem = "too many parts are lit differently; give vkernel a larger --tolerance";
                    return Err(Error::Numeric(problem.to_owned()));
                }
                light.iter_mut().for_each(|x| *x /= weight);
                let mut image = vec![0.0; light.len()];
                exchange.apply(&light, &mut image);
                next.extend(cut(&image, part_of, weight));
                all.of_patches.push(light);
                all.images.push(image);
                all.part_of.push(part);
            }
            bounce = next;
        }
        Ok(all)
    }

    /// Products of the functions with their images.
    fn exchange(&self) -> DMatrix<f64> {
        let count = self.images.len();
        let lower = DMatrix::from_fn(count, count, |i, j| {
            if i < j { 0.0 } else { dot(&self.of_patches[i], &self.images[j]) }
        });
        DMatrix::from_fn(count, count, |i, j| lower[(i.max(j), i.min(j))])
    }

    fn along(&self, x: &[f64]) -> DVector<f64> {
        DVector::from_iterator(self.of_patches.len(), self.of_patches.iter().map(|f| dot(f, x)))
    }

    /// Largest residual norm of (I − S)x = light among the lights, relative to each.
    fn residual(&self, starts: &[Vec<f64>]) -> Result<f64> {
        let count = self.images.len();
        let system = (DMatrix::identity(count, count) - self.exchange()).cholesky().ok_or_else(|| {
            Error::Numeric("no light escapes this surface: open it, or refine the mesh".to_owned())
        })?;
        let of_light = |start: &Vec<f64>| {
            let solution = system.solve(&self.along(start));
            let mut residual = start.clone();
            for ((f, image), x) in self.of_patches.iter().zip(&self.images).zip(&solution) {
                residual.iter_mut().zip(f).zip(image).for_each(|((r, f), image)| *r -= x * (f - image));
            }
            (dot(&residual, &residual) / dot(start, start)).sqrt()
        };
        Ok(starts.iter().map(of_light).fold(0.0, f64::max))
    }

    fn reduce(
        self,
        exchange: &(impl Exchange + ?Sized),
        starts: &[Vec<f64>],
        tolerance: f64,
    ) -> ReducedExchange {
        let lights: Vec<_> = starts.iter().map(|start| self.along(start)).collect();
        let means: Vec<_> =
            self.of_patches.iter().map(|f| DVector::from_vec(exchange.facet_means(f))).collect();
        ReducedExchange {
            exchange: self.exchange(),
            lights: DMatrix::from_columns(&lights),
            means: DMatrix::from_columns(&means),
            part_of: self.part_of,
            tolerance,
        }
    }
}

/// The restriction of `x`, times `scale`, to each part.
fn cut(x: &[f64], part_of: &[usize], scale: f64) -> Vec<(usize, Vec<f64>)> {
    let parts = part_of.iter().max().map_or(0, |last| last + 1);
    let on = |part| x.iter().zip(part_of).map(|(x, of)| if *of == part { scale * x } else { 0.0 }).collect();
    (0..parts).map(|part| (part, on(part))).collect()
}
