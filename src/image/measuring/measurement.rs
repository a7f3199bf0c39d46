//! What a photograph says about a facet or a patch.

use std::ops::Range;

/// What a photograph says about one facet.
#[derive(Debug, Clone, PartialEq)]
pub struct FacetMeasurement {
    /// Mean linear light per channel, 1 at the white level; none if no pixel is usable, more than 2 % are
    /// clipped or the facet reaches out of the picture.
    pub mean: Option<Vec<f64>>,
    /// Standard error of the mean per channel, from the spread about a plane; none if there are too few
    /// pixels to tell. It takes the noise of every pixel for its own: see
    /// [`FacetMeasurement::with_shared_noise`].
    pub standard_error: Option<Vec<f64>>,
    /// Usable pixels, of a mosaic those of all colours; a pixel shared among facets counts by the part of its
    /// area that lies in this one.
    pub pixels: f64,
    /// Pixels left out because a channel is clipped.
    pub clipped: usize,
    /// Pixels left out because a channel is not finite or the pixel is transparent.
    pub not_finite: usize,
    /// Pixels left out because they do not look like the rest of the facet: dust, specks.
    pub outliers: usize,
    /// Where the pixels are that were left out.
    pub left_out: Vec<PixelRun>,
}

/// Pixels beside each other.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PixelRun {
    /// Their columns.
    pub columns: Range<usize>,
    /// Their row.
    pub row: usize,
}

impl FacetMeasurement {
    /// Of no channels and no pixels.
    pub(super) const NOTHING: Self = Self {
        mean: Some(Vec::new()),
        standard_error: Some(Vec::new()),
        pixels: 0.0,
        clipped: 0,
        not_finite: 0,
        outliers: 0,
        left_out: Vec::new(),
    };

    /// Of a facet that the photograph does not show.
    #[must_use]
    pub fn unseen() -> Self {
        Self { mean: None, standard_error: None, ..Self::NOTHING }
    }

    /// The same with standard errors for noise that so many pixels share, per channel as
    /// [`pixels_sharing_noise`](super::pixels_sharing_noise) gives it.
    #[must_use]
    pub fn with_shared_noise(mut self, pixels: &[f64]) -> Self {
        for (error, pixels) in self.standard_error.iter_mut().flatten().zip(pixels) {
            *error *= pixels.sqrt();
        }
        self
    }

    /// Both measurements as one; where either lacks a number, so does the result.
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
