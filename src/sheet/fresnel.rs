//! Fresnel reflection of a smooth surface.

/// Refractive index of the surface.
const INDEX: f64 = 1.5;
/// Mean Fresnel reflectance at index 1.5 over cosine-weighted directions.
pub(super) const FRESNEL_MEAN: f64 = 0.091_777_959_342;

/// Reflectance of a smooth surface of index 1.5 in unpolarised light.
pub(super) fn fresnel(cos: f64) -> f64 {
    let g = (INDEX * INDEX - 1.0 + cos * cos).sqrt();
    let (minus, plus) = (g - cos, g + cos);
    let ratio = minus / plus;
    let other = (cos * plus - 1.0) / (cos * minus + 1.0);
    0.5 * ratio * ratio * (1.0 + other * other)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::quadrature::Rule;

    #[test]
    fn a_smooth_surface_reflects_what_its_index_says() {
        let mean: f64 = Rule::gauss_legendre(60).on(0.0, 1.0).map(|(c, w)| w * 2.0 * c * fresnel(c)).sum();
        assert!((mean - FRESNEL_MEAN).abs() < 1e-10, "{mean}");
        assert!((fresnel(1.0) - 0.04).abs() < 1e-15);
    }
}
