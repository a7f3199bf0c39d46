//! Adds the rounding error of a JPEG to the errors of facets.
//!
//! In a JPEG, noise was smoothed away that would make the rounding errors of neighbouring pixels independent,
//! and a block of pixels is stored as a few waves, themselves rounded. So rounding shifts whole blocks, which
//! neither the scatter of pixels nor that of their means over smaller blocks reveals.

use super::measurement::FacetMeasurement;
use crate::image::photograph::PhotographInfo;

/// Pixels rounded together: most JPEGs store colours for two rows and columns at once, hence 16 x 16 (ITU-T
/// T.81, section A.1.1).
const ALIKE: f64 = 256.0;

/// A facet with the rounding error included in its standard errors, if the picture is a JPEG.
pub(super) fn with_rounding(facet: FacetMeasurement, info: &PhotographInfo) -> FacetMeasurement {
    let (Some(mean), Some(errors)) = (&facet.mean, &facet.standard_error) else { return facet };
    if !info.format.starts_with("JPEG") {
        return facet;
    }
    // rounding errors are uniformly distributed over plus and minus half a step
    let off = 1.0 / ((info.white_level[0] - info.black_level[0]) * 12_f64.sqrt());
    let of_stored = |light: f64| off * info.transfer_used.slope(light);
    let of_block = match (&info.undone, mean.as_slice()) {
        (Some(development), &[red, green, blue]) => {
            development.errors([red, green, blue], of_stored).to_vec()
        }
        _ => mean.iter().copied().map(of_stored).collect(),
    };
    let blocks = (facet.pixels / ALIKE).max(1.0);
    let both = |(error, of_block): (&f64, f64)| error.hypot(of_block / blocks.sqrt());
    let errors = errors.iter().zip(of_block).map(both).collect();
    FacetMeasurement { standard_error: Some(errors), ..facet }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::{CameraNotes, Transfer};

    fn facet() -> FacetMeasurement {
        FacetMeasurement {
            mean: Some(vec![0.214_041_140_482_232; 3]),
            standard_error: Some(vec![1e-3; 3]),
            pixels: 1024.0,
            ..FacetMeasurement::NOTHING
        }
    }

    fn info(format: &str) -> PhotographInfo {
        let new = PhotographInfo::new(CameraNotes::default(), (640, 480), format.to_owned());
        PhotographInfo { transfer_used: Transfer::Srgb, white_level: vec![255.0], ..new }
    }

    /// Halfway to white the curve of sRGB has a slope of 0.9256; four blocks halve 0.9256 / 255 / sqrt(12).
    #[test]
    fn blocks_are_rounded_alike() {
        let errors = with_rounding(facet(), &info("JPEG, 8-bit, RGB")).standard_error.unwrap();
        let want = (1e-6_f64 + (0.5_f64 * 0.925_583 / 255.0).powi(2) / 12.0_f64).sqrt();
        assert!(errors.iter().all(|error| (error - want).abs() < 1e-8), "{errors:?} {want}");
    }

    #[test]
    fn noise_of_other_pictures_is_rounded_at_random() {
        assert_eq!(with_rounding(facet(), &info("PNG, 8-bit, RGB")), facet());
    }
}
