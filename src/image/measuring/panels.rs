//! Measurement of the panels of a sheet.

use super::facets::measure;
use super::measurement::FacetMeasurement;
use super::processing::{Processing, processing};
use super::rounding::with_rounding;
use super::shared_noise::pixels_sharing_noise;
use crate::error::Result;
use crate::image::photograph::Photograph;
use crate::image::placing::{Grid, Homography};

/// Measurement of panels.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredPanels {
    /// The facets from [`measure`], with rounding and noise shared by pixels added to their standard errors.
    pub facets: Vec<FacetMeasurement>,
    /// Number of neighbouring pixels per independent number, per channel.
    pub pixels_sharing_noise: Vec<f64>,
    /// Processing of the picture that its noise reveals.
    pub processing: Option<Processing>,
}

/// Measures all facets of one or more panels, and analyses their noise.
///
/// # Arguments
/// - `panels`, `margin_px`: as for [`measure`].
///
/// # Errors
/// As [`measure`].
///
/// # Example
/// ```
/// use vfold::image::{Grid, Homography, Photograph, Point, measure_panels};
/// let photograph = Photograph::from_light(40, 40, vec![0.5; 1600])?;
/// let corners = [(0., 0.), (40., 0.), (40., 40.), (0., 40.)].map(|(x, y)| Point::new(x, y));
/// let panel = Grid::even(Homography::from_unit_square(corners)?, [2, 2]);
/// let measured = measure_panels(&photograph, &[panel], 1.0)?;
/// assert!(measured.facets.iter().all(|facet| facet.mean == Some(vec![0.5])));
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn measure_panels(photograph: &Photograph, panels: &[Grid], margin_px: f64) -> Result<MeasuredPanels> {
    let outlines: Vec<Homography> = panels.iter().map(|panel| panel.outline.clone()).collect();
    let pixels_sharing_noise = pixels_sharing_noise(photograph, &outlines);
    let facets = measure(photograph, panels, margin_px)?;
    let processing = processing(photograph, panels, margin_px, &facets)?;
    let with_errors = |facet: FacetMeasurement| {
        with_rounding(facet.with_shared_noise(&pixels_sharing_noise), photograph.info())
    };
    let facets = facets.into_iter().map(with_errors).collect();
    Ok(MeasuredPanels { facets, pixels_sharing_noise, processing })
}
