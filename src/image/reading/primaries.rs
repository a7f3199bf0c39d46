//! Red, green, blue and white of a colour space, as CIE x and y.

/// The primaries of sRGB.
///
/// # Source
/// IEC 61966-2-1:1999, table 1.
pub(super) const SRGB: [[f64; 2]; 4] = [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06], [0.3127, 0.3290]];
/// Largest difference between equal primaries: writers round.
const SAME: f64 = 2e-3;

/// Whether red, green, blue and white equal those of sRGB.
pub(super) fn are_srgb(corners: &[[f64; 2]; 4]) -> bool {
    corners.as_flattened().iter().zip(SRGB.as_flattened()).all(|(got, want)| (got - want).abs() < SAME)
}
