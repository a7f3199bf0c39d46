//! The bounces between facets, and the light they lead to.

use vfold::paper::{FacetOperator, FoldKernel};
use vfold::response::{ModeLight, Response};

/// The operator of a kernel whose patches are the facets.
pub fn operator(kernel: &FoldKernel) -> FacetOperator<'_> {
    FacetOperator::new(kernel, kernel.facets())
}

/// Irradiance of every facet of panel 0 under even light at reflectance `r`.
pub fn irradiance(response: &Response, r: f64) -> Vec<f64> {
    let even = ModeLight::Sun([1.0, 1.0]);
    (0..response.facets()).map(|facet| response.irradiance(0, facet, even, [r; 2])).collect()
}
