//! Measurement of a facet or a patch.

use std::ops::Range;

/// Measurement of one facet.
#[derive(Debug, Clone, PartialEq)]
pub struct FacetMeasurement {
    /// Mean linear light per channel, 1 at the white level; none if no pixel is usable, more than 2 % are
    /// clipped or the facet extends beyond the picture.
    pub mean: Option<Vec<f64>>,
    /// Standard error of the mean per channel, from the scatter about a plane; none if pixels are too few. It
    /// assumes independent noise in each pixel: see [`FacetMeasurement::with_shared_noise`].
    pub standard_error: Option<Vec<f64>>,
    /// Usable pixels, of all colours in a mosaic; a pixel shared between facets counts by the fraction of its
    /// area in this one.
    pub pixels: f64,
    /// Pixels excluded because a channel is clipped.
    pub clipped: usize,
    /// Pixels excluded because a channel is not finite or the pixel is transparent.
    pub not_finite: usize,
    /// Pixels excluded because they differ from the rest of the facet: dust, specks.
    pub outliers: usize,
    /// Positions of the excluded pixels.
    pub left_out: Vec<PixelRun>,
}

/// Adjacent pixels in a row.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PixelRun {
    /// Their columns.
    pub columns: Range<usize>,
    /// Their row.
    pub row: usize,
}

impl FacetMeasurement {
    /// With no channels and no pixels.
    pub(super) const NOTHING: Self = Self {
        mean: Some(Vec::new()),
        standard_error: Some(Vec::new()),
        pixels: 0.0,
        clipped: 0,
        not_finite: 0,
        outliers: 0,
        left_out: Vec::new(),
    };

    /// For a facet outside the photograph.
    #[must_use]
    pub fn unseen() -> Self {
        Self { mean: None, standard_error: None, ..Self::NOTHING }
    }

    /// The same with standard errors for noise shared by this many pixels per channel, from
    /// [`pixels_sharing_noise`](super::pixels_sharing_noise).
    #[must_use]
    pub fn with_shared_noise(mut self, pixels: &[f64]) -> Self {
        for (error, pixels) in self.standard_error.iter_mut().flatten().zip(pixels) {
            *error *= pixels.sqrt();
        }
        self
    }

    /// Joins the channels of two measurements; what either lacks, the result lacks.
    pub(super) fn with_channels(self, others: Self) -> Self {
        let joined = |own: Option<Vec<f64>>, others: Option<Vec<f64>>| Some([own?, others?].concat());
        Self {
            mean: joined(self.mean, others.mean),
            standard_error: joined(self.standard_error, others.standard_error),
            pixels: self.pixels + others.pixels,
            clipped: self.clipped + others.clipped,
            not_finite: self.not_finite + others.not_finite,
            outliers: self.outliers + others.outliers,
            left_out: [self.left_out, others.left_out].concat(),
        }
    }
}
