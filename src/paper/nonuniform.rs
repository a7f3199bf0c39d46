//! Sheets whose reflectance differs from facet to facet: eq. (24) as printed, with one flat patch per facet.
//!
//! The irradiance E of facets obeys `E = E₀ + K·R·E`. With S = √A·K·√A⁻¹, which is symmetric, and y = √R·√A·E
//! this is `(I − √R·S·√R)·y = √R·√A·E₀`: symmetric, positive definite, and well-defined for black facets.
//! Panels see each other but not themselves, `√R·S·√R = [0 G; Gᵀ 0]`, so eliminating panel 1 leaves `I −
//! G·Gᵀ`, which takes half as many iterations.

use nalgebra::{DMatrix, DVector, DVectorView};
use rayon::prelude::*;

use super::facets::FacetOperator;
use super::{FoldKernel, conjugate_gradients};
use crate::camera::CameraResponse;
use crate::error::{Error, Result};
use crate::forward::{Lighting, seen_bands};
use crate::response::{ModeLight, PanelOperator};
use crate::surfaces::Exchange;

/// Residual of the solution in a waveband, relative to the light.
const TOLERANCE: f64 = 1e-14;
/// Wavebands solved before they are summed, always in the same order.
const BATCH: usize = 16;

/// RGB of every facet at exposure 1, facet by channel, for a `reflectance` in [0, 1] for every facet and
/// waveband; facet order panel, row, column. Wavebands to which no sensor responds are skipped.
///
/// # Errors
/// [`Error::Numeric`] if the bounces in a waveband do not converge: a fold far narrower than 0.1°.
///
/// # Source
/// Deeb et al., eq. (24), that is eq. (15) in every waveband.
///
/// # Example
/// ```
/// use nalgebra::dmatrix;
/// use vfold::camera::CameraResponse;
/// use vfold::forward::Lighting;
/// use vfold::paper::{nonuniform, form_factors};
/// use vfold::geometry::{FacetGrid, Fold, Light};
/// // A white square beside a grey one at a right angle: each gets a fifth of what the other sends.
/// let fold = Fold::new(90.0, 1.0, 1.0, FacetGrid { rows: 1, cols: 1 })?;
/// let eye = CameraResponse::from_weights(vec![vec![1.0]]);
/// let lighting = Lighting { light: Light::new(&fold, 0.0, 0.0, 0.0)?, sun: eye.clone(), sky: eye };
/// let rgb = nonuniform::facet_rgb(&form_factors(&fold), &lighting, &dmatrix![1.0; 0.5])?;
/// let (direct, k) = (0.5_f64.sqrt(), 0.20004377607540316);
/// assert!((rgb[0] - direct * (1.0 + 0.5 * k) / (1.0 - 0.5 * k * k)).abs() < 1e-14);
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn facet_rgb(
    kernel: &FoldKernel,
    lighting: &Lighting,
    reflectance: &DMatrix<f64>,
) -> Result<DMatrix<f64>> {
    let operator = FacetOperator::new(kernel, kernel.facets());
    let sources: Vec<_> =
        lighting.sources().map(|(light, camera)| (direct(&operator, light), camera)).collect();
    let mut rgb = DMatrix::zeros(reflectance.nrows(), lighting.sun.channels());
    for bands in lighting.seen_bands().chunks(BATCH) {
        for (light, camera) in &sources {
            let exitance = |band: &usize| {
                Waveband::new(&operator, reflectance.column(*band)).exitance(light).map(|all| (*band, all))
            };
            for (band, exitance) in bands.par_iter().map(exitance).collect::<Result<Vec<_>>>()? {
                for (channel, mut values) in rgb.column_iter_mut().enumerate() {
                    values.axpy(camera.channel(channel)[band], &exitance, 1.0);
                }
            }
        }
    }
    Ok(rgb)
}

/// `√A·E₀` of both panels.
fn direct(operator: &FacetOperator, light: ModeLight) -> [DVector<f64>; 2] {
    let [even0, even1] = [0, 1].map(|panel| DVector::from_vec(operator.uniform(panel)));
    match light {
        ModeLight::Sun([sun0, sun1]) => [sun0 * even0, sun1 * even1],
        ModeLight::Sky(sky) => {
            let hidden = [(0, &even1), (1, &even0)].map(|(panel, facing)| apply(operator, panel, facing));
            let [hidden0, hidden1] = hidden;
            [sky * (even0 - hidden0), sky * (even1 - hidden1)]
        }
    }
}

/// Symmetrised irradiance on `panel` from exitance `x` of the other panel.
fn apply(operator: &FacetOperator, panel: usize, x: &DVector<f64>) -> DVector<f64> {
    let mut out = DVector::zeros(x.len());
    operator.apply(panel, x.as_slice(), out.as_mut_slice());
    out
}

/// The exchange between facets in one waveband.
struct Waveband<'a> {
    operator: &'a FacetOperator<'a>,
    /// Square roots of the reflectances on each panel.
    roots: [DVector<f64>; 2],
}

impl<'a> Waveband<'a> {
    fn new(operator: &'a FacetOperator<'a>, reflectance: DVectorView<f64>) -> Self {
        let half = reflectance.len() / 2;
        let roots = [0, half].map(|first| reflectance.rows(first, half).map(f64::sqrt));
        Self { operator, roots }
    }

    /// `G·x` on panel 0, `Gᵀ·x` on panel 1, where x belongs to the other panel.
    fn hand_on(&self, panel: usize, x: &DVector<f64>) -> DVector<f64> {
        apply(self.operator, panel, &x.component_mul(&self.roots[1 - panel]))
            .component_mul(&self.roots[panel])
    }

    /// Reflectance times irradiance of every facet in `direct` light, including all bounces.
    fn exitance(&self, direct: &[DVector<f64>; 2]) -> Result<DVector<f64>> {
        let [b0, b1] = [0, 1].map(|panel| self.roots[panel].component_mul(&direct[panel]));
        let right = b0 + self.hand_on(0, &b1);
        let product = |x: &DVector<f64>| x - self.hand_on(0, &self.hand_on(1, x));
        let y0 = conjugate_gradients(product, right, TOLERANCE).ok_or_else(|| {
            Error::Numeric("the bounces do not converge: the fold is too narrow".to_owned())
        })?;
        let y1 = b1 + self.hand_on(1, &y0);
        let of_facets = [(0, y0), (1, y1)].map(|(panel, y)| {
            self.operator.facet_means(panel, self.roots[panel].component_mul(&y).as_slice())
        });
        Ok(DVector::from_vec(of_facets.concat()))
    }
}

/// The same for any surface under `lights`, each with a direct irradiance per patch and the camera's response
/// to it.
///
/// # Errors
/// [`Error::Numeric`] if the bounces in a waveband do not converge.
///
/// # Example
/// ```
/// use nalgebra::dmatrix;
/// use vfold::camera::CameraResponse;
/// use vfold::paper::nonuniform;
/// use vfold::surfaces::DenseExchange;
/// // Two like patches hand half of their light to each other, and one is lit.
/// let exchange = DenseExchange::new(&dmatrix![0.0, 0.5; 0.5, 0.0], &[1.0, 1.0], vec![0, 1]);
/// let eye = CameraResponse::from_weights(vec![vec![1.0]]);
/// let rgb = nonuniform::surface_rgb(&exchange, &[(vec![1.0, 0.0], eye)], &dmatrix![1.0; 0.6])?;
/// assert!((rgb[0] - 1.0 / (1.0 - 0.6 * 0.25)).abs() < 1e-14);
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn surface_rgb(
    exchange: &(impl Exchange + ?Sized),
    lights: &[(Vec<f64>, CameraResponse)],
    reflectance: &DMatrix<f64>,
) -> Result<DMatrix<f64>> {
    let channels = lights.first().map_or(0, |(_, camera)| camera.channels());
    let mut rgb = DMatrix::zeros(reflectance.nrows(), channels);
    for (light, camera) in lights {
        let direct = DVector::from_vec(exchange.start(light));
        for bands in seen_bands(std::iter::once(camera)).chunks(BATCH) {
            let of = |band: &usize| {
                surface_exitance(exchange, &direct, reflectance.column(*band)).map(|all| (*band, all))
            };
            for (band, exitance) in bands.par_iter().map(of).collect::<Result<Vec<_>>>()? {
                for (channel, mut values) in rgb.column_iter_mut().enumerate() {
                    values.axpy(camera.channel(channel)[band], &exitance, 1.0);
                }
            }
        }
    }
    Ok(rgb)
}

/// Reflectance times irradiance of every facet of a surface, with one `reflectance` per facet.
fn surface_exitance(
    exchange: &(impl Exchange + ?Sized),
    direct: &DVector<f64>,
    reflectance: DVectorView<f64>,
) -> Result<DVector<f64>> {
    let of_patches = exchange.facet_of().iter().map(|facet| reflectance[*facet].sqrt());
    let roots = DVector::from_iterator(direct.len(), of_patches);
    let product = |x: &DVector<f64>| {
        let mut received = DVector::zeros(x.len());
        exchange.apply(x.component_mul(&roots).as_slice(), received.as_mut_slice());
        x - received.component_mul(&roots)
    };
    let y = conjugate_gradients(product, roots.component_mul(direct), TOLERANCE)
        .ok_or_else(|| Error::Numeric("the bounces do not converge: the surface is closed".to_owned()))?;
    Ok(DVector::from_vec(exchange.facet_means(roots.component_mul(&y).as_slice())))
}
